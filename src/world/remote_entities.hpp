// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The incoming half of the model loop: checks what others say of their entities and keeps the state
// table.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "reckon/aoim/area_of_interest_manager.hpp"
#include "reckon/deadreckon/motion/geocentric.hpp"
#include "reckon/haptics/exchange/servo_types.hpp"
#include "reckon/peer/counters/counters.hpp"
#include "reckon/peer/counters/error_histogram.hpp"
#include "reckon/peer/world/arrival.hpp"
#include "reckon/peer/world/change_list.hpp"
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
#include "reckon/peer/world/sight_watch.hpp"
#include "reckon/peer/world/state_table.hpp"

namespace reckon::peer {

/// How entities of a peer went.
enum class Gone : std::uint8_t { left, silent };

/// The remote entities of one peer. One thread (the model loop's); no allocation after
/// construction. An update of a known entity costs some 0.3 us.
///
/// Nobody but its owner changes an entity: a living peer alone speaks for its numbers, by its
/// epoch. Of numbers that no peer has, the sender (address, port, epoch) that made a row may change
/// it, until it has been silent for RowOwners::kSilence, or a guest of plain DIS for half the
/// time-out of its entity, at most RowOwners::kGuestSilence.
class RemoteEntities {
 public:
  /// References outlive this.
  RemoteEntities(const deadreckon::LocalFrame& frame, aoim::AreaOfInterestManager& aoim,
                 const RemoteSettings& settings, Counters& counters);

  /// Has what updates of a datagram will touch brought near, before they are taken one by one: in a
  /// large table nothing of it is in a cache.
  void prefetch(std::span<const Inbound> updates) const noexcept;
  /// Takes one update, or refuses and counts it; true where it was taken. @param servo our own hand
  /// as last seen.
  bool take(const Inbound& update, const Arrival& arrival,
            const haptics::ServoSnapshot& servo) noexcept;
  /// In whose name somebody speaks who says something that is no state: by the rule of states, the
  /// owner where one of `ids` is his. What is refused is counted in `disputed_in` and reported. An
  /// entity number that no entity has stands for its site and application. Some 20 ns each.
  [[nodiscard]] Voice hear(std::span<const pdu::EntityId> ids, const Arrival& arrival) noexcept {
    return ownership_.hear(ids, arrival);
  }
  /// Something that is to be believed came from there: its rows are not given to others.
  void heard(const aoim::SourceAddress& from, std::chrono::nanoseconds now) noexcept {
    owners_.heard(from, now);
    outside_.heard(from, now);
  }
  /// Drops all entities of a peer.
  void drop_peer(aoim::PeerId id, Gone how) noexcept;
  /// The entities of a process whose epoch this is come to rest, from `now` until they are believed
  /// or updated, and are felt no more until they are updated. All rows are looked at.
  void doubt_peer(std::uint32_t epoch, std::chrono::nanoseconds now) noexcept;
  /// The same of one entity, where it is known.
  void doubt(const pdu::EntityId& id, std::chrono::nanoseconds now) noexcept;
  /// They go on from where they are shown, and converge to what was predicted all the while. Of
  /// hands that have said nothing since `silent` no force is left.
  void believe_peer(std::uint32_t epoch, std::chrono::nanoseconds silent,
                    std::chrono::nanoseconds now) noexcept;
  /// Of this entity no force is left until it is updated.
  void let_go(const pdu::EntityId& id) noexcept;
  /// A peer has these numbers now, in this life: drops what others said under them.
  void claim(aoim::PeerId id, std::uint32_t epoch) noexcept;
  /// Drops what has been silent for longer than its time-out. Some ns where nothing is.
  void expire(std::chrono::nanoseconds now) noexcept;
  /// Puts out of sight what is shown and is not within any more, by our movement or by its own,
  /// without a word of its owner: a second after it at the latest, where not more than
  /// SightWatch::kMostLooks are due at once. It is kept as what is heard outside, and comes back by
  /// look_outside. To be called as often, before it; some 2 us for each that goes.
  void look_shown(std::chrono::nanoseconds now) noexcept;
  /// Takes in what was heard outside the radius of interest and is within by now, by its movement
  /// or by ours, a second after it at the latest. To be called some ten times a second, after the
  /// foci have been set; 50 ns for each that is looked at.
  void look_outside(std::chrono::nanoseconds now) noexcept;

  /// Calls visit(epoch of its peer, position [m, S] as it was received, carried on to `now`, speed
  /// [m/s]) for each entity heard, shown or not.
  template <typename Visit>
  void for_each_place(std::chrono::nanoseconds now, Visit&& visit) const {
    for (const RemoteEntity& row : rows()) {
      const deadreckon::Pose pose = row.predicted(now);
      visit(row.epoch, pose.position, pose.velocity.norm());
    }
    outside_.for_each([&](const OutsideEntity& entity) {
      visit(entity.arrival().epoch, entity.position(now), entity.state().velocity.norm());
    });
  }
  /// We listen to these groups no more: what is shown by what came by near ones of them goes back
  /// to the newest that came by a row behind, which is what its owner keeps right for us. In order:
  /// of several rows the nearest first. 1 ns an entity and near group.
  void leave_groups(std::span<const aoim::GroupIndex> groups,
                    std::chrono::nanoseconds now) noexcept;
  /// What each of our hands could touch at `now`, see NearSearch.
  void find_near(std::span<const deadreckon::ProbeState> probes, std::chrono::nanoseconds now,
                 std::span<NearBodies> found) noexcept {
    near_.find(table_.rows(), probes, now, found);
  }
  /// The same, and which hands of others what moves of ours could meet.
  void find_near(std::span<const deadreckon::ProbeState> probes, std::chrono::nanoseconds now,
                 std::span<NearBodies> found, std::span<const MovingBody> bodies,
                 HandsNear& hands) noexcept {
    near_.find(table_.rows(), probes, now, found, bodies, hands);
  }
  /// So many bodies of ours may move from now on; allocates.
  void expect_bodies(std::size_t count) { near_.expect_bodies(count); }
  /// What has come, changed and gone since the last call, with `record_changes`; else nothing. Good
  /// until the next call. Whoever follows them in order has the entities of rows().
  [[nodiscard]] std::span<const EntityChange> take_changes() noexcept {
    return changes_.take(table_.rows());
  }

  [[nodiscard]] std::span<const RemoteEntity> rows() const noexcept { return table_.rows(); }
  [[nodiscard]] const RemoteEntity* find(const pdu::EntityId& id) const noexcept {
    return table_.find(id);
  }
  /// Articulated parts of an entity as shown at `now` (steady time); empty where it has none or is
  /// not known. Good until the next take, drop or expire.
  [[nodiscard]] ShownParts parts(const pdu::EntityId& id,
                                 std::chrono::nanoseconds now) const noexcept;
  /// Entities that have parts.
  [[nodiscard]] std::size_t with_parts() const noexcept { return parts_.in_use(); }
  /// Who spoke for entities of others, see Disputes::take_news.
  [[nodiscard]] std::optional<Dispute> take_dispute(std::chrono::nanoseconds now) noexcept {
    return ownership_.take_dispute(now);
  }
  /// What is kept of guests' entities, shown or not, may take so much now [octets]; a bound, of
  /// which 0.7 to 0.9 are used.
  [[nodiscard]] std::size_t strangers_octets() const noexcept { return admission_.guests_octets(); }
  /// Rows that made room for others', and whose the last of them was.
  [[nodiscard]] std::uint64_t evicted() const noexcept { return admission_.evicted(); }
  /// Entities of plain DIS programs for which there was no room, and who said the last of them:
  /// nobody has more.
  [[nodiscard]] std::uint64_t strangers_refused() const noexcept { return admission_.refused(); }
  [[nodiscard]] const aoim::SourceAddress& last_stranger() const noexcept {
    return admission_.last_refused();
  }
  [[nodiscard]] const aoim::SourceAddress& last_evicted() const noexcept {
    return admission_.last_evicted();
  }
  /// Whose force model was the last to be refused.
  [[nodiscard]] const pdu::EntityId& last_refused() const noexcept {
    return models_.last_refused();
  }
  /// Force models of those whom `touch` of the scene leaves out, and whose the last of them was.
  [[nodiscard]] std::uint64_t untouchable() const noexcept { return models_.untouchable(); }
  [[nodiscard]] const Untouchable& last_untouchable() const noexcept {
    return models_.last_untouchable();
  }
  /// Where the owner of a row of rows() speaks from.
  [[nodiscard]] const aoim::SourceAddress& owner(const RemoteEntity& row) const noexcept {
    return owners_.owner(table_.place_of(row));
  }
  /// Steady time at which the first one was accepted; negative before.
  [[nodiscard]] std::chrono::nanoseconds first_heard() const noexcept { return first_heard_; }

  /// Innovations: how far each update was from what had been predicted for the same instant, as
  /// pose [m] and as force on our hand [N]. What a listener can know of its errors. Any thread.
  [[nodiscard]] const ErrorHistogram& pose_jumps() const noexcept { return motion_.pose_jumps(); }
  [[nodiscard]] const ErrorHistogram& force_jumps() const noexcept { return motion_.force_jumps(); }

 private:
  RemoteEntity* row_for(RemoteEntity* row, const Inbound& update, const Arrival& arrival,
                        const deadreckon::KinematicState& state) noexcept;
  void keep_outside(const Inbound& update, const Arrival& arrival,
                    const deadreckon::KinematicState& state, const RemoteEntity* row) noexcept;
  void keep_outside(const RemoteEntity& row) noexcept;
  void note_sight(const RemoteEntity& row, aoim::InterestVerdict verdict,
                  const deadreckon::KinematicState& state, std::chrono::nanoseconds now) noexcept;
  void note_held(const RemoteEntity& row, const HeardState& heard, std::chrono::nanoseconds time,
                 bool newest) noexcept;
  void go_back(std::size_t place, const HeldState& held, std::chrono::nanoseconds now) noexcept;
  void enter(const OutsideEntity& entity, std::chrono::nanoseconds owner_heard) noexcept;
  void note_taken(RemoteEntity& row, const Inbound& update) noexcept;
  RemoteEntity* add_row(const pdu::EntityId& id, const Arrival& arrival) noexcept;
  void keep_outside(const OutsideEntity& entity) noexcept;
  bool note_repeat(RemoteEntity& row, const Inbound& update, const HeardState& heard) noexcept;
  void take_parts(RemoteEntity& row, const pdu::EntityState& state, std::chrono::nanoseconds now,
                  bool abrupt) noexcept;
  bool refresh(RemoteEntity& row, const HeardState& heard) noexcept;
  void take_model(RemoteEntity& row, const pdu::HapticRecord& model) noexcept;
  void doubt_row(std::size_t place, std::chrono::nanoseconds now) noexcept;
  void believe_row(std::size_t place, std::chrono::nanoseconds now) noexcept;
  static void let_go(RemoteEntity& row) noexcept;
  void drop(std::size_t place, Counter& why) noexcept;

  const deadreckon::LocalFrame& frame_;
  aoim::AreaOfInterestManager& aoim_;
  RemoteSettings settings_;
  RemoteParts parts_;
  RemoteCounters counts_;
  StateTable table_;
  // Beside it, row by row.
  RowOwners owners_;
  RemoteMotion motion_;
  HeldStates held_;  // in scenes of near groups
  DueColumn time_outs_;
  SightWatch sight_;
  NearSearch near_;
  ChangeList changes_;
  OutsideEntities outside_;
  EntityOwnership ownership_;
  RowAdmission admission_;
  ForceModelIntake models_;
  std::chrono::nanoseconds first_heard_{-1};
};

}  // namespace reckon::peer
