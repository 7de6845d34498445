// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Recorded PDUs made to look as if they were sent now.
#pragma once

#include <chrono>
#include <cstddef>
#include <span>

namespace reckon::tools {

/// Sets the timestamp of every whole PDU of a datagram to `utc` (since 1970-01-01); whether it
/// counts as absolute stays as it was. The send time of a datagram trailer follows. What is broken
/// stays as it is.
void rewrite_timestamps(std::span<std::byte> datagram, std::chrono::nanoseconds utc) noexcept;

}  // namespace reckon::tools
