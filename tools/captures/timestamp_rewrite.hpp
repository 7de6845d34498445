// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Updates recorded PDUs so that they appear to be sent now.
#pragma once

#include <chrono>
#include <cstddef>
#include <span>

namespace reckon::tools {

/// Sets the timestamp of every whole PDU of a datagram to `utc` (since 1970-01-01); its absolute
/// bit stays. The send time of a datagram trailer follows. Broken PDUs stay unchanged.
void rewrite_timestamps(std::span<std::byte> datagram, std::chrono::nanoseconds utc) noexcept;

}  // namespace reckon::tools
