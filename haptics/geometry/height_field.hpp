// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A solid whose upper side is a picture, as triangles. Set-up code.
#pragma once

#include <cstddef>

#include "reckon/haptics/geometry/mesh_repair.hpp"
#include "reckon/haptics/geometry/shape.hpp"
#include "reckon/haptics/image_files/image_file.hpp"

namespace reckon::haptics {

/// Of a picture that becomes a solid: two triangles each, some 600 octets at load.
inline constexpr std::size_t kMostFieldPixels = 1 << 20;

/// The picture of a solid.
/// @throws std::invalid_argument naming the file or the length, and the remedy: not readable, more
/// than kMostFieldPixels, a length out of its range
[[nodiscard]] GreyImage heights_of(const HeightsShape& shape);

/// Its length along y [m]: as stated, or of square pixels.
[[nodiscard]] double length_of(const HeightsShape& shape, const GreyImage& picture) noexcept;

/// At most so many pixels of it, evenly spread and with its border. For drawing.
[[nodiscard]] GreyImage thinned(const GreyImage& picture, std::size_t most_pixels);

/// The closed surface: two triangles between each four pixels, four walls, a bottom. Its vertices
/// stand over the middles of the pixels. Triangles are named "top", "side" and "bottom", as
/// materials.
/// @param picture of heights_of()
[[nodiscard]] TriangleSoup solid_of(const HeightsShape& shape, const GreyImage& picture);

}  // namespace reckon::haptics
