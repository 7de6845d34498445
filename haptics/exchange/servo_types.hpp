// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Inputs of the servo (remote hands) and its outputs (snapshots). Plain data, copied through triple
// buffers. Frame S everywhere, SI units.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "reckon/deadreckon/force/force_model.hpp"
#include "reckon/deadreckon/motion/kinematic_state.hpp"
#include "reckon/haptics/exchange/force_stop.hpp"
#include "reckon/haptics/exchange/servo_tally.hpp"
#include "reckon/haptics/exchange/spsc_ring.hpp"
#include "reckon/haptics/scene/grab_spring.hpp"
#include "reckon/pdu/codec/records.hpp"

namespace reckon::haptics {

/// Greatest number of remote hands that one servo can touch at the same time.
inline constexpr std::size_t kMaxRemoteHands = 32;

/// Copies only the entries in use, so that the cost does not depend on the capacity.
template <class T>
void copy_used(std::array<T, kMaxRemoteHands>& to, const std::array<T, kMaxRemoteHands>& from,
               std::size_t count) noexcept {
  if (&to != &from) std::copy_n(from.begin(), std::min(count, kMaxRemoteHands), to.begin());
}

/// A remote hand as received: its two predictors and the energy account of its owner with us.
struct RemoteHand {
  pdu::EntityId id;
  deadreckon::KinematicState state;         ///< S frame, at state_time
  std::chrono::nanoseconds state_time{0};   ///< local steady time of the state
  deadreckon::ForceModel model;             ///< body axes of state
  std::chrono::nanoseconds valid_until{0};  ///< after it the force fades out over 100 ms
  std::uint32_t version = 0;                ///< changes with each accepted update
  double given_to_us = 0.0;                 ///< [J], total that its owner has given to us
  double need = 0.0;                        ///< [J], request of its owner
  double spring_need = 0.0;                 ///< [J], further request, see EnergyDemand
  std::uint32_t epoch = 0;                  ///< of its owner's process; a change resets totals
  /// Number of hands with which its owner exchanges energy, as far as known.
  std::uint8_t neighbours = 0;
  /// A hand with a device, which needs energy too; false: a body that no hand holds, which may be
  /// stiffer.
  bool has_device = true;
};

/// The nearest remote hands. A copy takes only the entries in use.
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

/// All inputs from others; written by the model loop, the newest set is used.
struct ContactSet : HandList {
  bool frozen = false;       ///< simulation frozen: predictors stop, contact stays
  std::size_t left_out = 0;  ///< nearby hands left out of the list, farther than all in it
};

/// The servo's side of one contact; `given` and `need` are sent to the hand's owner.
struct ContactAccount {
  pdu::EntityId id;
  double given = 0.0;        ///< [J], total that we gave to the owner
  double received = 0.0;     ///< [J], total credited from the owner
  double need = 0.0;         ///< [J], our request to the owner; 0 = none
  double spring_need = 0.0;  ///< [J], our further request, see EnergyDemand
  double depth = 0.0;        ///< [m], at the gate's own parameters; <= 0 outside
  Eigen::Vector3d force = Eigen::Vector3d::Zero();         ///< [N], spring on our hand, as rendered
  Eigen::Vector3d damper_force = Eigen::Vector3d::Zero();  ///< [N], besides it, as rendered
  Eigen::Vector3d asked_force = Eigen::Vector3d::Zero();   ///< [N], with enough energy, alone
  Eigen::Vector3d ungated_force = Eigen::Vector3d::Zero();  ///< [N], of the record as received
  double stiffness_limit = 0.0;  ///< [N/m], greatest stiffness at which its spring is shown
  bool refused = false;          ///< its record has values that no servo can show
  bool has_device = true;        ///< a hand, which feels ours; false: a body that no hand holds
  double sliding = 0.0;          ///< [m/s], of our hand over its surface
  double ledger = 0.0;           ///< [J], energy of the device that is in no spring
};

/// Accounts of the contacts of the set. A copy takes only the entries in use.
struct AccountList {
  std::size_t count = 0;  ///< number of contacts
  std::array<ContactAccount, kMaxRemoteHands> contacts{};

  AccountList() = default;
  AccountList(const AccountList& other) noexcept { *this = other; }
  AccountList& operator=(const AccountList& other) noexcept {
    count = other.count;
    copy_used(contacts, other.contacts, count);
    return *this;
  }
};

/// Probes of a tool.
inline constexpr std::size_t kMostProbes = 8;

/// Pose of the tool of a device of six axes. Frame S.
struct ToolState {
  bool turns = false;  ///< false: a device of three axes; the other members are unset
  Eigen::Vector3d handle = Eigen::Vector3d::Zero();                 ///< [m], measured
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< tool -> S, measured
  Eigen::Vector3d turn_rate = Eigen::Vector3d::Zero();              ///< [rad/s]
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();   ///< [N m], about the handle, as written
  std::size_t count = 0;                              ///< number of probes
  std::array<Eigen::Vector3d, kMostProbes> probes{};  ///< [m], positions
};

/// The body that a hand holds.
struct HeldBody {
  std::uint16_t number = 0;  ///< among the moving objects, plus 1; 0: it holds none
  double stiffness = 0.0;    ///< [N/m], of the spring between them
};

/// Published result of one servo step.
struct ServoSnapshot : AccountList {
  std::chrono::nanoseconds time{0};
  std::uint64_t step = 0;
  Eigen::Vector3d device = Eigen::Vector3d::Zero();  ///< [m], measured: the handle,
                                                     ///< or the tool's first probe
  /// [m], surface contact point, outside the objects; the grip point of a held body
  Eigen::Vector3d scp = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();             ///< [m/s], of the SCP, filtered
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();         ///< [m/s^2], of the SCP, filtered
  Eigen::Vector3d device_velocity = Eigen::Vector3d::Zero();      ///< [m/s], measured or filtered
  Eigen::Vector3d device_acceleration = Eigen::Vector3d::Zero();  ///< [m/s^2], filtered
  Eigen::Vector3d force = Eigen::Vector3d::Zero();        ///< [N], total written to the device
  Eigen::Vector3d mesh_force = Eigen::Vector3d::Zero();   ///< [N], share of the static scene
  Eigen::Vector3d mesh_normal = Eigen::Vector3d::Zero();  ///< unit at the SCP, zero when free
  double spring_share = 1.0;     ///< share of the hands' springs that the energy allows
  double crowd_share = 1.0;      ///< share of them before that, if they are together too stiff
  double extra_share = 1.0;      ///< share of dampers and effects
  double limit_share = 1.0;      ///< share of all forces, if they exceed the device's limit
  std::uint32_t mesh_patch = 0;  ///< below the SCP, number in SurfacePatches; 0: none
  bool in_mesh_contact = false;
  HeldBody held;
  bool enabled = false;         ///< operator switch held, no trip pending, and not stopped
  bool stopped = false;         ///< the software stop held the force at zero in this step
  ToolState tool;
  std::size_t left_out = 0;  ///< nearby hands that are not felt, because there are too many
  /// [J], absorbed from the hand + guaranteed damping + received from hands and bodies - given to
  /// them.
  double port_energy = 0.0;
  /// [J], least value of port_energy + loan + source_energy() so far; >= -1e-9 - late_cost on a
  /// device that keeps its limits.
  double port_energy_min = 0.0;
  double late_cost =
      0.0;  ///< [J], upper bound of the energy that late steps took from an empty ledger
  /// [J], greatest error of port_energy above the truth from encoder steps; 0 without them.
  double encoder_allowance = 0.0;
  double loan = 0.0;       ///< [J], debt, see exchange_energy(); <= kGreatestLoan
  double loan_most = 0.0;  ///< [J], greatest loan so far
  /// [J], outstanding loan of the potentials of regions; <= ServoConfig::region_loan.
  double region_loan = 0.0;
  double region_loan_most = 0.0;  ///< [J], greatest so far
  /// [J], net energy that oscillations of regions have put in so far, plus the greatest energy of
  /// pending ones for a handle with a delay; at most ServoConfig::oscillation_energy plus
  /// oscillation_power times the time.
  double oscillation_energy = 0.0;
  double mesh_ledger = 0.0;  ///< [J]
  /// Share of the stiffness of remote hands and bodies that the device can show, limited by energy,
  /// walls and other contacts, (0, 1]. It is sent to them, so that both ends show the same.
  double softening = 1.0;
  std::uint64_t trips = 0;  ///< times that safety cut the force
  ServoTally tally;

  /// Energy that regions have put in [J].
  [[nodiscard]] double source_energy() const noexcept { return region_loan + oscillation_energy; }
};

/// Settings of a servo, fixed at construction.
struct ServoConfig {
  std::chrono::nanoseconds period{1'000'000};  ///< nominal; default 1 ms, range 0.1 .. 10 ms
  Eigen::Vector3d device_origin = Eigen::Vector3d::Zero();  ///< [m], origin of D in S
  Eigen::Quaterniond device_orientation = Eigen::Quaterniond::Identity();  ///< v_S = q * v_D
  double probe_radius = 0.01;  ///< [m], of our own hand against remote hands; >= 0
  /// [m], radius of the contact patch of a probe, which resists rotation of bodies with friction
  /// about the contact normal, like a soft finger; 0 (a point) to 1.
  double patch_radius = 0.0;
  /// Grab spring for a body that a probe touches while one of these buttons is pressed (bit i is
  /// button i). Device and body may limit it further.
  GrabSpring grab{};
  std::uint32_t grab_buttons = 1;
  double contact_radius = 0.0;  ///< [m], of the probes against the static scene; 0 (points) to 1
  /// Probes of the tool on a device of six axes: 1 to 8 positions from the handle [m], in axes of
  /// the tool, each at most 1 m away. Remote hands touch the first. Empty: the handle is the probe.
  std::vector<Eigen::Vector3d> probes{};
  double max_force = std::numeric_limits<double>::infinity();  ///< [N], lowers the device's limit
  /// [N], continuous force of the device's motors; 0: their greatest force. They become warm with
  /// the time constant `thermal_time` [s], at least 1, and the force limit then falls to this.
  double continuous_force = 0.0;
  double thermal_time = 20.0;
  /// [N/s], limit for growth and rotation of the force; its decrease is free. At most, and by
  /// default, the rate of the stiffest surface that the device can hold at 1 m/s.
  double max_force_rate = std::numeric_limits<double>::infinity();
  /// [W], greatest power of the force on a yielding hand; excess is cut, walls included. At most,
  /// and by default, the device's largest force at 1 m/s.
  double max_power = std::numeric_limits<double>::infinity();
  /// [W], greatest mean power of others on the hand through their contacts: stated gifts, minus the
  /// energy given to them, are credited no faster. A person pushes another with about 0.1 W; a
  /// dishonest peer gets no more than this.
  double max_received_power = 0.2;
  /// [J], greatest loan for the potentials of all regions: springs, magnets, borders, constant
  /// forces. At most what they can store within the device's workspace. 0: the hand's motion must
  /// pay for them.
  double region_loan = 0.12;
  /// Energy that oscillations of regions may put into the hand: a power [W] that refills an energy
  /// [J]. More power allows stronger oscillations.
  double oscillation_power = 0.1;
  double oscillation_energy = 0.02;
  double stiffness_share = 0.95;  ///< of the passive limit, (0, 1]; higher = stiffer, less margin
  std::size_t max_contacts = kMaxRemoteHands;  ///< remote hands accepted, <= kMaxRemoteHands
  bool transfer = true;  ///< gives energy on request (off: a hand cannot push another)
  /// The software stop, shared by the servos of a program, which it outlives; null: only a private
  /// one for `stop_button`.
  ForceStop* stop = nullptr;
  /// Bit number in DeviceSample::buttons, 0 to 31, of the button that presses and releases the
  /// stop; std::nullopt: no button.
  std::optional<int> stop_button{};
};

/// All servo steps for a recorder. A full ring drops and counts new records, so that a slow disk
/// cannot disturb the servo.
using TraceRing = SpscRing<ServoSnapshot>;

/// A contact set that a servo used from this time on.
struct TimedContactSet {
  std::chrono::nanoseconds time{0};
  ContactSet set;
};
/// The contact sets of one servo for a recorder. A full ring drops and counts new ones.
using ContactRing = SpscRing<TimedContactSet>;

}  // namespace reckon::haptics
