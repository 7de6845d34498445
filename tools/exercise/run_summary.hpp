// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What a run as one peer of a LAN cost, reported at its end.
#pragma once

#include <cstdio>
#include <span>
#include <string>

#include "reckon/peer/counters/counters.hpp"
#include "reckon/peer/peer.hpp"
#include "reckon/peer/peer_threads.hpp"

namespace reckon::tools {

/// A run that is over: nothing may change any more.
struct FinishedRun {
  peer::Peer& peer;
  const peer::PeerThreads& threads;
  double seconds = 0;  ///< how long it ran
};

/// One JSON object on one line; docs/json_lines.md has its keys.
void print_run_json(std::FILE* out, const FinishedRun& run);
/// The same for a person.
void print_run_text(std::FILE* out, const FinishedRun& run);

/// The walls that peers ran into, one line each, with the count of the peer that ran into it most:
/// hands that were not felt, a full table, full rings. Nothing where there were none.
void print_walls(std::FILE* out, std::span<const peer::Counters* const> peers);
/// The same as members of a JSON object, a comma before each.
[[nodiscard]] std::string walls_json(std::span<const peer::Counters* const> peers);

}  // namespace reckon::tools
