// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/command_line/size_text.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>

namespace reckon::tools {
namespace {

struct Unit {
  std::string_view name;
  double octets;
};

constexpr std::array kUnits{Unit{"", 1},        Unit{"B", 1},        Unit{"k", 1e3},
                            Unit{"kB", 1e3},    Unit{"K", 1e3},      Unit{"KB", 1e3},
                            Unit{"M", 1e6},     Unit{"MB", 1e6},     Unit{"G", 1e9},
                            Unit{"GB", 1e9},    Unit{"KiB", 1024.0}, Unit{"MiB", 1048576.0},
                            Unit{"GiB", 0x1p30}};

}  // namespace

std::optional<std::uint64_t> parse_size(std::string_view text) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{}) return std::nullopt;
  std::string_view unit(end, static_cast<std::size_t>(text.data() + text.size() - end));
  while (unit.starts_with(' ')) unit.remove_prefix(1);
  for (const Unit& known : kUnits) {
    const double octets = number * known.octets;
    if (unit == known.name && octets >= 1 && octets <= 0x1p53)
      return static_cast<std::uint64_t>(octets);
  }
  return std::nullopt;
}

std::string size_text(std::uint64_t octets) {
  const auto count = static_cast<double>(octets);
  if (count >= 1e9) return fmt::format("{:.4g} GB", count / 1e9);
  if (count >= 1e6) return fmt::format("{:.4g} MB", count / 1e6);
  if (count >= 1e3) return fmt::format("{:.4g} kB", count / 1e3);
  return fmt::format("{} B", octets);
}

}  // namespace reckon::tools
