// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Hooks for mechanisms that watch a peer, or act on its received and sent data. A new mechanism is
// a file and a row of THE list in peer_hooks.cpp.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/aoim/area_of_interest_manager.hpp"
#include "reckon/haptics/exchange/spsc_ring.hpp"
#include "reckon/pdu/bundle.hpp"
#include "reckon/peer/counters/counters.hpp"
#include "reckon/peer/loops/notice.hpp"
#include "reckon/peer/world/arrival.hpp"
#include "reckon/peer/world/remote_entities.hpp"

namespace reckon::peer {

struct Dispatch;
struct ModelWiring;
class OwnedEntity;

/// The watched state.
struct WatchedPeer {
  const RemoteEntities& remote;
  aoim::AreaOfInterestManager& aoim;
  std::size_t unfelt;     ///< nearby bodies that a servo omits now; largest number of all servos
  std::size_t unpressed;  ///< see PressingPublisher::left_out()
  const aoim::SourceAddress& crowder;  ///< host of most of the bodies nearby
  std::chrono::nanoseconds now;
  haptics::SpscRing<Notice>& notices;  ///< for the user
};

/// Answer of a hook that acts. Each hook has one effect: any answer but `pass` has it.
enum class Verdict : std::uint8_t { pass, refuse, hold, change };

/// An undamaged PDU of this exercise, before it is decoded.
struct ArrivingPdu {
  const pdu::BundledPdu& pdu;
  const Arrival& arrival;
};
/// A due update of an entity of ours.
struct DueUpdate {
  const OwnedEntity& entity;
  const Dispatch& how;
  std::chrono::nanoseconds now;
};
/// An update for all peers of its cell.
struct RoutedUpdate {
  const OwnedEntity& entity;
  aoim::GroupIndex group;  ///< the hook may set another group of the scene
};
/// A whole datagram, with its trailer.
struct LeavingDatagram {
  aoim::GroupIndex group;
  std::span<const std::byte> octets;
};

/// Called by the model loop's thread; must neither throw, block nor allocate. An unset hook costs
/// nothing.
struct PeerHooks {
  /// Called some twenty times a second.
  std::function<void(const WatchedPeer&)> look = nullptr;
  /// Called for each received and each sent datagram of this exercise.
  std::function<void(std::span<const std::byte>)> received = nullptr, sent = nullptr;

  /// `refuse`: the PDU is not decoded. The area-of-interest manager has read its control PDUs.
  /// Called also for each state that a leader relays.
  std::function<Verdict(const ArrivingPdu&)> arriving = nullptr;
  /// `hold`: the update waits, and is considered again at the entity's next change, or in 0.1 s.
  /// Final states do not wait.
  std::function<Verdict(const DueUpdate&)> deciding = nullptr;
  /// `change`: the update is sent to the group that the hook has set.
  std::function<Verdict(RoutedUpdate&)> routing = nullptr;
  /// `refuse`: the datagram is not sent. Receivers count it as lost.
  std::function<Verdict(const LeavingDatagram&)> leaving = nullptr;
};

/// A mechanism of a program, beside those of THE list.
struct NamedHooks {
  std::string name;  ///< snake case; its counter is `acts_<name>`
  PeerHooks hooks;
};

/// The acting hooks of one point, in the order of their mechanisms.
template <typename Subject>
class ActingHooks {
 public:
  [[nodiscard]] bool empty() const noexcept { return hooks_.empty(); }
  /// Whether all hooks answer `pass`. The first other answer decides and counts.
  [[nodiscard]] bool pass(Subject& subject) const {
    for (const Row& row : hooks_) {
      if (row.hook(subject) != Verdict::pass) return row.acts->add(), false;
    }
    return true;
  }
  void add(const std::function<Verdict(Subject&)>& hook, Counter& acts) {
    hooks_.push_back({hook, &acts});
  }

 private:
  struct Row {
    std::function<Verdict(Subject&)> hook;
    Counter* acts;
  };
  std::vector<Row> hooks_;
};

/// The hooks of the rows that a scene enables, then of a program's mechanisms. One thread;
/// allocates only at construction.
class HookList {
 public:
  /// All references in `wiring` outlive this.
  explicit HookList(const ModelWiring& wiring);
  HookList(const HookList&) = delete;
  HookList& operator=(const HookList&) = delete;

  void look(const WatchedPeer& peer) const {
    for (const auto& hook : look_) hook(peer);
  }
  void sent(std::span<const std::byte> datagram) const {
    for (const auto& hook : sent_) hook(datagram);
  }
  void received(std::span<const std::byte> datagram) const {
    for (const auto& hook : received_) hook(datagram);
  }

  /// Whether all PDUs of a datagram may arrive.
  [[nodiscard]] bool admits(std::span<const std::byte> datagram, const Arrival& arrival) const {
    return arriving.empty() || all_arrive(datagram, arrival);
  }

  ActingHooks<const ArrivingPdu> arriving;
  ActingHooks<const DueUpdate> deciding;
  ActingHooks<RoutedUpdate> routing;
  ActingHooks<const LeavingDatagram> leaving;

 private:
  [[nodiscard]] bool all_arrive(std::span<const std::byte> datagram, const Arrival& arrival) const;
  void add(std::string_view name, const PeerHooks& hooks, Counters& counters);

  std::vector<std::function<void(const WatchedPeer&)>> look_;
  std::vector<std::function<void(std::span<const std::byte>)>> sent_, received_;
};

}  // namespace reckon::peer
