// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Reads a picture as a table of heights. Set-up code.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string_view>
#include <vector>

namespace reckon::haptics {

/// Brightness of a picture, row by row from the top: 0 is black, 1 is white.
struct GreyImage {
  std::size_t width = 0, height = 0;  ///< [pixels]
  std::vector<float> pixels;
};

inline constexpr std::size_t kLeastPixels = 4;    ///< along each edge
inline constexpr std::size_t kMostPixels = 4096;  ///< along each edge
/// Greatest size of a file [octets]: more than any picture of kMostPixels needs.
inline constexpr std::size_t kMostImageOctets = 192 << 20;

/// @throws std::invalid_argument if a picture is too small or too large, or exceeds the pixel
/// budget of a scene
void check_pixels(std::size_t width, std::size_t height);

/// Decodes a PNG file of any depth and colour, or a PGM file (P2 or P5) of 8 or 16 bits. The first
/// octets decide which. Transparent pixels become black. The pixels are charged to LoadBudget
/// before memory is taken for them.
/// @throws std::invalid_argument with the fault and the remedy
[[nodiscard]] GreyImage decode_image(std::string_view bytes);

/// The same from a file.
/// @throws std::invalid_argument naming the file, the fault and the remedy
[[nodiscard]] GreyImage read_image(const std::filesystem::path& file);

}  // namespace reckon::haptics
