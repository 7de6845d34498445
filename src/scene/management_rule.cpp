// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/scene/management_rule.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace reckon::peer {
namespace {

std::string_view trimmed(std::string_view text) {
  const auto begin = text.find_first_not_of(' ');
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(' ') - begin + 1);
}

// 0 and 65535 name no simulation.
std::optional<std::uint16_t> number_of(std::string_view text) {
  std::uint16_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return {};
  return number == 0 || number == 0xFFFF ? std::nullopt : std::optional(number);
}

std::optional<aoim::PeerId> simulation_of(std::string_view text) {
  const auto colon = text.find(':');
  if (colon == std::string_view::npos) return {};
  const auto site = number_of(text.substr(0, colon));
  const auto application = number_of(text.substr(colon + 1));
  if (!site || !application) return {};
  return aoim::PeerId{*site, *application};
}

}  // namespace

std::optional<ManagementRule> ManagementRule::parse(std::string_view text) {
  ManagementRule rule;
  if (text == "nobody") return rule;
  rule.who_ = text == "members" ? Who::members : text == "anyone" ? Who::anyone : Who::named;
  if (rule.who_ != Who::named) return rule;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const auto simulation = simulation_of(trimmed(text.substr(begin, end - begin)));
    if (!simulation) return {};
    rule.named_.push_back(*simulation);
    begin = end + 1;
  }
  return rule;
}

std::string ManagementRule::text() const {
  if (who_ == Who::nobody) return "nobody";
  if (who_ == Who::members) return "members";
  if (who_ == Who::anyone) return "anyone";
  std::string text;
  for (const aoim::PeerId& one : named_)
    text += fmt::format("{}{}:{}", text.empty() ? "" : ", ", one.site, one.application);
  return text;
}

bool ManagementRule::allows(const aoim::PeerId& originator, bool member) const noexcept {
  if (who_ == Who::named) return std::ranges::find(named_, originator) != named_.end();
  return who_ == Who::anyone || (who_ == Who::members && member);
}

}  // namespace reckon::peer
