// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// CPU time that this host needs to receive a datagram.
#pragma once

namespace reckon::bench {

/// CPU time per datagram [s] of a thread that blocks until a datagram of 1,000 octets arrives over
/// loopback, reads it and blocks again: median of three runs of 0.2 s at 5,000 a second.
/// For set-up. @throws std::system_error if a socket on loopback fails
[[nodiscard]] double measure_read_cost();

}  // namespace reckon::bench
