// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The incoming half of the model loop: checks received states and keeps the state table.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>

#include "reckon/aoim/area_of_interest_manager.hpp"
#include "reckon/deadreckon/motion/geocentric.hpp"
#include "reckon/haptics/exchange/servo_types.hpp"
#include "reckon/peer/counters/counters.hpp"
#include "reckon/peer/counters/error_histogram.hpp"
#include "reckon/peer/world/arrival.hpp"
#include "reckon/peer/world/change_list.hpp"
#include "reckon/peer/world/contact_beginnings.hpp"
#include "reckon/peer/world/datagram_decoder.hpp"
#include "reckon/peer/world/due_column.hpp"
#include "reckon/peer/world/entity_ownership.hpp"
#include "reckon/peer/world/force_model_intake.hpp"
#include "reckon/peer/world/held_states.hpp"
#include "reckon/peer/world/near_search.hpp"
#include "reckon/peer/world/outside_entities.hpp"
#include "reckon/peer/world/remote_counters.hpp"
#include "reckon/peer/world/remote_motion.hpp"
#include "reckon/peer/world/remote_parts.hpp"
#include "reckon/peer/world/remote_settings.hpp"
#include "reckon/peer/world/row_admission.hpp"
#include "reckon/peer/world/row_owners.hpp"
#include "reckon/peer/world/scene_bodies.hpp"
#include "reckon/peer/world/sight_watch.hpp"
#include "reckon/peer/world/state_table.hpp"
#include "reckon/peer/world/touch_gate.hpp"

namespace reckon::peer {

/// Why the entities of a peer were removed.
enum class Gone : std::uint8_t { left, silent };

/// The remote entities of one peer. One thread (the model loop's); no allocation after
/// construction. An update of a known entity costs some 0.3 us, of an unwatched one 0.17 us.
///
/// Only its owner changes an entity. The numbers of a living peer belong to only that peer,
/// identified by its epoch. A row with a number that no peer has belongs to the sender (address,
/// port, epoch) that made it, until it has been silent for RowOwners::kSilence. For a guest of
/// plain DIS this time is half the time-out of its entity, at most RowOwners::kGuestSilence.
///
/// A body of the scene belongs to the peer that RemoteSettings::body_owners names, see SceneBodies.
/// Its row passes from owner to owner, and stays at its place when its owner leaves or is silent.
class RemoteEntities {
 public:
  /// References outlive this.
  RemoteEntities(const deadreckon::LocalFrame& frame, aoim::AreaOfInterestManager& aoim,
                 const RemoteSettings& settings, Counters& counters);

  /// Prefetches the memory that the updates of a datagram touch. In a large table this memory is
  /// usually not in a cache.
  void prefetch(std::span<const Inbound> updates) const noexcept;
  /// Takes one update, or refuses and counts it; true if it was taken.
  /// @param servo our own hand as last seen.
  bool take(const Inbound& update, const Arrival& arrival,
            const haptics::ServoSnapshot& servo) noexcept;
  /// In whose name a PDU other than a state was sent, by the same rule as for states: the owner's,
  /// if the sender owns one of `ids`. A refused PDU is counted in `disputed_in` and reported. An
  /// entity number without an entity means its site and application. Some 20 ns each.
  [[nodiscard]] SenderRight sender_right(std::span<const pdu::EntityId> ids,
                                         const Arrival& arrival) noexcept {
    return ownership_.sender_right(ids, arrival);
  }
  /// Records an accepted datagram from this address, so that its rows are not given to other
  /// senders.
  void heard(const aoim::SourceAddress& from, std::chrono::nanoseconds now) noexcept {
    owners_.heard(from, now);
    outside_.heard(from, now);
  }
  /// Drops all entities of a peer. The bodies of the scene that it owned are doubted.
  void drop_peer(aoim::PeerId id, Gone how, std::chrono::nanoseconds now) noexcept;
  /// Brings the entities of the process with this epoch to rest, from `now` until they are believed
  /// or updated. They are not felt until they are updated. Visits all rows.
  void doubt_peer(std::uint32_t epoch, std::chrono::nanoseconds now) noexcept;
  /// The same for one entity, if it is known.
  void doubt(const pdu::EntityId& id, std::chrono::nanoseconds now) noexcept;
  /// The entities move on from their shown places, and converge to the continued prediction. Hands
  /// that were silent since `silent` have no force any more.
  void believe_peer(std::uint32_t epoch, std::chrono::nanoseconds silent,
                    std::chrono::nanoseconds now) noexcept;
  /// Removes the force of this entity until it is updated.
  void end_force(const pdu::EntityId& id) noexcept;
  /// Records that it presses a hand of ours.  @return since when, after its last state
  std::chrono::nanoseconds note_pressed(const pdu::EntityId& id,
                                        std::chrono::nanoseconds now) noexcept;
  /// Fades its force out from `now` until it is updated.
  void fade(const pdu::EntityId& id, std::chrono::nanoseconds now) noexcept;
  /// Removes the row of a body that this peer owns from now on.
  void forget(const pdu::EntityId& body) noexcept;
  /// A peer has claimed these numbers with this epoch: drops rows of other senders under them.
  void claim(aoim::PeerId id, std::uint32_t epoch) noexcept;
  /// Drops entities that were silent for longer than their time-out, except bodies of the scene.
  /// Some ns if there are none.
  void expire(std::chrono::nanoseconds now) noexcept;
  /// Removes shown entities that have left the radius without an update, by our movement or their
  /// own. This takes at most a second if at most SightWatch::kMostLooks are due at once. They are
  /// kept as outside entities, and return by look_outside(). Call it as often as look_outside(),
  /// and before it; some 2 us for each removed one.
  void look_shown(std::chrono::nanoseconds now) noexcept;
  /// Adds outside entities that have entered the radius of interest, by their movement or ours,
  /// within a second. Call it some ten times a second, after the foci were set; 50 ns for each
  /// checked one.
  void look_outside(std::chrono::nanoseconds now) noexcept;

  /// Calls visit(epoch of its peer, position [m, S] as received and extrapolated to `now`, speed
  /// [m/s]) for each received entity, shown or not.
  void for_each_place(std::chrono::nanoseconds now, auto&& visit) const {
    for (const RemoteEntity& row : rows()) {
      const RemoteEntity::Motion motion = row.motion(now);
      visit(row.epoch, motion.position, motion.velocity.norm());
    }
    outside_.for_each([&](const OutsideEntity& entity) {
      visit(entity.arrival().epoch, entity.position(now), entity.state().velocity.norm());
    });
  }
  /// Call it after we have left these groups. An entity whose shown state came in one of their near
  /// groups returns to the newest state of an outer row, because its owner checks that one for us.
  /// If several rows were left, the order is from the nearest. 1 ns for each entity and near group.
  void leave_groups(std::span<const aoim::GroupIndex> groups,
                    std::chrono::nanoseconds now) noexcept;
  /// Finds the entities that each of our hands could touch at `now`, and the remote hands that
  /// moving bodies of ours could meet; see NearSearch.
  void find_near(std::span<const deadreckon::ProbeState> probes, std::chrono::nanoseconds now,
                 std::span<NearBodies> found, std::span<const MovingBody> bodies,
                 HandsNear& hands) noexcept {
    near_.find(table_.rows(), probes, now, found, bodies, hands);
  }
  /// Calls visit(row) for each entity that has a force model.
  void visit_felt(auto&& visit) const { near_.visit_felt(table_.rows(), visit); }
  /// Reserves room for this many moving bodies of ours; allocates.
  void expect_bodies(std::size_t count) { near_.expect_bodies(count); }
  /// Takes the changes since the last call, if `record_changes`; else nothing. Valid until the next
  /// call. Applying them in order yields the entities of rows().
  [[nodiscard]] std::span<const EntityChange> take_changes() noexcept {
    return changes_.take(table_.rows());
  }

  [[nodiscard]] std::span<const RemoteEntity> rows() const noexcept { return table_.rows(); }
  [[nodiscard]] const RemoteEntity* find(const pdu::EntityId& id) const noexcept {
    return table_.find(id);
  }
  /// Articulated parts of an entity as shown at `now` (steady time); empty if it has none or is not
  /// known. Valid until the next take, drop or expire.
  [[nodiscard]] ShownParts parts(const pdu::EntityId& id,
                                 std::chrono::nanoseconds now) const noexcept;
  /// Entities that have parts.
  [[nodiscard]] std::size_t with_parts() const noexcept { return parts_.in_use(); }
  /// Impostors, see Disputes::take_news.
  [[nodiscard]] std::optional<Dispute> take_dispute(std::chrono::nanoseconds now) noexcept {
    return ownership_.take_dispute(now);
  }
  /// Upper bound of the memory for guests' entities, shown or not [octets]; 0.7 to 0.9 of it are
  /// used.
  [[nodiscard]] std::size_t strangers_octets() const noexcept { return admission_.guests_octets(); }
  /// Rows dropped to make room for others, and the owner of the last one.
  [[nodiscard]] std::uint64_t evicted() const noexcept { return admission_.evicted(); }
  /// Entities of plain DIS programs refused for lack of room, and the sender of the last one, which
  /// belongs to the host with the most entities.
  [[nodiscard]] std::uint64_t strangers_refused() const noexcept { return admission_.refused(); }
  [[nodiscard]] const aoim::SourceAddress& last_stranger() const noexcept {
    return admission_.last_refused();
  }
  [[nodiscard]] const aoim::SourceAddress& last_evicted() const noexcept {
    return admission_.last_evicted();
  }
  /// Entity whose force model was refused last.
  [[nodiscard]] const pdu::EntityId& last_refused() const noexcept {
    return models_.last_refused();
  }
  /// Force models refused by the scene's `touch`, and the last such entity.
  [[nodiscard]] std::uint64_t untouchable() const noexcept { return models_.untouchable(); }
  [[nodiscard]] const Untouchable& last_untouchable() const noexcept {
    return models_.last_untouchable();
  }
  /// Counts a body that is not felt by the scene's `touch`.
  void refuse_touch(const RemoteEntity& row) noexcept { models_.refuse(row, table_.place_of(row)); }
  /// The scene's bodies as received.
  [[nodiscard]] const SceneBodies& bodies() const noexcept { return bodies_; }
  /// The scene's touch rule.
  [[nodiscard]] TouchGate& touch() noexcept { return touch_; }
  /// Bodies that appeared inside a hand and are not felt there yet.
  [[nodiscard]] const ContactBeginnings& beginnings() const noexcept { return beginnings_; }
  /// Address of the owner of a row of rows().
  [[nodiscard]] const aoim::SourceAddress& owner(const RemoteEntity& row) const noexcept {
    return owners_.owner(table_.place_of(row));
  }
  /// Time of the last datagram from the owner of a row of rows().
  [[nodiscard]] std::chrono::nanoseconds owner_heard(const RemoteEntity& row) const noexcept {
    return owners_.last_heard(table_.place_of(row));
  }
  /// Steady time at which the first one was accepted; negative before.
  [[nodiscard]] std::chrono::nanoseconds first_heard() const noexcept { return first_heard_; }

  /// Innovations: the distance of each update from its prediction for the same instant, as pose [m]
  /// and as force on our hand [N]. They measure the errors of a receiver. Any thread.
  [[nodiscard]] const ErrorHistogram& pose_jumps() const noexcept { return motion_.pose_jumps(); }
  [[nodiscard]] const ErrorHistogram& force_jumps() const noexcept { return motion_.force_jumps(); }

 private:
  RemoteEntity* row_for(RemoteEntity* row, const Inbound& update, const Arrival& arrival,
                        deadreckon::KinematicState& state) noexcept;
  void keep_outside(const Inbound& update, const Arrival& arrival,
                    const deadreckon::KinematicState& state, const RemoteEntity* row) noexcept;
  void keep_outside(const RemoteEntity& row) noexcept;
  void note_sight(const RemoteEntity& row, aoim::InterestVerdict verdict,
                  const deadreckon::KinematicState& state, std::chrono::nanoseconds now) noexcept;
  void note_held(const RemoteEntity& row, const ReceivedState& heard, std::chrono::nanoseconds time,
                 bool newest) noexcept;
  void go_back(std::size_t place, const HeldState& held, std::chrono::nanoseconds now) noexcept;
  void enter(const OutsideEntity& entity, std::chrono::nanoseconds owner_heard) noexcept;
  void note_taken(RemoteEntity& row, const Inbound& update) noexcept;
  RemoteEntity* add_row(const pdu::EntityId& id, const Arrival& arrival) noexcept;
  void keep_outside(const OutsideEntity& entity) noexcept;
  bool note_repeat(RemoteEntity& row, const Inbound& update, const ReceivedState& heard) noexcept;
  void take_parts(RemoteEntity& row, const pdu::EntityState& state, std::chrono::nanoseconds now,
                  bool abrupt) noexcept;
  bool refresh(RemoteEntity& row, const ReceivedState& heard) noexcept;
  void take_model(RemoteEntity& row, const pdu::HapticRecord& model) noexcept;
  void doubt_row(std::size_t place, std::chrono::nanoseconds now) noexcept;
  void believe_row(std::size_t place, std::chrono::nanoseconds now) noexcept;
  static void end_force(RemoteEntity& row) noexcept;
  void drop(std::size_t place, Removal cause) noexcept;
  [[nodiscard]] Counter& counter_of(Removal cause) noexcept;

  const deadreckon::LocalFrame& frame_;
  aoim::AreaOfInterestManager& aoim_;
  RemoteSettings settings_;
  RemoteParts parts_;
  RemoteCounters counts_;
  StateTable table_;
  // Beside it, row by row.
  RowOwners owners_;
  RemoteMotion motion_;
  HeldStates held_;  // in scenes with near groups
  DueColumn time_outs_;
  SightWatch sight_;
  ContactBeginnings beginnings_;
  NearSearch near_;
  ChangeList changes_;
  OutsideEntities outside_;
  EntityOwnership ownership_;
  RowAdmission admission_;
  TouchGate touch_;
  ForceModelIntake models_;
  SceneBodies bodies_;
  std::chrono::nanoseconds first_heard_{-1};
};

}  // namespace reckon::peer
