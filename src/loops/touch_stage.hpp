// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Contacts of this peer's hands and bodies: reads the servos, answers for bodies without a device,
// finds bodies nearby, sends felt entities, and publishes the nearby bodies to each servo.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "reckon/aoim/area_of_interest_manager.hpp"
#include "reckon/haptics/exchange/servo_types.hpp"
#include "reckon/haptics/exchange/triple_buffer.hpp"
#include "reckon/peer/clocks/time_keeper.hpp"
#include "reckon/peer/loops/entity_sender.hpp"
#include "reckon/peer/loops/felt_sources.hpp"
#include "reckon/peer/loops/model_counters.hpp"
#include "reckon/peer/loops/model_wiring.hpp"
#include "reckon/peer/loops/notice.hpp"
#include "reckon/peer/loops/silence_watch.hpp"
#include "reckon/peer/world/energy_books.hpp"
#include "reckon/peer/world/hand_port.hpp"
#include "reckon/peer/world/near_bodies.hpp"
#include "reckon/peer/world/owned_entities.hpp"
#include "reckon/peer/world/peer_view.hpp"
#include "reckon/peer/world/portless_bodies.hpp"
#include "reckon/peer/world/remote_entities.hpp"

namespace reckon::peer {

/// Reports a stiffness that a hand's device cannot show.
void report_softened(std::string_view marking, const DeviceStiffness& device,
                     haptics::SpscRing<Notice>& notices) noexcept;

/// A hand of this peer and its motion, S: a ball around its probes.
struct ApproachingHand {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m]
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< [m/s]
  double radius = 0.0;                                 ///< [m]
};

/// Data of other stages that this stage reads or changes; all outlive it.
struct TouchParts {
  OwnedEntities& owned;
  RemoteEntities& remote;
  aoim::AreaOfInterestManager& aoim;
  EntitySender& sender;
  const TimeKeeper& time;
  ModelCounters& counted;
};

/// One thread; allocates when hands and bodies are added.
class TouchStage {
 public:
  /// @param epoch of this process
  TouchStage(const ModelWiring& wiring, std::uint32_t epoch, const TouchParts& parts);

  /// Adds the device of entity `number`.  @throws std::invalid_argument beyond kMaxDevices
  void add_hand(EntityNumber number, haptics::TripleBuffer<haptics::ServoSnapshot>& snapshots,
                haptics::TripleBuffer<haptics::ContactSet>& contacts,
                const DeviceStiffness& stiffness);
  /// Adds entity `number`, which can be felt and has no device.  @param power [W] that it may give
  void add_body(EntityNumber number, double power);
  void remove_body(EntityNumber number) noexcept;

  /// Reads the newest snapshots of the servos; true if a hand has moved.
  bool read_hands() noexcept;
  /// Gives hands the energy that they request from bodies.
  void answer_bodies(const Pass& pass) noexcept;
  /// Finds the bodies that hands and moving bodies can touch. Call it after read_hands() and
  /// answer_bodies().
  void find_near(const Pass& pass) noexcept;
  /// Sends due updates of hands and moving bodies, and impacts.
  void consider(const Pass& pass) noexcept;
  /// Publishes the bodies nearby to the servos.
  void publish_contacts(const Pass& pass) noexcept;
  /// Publishes the sources of bodies that hands can feel.
  void publish_felt_sources() noexcept;
  /// Records the contact sets published to the servo of this device, see Peer::trace_contacts().
  void trace_contacts(haptics::ContactRing* ring, std::size_t device) noexcept {
    if (device < hands_.size()) hands_[device].trace_contacts(ring);
  }
  /// Energy that a remote hand states to have put into the bodies of the scene [J].
  [[nodiscard]] double body_energy_of(const pdu::EntityId& hand) const noexcept {
    const ReceivedAccount* account = books_.find(kOfBodies, hand);
    return account == nullptr ? 0.0 : account->given;
  }
  /// Stores the energy accounts of a remote body for entities of ours, and for the bodies of the
  /// scene.
  void note_accounts(const Inbound& update, const Pass& pass) noexcept;

  /// Whether a device moves this entity.
  [[nodiscard]] bool is_hand(EntityNumber number) const noexcept {
    return port_of(number) != nullptr;
  }
  [[nodiscard]] const HandPort* port_of(EntityNumber number) const noexcept;
  [[nodiscard]] const PortlessBody* body_of(EntityNumber number) const noexcept;
  [[nodiscard]] std::size_t hand_count() const noexcept { return hands_.size(); }
  /// Snapshot of the first hand; at rest if there is none.
  [[nodiscard]] const haptics::ServoSnapshot& servo() const noexcept;
  /// The bodies in reach of each hand.
  [[nodiscard]] std::span<const NearBodies> bodies_in_reach() const noexcept {
    return {near_.data(), hands_.size()};
  }
  /// Whether a remote body is near a hand or a moving body of ours, so that it may be felt soon.
  [[nodiscard]] bool has_near() const noexcept;
  /// Copies the motion of all hands.  @return their number
  std::size_t copy_hands(std::span<ApproachingHand, kMaxDevices> out) const noexcept;
  /// Copies the entities touched by all hands.  @return their number
  std::size_t copy_touched(
      std::span<Touched, kMaxDevices * haptics::kMaxRemoteHands> out) const noexcept;
  /// The last host with more bodies near a hand than it takes.
  [[nodiscard]] const aoim::SourceAddress& crowder() const noexcept { return crowder_; }
  /// Adds our hands to the view.  @return the most bodies that a servo has omitted
  std::size_t show(PeerView& view) const noexcept;

 private:
  // Contacts of one hand, now and at the last step.
  struct Touch {
    bool moved = false;
    std::array<Touched, haptics::kMaxRemoteHands> touched{};
    std::size_t touched_count = 0;
  };

  static constexpr EntityNumber kOfBodies = 0;  // in books_: no entity of ours

  void consider_hands(const Pass& pass) noexcept;
  void consider_bodies(const Pass& pass) noexcept;
  void send_impacts(std::size_t hand, const Pass& pass) noexcept;
  void send_impact(const HandPort& port, const RemoteEntity& row,
                   const haptics::ContactAccount& contact, const Pass& pass) noexcept;

  const SceneFile& scene_;
  const deadreckon::LocalFrame& frame_;
  std::uint32_t epoch_;
  OwnedEntities& owned_;
  RemoteEntities& remote_;
  aoim::AreaOfInterestManager& aoim_;
  EntitySender& sender_;
  const TimeKeeper& time_;
  ModelCounters& counted_;
  std::vector<HandPort> hands_;                 // at most kMaxDevices
  std::vector<Touch> touches_;                  // by hand
  std::vector<DeviceStiffness> stiffness_;      // by hand
  std::array<NearBodies, kMaxDevices> near_{};  // by hand
  std::vector<PortlessBody> bodies_;
  std::vector<MovingBody> moving_;  // in the order of bodies_
  HandsNear hands_near_;            // near moving_
  aoim::SourceAddress crowder_;
  EnergyBooks books_;
  std::uint16_t impacts_ = 0;
  double power_given_j_ = 0.0;
  FeltSourcesPublisher felt_sources_;
};

}  // namespace reckon::peer
