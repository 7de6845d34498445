// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Datagrams that a stranger sends from its own address in the name of a host.
#pragma once

#include <vector>

#include "reckon/tests/fuzz/leaders/simulated_host.hpp"

namespace reckon::fuzz::leaders {

/// One datagram in the name of the host, and one with an epoch that was never announced.
[[nodiscard]] std::vector<Datagram> forged(const Fault& fault, const SimulatedHost& victim);

}  // namespace reckon::fuzz::leaders
