// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Report of `reckon demo` at its end.
#pragma once

#include <cstdio>

#include "reckon/tools/exercise/exercise.hpp"

namespace reckon::tools {

/// Octets that a peer without dead reckoning would send every servo step: one Entity State and one
/// Attribute PDU with one force model, in one datagram.
inline constexpr double kRawOctets = 144 + 32 + 8 + 72;

/// Cost of a run.
struct DemoCost {
  double seconds = 0;
  double remote_seen = -1;
  double packets = 0, octets = 0, raw_packets = 0, raw_octets = 0;
  ServoReport servo;
  peer::Spread pose, force, possible_force;
  double energy_min = 0, late_cost = 0;
};

[[nodiscard]] DemoCost cost_of(const Exercise& exercise);

/// One line.
void print_demo_json(std::FILE* out, const DemoCost& cost, Exercise& exercise);
void print_demo_text(std::FILE* out, const DemoCost& cost, Exercise& exercise);

}  // namespace reckon::tools
