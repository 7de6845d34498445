// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Peers that fall silent: what they own comes to rest and is felt no more long before they are
// dropped, and goes on when they are heard again. Part of the model loop.
#pragma once

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

/// An entity of another peer that a hand of ours touches.
struct Touched {
  pdu::EntityId id;
  std::chrono::nanoseconds since{0};
};

/// Doubts a peer by the age of what was heard last from the whole of it, whatever it was. Plain DIS
/// has no such sign of life: its entities are believed until their time-out. One thread; allocates
/// at construction alone; some ns for each peer.
class SilenceWatch {
 public:
  /// A peer announces itself each second: with two of these lost it is doubted.
  static constexpr std::chrono::nanoseconds kPatience = std::chrono::milliseconds(2500);
  /// The owner of a hand that is touched says something each 60 ms: ten of these are lost. Who
  /// was silent before a touch began may not know of it yet: twice as long from then on.
  static constexpr std::chrono::nanoseconds kContactPatience = std::chrono::milliseconds(650);
  /// Looks farther apart than this [ns] tell that this peer itself stood still: what it has not
  /// heard meanwhile is nobody's silence.
  static constexpr std::chrono::nanoseconds kOwnPause = std::chrono::milliseconds(250);

  /// Makes the counter peers_doubted. `counters` outlives it.
  explicit SilenceWatch(Counters& counters);

  /// Whose hand is touched and who is heard, but for so long [ns] not of that hand, was cut off
  /// meanwhile: the hand may have gone.
  static constexpr std::chrono::nanoseconds kNoNews = std::chrono::milliseconds(500);

  /// Call it after what has arrived was taken, within kOwnPause of the last call. Sentences about
  /// those whose hands are touched go to `out`. True where somebody is heard again: he has doubted
  /// us too, maybe, and waits for new states.
  bool look(const aoim::Presence& presence, std::span<const Touched> touched,
            RemoteEntities& remote, std::chrono::nanoseconds now,
            haptics::SpscRing<Notice>& out) noexcept;

 private:
  struct Doubt {
    std::uint32_t epoch = 0;
    std::chrono::nanoseconds heard{0};  // last, before
    std::chrono::nanoseconds since{0};
    bool whole = false;  // all that it owns, not just what is touched
    bool reported = false;
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
  void believe(const aoim::Peer& peer, Doubt& doubt, const Look& look) noexcept;
  void tell(const aoim::Peer& peer, Doubt& doubt, const Look& look) noexcept;
  [[nodiscard]] Doubt* find(std::uint32_t epoch) noexcept;
  Doubt& doubt_of(const aoim::Peer& peer, std::chrono::nanoseconds now) noexcept;
  [[nodiscard]] std::chrono::nanoseconds heard(const aoim::Peer& peer) const noexcept;

  std::vector<Doubt> doubts_;  // no more than there are peers
  std::chrono::nanoseconds looked_{-1};
  std::chrono::nanoseconds listening_since_{0};
  Counter& doubted_;
};

}  // namespace reckon::peer
