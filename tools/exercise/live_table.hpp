// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The table that demo and peer show while they run: one line a hand, one line a remote entity, as
// many as the terminal has room for.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "reckon/peer/counters/counters.hpp"
#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/peer/world/peer_view.hpp"
#include "reckon/tools/terminal/screen_line.hpp"

namespace reckon::tools {

/// One peer as the table shows it.
struct TablePeer {
  const peer::PeerView* view;
  const peer::Counters* counters;
};

/// Everything that the table shows.
struct LivePicture {
  std::span<const TablePeer> peers;
  const peer::SceneFile& scene;
  double elapsed = 0;                    ///< [s]
  std::span<const std::string> notices;  ///< the newest last
  double strongest = 1;                  ///< [N], of forces that bars are compared with
  std::string head;                      ///< ASCII, below the title; empty: none
};

/// The whole screen: exactly `size.rows` lines of at most `size.columns` columns. What does not fit
/// in width are the columns of least use. Behind the force of a hand is a bar: what is left over of
/// the width makes it longer. Every peer has a line of its own, the rest of the lines
/// is shared among them; of its remote entities a peer shows the nearest, in the order of their
/// IDs, and says how many there are more.
[[nodiscard]] std::vector<ScreenLine> live_lines(const LivePicture& picture, ScreenSize size);

/// The same in one line, for where no terminal can show a screen.
[[nodiscard]] std::string live_status(const LivePicture& picture);

}  // namespace reckon::tools
