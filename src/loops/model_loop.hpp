// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The loop between the servo and the network: keeps the state table, decides what to send and to
// whom, and tells the servo which hands it can touch. It is the only writer of all of these.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "reckon/aoim/area_of_interest_manager.hpp"
#include "reckon/deadreckon/motion/geocentric.hpp"
#include "reckon/haptics/exchange/servo_types.hpp"
#include "reckon/haptics/exchange/spsc_ring.hpp"
#include "reckon/haptics/exchange/triple_buffer.hpp"
#include "reckon/peer/clocks/time_keeper.hpp"
#include "reckon/peer/counters/counters.hpp"
#include "reckon/peer/loops/aoim_setup.hpp"
#include "reckon/peer/loops/aoim_watch.hpp"
#include "reckon/peer/loops/network_read_loop.hpp"
#include "reckon/peer/loops/network_write_loop.hpp"
#include "reckon/peer/loops/notice.hpp"
#include "reckon/peer/loops/send_counters.hpp"
#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/peer/world/datagram_decoder.hpp"
#include "reckon/peer/world/own_hand.hpp"
#include "reckon/peer/world/peer_view.hpp"
#include "reckon/peer/world/remote_entities.hpp"

namespace reckon::peer {

/// What the model loop is connected to; all of it outlives the loop.
struct ModelWiring {
  const SceneFile& scene;
  const deadreckon::LocalFrame& frame;
  const GroupPool& pool;
  haptics::TripleBuffer<haptics::ServoSnapshot>& snapshots;
  haptics::TripleBuffer<haptics::ContactSet>& contacts;
  haptics::SpscRing<InboundDatagram>& inbound;
  haptics::SpscRing<Outbound>& outbound;
  haptics::SpscRing<GroupCommand>& commands;
  haptics::SpscRing<ShownSample>* shown;  ///< may be null
  Counters& counters;
};

/// The loop. step() and stop() by one thread; no allocation.
class ModelLoop {
 public:
  ModelLoop(const ModelWiring& wiring, const ModelIdentity& identity);

  /// Announces this peer at the next step. Call before the first step.
  void start(std::chrono::nanoseconds now);
  /// One pass. `utc` is the same instant as `now` by the host, which may leap.
  void step(std::chrono::nanoseconds now, std::chrono::nanoseconds utc) noexcept;
  /// Queues the last Entity State (deactivated) and the good-bye.
  void stop(std::chrono::nanoseconds now, std::chrono::nanoseconds utc) noexcept;

  [[nodiscard]] haptics::TripleBuffer<PeerView>& views() noexcept { return views_; }
  [[nodiscard]] haptics::SpscRing<Notice>& notices() noexcept { return notices_; }
  [[nodiscard]] const RemoteEntities& remote() const noexcept { return remote_; }
  /// The own hand. By the thread of step(), or when the loops stand still.
  [[nodiscard]] pdu::EntityId own_id() const noexcept { return hand_.id(); }

 private:
  using Nanoseconds = std::chrono::nanoseconds;
  struct Near {
    const RemoteEntity* row = nullptr;
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();  // of its sphere, S [m]
    Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  };

  void begin(Nanoseconds now, Nanoseconds utc) noexcept;
  void drain() noexcept;
  void take_datagram(const InboundDatagram& datagram) noexcept;
  void take_control(const Inbound& update) noexcept;
  void take_presence_events() noexcept;
  void subscribe() noexcept;
  void consider_own() noexcept;
  void send_own(deadreckon::SendReason reason) noexcept;
  [[nodiscard]] Nanoseconds hold(deadreckon::SendReason reason) const noexcept;
  void tell_impacts() noexcept;
  void send_impact(const RemoteEntity& row, const haptics::ContactAccount& contact) noexcept;
  void find_near() noexcept;
  void publish_contacts() noexcept;
  void publish_shown() noexcept;
  void publish_view() noexcept;
  void emit(bool everything) noexcept;
  void push_datagram(aoim::GroupIndex group, std::span<const std::byte> octets) noexcept;
  template <typename Pdu>
  void queue(const Pdu& pdu) noexcept;
  template <typename... Arguments>
  void tell(std::string_view format, const Arguments&... arguments) noexcept;

  const SceneFile& scene_;
  const deadreckon::LocalFrame& frame_;
  const GroupPool& pool_;
  haptics::TripleBuffer<haptics::ServoSnapshot>& snapshots_;
  haptics::TripleBuffer<haptics::ContactSet>& contacts_;
  haptics::SpscRing<InboundDatagram>& inbound_;
  haptics::SpscRing<Outbound>& outbound_;
  haptics::SpscRing<GroupCommand>& commands_;
  haptics::SpscRing<ShownSample>* shown_;

  Nanoseconds now_{0};
  Nanoseconds utc_{0};  // without jumps, see TimeKeeper
  Nanoseconds started_{0};
  Nanoseconds next_view_{0};
  Nanoseconds last_sent_{Nanoseconds::min() / 2};
  aoim::GroupIndex last_group_;
  bool frozen_ = false;

  OwnHand hand_;
  aoim::AreaOfInterestManager aoim_;
  TimeKeeper time_;
  RemoteEntities remote_;
  DatagramDecoder decoder_;
  HandUpdate outgoing_;
  std::array<pdu::EntityId, haptics::kMaxRemoteHands> touched_{};  // at the last step
  std::size_t touched_count_ = 0;
  std::uint16_t impacts_ = 0;
  std::array<Near, haptics::kMaxRemoteHands> near_{};  // of this step
  std::size_t near_count_ = 0;
  haptics::TripleBuffer<PeerView> views_;
  haptics::SpscRing<Notice> notices_;
  AoimWatch aoim_watch_;

  SendCounters sending_;
  Counter& datagrams_refused_;
  Counter& lost_;
  Counter& doubled_;
  Counter& reordered_;
  Counter& write_overflow_;
};

}  // namespace reckon::peer
