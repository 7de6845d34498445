// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Reads the golden samples of tests/support/wire_samples: octets in hexadecimal; '#' starts a
// comment.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/tests/support/places.hpp"

namespace reckon::test {

inline std::vector<std::byte> octets_from_hex(std::string_view hex) {
  std::vector<std::byte> octets;
  std::string digits;
  for (const char c : hex) {
    if (c == ' ' || c == '\n') continue;
    digits += c;
    if (digits.size() < 2) continue;
    octets.push_back(static_cast<std::byte>(std::stoul(digits, nullptr, 16)));
    digits.clear();
  }
  return octets;
}

inline std::filesystem::path sample_path(std::string_view name, std::string_view extension) {
  return std::filesystem::path(test::source_dir()) / "tests/support/wire_samples" /
         (std::string(name) + std::string(extension));
}

inline std::ifstream open_sample(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("no golden sample " + path.string());
  return file;
}

inline std::vector<std::byte> sample_octets(std::string_view name) {
  std::ifstream file = open_sample(sample_path(name, ".hex"));
  std::string hex;
  for (std::string line; std::getline(file, line);) hex += line.substr(0, line.find('#'));
  return octets_from_hex(hex);
}

/// Writes whole numbers that a double cannot hold as text, as in our JSON.
inline void write_large_numbers_as_text(nlohmann::json& values) {
  constexpr std::uint64_t kMostExact = std::uint64_t{1} << 53;
  if (values.is_number_unsigned() && values.get<std::uint64_t>() > kMostExact)
    values = std::to_string(values.get<std::uint64_t>());
  if (values.is_structured())
    for (auto& item : values) write_large_numbers_as_text(item);
}

inline nlohmann::json sample_values(std::string_view name) {
  nlohmann::json values = nlohmann::json::parse(open_sample(sample_path(name, ".json")));
  write_large_numbers_as_text(values);
  return values;
}

}  // namespace reckon::test
