// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Identifies a peer: the first two numbers of each of its entities' IDs.
#pragma once

#include "reckon/pdu/codec/records.hpp"

namespace reckon::aoim {

/// DIS simulation address: site and application.
using PeerId = pdu::SimulationAddress;

}  // namespace reckon::aoim
