// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Serves the page of a program that runs peers. It receives their datagrams from the network like
// any listener, and shows the program's hands from the snapshots of their servos. It puts no load
// on the loops of the peers.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/tools/command_line/console.hpp"
#include "reckon/tools/viewer/own_hands.hpp"
#include "reckon/tools/viewer/peers_reception.hpp"
#include "reckon/tools/viewer/view_flags.hpp"
#include "reckon/tools/viewer/viewing.hpp"

namespace reckon::tools {

/// Properties of the program.
struct SelfViewOptions {
  std::string_view kind;     ///< "demo" or "peer"
  std::string source;        ///< its scene, as named by the user
  std::string iface;         ///< interface of its peers; empty: the scene's, else chosen by rule
  double raw_bit_per_s = 0;  ///< rate without dead reckoning; 0: unknown
  bool knows_all = false;    ///< all hands of the exercise belong to the program
  ViewerControls* controls = nullptr;  ///< outlives the view; null: pages cannot change anything
};

/// One thread, the reader of the peers' views.
class SelfView {
 public:
  /// Interval between readings of the hands.
  static constexpr std::chrono::nanoseconds kLookEvery = std::chrono::milliseconds(33);

  /// Starts to serve. @param hands of the program, as of now
  /// @throws EnvironmentError if the network or the port cannot be used
  SelfView(const ViewFlags& flags, const peer::SceneFile& scene, const SelfViewOptions& options,
           OwnHands hands);

  /// Update these with new snapshots, then call show_hands().
  [[nodiscard]] OwnHands& hands() noexcept { return hands_; }
  void show_hands();
  /// From now on show_hands() shows the reception statistics of `peer` too. @param peer outlives it
  void add_receiver(const peer::Peer& peer) { reception_.add(peer); }
  /// Adds a line to the pages' log.
  void note(std::string_view text) { thread_->put_note("info", std::string(text)); }
  /// URL for this user.
  [[nodiscard]] const std::string& address() const noexcept { return thread_->address(); }
  /// URLs for users of other hosts; none if it serves this host only.
  [[nodiscard]] const std::vector<std::string>& addresses_for_others() const noexcept {
    return thread_->addresses_for_others();
  }

 private:
  peer::SteadyClock clock_;
  bool knows_all_;
  OwnHands hands_;
  PeersReception reception_;
  std::unique_ptr<ViewThread> thread_;
};

}  // namespace reckon::tools
