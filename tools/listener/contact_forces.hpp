// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The contact forces that a stream of PDUs speaks of: every pair of haptic entities, poses dead
// reckoned and force models evaluated as a peer does that hears the same, before any receiver's
// gate. Pure: PDUs and times in, forces out.
#pragma once

#include <Eigen/Core>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "reckon/deadreckon/force/force_model.hpp"
#include "reckon/deadreckon/motion/geocentric.hpp"
#include "reckon/pdu/entity/attribute.hpp"
#include "reckon/pdu/entity/entity_state.hpp"
#include "reckon/peer/world/state_table.hpp"

namespace reckon::tools {

/// The force of one entity's model on the hand of another at one instant. Not what a hand felt: a
/// receiver's gate may hold back some of it (docs/haptic_stability.md), and friction is left out.
struct ContactForce {
  pdu::EntityId on;                                 ///< who is pushed
  pdu::EntityId by;                                 ///< whose model it is
  double depth = 0;                                 ///< [m], > 0
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  ///< [N], east, north, up (S frame)
};

/// By how much an update changed a force, at the instant of its arrival.
struct ForceJump {
  pdu::EntityId on;
  pdu::EntityId by;
  double size = 0;  ///< [N], length of the difference
};

/// What one entity last told of the energy that it gave to another.
struct ToldEnergy {
  double given = 0;  ///< [J], running total
  double need = 0;   ///< [J]
};

/// What could not be used.
struct ContactForcesRefusals {
  std::uint64_t values = 0;    ///< states and models with impossible numbers
  std::uint64_t stale = 0;     ///< states not newer than what was known
  std::uint64_t unplaced = 0;  ///< models of an entity without a pose
  std::uint64_t crowded = 0;   ///< entities and accounts beyond the room
};

/// A listener to haptic entities. One thread. Feed every PDU of a datagram in order, then call
/// end_datagram(); ask at() for any time from then to the next datagram. Allocates at construction,
/// and within bounds as entities come. An update costs about 0.1 us for each haptic entity, at() as
/// much and a few ns for each pair.
class ContactForces {
 public:
  /// Haptic entities that are remembered at once; more are counted as crowded.
  static constexpr std::size_t kMostEntities = 512;
  /// Directed pairs whose energy accounts are remembered.
  static constexpr std::size_t kMostAccounts = 4096;

  ContactForces();

  /// One PDU of any type; Entity State and Attribute are looked at. An entity becomes known by an
  /// Entity State that is coupled (CEI), and haptic by the record behind it. Any octets will do.
  /// @param time of the datagram's arrival since 1970-01-01 UTC; timestamps within 5 s of it are
  /// taken at their word, others are laid on the arrivals.
  void take(std::span<const std::byte> pdu, const pdu::PduHeader& header,
            std::chrono::nanoseconds time);
  /// The end of a datagram: how much its updates changed the forces of pairs that were known. Good
  /// until the next call.
  [[nodiscard]] std::span<const ForceJump> end_datagram(std::chrono::nanoseconds time);

  /// Entities that the datagram ended last was about, good until the next one ends.
  [[nodiscard]] std::span<const pdu::EntityId> updated() const noexcept { return updated_; }

  /// All pairs that touch at `time`, in the order of the rows. Good until the next call. Forgets
  /// entities that have been silent too long; a model that is no longer valid gives no force.
  [[nodiscard]] std::span<const ContactForce> at(std::chrono::nanoseconds time);
  /// Sum of the forces on one entity [N], east, north, up; zero where there is none.
  [[nodiscard]] Eigen::Vector3d force_on(const pdu::EntityId& id, std::chrono::nanoseconds time);

  /// Known entities; `haptic` tells those that have sent a model.
  [[nodiscard]] std::span<const peer::RemoteEntity> entities() noexcept { return table_.rows(); }
  [[nodiscard]] const peer::RemoteEntity* find(const pdu::EntityId& id) noexcept {
    return table_.find(id);
  }
  /// What `from` last told about `to`; zeros where it told nothing.
  [[nodiscard]] ToldEnergy told_energy(const pdu::EntityId& from,
                                       const pdu::EntityId& to) const noexcept;
  /// Its `given` and `need` summed over all counterparts.
  [[nodiscard]] ToldEnergy told_energy(const pdu::EntityId& from) const noexcept;

  [[nodiscard]] const ContactForcesRefusals& refusals() const noexcept { return refusals_; }

 private:
  /// An entity that the datagram at hand is about.
  struct Touched {
    pdu::EntityId id;
    bool known = false;    // `before` holds what was
    bool refused = false;  // its state: the model behind it is not taken either
    peer::RemoteEntity before;
  };
  /// A row with its pose at one instant.
  struct Placed {
    const peer::RemoteEntity* row;
    deadreckon::Pose pose;
    deadreckon::ProbeState probe;
    bool is_probe;  // a ball, that others push
    bool is_valid;  // its model pushes
    double reach;   // [m] of the model about its point; infinite for planes
  };

  [[nodiscard]] const deadreckon::LocalFrame* frame_for(const pdu::WorldCoordinates& location);
  [[nodiscard]] Touched& touch(const pdu::EntityId& id);
  void take_state(const pdu::EntityState& state, std::chrono::nanoseconds time);
  void refresh(peer::RemoteEntity& row, const pdu::EntityState& state, Touched& touched,
               std::chrono::nanoseconds time);
  void take_record(const pdu::EntityId& id, const pdu::HapticRecord& record);
  void take_account(const pdu::EntityId& id, const pdu::EnergyAccountRecord& record);
  void expire(std::chrono::nanoseconds time);
  void forget(const pdu::EntityId& id);
  [[nodiscard]] static Placed place(const peer::RemoteEntity& row, std::chrono::nanoseconds time);
  [[nodiscard]] static bool may_touch(const Placed& on, const Placed& by);
  [[nodiscard]] static ContactForce between(const Placed& on, const Placed& by);
  void note_jumps(const Touched& touched, std::chrono::nanoseconds time);

  using AccountKey = std::array<std::uint16_t, 6>;  // from, to
  [[nodiscard]] static AccountKey key(const pdu::EntityId& from, const pdu::EntityId& to) noexcept;

  peer::StateTable table_;
  std::optional<deadreckon::LocalFrame> frame_;
  std::map<AccountKey, ToldEnergy> accounts_;
  std::vector<Touched> touched_;
  std::vector<Placed> placed_;
  std::vector<ContactForce> forces_;
  std::vector<ForceJump> jumps_;
  std::vector<pdu::EntityId> updated_;
  ContactForcesRefusals refusals_;
};

/// The scene frame whose origin lies at a geocentric position [m], finite: east, north, up of the
/// ellipsoid there. Height is cut to +-1e8 m.
[[nodiscard]] deadreckon::LocalFrame local_frame_at(const Eigen::Vector3d& position);

}  // namespace reckon::tools
