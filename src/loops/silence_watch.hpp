// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Handles silent peers: their entities are stopped and lose their force long before they are
// dropped, and resume when the peer is received again. Part of the model loop.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <span>
#include <vector>

#include "reckon/aoim/presence/presence.hpp"
#include "reckon/haptics/exchange/spsc_ring.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/peer/counters/counters.hpp"
#include "reckon/peer/loops/notice.hpp"
#include "reckon/peer/world/remote_entities.hpp"

namespace reckon::peer {

/// A remote entity in contact with a hand of ours.
struct Touched {
  pdu::EntityId id;
  std::chrono::nanoseconds since{0};
};

/// Doubts a peer by the time since its last datagram of any kind. A touched body without a hand, or
/// of a plain DIS program, fades out without updates of its own. Other entities of plain DIS
/// programs are trusted until their time-out. One thread; allocates only at construction; some ns
/// for each peer.
class SilenceWatch {
 public:
  /// A peer announces itself each second: it is doubted after two lost announcements.
  static constexpr std::chrono::nanoseconds kPatience = std::chrono::milliseconds(2500);
  /// The owner of a touched hand or body sends every 60 ms, so ten updates are lost after this
  /// time. An owner that was silent before the touch began may not be aware of it yet: it gets
  /// twice the time from then on.
  static constexpr std::chrono::nanoseconds kContactPatience = std::chrono::milliseconds(650);
  /// The same for a plain DIS program, from the first touch of any of its bodies after its host's
  /// last datagram: with the fade of 100 ms, half the force is gone after 0.5 s.
  static constexpr std::chrono::nanoseconds kGuestPatience = std::chrono::milliseconds(450);
  /// A longer gap [ns] between two calls means that this peer itself was suspended; then others do
  /// not count as silent.
  static constexpr std::chrono::nanoseconds kOwnPause = std::chrono::milliseconds(250);

  /// Makes the counter peers_doubted. `counters` outlives it.
  explicit SilenceWatch(Counters& counters);

  /// If a peer is received, but its touched hand was not updated for this time [ns], it was
  /// disconnected meanwhile: the hand may be gone.
  static constexpr std::chrono::nanoseconds kNoNews = std::chrono::milliseconds(500);

  /// Number of bodies without a hand that faded out without updates, and the last one.
  [[nodiscard]] std::uint64_t faded() const noexcept { return faded_.value(); }
  [[nodiscard]] const Untouchable& last_faded() const noexcept { return last_faded_; }

  /// Call it after arrived datagrams were taken, within kOwnPause of the last call. Notices about
  /// owners of touched hands are added to `out`. True if a peer is received again: it may have
  /// doubted us too, and waits for new states.
  bool look(const aoim::Presence& presence, std::span<const Touched> touched,
            RemoteEntities& remote, std::chrono::nanoseconds now,
            haptics::SpscRing<Notice>& out) noexcept;

 private:
  struct Doubt {
    std::uint32_t epoch = 0;
    std::chrono::nanoseconds heard{0};  // last reception before the doubt
    std::chrono::nanoseconds since{0};
    bool whole = false;  // applies to all its entities, not only touched ones
    bool reported = false;
  };
  // Hosts of plain DIS programs whose bodies press a hand.
  struct Host {
    decltype(aoim::SourceAddress::octets) octets{};
    std::chrono::nanoseconds heard{-1};  // its last datagram
    std::chrono::nanoseconds since{0};   // first press after that
  };
  struct Look {
    std::span<const Touched> touched;
    RemoteEntities& remote;
    std::chrono::nanoseconds now;
    haptics::SpscRing<Notice>& out;
  };

  [[nodiscard]] bool look_at(const aoim::Peer& peer, const Look& look) noexcept;
  void look_at_touched(const Touched& touched, const aoim::Presence& presence,
                       const Look& look) noexcept;
  void look_at_body(const Touched& touched, const RemoteEntity& row, const Look& look) noexcept;
  [[nodiscard]] std::chrono::nanoseconds pressed_since(const RemoteEntity& row,
                                                       const Look& look) noexcept;
  void believe(const aoim::Peer& peer, Doubt& doubt, const Look& look) noexcept;
  void report(const aoim::Peer& peer, Doubt& doubt, const Look& look) noexcept;
  [[nodiscard]] Doubt* find(std::uint32_t epoch) noexcept;
  Doubt& doubt_of(const aoim::Peer& peer, std::chrono::nanoseconds now) noexcept;
  [[nodiscard]] std::chrono::nanoseconds heard(const aoim::Peer& peer) const noexcept;

  std::vector<Doubt> doubts_;  // at most one per peer
  std::chrono::nanoseconds looked_{-1};
  std::chrono::nanoseconds listening_since_{0};
  Counter &doubted_, &faded_;
  Untouchable last_faded_;
  std::array<Host, 32> hosts_{};  // the one with the oldest press is replaced
};

}  // namespace reckon::peer
