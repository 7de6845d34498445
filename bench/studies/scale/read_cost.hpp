// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What the kernel takes of this host for each datagram that a program waits for.
#pragma once

namespace reckon::bench {

/// CPU of a thread that blocks until a datagram of 1,000 octets comes over loopback, reads it and
/// blocks again [s], median of three runs of 0.2 s at 5,000 a second. For set-up.
/// @throws std::system_error where the host has no loopback
[[nodiscard]] double measure_read_cost();

}  // namespace reckon::bench
