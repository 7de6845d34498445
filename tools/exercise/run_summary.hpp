// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Report of a single peer at the end of its run on a LAN.
#pragma once

#include <cstdio>
#include <span>
#include <string>

#include "reckon/peer/counters/counters.hpp"
#include "reckon/peer/peer.hpp"
#include "reckon/peer/peer_threads.hpp"

namespace reckon::tools {

/// A finished run: nothing may change any more.
struct FinishedRun {
  peer::Peer& peer;
  const peer::PeerThreads& threads;
  double seconds = 0;  ///< how long it ran
};

/// One JSON object on one line; docs/json_lines.md lists its keys.
void print_run_json(std::FILE* out, const FinishedRun& run);
/// The same as text.
void print_run_text(std::FILE* out, const FinishedRun& run);

/// The limits that peers reached, one line each, with the largest count of any peer: hands that
/// were not felt, a full table, full rings. Nothing if no limit was reached.
void print_walls(std::FILE* out, std::span<const peer::Counters* const> peers);
/// The same as members of a JSON object, each with a comma before it.
[[nodiscard]] std::string walls_json(std::span<const peer::Counters* const> peers);

}  // namespace reckon::tools
