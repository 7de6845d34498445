// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The loop between the servos and the network: keeps the state table and the entities of this peer,
// decides what to send and to whom, and tells each servo what its hand can touch. It is the only
// writer of all of these.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "reckon/aoim/participant.hpp"
#include "reckon/haptics/exchange/servo_types.hpp"
#include "reckon/haptics/exchange/triple_buffer.hpp"
#include "reckon/peer/clocks/time_keeper.hpp"
#include "reckon/peer/loops/aoim_setup.hpp"
#include "reckon/peer/loops/datagram_intake.hpp"
#include "reckon/peer/loops/datagram_outlet.hpp"
#include "reckon/peer/loops/entity_sender.hpp"
#include "reckon/peer/loops/model_counters.hpp"
#include "reckon/peer/loops/model_wiring.hpp"
#include "reckon/peer/loops/order_stage.hpp"
#include "reckon/peer/loops/peer_watches.hpp"
#include "reckon/peer/loops/subscriber.hpp"
#include "reckon/peer/loops/touch_stage.hpp"
#include "reckon/peer/loops/view_publisher.hpp"
#include "reckon/peer/world/interaction_sender.hpp"
#include "reckon/peer/world/owned_entities.hpp"
#include "reckon/peer/world/remote_entities.hpp"
#include "reckon/peer/world/tracked_entities.hpp"

namespace reckon::peer {

class ModelLoop;

/// A program that takes part in each pass. Called by the model loop's thread within step(); must
/// not throw.
class ModelGuest {
 public:
  virtual ~ModelGuest() = default;
  /// A pass begins: now entities may be added, moved and removed, and PDUs said.
  virtual void begin_pass(ModelLoop& loop) noexcept = 0;
  /// What is not the peer's own business: fires, detonations, comments, and orders too. Nothing
  /// that was said in another's name.
  /// @param octets of the whole PDU, good until the call returns
  virtual void hear(const pdu::PduHeader& header, std::span<const std::byte> octets,
                    const InteractionSender& sender) noexcept = 0;
  /// A pass ends: all that has arrived is in remote().
  virtual void end_pass(ModelLoop& loop) noexcept = 0;
};

/// The loop. step() and stop() by one thread; no allocation but in add().
class ModelLoop : private UpdateHandler, private aoim::ParticipantHandler {
 public:
  ModelLoop(const ModelWiring& wiring, const ModelIdentity& identity);

  /// A hand: an entity of the scene's [hand] that a device moves. Before start() alone; at most
  /// kMaxDevices. @param stiffness that its device can show: others feel no more of it, and where
  /// that is less than the scene asks, the next picture says so
  EntityNumber add_hand(std::string_view marking,
                        haptics::TripleBuffer<haptics::ServoSnapshot>& snapshots,
                        haptics::TripleBuffer<haptics::ContactSet>& contacts,
                        const DeviceStiffness& stiffness = {});
  /// An entity that the program moves, under a number that is free; false where it is not. Shown to
  /// others from its first truth on.
  bool add(EntityNumber number, const EntityDescription& description,
           const EntityTruth& truth = {});
  /// The peer itself moves it along its track from now on. Before start() alone.
  void follow(EntityNumber number, const EntityTrack& track);
  /// Where it is now. False where there is none, or the truth is not finite or older than the last.
  bool move(EntityNumber number, const EntityTruth& truth) noexcept;
  /// It leaves the exercise: its last state says so. False where there is none.
  bool remove(EntityNumber number) noexcept;
  /// To change what else there is to say of it; nullptr where there is none. Call look_at() after.
  [[nodiscard]] OwnedEntity* find_own(EntityNumber number) noexcept { return owned_.find(number); }
  void look_at(EntityNumber number) noexcept { owned_.look_at(number); }
  /// Queues an encoded PDU, for those who can sense `place` [m, S] or for everybody.
  aoim::AddResult say(std::span<const std::byte> pdu, const std::optional<aoim::Position>& place);
  /// @param guest outlives the loop, or the next call; nullptr: nobody.
  void receive(ModelGuest* guest) noexcept { guest_ = guest; }

  /// Announces this peer at the next step. Call before the first step.
  void start(std::chrono::nanoseconds now);
  /// One pass. `utc` is the same instant as `now` by the host, which may leap.
  void step(std::chrono::nanoseconds now, std::chrono::nanoseconds utc) noexcept;
  /// When step() is due at the latest if nothing arrives and no servo steps. By the thread of
  /// step().
  [[nodiscard]] std::chrono::nanoseconds next_step() const noexcept {
    return std::min({aoim_.next_step(), view_.next(), owned_.next_due(), tracked_.next_due()});
  }
  /// Queues last Entity States (deactivated), as many as the writer has room for, and at last the
  /// good-bye. True once all is said; until then call it again when the writer has made room.
  bool stop(std::chrono::nanoseconds now, std::chrono::nanoseconds utc) noexcept;
  /// Nobody will read what waits in the rings from the network: reports it to the tap.
  void report_unread() noexcept { intake_.report_unread(); }

  [[nodiscard]] haptics::TripleBuffer<PeerView>& views() noexcept { return view_.views(); }
  [[nodiscard]] haptics::SpscRing<Notice>& notices() noexcept { return watches_.notices(); }
  [[nodiscard]] const RemoteEntities& remote() const noexcept { return remote_; }
  [[nodiscard]] RemoteEntities& remote() noexcept { return remote_; }
  [[nodiscard]] const OwnedEntities& owned() const noexcept { return owned_; }
  [[nodiscard]] const TimeKeeper& time() const noexcept { return time_; }
  /// The pass under way, or the last one.
  [[nodiscard]] const Pass& pass() const noexcept { return pass_; }
  /// The first entity of this peer; number 0 where it has none. By the thread of step(), or when
  /// the loops stand still.
  [[nodiscard]] pdu::EntityId own_id() const noexcept;

 private:
  using Nanoseconds = std::chrono::nanoseconds;

  void begin(Nanoseconds now, Nanoseconds utc) noexcept;
  void drop_stale(Nanoseconds now) noexcept;
  void take_datagram(std::span<const std::byte> octets) noexcept override;
  void take_update(const Inbound& update, const Arrival& arrival) noexcept override;
  void take_interaction(const Inbound& update, const Arrival& arrival) noexcept;
  void claim(const aoim::PeerId& name, std::uint32_t epoch) noexcept override;
  void drop(const aoim::PresenceEvent::Dropped& life, bool silent) noexcept override;
  void rename(const aoim::PeerId& own) noexcept override;
  void receive(const aoim::RelayedState& relayed,
               const aoim::SourceAddress& from) noexcept override;
  void report(const aoim::PresenceEvent& event) noexcept override;
  void doubt_the_silent() noexcept;
  void send_what_is_felt() noexcept;
  void consider_others() noexcept;
  [[nodiscard]] bool consider_other(OwnedEntity& entity, EntityNumber number) noexcept;
  [[nodiscard]] Eigen::Vector3d middle_of_interest() const noexcept;
  void look_around() noexcept;
  void publish_view() noexcept;
  void emit(bool everything) noexcept;
  template <typename... Arguments>
  void report(std::string_view format, const Arguments&... arguments) noexcept;

  const SceneFile& scene_;
  Pass pass_;
  ModelCounters counted_;
  OwnedEntities owned_;
  TrackedEntities tracked_;
  aoim::Participant participant_;
  aoim::AreaOfInterestManager& aoim_ = participant_.manager();
  TimeKeeper time_;
  RemoteEntities remote_;
  EntitySender sender_;
  DatagramIntake intake_;
  DatagramOutlet outlet_;
  TouchStage touch_;
  Subscriber subscriber_;
  PeerWatches watches_;
  OrderStage orders_;
  ViewPublisher view_;
  ModelGuest* guest_ = nullptr;
  Nanoseconds heard_again_ = Nanoseconds::min() / 2;  // somebody
  std::size_t goodbyes_ = 0;                          // numbers up to this one have said so
};

}  // namespace reckon::peer
