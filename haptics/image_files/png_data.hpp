// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Bounds the unpacked data of a PNG picture. libpng unpacks all of it, also what lies behind the
// last row: a file of 1 MB can hold 1 GB. Set-up code.
#pragma once

#include <string_view>

namespace reckon::haptics {

/// Unpacks the data chunks of a PNG file once, without keeping them, and stops where they exceed
/// the rows that its head states. 3 ns an octet of the rows. Damage is left to libpng.
/// @param bytes begin with the signature and a whole head
/// @throws std::invalid_argument with the fault and the remedy
void check_png_data(std::string_view bytes);

}  // namespace reckon::haptics
