// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The UDP endpoints of the programs of this host, as the kernel lists them for any user.
#pragma once

#include <istream>
#include <vector>

#include "reckon/peer/network/link.hpp"

namespace reckon::peer {

/// Reads a table of UDP sockets (/proc/net/udp, /proc/net/udp6). Returns the address and port to
/// which each socket is bound, without duplicates, in the order of the table. Skips lines of
/// another form.
[[nodiscard]] std::vector<IpEndpoint> read_bound_endpoints(std::istream& table, bool ipv6);

/// The endpoints of this host's network namespace; empty if the kernel does not list them.
[[nodiscard]] std::vector<IpEndpoint> bound_endpoints(bool ipv6);

}  // namespace reckon::peer
