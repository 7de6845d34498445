// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A request for numbered parts.
#pragma once

#include <cstddef>
#include <cstdint>

namespace reckon::aoim {

/// Most parts that one request can name.
inline constexpr std::size_t kMostRequested = 64;

/// The requested parts.
struct PartRequest {
  std::size_t first = 0;    ///< first part in `parts`
  std::uint64_t parts = 0;  ///< bit i: part first + i
};

}  // namespace reckon::aoim
