// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// THE state of all entities that a listener receives: which PDUs are accepted or refused, the time
// at which each state was valid, and the present pose of each entity. Views evaluate it further:
// forces between pairs (ContactForces), causes of updates (EntityTable), the difference of two
// streams (MotionDifference). Pure: PDUs and times in, no I/O.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "reckon/deadreckon/motion/geocentric.hpp"
#include "reckon/deadreckon/wire_conversion.hpp"
#include "reckon/pdu/entity/attribute.hpp"
#include "reckon/pdu/reckon/compressed_states.hpp"
#include "reckon/pdu/reckon/haptic_record.hpp"
#include "reckon/peer/clocks/sender_clock.hpp"
#include "reckon/peer/world/key_index.hpp"
#include "reckon/tools/datagrams/state_keys.hpp"
#include "reckon/tools/listener/received_entity.hpp"
#include "reckon/tools/listener/update_pace.hpp"

namespace reckon::tools {

/// Intended differences between listeners. The three kinds are below.
struct ListenerRules {
  /// Source of the local time of a state.
  enum class Timing : std::uint8_t {
    sender_clock,             ///< the sender's clock, as in a peer: older or equal states are
                              ///< refused
    sender_clock_or_arrival,  ///< the same, but arrival if timestamps do not advance; refuses none
    pace                      ///< arrival; UpdatePace finds copies and late updates
  };
  enum class Frame : std::uint8_t {
    geocentric,   ///< W, as on the wire
    first_place,  ///< east, north, up at the first entity: frame of the forces
    equator       ///< the same at latitude and longitude 0: common to several streams
  };

  std::size_t most_entities = 0;
  Timing timing = Timing::pace;
  Frame frame = Frame::geocentric;
  bool by_exercise = false;  ///< the same ID in another exercise is another entity
  bool uncoupled = false;    ///< entities without the CEI flag are accepted too
  bool models = false;       ///< force models are taken
  bool accounts = false;     ///< energy accounts are taken
  bool partial = false;      ///< Entity State Update and Remove Entity are taken
  bool keeps = false;        ///< entities that left, are silent or sent nothing usable are kept and
                             ///< marked
  bool sweeps = false;       ///< each state drops all entities that are silent past their time-out
  bool by_datagram = false;  ///< keeps the states before a datagram, and refuses models after a
                             ///< refused state in it; requires end_datagram()
  bool holds = false;        ///< a silent entity stops at its time-out
  bool rests = false;        ///< entities at rest have a longer time-out, as in DIS 7
};

/// Like a peer that receives coupled entities: the same PDUs are refused, and entities that left
/// are dropped.
inline constexpr ListenerRules kPeerRules{
    .most_entities = 512,  // haptic entities: all pairs are evaluated
    .timing = ListenerRules::Timing::sender_clock,
    .frame = ListenerRules::Frame::first_place,
    .models = true,
    .accounts = true,
    .sweeps = true,
    .by_datagram = true,
    .holds = true};
/// Motions of all entities of a capture, for comparison with another capture.
inline constexpr ListenerRules kCaptureRules{
    .most_entities = 4096,
    .timing = ListenerRules::Timing::sender_clock_or_arrival,
    .frame = ListenerRules::Frame::equator,
    .uncoupled = true,
    .holds = true};
/// All PDUs received, good or bad, of streams of any origin, for display.
inline constexpr ListenerRules kMonitorRules{.most_entities = std::size_t{1} << 16,
                                             .timing = ListenerRules::Timing::pace,
                                             .frame = ListenerRules::Frame::geocentric,
                                             .by_exercise = true,
                                             .uncoupled = true,
                                             .models = true,
                                             .partial = true,
                                             .keeps = true,
                                             .rests = true};

/// Result for a state or a model.
enum class ReceiveVerdict : std::uint8_t {
  taken,
  values,     ///< impossible values
  stale,      ///< not newer than the known state
  duplicate,  ///< a copy of the known state
};

/// Counters of unusable data.
struct ListenerRefusals {
  std::uint64_t values = 0;    ///< states, models and accounts with impossible values
  std::uint64_t stale = 0;     ///< states not newer than the known one
  std::uint64_t unplaced = 0;  ///< models of an entity without a state
  std::uint64_t crowded = 0;   ///< states and accounts without room
};

/// A state before it is taken.
struct StateUpdate {
  std::size_t place = 0;  ///< of its entity, whose data are still the earlier ones
  ReceiveVerdict verdict = ReceiveVerdict::taken;
  deadreckon::ConversionError error = deadreckon::ConversionError::none;  ///< reason of verdict
                                                                          ///< `values`
  bool is_first = true;  ///< no comparison with an earlier state is possible (Timing::pace)
  Interval between;      ///< since the state before (Timing::pace)
  double heartbeat = 0;  ///< [s] from now on
  const pdu::EntityState* pdu = nullptr;
  std::size_t compressed = 0;  ///< octets of its compressed form; 0: not compressed
  FixedOctets octets;
  deadreckon::KinematicState state;
  std::chrono::nanoseconds state_time{};
  std::chrono::nanoseconds arrival{};
};

/// A force model before it is taken.
struct ModelUpdate {
  std::size_t place = 0;  ///< of its entity, whose data are still the earlier ones
  deadreckon::ForceModel model;
  std::chrono::nanoseconds arrival{};
};

/// An entity in the present datagram, with its data before the datagram.
struct TouchedEntity {
  std::uint64_t key = 0;
  pdu::EntityId id;
  bool known = false;    ///< `before` is valid
  bool refused = false;  ///< its state was refused: so is the model after it
  ReceivedEntity before;
  ReceivedModel model_before;  ///< if before.is_haptic()
};

/// Last values of an entity's energy account for another entity.
struct StatedEnergy {
  double given = 0;  ///< [J], running total
  double need = 0;   ///< [J]
};

/// Observer that ignores everything; a base class.
struct ListenerObserver {
  /// A state after its check, before it is taken.
  void receive_state(const StateUpdate&) {}
  /// A set of records for the entity at `place`, one of `sets` in its PDU.
  void receive_records(std::size_t /*place*/, std::size_t /*sets*/) {}
  /// A model that will be taken.
  void receive_model(const ModelUpdate&) {}
};

/// A listener to one stream:
///
///   Listener listener(kPeerRules);
///   listener.take_pdu(octets, header, arrival);  // each PDU of a datagram
///   listener.end_datagram();
///   for (const ReceivedEntity& entity : listener.entities()) draw(entity.pose_at(now));
///
/// Accepts any octets. Places of entities and models are dense, from 0; forget_*() moves the last
/// one to the free place. One thread. Compressed States are restored: the residual form from the
/// first key of each entity that follows the first residual. Beyond 4,096 compressed entities the
/// oldest must wait for a new key. Allocates for new entities, within bounds, never for known ones.
/// Some 0.1 us per state with `pace`; `sweeps` costs some ns more for each entity.
class Listener {
 public:
  static constexpr std::size_t kNone = ~std::size_t{0};
  /// Limit of directed pairs whose energy accounts are kept.
  static constexpr std::size_t kMostAccounts = 4096;

  explicit Listener(const ListenerRules& rules);

  /// Takes one PDU of any type.
  /// @param arrival almost non-decreasing. If it is time since 1970-01-01 UTC, timestamps near it
  /// are taken as absolute.
  void take_pdu(std::span<const std::byte> pdu, const pdu::PduHeader& header,
                std::chrono::nanoseconds arrival);
  /// The same; calls `observer` (see ListenerObserver) before anything is taken.
  /// @param decoded the body of an Entity State, if the caller has decoded it already
  void take_pdu(std::span<const std::byte> pdu, const pdu::PduHeader& header,
                std::chrono::nanoseconds arrival, auto& observer,
                const pdu::EntityState* decoded = nullptr);
  /// Takes an Entity State that cannot be decoded. @return the entity's place, if the rules keep it
  std::size_t take_unreadable(std::uint8_t exercise, const pdu::EntityId& id,
                              std::chrono::nanoseconds arrival);
  /// Ends a datagram: clears touched().
  void end_datagram() noexcept { touched_.clear(); }

  /// Drops all entities that are silent past their time-out.
  void forget_silent(std::chrono::nanoseconds time);
  void forget_entity(std::size_t place);

  [[nodiscard]] std::span<const ReceivedEntity> entities() const noexcept { return entities_; }
  [[nodiscard]] std::span<const ReceivedModel> models() const noexcept { return models_; }
  /// An entity; null if it is unknown. The exercise is ignored unless the rules distinguish it.
  [[nodiscard]] const ReceivedEntity* find_entity(const pdu::EntityId& id,
                                                  std::uint8_t exercise = 0) const noexcept {
    const std::size_t place = place_of(exercise, id);
    return place == kNone ? nullptr : &entities_[place];
  }
  /// The place of an entity; kNone if it is unknown.
  [[nodiscard]] std::size_t place_of(std::uint8_t exercise, const pdu::EntityId& id) const noexcept;
  /// The same by ReceivedEntity::key.
  [[nodiscard]] std::size_t place_of_key(std::uint64_t key) const noexcept;
  /// Its force model; null if it has none.
  [[nodiscard]] const ReceivedModel* model_of(const ReceivedEntity& entity) const noexcept {
    return entity.is_haptic() ? &models_[entity.model] : nullptr;
  }
  /// The entities of the present datagram, at most 128.
  [[nodiscard]] std::span<const TouchedEntity> touched() const noexcept { return touched_; }

  /// Last account of `from` for `to`; zeros if there is none.
  [[nodiscard]] StatedEnergy stated_energy(const pdu::EntityId& from,
                                           const pdu::EntityId& to) const noexcept;
  /// `given` and `need` of `from`, summed over all counterparts.
  [[nodiscard]] StatedEnergy stated_energy(const pdu::EntityId& from) const noexcept;

  [[nodiscard]] const ListenerRefusals& refusals() const noexcept { return refusals_; }

 private:
  using Bytes = std::span<const std::byte>;
  using Nanoseconds = std::chrono::nanoseconds;
  using AccountKey = std::array<std::uint16_t, 6>;  // from, to

  [[nodiscard]] std::uint64_t key_of(std::uint8_t exercise, const pdu::EntityId& id) const noexcept;
  [[nodiscard]] std::size_t admit(std::uint8_t exercise, const pdu::EntityId& id);
  [[nodiscard]] TouchedEntity& touch(std::uint8_t exercise, const pdu::EntityId& id);
  [[nodiscard]] bool read_state(Bytes pdu, const pdu::PduHeader& header,
                                const pdu::EntityState* decoded, StateUpdate& update);
  [[nodiscard]] bool read_partial(Bytes pdu, const pdu::PduHeader& header, StateUpdate& update);
  [[nodiscard]] bool place_state(StateUpdate& update);
  void judge(StateUpdate& update);
  [[nodiscard]] deadreckon::ConversionError convert(const pdu::EntityState& pdu,
                                                    deadreckon::KinematicState& out);
  [[nodiscard]] ReceiveVerdict lay_on_time(StateUpdate& update);
  void settle(const StateUpdate& update);
  void adopt(ReceivedEntity& entity, const StateUpdate& update) const;
  [[nodiscard]] bool read_model(const pdu::PduHeader& header, const pdu::EntityId& id,
                                const pdu::HapticRecord& record, ModelUpdate& update);
  void adopt(const ModelUpdate& update);
  void set_heartbeat(ReceivedEntity& entity, double heartbeat) const noexcept;
  void take_account(const pdu::EntityId& id, const pdu::EnergyAccountRecord& record);
  void take_removal(Bytes pdu, const pdu::PduHeader& header, Nanoseconds arrival);
  void take_state(Bytes pdu, const pdu::PduHeader& header, Nanoseconds arrival, auto& observer,
                  const pdu::EntityState* decoded);
  void take_compressed(Bytes pdu, Nanoseconds arrival, auto& observer);
  [[nodiscard]] bool restore(const pdu::CompressedStates& states,
                             const pdu::CompressedState& state);
  void take_records(Bytes pdu, const pdu::PduHeader& header, Nanoseconds arrival, auto& observer);
  void drop_entity(std::size_t place);
  void drop_model(std::size_t place);
  [[nodiscard]] static AccountKey key(const pdu::EntityId& from, const pdu::EntityId& to) noexcept;

  ListenerRules rules_;
  std::optional<deadreckon::LocalFrame> frame_;
  std::vector<ReceivedEntity> entities_;
  std::vector<peer::SenderClock> clocks_;  // one per entity, if the timing requires it
  std::vector<ReceivedModel> models_;
  peer::KeyIndex index_;
  std::map<AccountKey, StatedEnergy> accounts_;
  std::vector<TouchedEntity> touched_;
  pdu::EntityState read_;  // buffer of the present state
  StateKeys keys_;
  FixedOctets restored_;  // of the present state
  ListenerRefusals refusals_;
};

void Listener::take_pdu(Bytes pdu, const pdu::PduHeader& header, Nanoseconds arrival,
                        auto& observer, const pdu::EntityState* decoded) {
  const auto type = header.pdu_type;
  if (type == pdu::PduType::attribute) return take_records(pdu, header, arrival, observer);
  if (type == pdu::PduType::compressed_states) return take_compressed(pdu, arrival, observer);
  if (type == pdu::PduType::entity_state || type == pdu::PduType::entity_state_update) {
    take_state(pdu, header, arrival, observer, decoded);
  } else if (rules_.partial) {
    take_removal(pdu, header, arrival);
  }
}

void Listener::take_state(Bytes pdu, const pdu::PduHeader& header, Nanoseconds arrival,
                          auto& observer, const pdu::EntityState* decoded) {
  StateUpdate update;
  update.arrival = arrival;
  if (!read_state(pdu, header, decoded, update)) return;
  if (header.pdu_type == pdu::PduType::entity_state) keys_.note_plain(*update.pdu);
  if (!place_state(update)) return;
  observer.receive_state(update);
  settle(update);
}

void Listener::take_compressed(Bytes pdu, Nanoseconds arrival, auto& observer) {
  pdu::CompressedStates states;
  if (decode(pdu, states) != pdu::DecodeError::none) return;
  pdu::CompressedStateReader reader(states);
  for (pdu::CompressedState one; reader.next(one);) {
    if (!restore(states, one)) continue;
    StateUpdate update;
    update.arrival = arrival;
    update.pdu = &read_;
    update.compressed = pdu::kCompressedHeadSize + one.body.size();
    update.octets = restored_;
    if (!place_state(update)) continue;
    observer.receive_state(update);
    settle(update);
  }
}

void Listener::take_records(Bytes pdu, const pdu::PduHeader& header, Nanoseconds arrival,
                            auto& observer) {
  pdu::Attribute attribute;
  if (!rules_.models || decode(pdu, attribute) != pdu::DecodeError::none) return;
  for (const pdu::AttributeSet& set : pdu::AttributeReader(attribute)) {
    const std::size_t place = place_of(header.exercise_id, set.entity_id);
    if (place != kNone) observer.receive_records(place, attribute.record_sets.count);
    for (const pdu::AttributeRecord& record : set.records()) {
      pdu::HapticRecord model;
      pdu::EnergyAccountRecord account;
      ModelUpdate update;
      update.arrival = arrival;
      if (decode(record, model) == pdu::DecodeError::none) {
        if (!read_model(header, set.entity_id, model, update)) continue;
        observer.receive_model(update);
        adopt(update);
      } else if (rules_.accounts && decode(record, account) == pdu::DecodeError::none) {
        take_account(set.entity_id, account);
      }
    }
  }
}

}  // namespace reckon::tools
