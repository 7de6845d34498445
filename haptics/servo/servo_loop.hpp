// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// One step of the force loop: read, predict, contact, gate, safety, write, publish. Its own thread
// calls step() every period; tests call it directly.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <memory>
#include <span>

#include "reckon/haptics/contact/remote_contact.hpp"
#include "reckon/haptics/contact/static_contact.hpp"
#include "reckon/haptics/devices/haptic_device.hpp"
#include "reckon/haptics/exchange/servo_types.hpp"
#include "reckon/haptics/exchange/triple_buffer.hpp"
#include "reckon/haptics/passivity/energy_port.hpp"
#include "reckon/haptics/passivity/softening.hpp"
#include "reckon/haptics/scene/effect_plan.hpp"
#include "reckon/haptics/servo/motion_filter.hpp"
#include "reckon/haptics/servo/safety.hpp"

namespace reckon::haptics {

/// The servo of one impedance device. Takes the newest ContactSet, publishes a ServoSnapshot every
/// step.
///
/// One energy port serves all contacts of the device. Walls may use at most 3/4 of the device's
/// guaranteed damping; the rest is for hands.
class ServoLoop {
 public:
  /// @param device outlives the loop; its limits are read once, here.
  /// @param plan not null; never modified, so that all servos of a process may share it
  /// @throws std::invalid_argument when a setting is out of range; the text says which and why.
  ServoLoop(HapticDevice& device, std::shared_ptr<const EffectPlan> plan,
            const ServoConfig& config);
  /// The same with a plan that no other servo shares.
  ServoLoop(HapticDevice& device, EffectPlan plan, const ServoConfig& config);

  ServoLoop(const ServoLoop&) = delete;
  ServoLoop& operator=(const ServoLoop&) = delete;

  /// One servo period. @param now steady, never decreasing. Servo thread only; no allocation, no
  /// lock, no clock. About 0.2 us plus the device's own time, 0.35 us for each remote hand in
  /// reach, and the contact queries. Logarithmic in the number of objects out of reach.
  void step(std::chrono::nanoseconds now) noexcept;

  /// Whether a late step could be felt: the hand feels something, or a hand or a surface is within
  /// kSoonFelt of the probe. Servo thread; surfaces are searched in one of 8 steps.
  [[nodiscard]] bool has_near() noexcept;
  /// Farther than a hand moves before the next search, at 2 m/s and 100 Hz [m].
  static constexpr double kSoonFelt = 0.2;

  /// Whether the model loop has to see the last steps: something is near, the hand has moved by
  /// more than `moved` [m] or did within 100 ms, or 10 ms have passed. Notes that it will; servo
  /// thread.
  [[nodiscard]] bool take_news(double moved) noexcept;

  /// The model loop writes the remote hands here.
  [[nodiscard]] TripleBuffer<ContactSet>& contacts() noexcept { return contacts_; }
  /// The model loop reads the outcome here.
  [[nodiscard]] TripleBuffer<ServoSnapshot>& snapshots() noexcept { return snapshots_; }

  /// Records every step from now on; nullptr stops. Call while no step runs.
  void trace(TraceRing* ring) noexcept { trace_ = ring; }

  /// Stiffness limit of the static scene [N/m]; stiffer surfaces are softened to it.
  [[nodiscard]] double static_stiffness_limit() const noexcept { return static_cap_; }
  /// Rate limit for growth and rotation of the force [N/s]. Its decrease is not limited.
  [[nodiscard]] double force_rate_limit() const noexcept { return max_rate_; }
  /// Most power [W] that the force puts into a yielding hand.
  [[nodiscard]] double power_limit() const noexcept { return max_power_; }
  /// Stiffness that the scene asks for [N/m].
  [[nodiscard]] double static_stiffness() const noexcept { return plan_->max_stiffness(); }
  /// The static scene; any thread.
  [[nodiscard]] const EffectPlan& plan() const noexcept { return *plan_; }
  /// Stiffness limit of a remote hand [N/m]: half that of a wall, because two hands that press each
  /// other share the energy of one spring.
  [[nodiscard]] double remote_stiffness_limit() const noexcept;
  /// Stiffness limit of a body that no device moves [N/m].
  [[nodiscard]] double body_stiffness_limit() const noexcept;
  /// Guaranteed damping of the device [N s/m].
  [[nodiscard]] double damping() const noexcept { return limits_.damping; }
  /// Greatest force [N] that is written to the device.
  [[nodiscard]] double force_limit() const noexcept { return step_.force_limit; }

 private:
  void note_time() noexcept;
  void reduce(double scale) noexcept;
  [[nodiscard]] std::size_t exchange(const PortLoad& load) noexcept;  // number of contacts engaged
  [[nodiscard]] bool at_rest() noexcept;
  [[nodiscard]] double sure_speed() const noexcept;  // [m/s], lower bound
  void note_limit(const Eigen::Vector3d& force, double scale) noexcept;
  void start(const Eigen::Vector3d& device) noexcept;
  void let_go(const DeviceSample& reading, const Eigen::Vector3d& probe) noexcept;
  void forfeit(const Eigen::Vector3d& probe) noexcept;
  bool sample(const DeviceSample& reading) noexcept;
  void settle() noexcept;
  void take_contacts() noexcept;
  [[nodiscard]] bool place(const RemoteHand& hand, std::size_t at) noexcept;
  void advance() noexcept;
  void drop_faded() noexcept;
  [[nodiscard]] PortLoad load() noexcept;
  void soften_crowd(PortLoad& load) noexcept;
  [[nodiscard]] Eigen::Vector3d hold(PortLoad& load) noexcept;
  [[nodiscard]] Eigen::Vector3d keep_rate(const PortLoad& load,
                                          const Eigen::Vector3d& wanted) noexcept;
  void soften(const PortLoad& load, double held) noexcept;
  void publish(const Eigen::Vector3d& force, bool enabled) noexcept;
  [[nodiscard]] PairAccount& pair_of(const pdu::EntityId& id) noexcept;
  [[nodiscard]] double transferred() const noexcept;
  [[nodiscard]] RemoteContact* slot_of(const pdu::EntityId& id, std::size_t at) noexcept;
  [[nodiscard]] RemoteContact* take_slot() noexcept;
  [[nodiscard]] std::span<RemoteContact* const> near() const noexcept {
    return {near_.data(), near_count_};
  }

  HapticDevice& device_;
  DeviceLimits limits_;
  ServoConfig config_;
  std::shared_ptr<const EffectPlan> plan_;
  double period_;                 // [s], nominal
  double stiffness_per_damping_;  // [1/s]: K cap for 1 N s/m of damping
  double static_cap_ = 0.0;       // [N/m]
  double max_rate_ = 0.0;         // [N/s], growth and rotation of the force
  double max_power_ = 0.0;        // [W], into a yielding hand
  StaticContact static_;
  EnergyPort port_;
  Softening softening_;
  double crowd_share_ = 1.0;  // share of the springs of all hands that the device can show
  PortHold held_;             // shares of the load that the port held
  double limit_share_ = 1.0;  // share of that within the greatest force
  Safety safety_;
  MotionFilter device_motion_;
  MotionFilter scp_motion_;
  std::array<RemoteContact, kMaxRemoteHands> remote_{};
  std::array<RemoteContact*, kMaxRemoteHands> near_{};    // slots in use, in the order of remote_
  std::array<RemoteContact*, kMaxRemoteHands> placed_{};  // slots by place in the last set
  std::size_t near_count_ = 0;
  std::uint64_t next_search_ = 0;  // of surfaces, by count_
  bool near_surface_ = true;
  Eigen::Vector3d seen_at_ = Eigen::Vector3d::Zero();  // [m, S], of the probe as last seen
  std::chrono::nanoseconds seen_{0}, moved_{0};        // times of news
  std::size_t left_out_ = 0;
  std::array<PairAccount, 8 * kMaxRemoteHands> pairs_{};

  TripleBuffer<ContactSet> contacts_;
  TripleBuffer<ServoSnapshot> snapshots_;
  TraceRing* trace_ = nullptr;

  StepContext step_;
  std::uint64_t count_ = 0;
  std::chrono::nanoseconds stepped_at_{0};
  double elapsed_ = 0.0;  // [s], since the last step
  double rested_ = 0.0;   // [s], time short of energy and at rest
  ServoTally tally_;
  bool frozen_ = false;
  bool started_ = false;
  std::chrono::nanoseconds sampled_at_{0};             // last good reading
  Eigen::Vector3d written_ = Eigen::Vector3d::Zero();  // [N], S, held since the last step
  Eigen::Vector3d last_probe_ = Eigen::Vector3d::Zero();
  double port_min_ = 0.0;
  double loan_most_ = 0.0;
  double resting_ = 0.0;  // [J], received - given of all accounts without a contact now
};

}  // namespace reckon::haptics
