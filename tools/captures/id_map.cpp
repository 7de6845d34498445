// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/captures/id_map.hpp"

#include <fmt/format.h>

#include <string_view>

#include "reckon/tools/captures/number_list.hpp"
#include "reckon/tools/command_line/console.hpp"

namespace reckon::tools {
namespace {

constexpr std::uint16_t kAllSites = 0xFFFF;

}  // namespace

IdMap::IdMap(const std::vector<std::string>& rules) {
  for (const std::string& text : rules) rules_.push_back(parse(text));
}

std::optional<IdMap::Pattern> IdMap::pattern_of(std::string_view text) {
  const auto words = parts_of(text, ':');
  Pattern pattern;
  if (words.size() != pattern.size()) return std::nullopt;
  for (std::size_t i = 0; i < pattern.size(); ++i) {
    if (words[i] == "*") continue;
    pattern[i] = number_of<std::uint16_t>(words[i]);
    if (!pattern[i].has_value()) return std::nullopt;
  }
  return pattern;
}

IdMap::Rule IdMap::parse(const std::string& text) {
  const auto words = parts_of(text, '=');
  const auto from = pattern_of(words.front());
  const auto to = pattern_of(words.back());
  if (words.size() != 2 || !from.has_value() || !to.has_value())
    throw UsageError(
        fmt::format("--map-id {}: write FROM=TO as site:application:entity, each 0 to 65535 or *, "
                    "for example 1:2:*=9:2:*",
                    text));
  if (!(*from)[2].has_value() && (*to)[2].has_value())
    throw UsageError(fmt::format(
        "--map-id {}: this would merge all entities; write * for the entity on the right too",
        text));
  return {*from, *to};
}

bool IdMap::matches(const Rule& rule, const pdu::EntityId& id) {
  if (id == pdu::EntityId{}) return false;
  const std::array<std::uint16_t, 3> parts{id.site, id.application, id.entity};
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const bool is_all = i < 2 && parts[i] == kAllSites;
    if (rule.from[i].has_value() ? *rule.from[i] != parts[i] : is_all) return false;
  }
  return true;
}

pdu::EntityId IdMap::operator()(const pdu::EntityId& id) const {
  for (const Rule& rule : rules_) {
    if (!matches(rule, id)) continue;
    return {rule.to[0].value_or(id.site), rule.to[1].value_or(id.application),
            rule.to[2].value_or(id.entity)};
  }
  return id;
}

pdu::SimulationAddress IdMap::operator()(const pdu::SimulationAddress& address) const {
  if (address == pdu::SimulationAddress{}) return address;
  for (const Rule& rule : rules_) {
    if (rule.from[2].has_value() || !matches(rule, {address.site, address.application, 1}))
      continue;
    return {rule.to[0].value_or(address.site), rule.to[1].value_or(address.application)};
  }
  return address;
}

}  // namespace reckon::tools
