// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The fixed octets of an Entity State, as a listener keeps them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace reckon::tools {

/// An Entity State PDU without its variable parameters.
inline constexpr std::size_t kFixedOctets = 144;
using FixedOctets = std::array<std::byte, kFixedOctets>;

/// The timestamp field.
[[nodiscard]] inline std::uint32_t timestamp_of(const FixedOctets& octets) noexcept {
  std::uint32_t value = 0;
  for (std::size_t i = 4; i < 8; ++i)
    value = value << 8 | std::to_integer<std::uint32_t>(octets[i]);
  return value;
}

}  // namespace reckon::tools
