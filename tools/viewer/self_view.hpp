// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A program that runs peers and serves their page itself: it hears on the network what they say, as
// anybody else would, and shows its own hands from what their servos publish. No loop of a peer is
// asked for anything.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
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

/// What a program is.
struct SelfViewOptions {
  std::string_view kind;     ///< "demo" or "peer"
  std::string source;        ///< its scene, as named
  std::string iface;         ///< on which its peers speak; empty: the scene's, else chosen by rule
  double raw_bit_per_s = 0;  ///< that it would send without dead reckoning; 0: not known
  bool knows_all = false;    ///< all hands of the exercise are its own
  ViewerControls* controls = nullptr;  ///< outlives it; null: pages only look
};

/// One thread: that which looks at the peers.
class SelfView {
 public:
  /// How often hands are looked at.
  static constexpr std::chrono::nanoseconds kLookEvery = std::chrono::milliseconds(33);

  /// Serves from now on. @param hands of the program, as of now
  /// @throws EnvironmentError where the network or the port cannot be used
  SelfView(const ViewFlags& flags, const peer::SceneFile& scene, const SelfViewOptions& options,
           OwnHands hands);

  /// To be changed by what is new, then shown.
  [[nodiscard]] OwnHands& hands() noexcept { return hands_; }
  void show_hands();
  /// From now on show_hands() shows how this peer receives others, too. @param peer outlives it
  void add_receiver(const peer::Peer& peer) { reception_.add(peer); }
  /// A line for the pages' log.
  void note(std::string_view text) { thread_->put_note("info", std::string(text)); }
  /// What a user opens.
  [[nodiscard]] const std::string& address() const noexcept { return thread_->address(); }
  /// By which users of other hosts open it; none where it serves this host alone.
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
