// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Makes triangles of a solid whose upper side is a picture. Set-up code.
#pragma once

#include <cstddef>

#include "reckon/haptics/geometry/mesh_repair.hpp"
#include "reckon/haptics/geometry/shape.hpp"
#include "reckon/haptics/image_files/image_file.hpp"

namespace reckon::haptics {

/// Greatest size of a picture for a solid: two triangles for each pixel, about 600 octets at load.
inline constexpr std::size_t kMostFieldPixels = 1 << 20;

/// The picture of a solid.
/// @throws std::invalid_argument naming the file or the length, and the remedy: not readable, more
/// than kMostFieldPixels, a length out of its range
[[nodiscard]] GreyImage heights_of(const HeightsShape& shape);

/// Length of the shape along y [m]: as stated, or for square pixels.
[[nodiscard]] double length_of(const HeightsShape& shape, const GreyImage& picture) noexcept;

/// A picture of at most `most_pixels` pixels, evenly spread and with the border of `picture`. For
/// drawing.
[[nodiscard]] GreyImage thinned(const GreyImage& picture, std::size_t most_pixels);

/// The closed surface: two triangles between each four pixels, four walls, a bottom. Its vertices
/// are above the centers of the pixels. Triangles are named "top", "side" and "bottom", as
/// materials.
/// @param picture of heights_of()
[[nodiscard]] TriangleSoup solid_of(const HeightsShape& shape, const GreyImage& picture);

}  // namespace reckon::haptics
