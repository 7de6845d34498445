// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Which peers are silent, and for how long this process itself was suspended.
#pragma once

#include <chrono>
#include <optional>

#include "reckon/aoim/presence/peer_table.hpp"
#include "reckon/aoim/presence/presence_config.hpp"
#include "reckon/aoim/presence/presence_event.hpp"

namespace reckon::aoim {

/// Times at which the peers were last received. They are checked only when the first time-out may
/// be due, not in each step. One thread; allocates nothing.
class Liveness {
 public:
  /// @param config, peers, events outlive this
  Liveness(const PresenceConfig& config, PeerTable& peers, PresenceEvents& events) noexcept
      : config_(config), peers_(peers), events_(events) {}

  /// Notes a call of this process. @return the time since the last call
  std::chrono::nanoseconds wake(std::chrono::nanoseconds now) noexcept;
  /// Time of the last call.
  [[nodiscard]] std::optional<std::chrono::nanoseconds> awake() const noexcept { return awake_; }
  /// This process was suspended for `slept`, which does not count as silence of others.
  void note_slept(std::chrono::nanoseconds slept, std::chrono::nanoseconds now) noexcept;

  /// A datagram of the peer was received.
  void note_heard(Peer& peer, std::chrono::nanoseconds now) noexcept;
  /// The peer has a new row, or another `last_heard`.
  void watch(const Peer& peer) noexcept;

  /// Whether a peer may be silent, so that all peers must be checked.
  [[nodiscard]] bool is_due(std::chrono::nanoseconds now) const noexcept {
    return look_ || now >= silent_at_;
  }
  /// Checks a peer; reports it as quiet or as received again. @return whether it has timed out
  [[nodiscard]] bool is_lost(Peer& peer, std::chrono::nanoseconds now);
  /// All peers have been checked.
  void watch_all() noexcept;

  /// Lower bound of the last receive times of all joined peers; may lag by some seconds.
  [[nodiscard]] std::chrono::nanoseconds heard_since() const noexcept { return heard_since_; }
  /// Earliest time-out; nanoseconds::max() without peers.
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
  bool look_ = false;  // a quiet peer may have been received
};

}  // namespace reckon::aoim
