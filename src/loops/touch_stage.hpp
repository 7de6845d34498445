// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What this peer's hands and bodies touch: reads the servos, answers for bodies without a device,
// finds what is near, sends what is felt, and gives each servo its picture of the hands near it.
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

/// Reports what of a hand's stiffness its device cannot show.
void report_softened(std::string_view marking, const DeviceStiffness& device,
                     haptics::SpscRing<Notice>& notices) noexcept;

/// What the other stages own and touch reads or changes; all outlives it.
struct TouchParts {
  OwnedEntities& owned;
  RemoteEntities& remote;
  aoim::AreaOfInterestManager& aoim;
  EntitySender& sender;
  const TimeKeeper& time;
  ModelCounters& counted;
};

/// One thread; allocates where hands and bodies are added.
class TouchStage {
 public:
  /// @param epoch of this process
  TouchStage(const ModelWiring& wiring, std::uint32_t epoch, const TouchParts& parts);

  /// Entity `number` is moved by this device. @throws std::invalid_argument beyond kMaxDevices
  void add_hand(EntityNumber number, haptics::TripleBuffer<haptics::ServoSnapshot>& snapshots,
                haptics::TripleBuffer<haptics::ContactSet>& contacts,
                const DeviceStiffness& stiffness);
  /// Entity `number` can be felt and has no device. @param power [W] that it may give
  void add_body(EntityNumber number, double power);
  void remove_body(EntityNumber number) noexcept;

  /// Takes the newest snapshots of the servos; true where a hand has moved.
  bool read_hands() noexcept;
  /// Bodies give what hands ask of them.
  void answer_bodies(const Pass& pass) noexcept;
  /// Finds what hands and moving bodies can touch; after both.
  void find_near(const Pass& pass) noexcept;
  /// Sends hands and moving bodies where their updates are due, and impacts.
  void consider(const Pass& pass) noexcept;
  /// Gives the servos what is near.
  void publish_contacts(const Pass& pass) noexcept;
  /// Keeps what the owner of another body says of its account with ours.
  void note_accounts(const Inbound& update, const Pass& pass) noexcept;

  /// Whether a device moves this entity.
  [[nodiscard]] bool is_hand(EntityNumber number) const noexcept {
    return port_of(number) != nullptr;
  }
  [[nodiscard]] const HandPort* port_of(EntityNumber number) const noexcept;
  [[nodiscard]] const PortlessBody* body_of(EntityNumber number) const noexcept;
  [[nodiscard]] std::size_t hand_count() const noexcept { return hands_.size(); }
  /// Of the first hand; at rest where there is none.
  [[nodiscard]] const haptics::ServoSnapshot& servo() const noexcept;
  /// What is near each hand.
  [[nodiscard]] std::span<const NearBodies> near() const noexcept {
    return {near_.data(), hands_.size()};
  }
  /// Copies what all hands touch. @return how many
  std::size_t copy_touched(
      std::span<Touched, kMaxDevices * haptics::kMaxRemoteHands> out) const noexcept;
  /// The last sender that had more near a hand than it takes.
  [[nodiscard]] const aoim::SourceAddress& crowder() const noexcept { return crowder_; }
  /// Fills in our hands. @return the most that a servo has left out
  std::size_t show(PeerView& view) const noexcept;

 private:
  // What one hand touches, and what it touched at the last step.
  struct Touch {
    bool moved = false;
    std::array<Touched, haptics::kMaxRemoteHands> touched{};
    std::size_t touched_count = 0;
  };

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
  std::vector<Touch> touches_;                  // of hands_
  std::vector<DeviceStiffness> stiffness_;      // of hands_
  std::array<NearBodies, kMaxDevices> near_{};  // to hands_
  std::vector<PortlessBody> bodies_;
  std::vector<MovingBody> moving_;  // of bodies_, in their order
  HandsNear hands_near_;            // of moving_
  aoim::SourceAddress crowder_;
  EnergyBooks books_;
  std::uint16_t impacts_ = 0;
  double power_given_j_ = 0.0;
};

}  // namespace reckon::peer
