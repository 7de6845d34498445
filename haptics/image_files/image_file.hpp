// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Reads a picture as a table of heights. Set-up code.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

namespace reckon::haptics {

/// Brightness of a picture, row by row from the top: 0 is black, 1 is white.
struct GreyImage {
  std::size_t width = 0, height = 0;  ///< [pixels]
  std::vector<float> pixels;
};

inline constexpr std::size_t kLeastPixels = 4;    ///< along each edge
inline constexpr std::size_t kMostPixels = 4096;  ///< along each edge

/// A PNG file of any depth and colour; what is transparent is black.
/// @throws std::invalid_argument naming the file, the fault and the remedy
[[nodiscard]] GreyImage read_image(const std::filesystem::path& file);

}  // namespace reckon::haptics
