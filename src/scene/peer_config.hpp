// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Configuration of a peer before it starts: plain structs with the defaults of docs/scene_files.md.
// scene_file.hpp fills them; nothing here changes while a peer runs.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "reckon/aoim/cells/cell_grid.hpp"
#include "reckon/deadreckon/force/force_model.hpp"
#include "reckon/deadreckon/motion/convergence.hpp"
#include "reckon/deadreckon/wire_conversion.hpp"
#include "reckon/haptics/devices/motion_device.hpp"
#include "reckon/haptics/scene/grab_spring.hpp"
#include "reckon/pdu/codec/enumerations.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/peer/network/impairment.hpp"
#include "reckon/peer/network/link.hpp"
#include "reckon/peer/network/unicast_peers.hpp"
#include "reckon/peer/scene/dead_reckoning_config.hpp"
#include "reckon/peer/scene/management_rule.hpp"
#include "reckon/peer/scene/tier_config.hpp"
#include "reckon/peer/scene/touch_rule.hpp"

namespace reckon::peer {

/// The point at which the scene's tangent frame S (east, north, up) touches the WGS84 ellipsoid.
struct OriginConfig {
  double latitude = 0.0;   ///< [rad], -pi/2 .. pi/2
  double longitude = 0.0;  ///< [rad], -pi .. pi
  double height = 0.0;     ///< [m] above the ellipsoid
};

/// The force model that this peer's hand shows to others: a sphere that repels with F = k1 d + k3
/// d^3 - damping * d'.
struct HandModel {
  double radius = 0.02;         ///< [m] > 0; also the probe radius against remote hands
  double patch_radius = 0.0;    ///< [m] >= 0, of the patch that resists turning of bodies
  haptics::GrabSpring grab{};   ///< holds a body while the button is pressed
  double contact_radius = 0.0;  ///< [m] >= 0, of the sphere with which its device feels objects
  /// [N/m] >= 0; the receiver limits it to the stiffness that its device can show. The default,
  /// with its damper, is the limit of a device with default values.
  double k1 = 475.0;
  double k3 = 0.0;                ///< [N/m^3] >= 0
  double damping = 0.5;           ///< [N s/m] >= 0
  double static_friction = 0.4;   ///< coefficient >= kinetic_friction; 0 = none
  double kinetic_friction = 0.3;  ///< coefficient >= 0
  std::chrono::nanoseconds validity = std::chrono::seconds(12);  ///< the force fades out after this
};

/// `hand` as the force model to send: kind sphere, both points at the body's origin.
[[nodiscard]] deadreckon::ForceModel to_force_model(const HandModel& hand);

/// Motion of a simulated hand.
enum class OperatorKind : std::uint8_t { passive, trace, sweep };

/// One simulated hand: a spring-damper (the grip) between the device and a moving target.
struct OperatorConfig {
  OperatorKind kind = OperatorKind::passive;
  std::filesystem::path trace;  ///< kind trace: CSV t_s,px_m,py_m,pz_m; absolute once loaded
  /// Kind trace: the recording is centred in this box [m] of S and scaled to fit; set by programs.
  std::optional<Eigen::AlignedBox3d> fit_to = {};
  double speed = 1.0;                 ///< kind trace: playback speed; 2 is twice as fast; > 0
  std::chrono::nanoseconds begin{0};  ///< kind trace: start within the recording, >= 0
  /// [m] S, kind trace: offset of its first position from the point of `begin`, which it reaches at
  /// `start`.
  Eigen::Vector3d approach = Eigen::Vector3d::Zero();
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m] S: passive: held point; trace: added
  Eigen::Vector3d from = Eigen::Vector3d::Zero();      ///< [m] S: sweep: one end
  Eigen::Vector3d to = Eigen::Vector3d::Zero();        ///< [m] S: sweep: the other end
  std::chrono::nanoseconds period = std::chrono::seconds(2);  ///< sweep: time there and back, > 0
  bool grabs = false;  ///< sweep: on the way to `to` it presses button 0 of its device
  std::chrono::nanoseconds start{0};  ///< at rest until then, >= 0
  double stiffness = 300.0;           ///< [N/m] of the grip, >= 0
  double damping = 3.0;               ///< [N s/m] of the grip, >= 0
  /// For a device of six axes: rotation by the hand, about each axis of S.
  Eigen::Vector3d turned = Eigen::Vector3d::Zero();  ///< [rad]; sweep: at `to`, none at `from`
  double turn_stiffness = 1.0;                       ///< [N m/rad] of the grip, >= 0
  double turn_damping = 0.02;                        ///< [N m s/rad] of the grip, >= 0
};

/// Orientation as defined by DIS [rad].
struct Attitude {
  double heading = 0.0;  ///< clockwise from north, seen from above
  double pitch = 0.0;    ///< nose up positive
  double roll = 0.0;     ///< right side down positive
};

/// Unit quaternion, body (x forward, y right, z down) to S (x east, y north, z up).
[[nodiscard]] Eigen::Quaterniond orientation_of(const Attitude& attitude) noexcept;
/// The same for the axes of a device (x right, y forward, z up): all zero is the identity.
[[nodiscard]] Eigen::Quaterniond device_orientation_of(const Attitude& attitude) noexcept;

/// An entity that a peer owns, without a device: a vehicle, a post, a robot's tip.
struct EntityConfig {
  std::uint32_t peer = 1;  ///< number of the owning peer, from 1; others only see it
  std::string marking;     ///< at most 11 ASCII characters
  pdu::EntityType type{};  ///< numbers of SISO-REF-010
  pdu::ForceId force_id = pdu::ForceId::other;
  std::uint32_t appearance = 0;    ///< as on the wire; the peer sets deactivated and frozen
  std::uint32_t capabilities = 0;  ///< as on the wire
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m] S; with a track: added to it
  /// Body (forward, right, down) to S; level, its nose to the north.
  Eigen::Quaterniond orientation = orientation_of({});
  std::filesystem::path track;  ///< CSV t_s,px_m,py_m,pz_m; absolute once loaded; empty: at rest
  double speed = 1.0;           ///< of the track; 2 is twice as fast; > 0
  std::optional<bool> repeat;   ///< of the track; none: true if its end equals its begin
  /// With a track: whether it turns, by the track's columns of orientation. Without such columns
  /// its nose points along the track, unless hands feel it.
  bool turns = true;
  DeadReckoningConfig dead_reckoning;           ///< as in docs/scene_files.md, [[entity]]
  std::optional<deadreckon::ForceModel> model;  ///< its model for hands, body axes
  double power = 0.05;  ///< [W] >= 0 that it may give to the hands that it pushes while it moves
  std::string beacon;   ///< name by which others find its cell; empty: none
};

/// Source of a simulated device's motion.
enum class DeviceSource : std::uint8_t {
  simulated,  ///< its operator
  pointer,    ///< a person's pointer, starting where its operator holds it
};

/// Kind of a device.
enum class DeviceDriver : std::uint8_t {
  simulated,  ///< a simulated mass that its operator holds
  falcon,     ///< a Novint Falcon on USB, held by a person
  polhem,     ///< a Polhem on USB, held by a person
  serial,     ///< a board on a serial port, held by a person
  evdev,      ///< a Linux force feedback device, held by a person
  plugin,     ///< a device driven by a shared library
};

/// A contact point of a tool.
struct ProbeConfig {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m] from the handle, in the tool's axes
};

/// A simulated device that measures the hand's force and moves like a mass.
struct AdmittanceConfig {
  double mass = 0.0;               ///< [kg], virtual mass; 0: it is not such a device
  double bandwidth = 30.0;         ///< [Hz] > 0, of its motion
  double sensor_stiffness = 20e3;  ///< [N/m] > 0, of its force sensor
  haptics::MotionLoop loop = haptics::MotionLoop::position;
};

/// Values of a device that only a descriptor gives.
struct DescribedDevice {
  std::string name;                   ///< product name; empty: the device has no descriptor
  std::chrono::nanoseconds delay{0};  ///< >= 0, until a force reaches the handle
  double mass = 0.1;                  ///< [kg] > 0
  double friction = 0.0;              ///< [N] >= 0, dry
  double inertia = 1e-4;              ///< [kg m^2] > 0, for six axes
  Eigen::AlignedBox3d work_space{Eigen::Vector3d::Constant(-0.05),
                                 Eigen::Vector3d::Constant(0.05)};  ///< [m], frame D
};

/// A haptic device of one peer, and the hand that it moves.
struct DeviceConfig {
  std::uint32_t peer = 1;             ///< number of its peer, from 1
  std::uint32_t operator_number = 1;  ///< number of the [[operator]] that holds it, from 1
  DeviceSource source = DeviceSource::simulated;
  DeviceDriver driver = DeviceDriver::simulated;
  std::filesystem::path firmware;  ///< of a Falcon; absolute once loaded; empty: none is loaded
  std::string descriptor;          ///< file or name; absolute once loaded; empty: none
  DescribedDevice described;       ///< values of the descriptor without a member below
  double scale = 1.0;              ///< > 0, motion of the hand in S per motion of the handle
  bool left_handed = false;        ///< left and right are exchanged
  int clutch_button = -1;          ///< while it is pressed the hand does not move; negative: none
  double upper_weight = 0.0;       ///< [N m] >= 0, of a Polhem's upper link when level
  double fore_weight = 0.0;        ///< [N m] >= 0, of its fore link when level
  std::string port;                ///< of a serial board, such as /dev/ttyACM0
  std::uint32_t baud = 1'000'000;  ///< of that port
  std::string event;               ///< of an event device: its path, or a part of its name
  int event_axes = 2;              ///< of an event device: 1 or 2
  double travel = 0.0;             ///< [m], of an event device, from end to end of an axis; 0: not
                                   ///< given
  double full_force = 0.0;         ///< [N], of an event device at its greatest level; 0: not given
  double full_stiffness = 0.0;     ///< [N/m], of its greatest coefficient; 0: not given
  std::filesystem::path plugin;    ///< shared library of its driver, as in the scene
  std::string plugin_options;      ///< for that driver
  AdmittanceConfig admittance;
  double reach = 0.5;   ///< [m] > 0, of a pointer from the start, along each of the device's axes
  std::string marking;  ///< of its hand; empty: the peer's name and a number
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m] S, of the device's own origin
  bool is_placed = false;                              ///< the file gives its position
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< device axes to S
  double max_force = 10.0;                                          ///< [N] > 0
  double continuous_force = 0.0;    ///< [N], permanent limit of its motors; 0: max_force
  double thermal_time = 20.0;       ///< [s] >= 1, time constant of their warming
  double damping = 1.0;             ///< [N s/m] >= 0, guaranteed physical damping
  double joint_damping = 0.0;       ///< [N m s/rad] >= 0, of a Falcon or Polhem; 0: not given
  double max_stiffness = 0.0;       ///< [N/m]; 0: the limit by its damping
  int axes = 3;                     ///< 3, or 6: it turns and shows torque
  double turn_damping = 0.01;       ///< [N m s/rad] > 0, guaranteed, about each axis
  double max_torque = 1.0;          ///< [N m] > 0
  double turn_resolution = 0.0;     ///< [rad] >= 0, step of its angle sensors; 0: exact
  std::vector<ProbeConfig> probes;  ///< of the tool on six axes; none: the handle
  double max_speed = 2.0;           ///< [m/s] > 0; a faster reading switches the force off
  /// [N/s], limit of the rate of its force in size and direction; 0: as in haptics::ServoConfig.
  double max_force_rate = 0.0;
  double received_power = 0.2;     ///< [W] > 0, largest average power that others put into its hand
  double region_loan = 0.12;       ///< [J] >= 0, greatest loan for potentials of regions
  double oscillation_power = 0.1;  ///< [W] >= 0, power of oscillations of regions into its hand
  double oscillation_energy = 0.02;  ///< [J] >= 0, their limit at once
  int stop_button = -1;              ///< button that stops all forces, 0 to 31; negative: none
  std::uint32_t grab_button = 0;     ///< of the device, from 0: the hand holds bodies while it is
                                     ///< pressed
  double resolution = 0.0;           ///< [m] >= 0, step of its position sensors; 0: exact
  int delay_samples = 0;  ///< servo periods between a write and the force at the handle, >= 0
  std::chrono::nanoseconds period = std::chrono::milliseconds(1);  ///< of its servo, 0.1 .. 10 ms
};

/// Basis of the shown pose of a remote entity.
enum class Prediction : std::uint8_t {
  as_sent,  ///< the model of its last update
  adaptive  ///< the extrapolator that predicted its last updates best
};

/// How remote entities are shown. The servo always uses the model as sent.
struct ConvergenceConfig {
  deadreckon::ConvergenceSettings settings;
  Prediction prediction = Prediction::as_sent;
};

/// Range at which entities of one type can be sensed beyond themselves.
struct NimbusClass {
  pdu::EntityType type{};  ///< 0 matches any number
  double nimbus = 0.0;     ///< [m] >= 0
};

/// A solid box along the axes of S.
struct OccluderConfig {
  Eigen::Vector3d from = Eigen::Vector3d::Zero(), to = Eigen::Vector3d::Zero();  ///< corners [m]
};

/// Selection among the received entities, and the budget for their updates.
struct AwarenessConfig {
  double budget = 0.0;  ///< [B/s] of updates that this peer can take; 0: unlimited
  std::string kinds;    ///< wanted kinds, as written; empty: all
  std::uint32_t kinds_wanted = 0xFFFFFFFFU;  ///< bit k: kind k
  double aura = 0.0;                         ///< [m]; 0: no bound
  std::vector<NimbusClass> nimbus;           ///< the first match applies
  std::vector<OccluderConfig> occluders;
};

/// A square, quartered repeatedly where there are many entities. The same at all peers of a scene.
struct QuadTreeConfig {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< of the square [m] S; z has no effect
  double side = 1000.0;                              ///< of the square [m] > 0
  double smallest = 10.0;                            ///< no cell has a shorter side [m] > 0
  std::uint32_t most = 0;           ///< cells; 0: as many as can have a group or a number
  std::filesystem::path density;    ///< see read_density(); absolute once loaded; empty: `leaves`
  double reach = 0.0;               ///< [m] range of the entities of the sample, > 0 with `density`
  std::string leaves;               ///< as written
  std::vector<aoim::CellId> cells;  ///< result of either; see aoim::QuadTree::of_cells
};

/// A part of the world with its own frame, for example a room. The same at all peers of a scene.
struct LocaleConfig {
  std::string name;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< of its frame, the centre [m] S
  double yaw = 0.0;                                  ///< from S's x axis to its x axis [rad]
  Eigen::Vector3d size = Eigen::Vector3d::Zero();    ///< [m] > 0 along its axes; z 0: any height
  std::string neighbours;                            ///< names, as written
};

/// The cells of the area-of-interest manager and the pool of groups that they share.
struct AoimConfig {
  aoim::CellScheme scheme = aoim::CellScheme::hexagonal;
  double cell = 1.0;  ///< [m] > 0: side of a square, or corner radius of a hexagon
  QuadTreeConfig quad_tree;
  std::vector<LocaleConfig> locales;
  double radius = 2.0;  ///< [m] > 0: range of this peer; joins within it, leaves beyond 1.1 of it
  std::uint32_t pool = aoim::kDefaultPool;  ///< groups; see aoim::is_pool
  /// Limit of groups of the pool joined at once, 1 .. aoim::kMaximumPool; further groups are not
  /// received.
  std::uint32_t groups = aoim::kMaximumPool;
  bool leaders = false;  ///< each cell has a leader, which serves newcomers; the same at all peers
  /// The leader of the scene assigns groups of the pool to cells, instead of the fixed tile; the
  /// same at all peers.
  bool hand_out = false;
  Tiers tiers;         ///< the same at all peers
  std::string follow;  ///< names of beacons whose cells are subscribed to; see beacon_names
  AwarenessConfig awareness;
  /// Groups after the base group: the pool, and as many for each tier with its own groups.
  [[nodiscard]] std::size_t all_groups() const noexcept {
    return pool * (1 + group_tier_count(tiers));
  }
};

/// The nimbus of the entities of this type [m]. Some ns for each class.
[[nodiscard]] double nimbus_of(const std::vector<NimbusClass>& classes,
                               const pdu::EntityType& type) noexcept;

/// How long updates wait for a bundle: time-out, quorum or both (hybrid). New and felt updates
/// never wait.
struct BundlePolicy {
  /// Time-out: longest wait of a pose, 0 .. 1 s; with a quorum, the longest time-out leaves only
  /// the quorum.
  std::chrono::nanoseconds hold{0};
  std::uint32_t updates = 0;  ///< quorum: this many are sent together; 0 = only by size
};

/// The policy of the entities of one type.
struct BundleClass {
  pdu::EntityType type{};  ///< 0 matches any number
  BundlePolicy policy;
};

/// Address and manner of sending.
struct NetworkConfig {
  GroupAddress group = GroupAddress::v4(0xEFC00100, 3000);  ///< base group; the pool follows it
  bool interop = false;           ///< plain DIS to the base group, no Reckon trailer
  bool lenient = false;           ///< with interop: a length field of 0 is read as the rest
  std::uint8_t exercise = 1;      ///< DIS exercise ID
  bool exercise_named = false;    ///< whether the file gives it; set by the reader
  std::uint8_t ttl = 1;           ///< hops; 1 = this LAN
  std::size_t bundle_max = 1288;  ///< [octets] of a datagram's payload
  /// [1/s] datagrams in one group, from all peers; the receive buffer holds 50 ms of them.
  std::size_t rate = 20'000;
  bool offload = true;  ///< the kernel segments and coalesces runs of datagrams, if it can
  BundlePolicy bundle;  ///< of updates that match no class
  std::vector<BundleClass> bundle_classes;  ///< the first match applies
  /// Form of sent Entity States; the peers of a scene must have the same.
  pdu::CompressedForm compression = pdu::CompressedForm::none;
  std::string iface;  ///< interface name or address; empty = chosen by the documented rule
  std::filesystem::path
      key;  ///< key file of a sealed exercise; absolute once loaded; empty = plain
  /// Recipients of each datagram without multicast, see FanOutLink; empty: groups.
  std::vector<NamedPeer> peers;
  /// Memory limit [octets] for the entities of plain DIS programs
  std::size_t strangers_memory = std::size_t{32} << 20;
  ManagementRule management;       ///< senders whose Stop/Freeze and Start/Resume are obeyed
  std::optional<TouchRule> touch;  ///< as in the scene, see touch_rule()

  /// The owners whose force models and bodies are felt.
  [[nodiscard]] TouchRule touch_rule() const { return touch.value_or(TouchRule::usual(interop)); }
};

/// The policy of the entities of this type. Some ns for each class.
[[nodiscard]] const BundlePolicy& bundle_policy_of(const NetworkConfig& network,
                                                   const pdu::EntityType& type) noexcept;

}  // namespace reckon::peer
