// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Bounds the unpacked data of a PNG picture. libpng unpacks all data, even after the last row: a
// file of 1 MB can hold 1 GB. Set-up code.
#pragma once

#include <string_view>

namespace reckon::haptics {

/// Unpacks the data chunks of a PNG file once, without storing them, and fails if they exceed the
/// rows declared in its header. 3 ns per octet of the rows. Damage is left to libpng.
/// @param bytes begin with the signature and a complete header
/// @throws std::invalid_argument with the fault and the remedy
void check_png_data(std::string_view bytes);

}  // namespace reckon::haptics
