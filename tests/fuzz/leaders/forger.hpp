// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What a stranger says, from an address of its own, in the name of a host.
#pragma once

#include <vector>

#include "reckon/tests/fuzz/leaders/simulated_host.hpp"

namespace reckon::fuzz::leaders {

/// Once in the name of the host, and once as a life that nobody has announced.
[[nodiscard]] std::vector<Datagram> forged(const Fault& fault, const SimulatedHost& victim);

}  // namespace reckon::fuzz::leaders
