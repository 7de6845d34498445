// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/notation/beacon_names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace reckon::peer {
namespace {

bool is_letter_of_name(char letter) noexcept {
  return (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') ||
         (letter >= '0' && letter <= '9') || letter == '-' || letter == '_' || letter == '.';
}

}  // namespace

bool is_beacon_name(std::string_view name) noexcept {
  return !name.empty() && name.size() <= kLongestBeacon &&
         std::all_of(name.begin(), name.end(), is_letter_of_name);
}

std::vector<std::string> beacon_names(std::string_view list) {
  std::vector<std::string> names;
  for (std::size_t at = 0; !list.empty() && at <= list.size();) {
    const std::size_t comma = std::min(list.find(',', at), list.size());
    std::string name(list.substr(at, comma - at));
    name.erase(0, name.find_first_not_of(' '));
    name.erase(name.find_last_not_of(' ') + 1);
    if (!is_beacon_name(name)) {
      throw std::invalid_argument(
          fmt::format("\"{}\" is not a beacon name: use 1 to {} letters, digits, '-', '_' or '.'",
                      name, kLongestBeacon));
    }
    if (std::find(names.begin(), names.end(), name) != names.end())
      throw std::invalid_argument(fmt::format("\"{}\" occurs twice: keep one", name));
    names.push_back(std::move(name));
    at = comma + 1;
  }
  if (names.size() > kMostFollowed) {
    throw std::invalid_argument(
        fmt::format("{} beacons are more than {}: remove some", names.size(), kMostFollowed));
  }
  return names;
}

}  // namespace reckon::peer
