// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/notation/simulation_names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>

namespace reckon::peer {
namespace {

std::string_view trimmed(std::string_view text) {
  const auto begin = text.find_first_not_of(' ');
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(' ') - begin + 1);
}

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

std::optional<std::vector<aoim::PeerId>> parse_simulations(std::string_view text) {
  std::vector<aoim::PeerId> names;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const auto simulation = simulation_of(trimmed(text.substr(begin, end - begin)));
    if (!simulation) return {};
    names.push_back(*simulation);
    begin = end + 1;
  }
  return names;
}

std::string simulations_text(const std::vector<aoim::PeerId>& names) {
  std::string text;
  for (const aoim::PeerId& one : names)
    text += fmt::format("{}{}:{}", text.empty() ? "" : ", ", one.site, one.application);
  return text;
}

}  // namespace reckon::peer
