// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Who is silent, and for how long this process itself stood still.
#pragma once

#include <chrono>
#include <optional>

#include "reckon/aoim/presence/peer_table.hpp"
#include "reckon/aoim/presence/presence_config.hpp"
#include "reckon/aoim/presence/presence_event.hpp"

namespace reckon::aoim {

/// Times at which the peers were heard last. All are looked at when the first of them may have been
/// silent for long, not in each step. One thread; allocates nothing.
class Liveness {
 public:
  /// @param config, peers, events outlive this
  Liveness(const PresenceConfig& config, PeerTable& peers, PresenceEvents& events) noexcept
      : config_(config), peers_(peers), events_(events) {}

  /// We are called. @return how long ago the last call was
  std::chrono::nanoseconds wake(std::chrono::nanoseconds now) noexcept;
  /// When we were last called.
  [[nodiscard]] std::optional<std::chrono::nanoseconds> awake() const noexcept { return awake_; }
  /// This process stood still for `slept`: nobody could be heard, so nobody was silent meanwhile.
  void note_slept(std::chrono::nanoseconds slept, std::chrono::nanoseconds now) noexcept;

  /// The peer has been heard.
  void note_heard(Peer& peer, std::chrono::nanoseconds now) noexcept;
  /// The peer has a new row, or another `last_heard`.
  void watch(const Peer& peer) noexcept;

  /// Whether somebody may be silent: each peer is to be looked at.
  [[nodiscard]] bool is_due(std::chrono::nanoseconds now) const noexcept {
    return look_ || now >= silent_at_;
  }
  /// Reports the peer as quiet, or heard again. @return whether it is lost
  [[nodiscard]] bool is_lost(Peer& peer, std::chrono::nanoseconds now);
  /// Each has been looked at.
  void watch_all() noexcept;

  /// No joined peer was heard last before this: a bound, which may lag behind by some seconds.
  [[nodiscard]] std::chrono::nanoseconds heard_since() const noexcept { return heard_since_; }
  /// Nobody is silent for too long before; duration max where there is no peer.
  [[nodiscard]] std::chrono::nanoseconds next_step() const noexcept { return silent_at_; }

 private:
  using Nanoseconds = std::chrono::nanoseconds;
  [[nodiscard]] Nanoseconds silence_due(const Peer& peer) const noexcept;

  const PresenceConfig& config_;
  PeerTable& peers_;
  PresenceEvents& events_;
  std::optional<Nanoseconds> awake_;
  Nanoseconds silent_at_ = Nanoseconds::max();
  Nanoseconds heard_since_ = Nanoseconds::max();
  bool look_ = false;  // one that was quiet may have been heard
};

}  // namespace reckon::aoim
