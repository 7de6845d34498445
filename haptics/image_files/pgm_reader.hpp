// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Reads PGM pictures, as netpbm defines them: grey only, of 8 or 16 bits. Set-up code.
#pragma once

#include <string_view>

#include "reckon/haptics/image_files/image_file.hpp"

namespace reckon::haptics {

/// Whether the octets begin as a PGM file: "P2" (numbers as text) or "P5" (octets).
[[nodiscard]] bool is_pgm(std::string_view bytes) noexcept;

/// The first picture of a PGM file; black is 0, white the file's greatest value. Takes memory only
/// for pixels that the octets can hold.
/// @throws std::invalid_argument with the fault, its place and the remedy, without the file's name
[[nodiscard]] GreyImage read_pgm(std::string_view bytes);

}  // namespace reckon::haptics
