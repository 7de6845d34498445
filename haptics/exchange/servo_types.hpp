// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What goes into the servo (remote hands) and what comes out of it (snapshots). Plain data, copied
// through triple buffers. Frame S everywhere, SI units.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "reckon/deadreckon/force/force_model.hpp"
#include "reckon/deadreckon/motion/kinematic_state.hpp"
#include "reckon/haptics/exchange/servo_tally.hpp"
#include "reckon/haptics/exchange/spsc_ring.hpp"
#include "reckon/pdu/codec/records.hpp"

namespace reckon::haptics {

/// Most remote hands that one servo can touch at the same time.
inline constexpr std::size_t kMaxRemoteHands = 32;

/// Copies the entries in use and leaves the others as they are: one hand costs what one costs,
/// however many there is room for.
template <class T>
void copy_used(std::array<T, kMaxRemoteHands>& to, const std::array<T, kMaxRemoteHands>& from,
               std::size_t count) noexcept {
  if (&to != &from) std::copy_n(from.begin(), std::min(count, kMaxRemoteHands), to.begin());
}

/// A remote hand as received: its two predictors and the energy account of its owner with us.
struct RemoteHand {
  pdu::EntityId id;
  deadreckon::KinematicState state;         ///< S frame, at state_time
  std::chrono::nanoseconds state_time{0};   ///< local steady time at which state was true
  deadreckon::ForceModel model;             ///< body axes of state
  std::chrono::nanoseconds valid_until{0};  ///< then the force fades out over 100 ms
  std::uint32_t version = 0;                ///< changes with each accepted update
  double given_to_us = 0.0;                 ///< [J], running total its owner has given to us
  double need = 0.0;                        ///< [J], what its owner asks of us
  double spring_need = 0.0;                 ///< [J], what it would like beyond, see EnergyDemand
  std::uint32_t epoch = 0;                  ///< of its owner's process; a change resets totals
  /// How many its owner exchanges energy with, as far as it is known.
  std::uint8_t neighbours = 0;
  /// A hand, which has to be paid too; false: a body that nobody holds, which may be stiffer.
  bool has_device = true;
};

/// Remote hands, the nearest ones. A copy takes those in use.
struct HandList {
  std::size_t count = 0;  ///< <= kMaxRemoteHands
  std::array<RemoteHand, kMaxRemoteHands> hands{};

  HandList() = default;
  HandList(const HandList& other) noexcept { *this = other; }
  HandList& operator=(const HandList& other) noexcept {
    count = other.count;
    copy_used(hands, other.hands, count);
    return *this;
  }
};

/// Everything the servo knows about others; written by the model loop, newest wins.
struct ContactSet : HandList {
  bool frozen = false;       ///< simulation frozen: predictors hold still, contact stays
  std::size_t left_out = 0;  ///< hands that were near too, but farther than all in the list
};

/// The servo's side of one contact; `given` and `need` go out to the hand's owner.
struct ContactAccount {
  pdu::EntityId id;
  double given = 0.0;        ///< [J], running total we have given to the owner
  double received = 0.0;     ///< [J], running total credited from the owner
  double need = 0.0;         ///< [J], what we ask of the owner; 0 = nothing
  double spring_need = 0.0;  ///< [J], what we would like beyond, see EnergyDemand
  double depth = 0.0;        ///< [m], at the gate's own parameters; <= 0 outside
  Eigen::Vector3d force = Eigen::Vector3d::Zero();         ///< [N], spring on our hand, as rendered
  Eigen::Vector3d damper_force = Eigen::Vector3d::Zero();  ///< [N], beside it, as rendered
  Eigen::Vector3d asked_force = Eigen::Vector3d::Zero();   ///< [N], with energy to spare, alone
  Eigen::Vector3d ungated_force = Eigen::Vector3d::Zero();  ///< [N], the record as received
  double stiffness_limit = 0.0;  ///< [N/m], stiffest that its spring is shown
  bool refused = false;          ///< its record has values that no servo can show
  bool has_device = true;        ///< a hand, which feels ours; false: a body that nobody holds
  double sliding = 0.0;          ///< [m/s], of our hand over its surface
  double ledger = 0.0;           ///< [J], energy of the device that is in no spring
};

/// What the servo makes of each hand of its set. A copy takes those in use.
struct AccountList {
  std::size_t count = 0;  ///< of contacts
  std::array<ContactAccount, kMaxRemoteHands> contacts{};

  AccountList() = default;
  AccountList(const AccountList& other) noexcept { *this = other; }
  AccountList& operator=(const AccountList& other) noexcept {
    count = other.count;
    copy_used(contacts, other.contacts, count);
    return *this;
  }
};

/// One servo step as others see it.
struct ServoSnapshot : AccountList {
  std::chrono::nanoseconds time{0};
  std::uint64_t step = 0;
  Eigen::Vector3d device = Eigen::Vector3d::Zero();           ///< [m], measured handle
  Eigen::Vector3d scp = Eigen::Vector3d::Zero();              ///< [m], contact point kept outside
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();         ///< [m/s], of the SCP, filtered
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();     ///< [m/s^2], of the SCP, filtered
  Eigen::Vector3d device_velocity = Eigen::Vector3d::Zero();  ///< [m/s], its own or filtered
  Eigen::Vector3d device_acceleration = Eigen::Vector3d::Zero();  ///< [m/s^2], filtered
  Eigen::Vector3d force = Eigen::Vector3d::Zero();        ///< [N], total written to the device
  Eigen::Vector3d mesh_force = Eigen::Vector3d::Zero();   ///< [N], share of the static scene
  Eigen::Vector3d mesh_normal = Eigen::Vector3d::Zero();  ///< unit at the SCP, zero when free
  double spring_share = 1.0;     ///< of the springs of hands, held with the energy there is
  double crowd_share = 1.0;      ///< of them before that, where together they are too stiff
  double extra_share = 1.0;      ///< of dampers and effects
  double limit_share = 1.0;      ///< of all forces, where they are more than the device can show
  std::uint32_t mesh_patch = 0;  ///< below the SCP, number in SurfacePatches; 0: none
  bool in_mesh_contact = false;
  bool enabled = false;      ///< operator switch held and no trip pending
  std::size_t left_out = 0;  ///< hands near by that are not felt, for there are too many
  double port_energy = 0.0;  ///< [J], absorbed from the hand + sure damping + received - given
  /// [J], least of port_energy + loan so far; >= -1e-9 on a device that keeps its limits.
  double port_energy_min = 0.0;
  /// [J], most that port_energy may be above the truth for the steps of an encoder; 0 without.
  double encoder_allowance = 0.0;
  double loan = 0.0;         ///< [J], lent, see exchange_energy(), not paid back; <= kGreatestLoan
  double loan_most = 0.0;    ///< [J], of it so far
  double mesh_ledger = 0.0;  ///< [J]
  /// Share of the stiffness of what others move that the device can show, for lack of energy or
  /// beside walls and others, (0, 1]: goes out to them, so that both ends show the same.
  double softening = 1.0;
  std::uint64_t trips = 0;  ///< times that safety cut the force
  ServoTally tally;
};

/// Settings of a servo, fixed at construction.
struct ServoConfig {
  std::chrono::nanoseconds period{1'000'000};  ///< nominal; default 1 ms, range 0.1 .. 10 ms
  Eigen::Vector3d device_origin = Eigen::Vector3d::Zero();  ///< [m], origin of D in S
  Eigen::Quaterniond device_orientation = Eigen::Quaterniond::Identity();  ///< v_S = q * v_D
  double probe_radius = 0.01;   ///< [m], of our own hand against remote hands; >= 0
  double contact_radius = 0.0;  ///< [m], of the probe against the static scene; 0 to 1, 0 a point
  double max_force = std::numeric_limits<double>::infinity();  ///< [N], lowers the device's limit
  /// [N/s], fastest growth and turning of the force; never its fall. At most, and by default, what
  /// the stiffest surface that the device can hold gives at 1 m/s.
  double max_force_rate = std::numeric_limits<double>::infinity();
  /// [W], most that the force puts into a hand which gives way to it; more is cut, walls and all.
  /// At most, and by default, the device's largest force at 1 m/s.
  double max_power = std::numeric_limits<double>::infinity();
  /// [W], most that others put into the hand through their contacts, on average: what they say to
  /// have given is credited no faster, less what was given to them. A person pushes another with
  /// some 0.1 W; a liar gets no more than this.
  double max_received_power = 0.2;
  double stiffness_share = 0.95;  ///< of the passive limit, (0, 1]; higher = stiffer, less margin
  std::size_t max_contacts = kMaxRemoteHands;  ///< remote hands accepted, <= kMaxRemoteHands
  bool transfer = true;  ///< give energy on demand (off: a hand cannot push another)
};

/// Every servo step for a recorder. When it is full new records are dropped and counted, so that a
/// slow disk cannot disturb the servo.
using TraceRing = SpscRing<ServoSnapshot>;

}  // namespace reckon::haptics
