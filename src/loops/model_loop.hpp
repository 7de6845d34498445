// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The loop between the servos and the network: keeps the state table and the entities of this peer,
// decides what to send and to whom, and tells each servo what its hand can touch. It is the only
// writer of all of these.
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "reckon/aoim/area_of_interest_manager.hpp"
#include "reckon/aoim/interest/focus_cover.hpp"
#include "reckon/deadreckon/motion/geocentric.hpp"
#include "reckon/haptics/exchange/servo_types.hpp"
#include "reckon/haptics/exchange/spsc_ring.hpp"
#include "reckon/haptics/exchange/triple_buffer.hpp"
#include "reckon/peer/clocks/time_keeper.hpp"
#include "reckon/peer/counters/counters.hpp"
#include "reckon/peer/loops/aoim_setup.hpp"
#include "reckon/peer/loops/aoim_watch.hpp"
#include "reckon/peer/loops/beacon_watch.hpp"
#include "reckon/peer/loops/channel_keeper.hpp"
#include "reckon/peer/loops/contact_foci.hpp"
#include "reckon/peer/loops/datagram_ring.hpp"
#include "reckon/peer/loops/entity_sender.hpp"
#include "reckon/peer/loops/known_sources_publisher.hpp"
#include "reckon/peer/loops/leader_watch.hpp"
#include "reckon/peer/loops/limit_watch.hpp"
#include "reckon/peer/loops/link_watch.hpp"
#include "reckon/peer/loops/model_counters.hpp"
#include "reckon/peer/loops/network_read_loop.hpp"
#include "reckon/peer/loops/notice.hpp"
#include "reckon/peer/loops/notice_gate.hpp"
#include "reckon/peer/loops/refusal_watch.hpp"
#include "reckon/peer/loops/silence_watch.hpp"
#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/peer/world/datagram_decoder.hpp"
#include "reckon/peer/world/energy_books.hpp"
#include "reckon/peer/world/hand_port.hpp"
#include "reckon/peer/world/interaction_sender.hpp"
#include "reckon/peer/world/near_bodies.hpp"
#include "reckon/peer/world/overtaken_states.hpp"
#include "reckon/peer/world/owned_entities.hpp"
#include "reckon/peer/world/peer_view.hpp"
#include "reckon/peer/world/portless_bodies.hpp"
#include "reckon/peer/world/remote_entities.hpp"
#include "reckon/peer/world/tracked_entities.hpp"

namespace reckon::peer {

/// What the model loop is connected to; all of it outlives the loop.
struct ModelWiring {
  const SceneFile& scene;
  const deadreckon::LocalFrame& frame;
  const GroupPool& pool;
  DatagramRing& inbound;
  DatagramRing& outbound;
  haptics::SpscRing<GroupCommand>& commands;
  Link& link;  ///< to hear how it fares; the loop sends and reads by the rings
  haptics::SpscRing<ShownSample>* shown;  ///< may be null
  Counters& counters;
  std::size_t capacity = 100'000;                   ///< of the table of remote entities
  bool record_changes = false;                      ///< for RemoteEntities::take_changes()
  haptics::SpscRing<MutedSender>* muted = nullptr;  ///< of the read loop; may be null
  DatagramTap* tap = nullptr;    ///< is told what becomes of each datagram; may be null
  DatagramRing* felt = nullptr;  ///< what came in contact groups, taken first; may be null
  haptics::TripleBuffer<KnownSources>* known = nullptr;  ///< of the read loop; may be null
};

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
class ModelLoop {
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
    return std::min({aoim_.next_step(), next_view_, owned_.next_due(), tracked_.next_due()});
  }
  /// Queues last Entity States (deactivated), as many as the writer has room for, and at last the
  /// good-bye. True once all is said; until then call it again when the writer has made room.
  bool stop(std::chrono::nanoseconds now, std::chrono::nanoseconds utc) noexcept;
  /// Tells the tap of what waits in the ring from the network: nobody will read it.
  void settle() noexcept;

  [[nodiscard]] haptics::TripleBuffer<PeerView>& views() noexcept { return views_; }
  [[nodiscard]] haptics::SpscRing<Notice>& notices() noexcept { return notices_; }
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
  void drop_stale(std::chrono::nanoseconds now) noexcept;
  void drain() noexcept;
  void drain(DatagramRing& ring) noexcept;
  [[nodiscard]] std::size_t take_datagrams(std::span<const QueuedDatagram> datagrams) noexcept;
  [[nodiscard]] KeySpeaker key_speaker(const Arrival& arrival) const noexcept;
  [[nodiscard]] bool admit(const QueuedDatagram& datagram, ArrivedDatagram& admitted) noexcept;
  void take_update(const Inbound& update, const Arrival& arrival) noexcept;
  void take_interaction(const Inbound& update, const Arrival& arrival) noexcept;
  void take_control(const Inbound& update, const Arrival& arrival) noexcept;
  [[nodiscard]] bool obeys(const Inbound& update, const Arrival& arrival) noexcept;
  void answer(const Inbound& update, const Arrival& arrival, const pdu::EntityId& own) noexcept;
  void take_presence_events() noexcept;
  void take_relayed() noexcept;
  void doubt_the_silent() noexcept;
  void tell_what_is_felt() noexcept;
  void tell_muted() noexcept;
  void cover_our_entities() noexcept;
  void place_beacons() noexcept;
  void subscribe() noexcept;
  void listen_near() noexcept;
  void command(const aoim::SubscriptionChange& change) noexcept;
  void read_hands() noexcept;
  void answer_bodies() noexcept;
  void find_near() noexcept;
  void consider_hands() noexcept;
  void consider_bodies() noexcept;
  void consider_others() noexcept;
  [[nodiscard]] bool consider_other(OwnedEntity& entity, EntityNumber number) noexcept;
  [[nodiscard]] HandPort* port_of(EntityNumber number) noexcept;
  [[nodiscard]] PortlessBody* body_of(EntityNumber number) noexcept;
  void tell_impacts(std::size_t hand) noexcept;
  void tell_softened(std::string_view marking, const DeviceStiffness& device) noexcept;
  void send_impact(const HandPort& port, const RemoteEntity& row,
                   const haptics::ContactAccount& contact) noexcept;
  void publish_all_contacts() noexcept;
  void publish_shown() noexcept;
  [[nodiscard]] Eigen::Vector3d middle_of_interest() const noexcept;
  void publish_view() noexcept;
  void emit(bool everything) noexcept;
  void tell_judged(const QueuedDatagram& datagram, const aoim::Incoming& incoming,
                   std::uint64_t lost_before) noexcept;
  void tell_numbered(aoim::GroupIndex group, std::span<const std::byte> octets,
                     DatagramFate more) noexcept;
  [[nodiscard]] GroupAddress address_of(aoim::GroupIndex group) const noexcept {
    return group == aoim::kBaseGroup ? pool_.base() : pool_.address(group.value - 1u);
  }
  void push_datagram(aoim::GroupIndex group, std::span<const std::byte> octets) noexcept;
  template <typename Pdu>
  void queue(const Pdu& pdu) noexcept;
  template <typename... Arguments>
  void tell(std::string_view format, const Arguments&... arguments) noexcept;

  const SceneFile& scene_;
  const deadreckon::LocalFrame& frame_;
  const GroupPool& pool_;
  DatagramRing& inbound_;
  DatagramRing* felt_;
  DatagramRing& outbound_;
  haptics::SpscRing<GroupCommand>& commands_;
  haptics::SpscRing<ShownSample>* shown_;
  haptics::SpscRing<MutedSender>* muted_;
  KnownSourcesPublisher known_;
  DatagramTap* tap_;
  std::uint32_t epoch_;

  Pass pass_;
  Nanoseconds started_{0};
  Nanoseconds next_view_{0};

  // What one hand touches, and what it touched at the last step.
  struct Touch {
    bool moved = false;
    std::array<Touched, haptics::kMaxRemoteHands> touched{};
    std::size_t touched_count = 0;
  };

  OwnedEntities owned_;
  std::vector<HandPort> hands_;                 // at most kMaxDevices
  std::vector<Touch> touches_;                  // of hands_
  std::vector<DeviceStiffness> stiffness_;      // of hands_
  std::array<NearBodies, kMaxDevices> near_{};  // to hands_
  std::vector<PortlessBody> bodies_;
  std::vector<MovingBody> moving_;  // of bodies_, in their order
  HandsNear hands_near_;            // of moving_
  aoim::SourceAddress crowder_;     // the last one who had more near a hand than it takes
  TrackedEntities tracked_;
  EnergyBooks books_;
  aoim::AreaOfInterestManager aoim_;
  TimeKeeper time_;
  RemoteEntities remote_;
  DatagramDecoder decoder_;
  std::vector<QueuedDatagram> queued_;     // those taken at a time
  std::vector<ArrivedDatagram> admitted_;  // of them, those that are read
  OvertakenStates overtaken_;
  bool looks_far_ = false;          // nearly all that waited was overtaken
  std::vector<aoim::Focus> balls_;  // what each entity of ours senses
  aoim::FocusCover cover_;
  std::span<const aoim::Focus> foci_;                 // they cover the balls
  bool moved_ = true;                                 // an entity of ours, since they were made
  Nanoseconds heard_again_ = Nanoseconds::min() / 2;  // somebody
  ContactFoci contact_foci_;
  EntitySender sender_;
  ModelGuest* guest_ = nullptr;
  std::uint16_t impacts_ = 0;
  double power_given_j_ = 0.0;
  std::size_t goodbyes_ = 0;  // numbers up to this one have said so
  ViewChoice view_choice_;
  haptics::TripleBuffer<PeerView> views_;
  haptics::SpscRing<Notice> notices_;
  NoticeGate notice_gate_;
  AoimWatch aoim_watch_;
  LimitWatch limit_watch_;
  SilenceWatch silence_watch_;
  LeaderWatch leader_watch_;
  BeaconWatch beacon_watch_;
  std::vector<aoim::PlacedBeacon> beacons_;  // of ours, as they were placed last
  RefusalWatch refusal_watch_{notice_gate_, notices_};
  ChannelKeeper channel_keeper_;
  LinkWatch link_watch_;
  ModelCounters counted_;
};

}  // namespace reckon::peer
