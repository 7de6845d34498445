// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The table of demo and peer during a run: one line for each hand and each remote entity, as far as
// they fit the terminal.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "reckon/peer/counters/counters.hpp"
#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/peer/world/peer_view.hpp"
#include "reckon/tools/terminal/screen_line.hpp"

namespace reckon::tools {

/// A peer as the table shows it.
struct TablePeer {
  const peer::PeerView* view;
  const peer::Counters* counters;
};

/// All input of the table.
struct LivePicture {
  std::span<const TablePeer> peers;
  const peer::SceneFile& scene;
  double elapsed = 0;                    ///< [s]
  std::span<const std::string> notices;  ///< the newest last
  double strongest = 1;                  ///< [N], greatest force so far; scales the bars
  std::string head;                      ///< ASCII, below the title; empty: none
};

/// The whole screen: exactly `size.rows` lines of at most `size.columns` columns. Columns of the
/// greatest rank are dropped if the terminal is too narrow. Remaining width extends the bar after
/// the force of a hand. Every peer has its own line; the peers share the other lines. A peer lists
/// its nearest remote entities, in the order of their IDs, and the number of hidden ones.
[[nodiscard]] std::vector<ScreenLine> live_lines(const LivePicture& picture, ScreenSize size);

/// A one-line summary for output that cannot show a screen.
[[nodiscard]] std::string live_status(const LivePicture& picture);

}  // namespace reckon::tools
