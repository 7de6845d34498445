// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Runs the protocol of ownership for the bodies of the scene: takes and sends its messages, asks
// for bodies that a hand will touch, lets the world simulate the bodies that this peer owns, and
// names the owner of each body.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>

#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/peer/loops/assured_stage.hpp"
#include "reckon/peer/loops/body_hand_overs.hpp"
#include "reckon/peer/loops/body_meetings.hpp"
#include "reckon/peer/loops/body_stage.hpp"
#include "reckon/peer/loops/hand_approach.hpp"
#include "reckon/peer/loops/model_wiring.hpp"
#include "reckon/peer/loops/ownership_counters.hpp"
#include "reckon/peer/loops/ownership_watch.hpp"
#include "reckon/peer/loops/pressing_publisher.hpp"
#include "reckon/peer/loops/touch_stage.hpp"
#include "reckon/peer/ownership/message_codec.hpp"
#include "reckon/peer/ownership/ownership.hpp"
#include "reckon/peer/world/arrival.hpp"
#include "reckon/peer/world/datagram_decoder.hpp"
#include "reckon/peer/world/owned_entities.hpp"
#include "reckon/peer/world/remote_entities.hpp"

namespace reckon::peer {

struct ModelIdentity;

/// Thread of the model loop. Does nothing in a scene without bodies and in a plain DIS exercise.
/// Allocates nothing after its first messages.
class OwnershipStage final : public AssuredUser, private OwnershipUser {
 public:
  /// The stages that it works with; all outlive it.
  struct Parts {
    aoim::AreaOfInterestManager& aoim;
    AssuredStage& assured;
    BodyStage& bodies;
    OwnedEntities& owned;
    RemoteEntities& remote;
    const TouchStage& touch;
    const TimeKeeper& time;
    haptics::SpscRing<Notice>& notices;
  };

  OwnershipStage(const ModelWiring& wiring, const ModelIdentity& identity, const Parts& parts);

  /// Whether the owners of bodies can change.
  [[nodiscard]] bool is_on() const noexcept { return is_on_; }
  /// Whether an assured PDU was a request, a grant or a refusal between peers.
  bool takes(const Inbound& update, const Arrival& arrival) noexcept;
  /// Notes the owner that a state of a body names. Call it before the state is judged.
  void note_state(const Inbound& update, const Arrival& arrival) noexcept;
  /// Between BodyStage::read() and BodyStage::move_own().
  void step(const Pass& pass) noexcept;
  [[nodiscard]] std::chrono::nanoseconds next_step() const noexcept {
    return is_on_ ? next_ : std::chrono::nanoseconds::max();
  }

  /// Requests a body, and keeps it as the owner until divest(). Its owner gives it to the peers in
  /// the order of their requests, while none of its hands touches it.
  void acquire(std::size_t body) noexcept;
  /// Gives a body to the next peer that asks.
  void divest(std::size_t body);
  /// Simulation address of the peer that waits longest for a body that this peer keeps; 0:0: none.
  [[nodiscard]] aoim::PeerId asker_of(std::size_t body) const noexcept;
  /// Sends an order of the program to the world; it has an effect if this peer owns the body.
  /// False: too many orders wait.
  bool order(const haptics::BodyOrder& order) noexcept { return this->order(std::span(&order, 1)); }
  /// The same for at most kMostOrders orders, which take effect together.
  bool order(std::span<const haptics::BodyOrder> orders) noexcept;
  /// Gives all bodies to other peers. Call step() until has_left(), at most for 1.5 s.
  void leave() noexcept { protocol_.leave(); }
  [[nodiscard]] bool has_left() const noexcept { return !is_on_ || protocol_.has_left(); }
  /// See Ownership::go_alone().
  void go_alone() noexcept;
  [[nodiscard]] const Ownership& protocol() const noexcept { return protocol_; }
  /// Whether this peer owns a body, and may move it now.
  [[nodiscard]] bool owns(std::size_t body) const noexcept {
    return protocol_.owns(body, pass_.now);
  }
  /// Epoch that owns a body, and the version of that, as far as this peer knows.
  [[nodiscard]] const Tenure& owner_of(std::size_t body) const noexcept;
  /// Simulation address of that owner; 0:0: not known, or it has left.
  [[nodiscard]] aoim::PeerId owner_id_of(std::size_t body) const noexcept;
  /// Motion of a body as this peer simulates or shows it.
  [[nodiscard]] haptics::ObjectMotion motion_now(std::size_t body) const noexcept {
    return body < states().size() ? parts_.bodies.motion_now(body, parts_.remote, pass_.now)
                                  : haptics::ObjectMotion{};
  }

  /// See PressingPublisher::left_out().
  [[nodiscard]] std::size_t unpressed() const noexcept { return pressing_.left_out(); }
  /// Writes the owners.
  void show(PeerView& view) const noexcept;

  [[nodiscard]] bool take_record(const UserRecord& record) noexcept override;
  void settle(const AssuredReport&) noexcept override {}

 private:
  using Nanoseconds = std::chrono::nanoseconds;

  [[nodiscard]] bool may_take(std::size_t object, std::uint32_t epoch) override;
  [[nodiscard]] bool is_busy(std::size_t object) override;
  [[nodiscard]] ObjectSet company_of(std::size_t object) override;
  [[nodiscard]] bool is_any_awake() override;
  [[nodiscard]] std::uint64_t host_of(std::uint32_t epoch) override;

  [[nodiscard]] std::span<const haptics::BodyState> states() const noexcept;
  void note_claim(std::size_t body, const Tenure& stated, const pdu::OwnershipRecord& record,
                  const Arrival& arrival) noexcept;
  [[nodiscard]] double time_to_touch(std::size_t body) const noexcept;
  void ask_ahead() noexcept;
  void choose_copies() noexcept;
  [[nodiscard]] bool should_unite(std::size_t body) noexcept;
  [[nodiscard]] bool meets_senior(std::size_t object) const noexcept;
  [[nodiscard]] double delay_to(std::uint32_t epoch) const noexcept;
  void take_events() noexcept;
  void name_owners() noexcept;
  void note_owner(std::size_t body, const Tenure& owner) noexcept;
  void send(const OutgoingMessage& message) noexcept;
  void send_messages() noexcept;
  [[nodiscard]] TransferNames names_for(std::uint32_t to) const noexcept;

  const SceneFile& scene_;
  const Link& link_;  // for its address
  haptics::BodyWorld* world_;
  std::uint32_t epoch_;
  Parts parts_;
  bool is_on_;
  bool requests_at_touch_;
  Ownership protocol_;
  BodyHandOvers hand_overs_;
  OwnershipCounters counted_;
  OwnershipWatch watch_;
  HandApproach approach_;
  BodyMeetings meetings_;
  PressingPublisher pressing_;
  Pass pass_;
  ObjectSet kept_;     // by the program
  ObjectSet reached_;  // by a hand, now or soon
  std::array<Nanoseconds, kMostOwnable> reached_until_{};
  std::array<Nanoseconds, kMostOwnable> gained_at_{};
  std::array<Nanoseconds, kMostOwnable> felt_at_{};  // by a hand, last
  std::array<BodyOwnerView, kMostOwnable> shown_{};
  std::array<Tenure, kMostOwnable> claims_{};  // by states, for bodies that the table lacks
  std::uint32_t half_ = 0;
  Nanoseconds next_{0};
};

}  // namespace reckon::peer
