// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The metrics of a running peer.
#pragma once

#include <string>

#include "reckon/peer/peer.hpp"
#include "reckon/peer/peer_threads.hpp"
#include "reckon/peer/world/peer_view.hpp"

namespace reckon::tools {

/// The counters of the peer and of its link, and values from its newest view and its loops, as
/// OpenMetrics text. Allocates; for the thread that reads the peer's views.
/// @param seconds since the start
[[nodiscard]] std::string peer_metrics(peer::Peer& peer, const peer::PeerThreads& threads,
                                       const peer::PeerView& view, double seconds);

}  // namespace reckon::tools
