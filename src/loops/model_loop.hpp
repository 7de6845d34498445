// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The loop between the servos and the network. It owns the state table and the entities of this
// peer, decides on updates and their recipients, and publishes the touchable bodies to each servo.
// It is the only writer of this data. A pass has the stages of LoopStage.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "reckon/aoim/event_handler.hpp"
#include "reckon/haptics/exchange/servo_types.hpp"
#include "reckon/haptics/exchange/triple_buffer.hpp"
#include "reckon/peer/clocks/time_keeper.hpp"
#include "reckon/peer/emissions/emission_table.hpp"
#include "reckon/peer/loops/aoim_setup.hpp"
#include "reckon/peer/loops/assured_stage.hpp"
#include "reckon/peer/loops/body_stage.hpp"
#include "reckon/peer/loops/datagram_intake.hpp"
#include "reckon/peer/loops/datagram_outlet.hpp"
#include "reckon/peer/loops/entity_sender.hpp"
#include "reckon/peer/loops/loop_trace.hpp"
#include "reckon/peer/loops/model_counters.hpp"
#include "reckon/peer/loops/model_wiring.hpp"
#include "reckon/peer/loops/order_stage.hpp"
#include "reckon/peer/loops/ownership_stage.hpp"
#include "reckon/peer/loops/peer_hooks.hpp"
#include "reckon/peer/loops/peer_watches.hpp"
#include "reckon/peer/loops/record_stage.hpp"
#include "reckon/peer/loops/returned_peers.hpp"
#include "reckon/peer/loops/subscriber.hpp"
#include "reckon/peer/loops/touch_stage.hpp"
#include "reckon/peer/loops/view_publisher.hpp"
#include "reckon/peer/world/interaction_sender.hpp"
#include "reckon/peer/world/owned_entities.hpp"
#include "reckon/peer/world/remote_entities.hpp"
#include "reckon/peer/world/tracked_entities.hpp"

namespace reckon::peer {

class ModelLoop;

/// A program's part of each pass. Called by the model loop's thread within step(); must not throw.
class ModelGuest : public DeliveryWatch {
 public:
  /// Action stage of a pass: the program may add, move and remove entities, and send PDUs.
  /// Datagrams and hands of this pass have been read.
  virtual void begin_pass(ModelLoop& loop) noexcept = 0;
  /// Receives PDUs for the program: fires, detonations, comments, and orders too; none with a
  /// forged issuer.  @param octets of the whole PDU, valid until the call returns
  virtual void receive(const pdu::PduHeader& header, std::span<const std::byte> octets,
                       const InteractionSender& sender) noexcept = 0;
  /// Publish stage of a pass: remote() contains all received updates, and due updates were sent.
  virtual void end_pass(ModelLoop& loop) noexcept = 0;
};

/// The loop. One thread calls step() and stop(); only add() allocates.
class ModelLoop : private UpdateHandler, private aoim::EventHandler {
 public:
  ModelLoop(const ModelWiring& wiring, const ModelIdentity& identity);

  /// Adds a hand: an entity of the scene's [hand] moved by a device. Only before start(); at most
  /// kMaxDevices.
  /// @param stiffness limits of its device: others feel no more of it, and the next view shows if
  /// that is less than in the scene
  EntityNumber add_hand(std::string_view marking,
                        haptics::TripleBuffer<haptics::ServoSnapshot>& snapshots,
                        haptics::TripleBuffer<haptics::ContactSet>& contacts,
                        const DeviceStiffness& stiffness = {});
  /// Adds an entity that the program moves, under a free number; false if it is in use. Others see
  /// it from its first true state on.
  bool add(EntityNumber number, const EntityDescription& description,
           const EntityTruth& truth = {});
  /// Adds the bodies of the scene, with numbers from `first` on; the wiring supplies their motion.
  /// Only before start().
  void add_bodies(EntityNumber first);
  /// Moves the entity along its track from now on. Only before start().
  void follow(EntityNumber number, const EntityTrack& track);
  /// Sets its true state. False if there is no such entity, or the state is not finite or older
  /// than the last.
  bool move(EntityNumber number, const EntityTruth& truth) noexcept;
  /// Removes it from the exercise with a final state. False if there is none.
  bool remove(EntityNumber number) noexcept;
  /// Gives access to its other properties; nullptr if there is none. Call look_at() after changes.
  [[nodiscard]] OwnedEntity* find_own(EntityNumber number) noexcept { return owned_.find(number); }
  void look_at(EntityNumber number) noexcept { owned_.look_at(number); }
  /// Queues an encoded PDU, for the peers that can sense `place` [m, S] or for all.
  aoim::AddResult send(std::span<const std::byte> pdu, const std::optional<aoim::Position>& place);
  /// The owners of the bodies.
  [[nodiscard]] OwnershipStage& ownership() noexcept { return ownership_; }
  /// Assured messages of this peer, for send() and for users of further kinds of records.
  [[nodiscard]] AssuredStage& assured() noexcept { return assured_; }
  /// The shared records.
  [[nodiscard]] RecordStage& records() noexcept { return records_; }
  /// @param guest outlives the loop, or the next call; nullptr: none.
  void set_guest(ModelGuest* guest) noexcept { assured_.set_watch(guest_ = guest); }

  /// See Peer::trace_contacts().
  void trace_contacts(haptics::ContactRing* ring, std::size_t device) noexcept {
    touch_.trace_contacts(ring, device);
  }
  /// See Peer::trace_loop().
  void trace(LoopRing* ring) noexcept { trace_.record(ring); }

  /// Announces this peer at the next step. Call before the first step.
  void start(std::chrono::nanoseconds now);
  /// One pass.  @param utc the same instant as `now` by the host's clock, which may jump.
  void step(std::chrono::nanoseconds now, std::chrono::nanoseconds utc) noexcept;
  /// Latest time for the next step() if nothing arrives and no servo steps. By the thread of
  /// step().
  [[nodiscard]] std::chrono::nanoseconds next_step() const noexcept {
    return std::min({aoim_.next_step(), assured_.next_step(), view_.next(), owned_.next_due(),
                     tracked_.next_due(), bodies_.next_step(), ownership_.next_step(),
                     records_.next_step()});
  }
  /// Whether the delay of arriving updates matters: a body is within reach of a hand or a moving
  /// body of ours.
  [[nodiscard]] bool has_near() const noexcept { return touch_.has_near(); }
  /// Whether peers wait for answers: assured records are under way, or bodies can change owners.
  [[nodiscard]] bool is_prompt(std::chrono::nanoseconds now) const noexcept {
    return ownership_.is_on() || assured_.is_active(now);
  }
  /// Queues final Entity States (deactivated), as far as the writer has room, and then the leaving
  /// announcement. True once all are queued; until then call it again when the writer has room.
  bool stop(std::chrono::nanoseconds now, std::chrono::nanoseconds utc) noexcept;
  /// Reports pending datagrams from the network to the tap as unread, at shutdown.
  void report_unread() noexcept { intake_.report_unread(); }

  [[nodiscard]] haptics::TripleBuffer<PeerView>& views() noexcept { return view_.views(); }
  [[nodiscard]] haptics::SpscRing<Notice>& notices() noexcept { return watches_.notices(); }
  [[nodiscard]] const RemoteEntities& remote() const noexcept { return remote_; }
  [[nodiscard]] RemoteEntities& remote() noexcept { return remote_; }
  /// Emissions of remote entities. Rows that have timed out are dropped before each view.
  [[nodiscard]] const EmissionTable& emissions() const noexcept { return emissions_; }
  [[nodiscard]] const OwnedEntities& owned() const noexcept { return owned_; }
  [[nodiscard]] const TimeKeeper& time() const noexcept { return time_; }
  /// The present pass, or the last one.
  [[nodiscard]] const Pass& pass() const noexcept { return pass_; }
  /// The first entity of this peer; number 0 if it has none. By the thread of step(), or while the
  /// loops are stopped.
  [[nodiscard]] pdu::EntityId own_id() const noexcept { return owned_.first_id(); }

 private:
  using Nanoseconds = std::chrono::nanoseconds;

  void begin(Nanoseconds now, Nanoseconds utc) noexcept;
  void read_sensors() noexcept;
  void do_tasks() noexcept;
  void publish() noexcept;
  void drop_stale(Nanoseconds now) noexcept;
  void take_update(const Inbound& update, const Arrival& arrival) noexcept override;
  bool take_interaction(const Inbound& update, const Arrival& arrival) noexcept;
  void claim(const aoim::PeerId& name, std::uint32_t epoch) noexcept override;
  void drop(const aoim::PresenceEvent::Dropped& life, bool silent) noexcept override;
  void rename(const aoim::PeerId& own) noexcept override;
  void receive(const aoim::RelayedState& relayed,
               const aoim::SourceAddress& from) noexcept override;
  void report(const aoim::PresenceEvent& event) noexcept override;
  void doubt_silent_peers() noexcept;
  void consider_others() noexcept;
  [[nodiscard]] bool consider_other(OwnedEntity& entity, EntityNumber number) noexcept;
  [[nodiscard]] Eigen::Vector3d middle_of_interest() const noexcept;
  void look_around() noexcept;
  void publish_view() noexcept;
  void emit(bool everything) noexcept;
  template <typename... Arguments>
  void report(NoticeKind kind, std::string_view format, const Arguments&... arguments) noexcept;

  const SceneFile& scene_;
  LoopTrace trace_;
  Pass pass_;
  ModelCounters counted_;
  OwnedEntities owned_;
  TrackedEntities tracked_;
  BodyStage bodies_;
  aoim::AreaOfInterestManager aoim_;
  TimeKeeper time_;
  RemoteEntities remote_;
  EmissionTable emissions_;
  EntitySender sender_;
  DatagramIntake intake_;
  DatagramOutlet outlet_;
  TouchStage touch_;
  Subscriber subscriber_;
  PeerWatches watches_;
  HookList hooks_;  // behind the stages that ask it, whose counters its rows read
  OrderStage orders_;
  AssuredStage assured_;
  OwnershipStage ownership_;
  RecordStage records_;
  ViewPublisher view_;
  ModelGuest* guest_ = nullptr;
  ReturnedPeers returned_;
  std::size_t goodbyes_ = 0;  // entities up to this number have sent their final state
};

}  // namespace reckon::peer
