// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The table that demo and peer show while they run: one block a peer, one row a remote entity.
#pragma once

#include <span>
#include <string>

#include "reckon/peer/counters/counters.hpp"
#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/peer/world/peer_view.hpp"
#include "reckon/tools/command_line/console.hpp"

namespace reckon::tools {

/// One peer as the table shows it.
struct TablePeer {
  const peer::PeerView* view;
  const peer::Counters* counters;
};

/// The whole table as text, lines ended by '\n'. `elapsed` [s].
[[nodiscard]] std::string live_table(std::span<const TablePeer> peers, const peer::SceneFile& scene,
                                     double elapsed);

/// Shows the table over and over in place on a terminal; says nothing elsewhere.
class TableScreen {
 public:
  explicit TableScreen(const Console& console);
  /// Overwrites what was shown before.
  void show(const std::string& table);
  /// Whether a table is shown at all.
  [[nodiscard]] bool active() const { return active_; }

 private:
  const Console& console_;
  bool active_;
  int lines_ = 0;
};

}  // namespace reckon::tools
