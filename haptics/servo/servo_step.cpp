// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/servo/servo_step.hpp"

#include <algorithm>
#include <utility>

#include "reckon/haptics/contact/energy_exchange.hpp"
#include "reckon/haptics/servo/between_hands.hpp"
#include "reckon/pdu/seconds.hpp"

namespace reckon::haptics {
namespace {

using Eigen::Vector3d;
using std::chrono::nanoseconds;

constexpr int kHoldSteps = 100;            // steps of zero force after a trip
constexpr double kStill = 0.02;            // [m/s]; a hand with a tremor counts as at rest
constexpr double kRest = 1.0;              // [s]
constexpr double kRestAfterGuests = 0.05;  // [s], if guests took the energy that hands lack
constexpr double kReadFor = 0.002;         // [s]: within it an encoder step may be no motion
constexpr std::uint64_t kPartsEach = 8;    // steps between two checks for solids between hands

template <int axes>
EnergyPortOf<axes> port_of(const DeviceLimits& limits, const ToolOf<axes>& tool) {
  return EnergyPortOf<axes>(tool.damping(), limits.delay_samples,
                            tool.step_at_port(limits.resolution, limits.turn_resolution));
}

}  // namespace

template <int axes>
ServoStepOf<axes>::ServoStepOf(HapticDevice& device, std::shared_ptr<const EffectPlan> plan,
                               const ServoConfig& config, std::shared_ptr<BodyWorld> bodies)
    : ServoCore(device, std::move(plan), config, std::move(bodies)),
      handle_(config_, limits_.turn_resolution),
      tool_({limits_.damping, limits_.turn_damping}, config_.probes),
      static_(*plan_,
              cap_for(tool_.probe_damping(), tool_.tool_damping(), tool_.bend(step_.force_limit)),
              config_.contact_radius, tool_.size()),
      port_(port_of(limits_, tool_)),
      hands_(config_.max_contacts),
      resolution_(limits_.resolution),
      port_rate_(tool_.size_at_port(max_rate_)),
      safety_(step_.force_limit, max_power_, limits_.max_speed, kHoldSteps),
      pressed_(bodies_, *plan_, config_, tool_.size(), static_cap_) {
  port_.limit_received_power(config_.max_received_power);
  static_.let_through_beyond(step_.force_limit);
  if (!plan_->regions().empty()) limit_sources();
  if constexpr (axes == 6) safety_.limit_turns(limits_.max_torque, kMostTurn / period_);
  if (config_.continuous_force > 0)
    safety_.limit_heat(config_.continuous_force, config_.thermal_time / period_);
}

// Limits the energy of regions: the loan that their potentials can need, and a power.
template <int axes>
void ServoStepOf<axes>::limit_sources() {
  Vector3d lever = Vector3d::Zero();
  if constexpr (axes == 6) lever.setConstant(tool_.lever(0).norm());
  const Eigen::AlignedBox3d space(limits_.workspace_min - lever, limits_.workspace_max + lever);
  Eigen::Isometry3d to_scene = Eigen::Isometry3d::Identity();
  to_scene.translate(config_.device_origin).rotate(config_.device_orientation);
  const double range = static_.regions().range(space, to_scene);
  port_.region_loan().limit(std::min(config_.region_loan, range));
  port_.oscillations().limit(config_.oscillation_power, config_.oscillation_energy);
}

template <int axes>
void ServoStepOf<axes>::step(nanoseconds now) noexcept {
  DeviceSample reading = device_.read(now);
  reading.ok &= handle_.is_whole(reading);
  step_.now = now;
  note_time();
  obey_stop(reading);
  pressed_.settle(step_.now, hands_.frozen(), port_);
  if (sample(reading)) settle();
  const Admission admission = safety_.admit(reading, tool_.twist());
  const bool enabled = admission == Admission::shown;
  step_.transfer = config_.transfer && enabled;

  port_.wait(step_.dt);
  if (contacts_.update()) hands_.take(contacts_.read(), step_, count_);
  part_hands();
  hands_.advance(step_, count_, port_);

  pressed_.grab(tool_, static_, buttons_, port_);
  pressed_.foresee(tool_, static_, period_);
  Load wanted = load();
  if (step_.transfer) {
    step_.engaged = exchange(wanted);
  } else {
    // Without forces the hand needs no energy: a transfer from others would be lost.
    for (RemoteContact* remote : hands_.all()) remote->ask_nothing();
  }
  const Force force = hold(wanted);
  if (enabled && static_.share() < 1.0) {
    tally_.walls.note(static_.share(), static_.asked(), step_.dt);
  }
  tally_.hidden = std::max(tally_.hidden, static_.hidden());
  tally_.passed = static_.passed();
  const RegionForces& regions = static_.regions();
  if (regions.share() < 1.0 && enabled) {
    tally_.effects.note(regions.share(), regions.asked(), step_.dt);
  }
  const double scale = enabled ? safety_.scale(tool_.wrench(force), tool_.twist()) : 0.0;
  note_limit(force, scale);
  if (scale < 1.0) port_.attenuate(scale);
  if (scale < 1.0 && admission != Admission::paused) reduce(scale);
  written_ = scale > 0.0 ? Force(scale * force) : Force::Zero();
  write();
  push_bodies(scale);
  publish(enabled);
  ++count_;
}

template <int axes>
bool ServoStepOf<axes>::has_near() noexcept {
  if (!hands_.empty() || !written_.isZero(0.0)) return true;
  if (count_ >= next_search_) {
    next_search_ = count_ + 8;
    near_surface_ = false;
    for (std::size_t i = 0; i < tool_.size() && !near_surface_; ++i)
      near_surface_ = plan_->has_within(tool_.place(i), kSoonFelt + config_.probe_radius);
  }
  return near_surface_;
}

template <int axes>
double ServoStepOf<axes>::sure_speed() const noexcept {
  return std::max(0.0, step_.velocity.norm() - resolution_ / kReadFor);
}

// Hands with a solid between them do not feel each other. The other peer does the same.
template <int axes>
void ServoStepOf<axes>::part_hands() noexcept {
  if (hands_.empty() || count_ % kPartsEach != 0) return;
  const ContactResult& walls = static_.walls().result();
  const Vector3d from = walls.in_contact ? walls.scp : step_.probe;
  hands_.set_apart([&](const Vector3d& to, bool apart) {
    return is_between_hands(*plan_, pressed_.bodies(), from, to, apart);
  });
}

// Whether energy has been short for a second while the hand is at rest in contact, so nobody will
// supply it; for less time if guests took it. Hands that separate and meet again ring, and would do
// so as long as a loan pays.
template <int axes>
bool ServoStepOf<axes>::at_rest() noexcept {
  const bool touches = std::ranges::any_of(hands_.all(), &RemoteContact::touching);
  const bool is = touches && softening_.share() < 1.0 && sure_speed() <= kStill;
  rested_ = is ? rested_ + step_.dt : 0.0;
  return rested_ >= (springs_.guests().pressed_lately() ? kRestAfterGuests : kRest);
}

template <int axes>
std::size_t ServoStepOf<axes>::exchange(const Load& load) noexcept {
  const bool rests = at_rest();
  const double walls = static_.lacks();
  // Without neighbours, loan or debt there is nothing to do.
  if (hands_.empty() && !(walls > 0) && !(port_.owed() > 0)) return 0;
  const double spare = tool_.at_probe(port_.spare(load.walls_slope, period_));
  return exchange_energy(hands_.all(), port_, {spare, walls, sure_speed(), rests, step_.dt});
}

// After a failed reading the hand keeps its position; the held force is cut in this step.
template <int axes>
bool ServoStepOf<axes>::sample(const DeviceSample& reading) noexcept {
  step_.dt = period_;
  if (!reading.ok || !reading.position.allFinite()) {
    ++tally_.failed;
    port_.miss(elapsed_);
    return false;
  }
  const HandlePose pose = handle_.pose_of(reading);
  buttons_ = reading.buttons;
  step_.dt = started_ ? std::max(pdu::to_seconds(step_.now - sampled_at_), 0.1 * period_) : period_;
  sampled_at_ = step_.now;
  held_share_ = std::clamp(reading.held, 0.0, 1.0);
  if constexpr (axes == 3) note_pose(reading);
  if (!std::exchange(started_, true)) {
    tool_.reset(pose);
    forfeit(pose);
  }
  took_ = reading.took ? pdu::to_seconds(*reading.took) : elapsed_;
  if (reading.watchdog) drop_force(reading, pose);
  tool_.move(pose);
  step_.probe = tool_.place();
  handle_.follow(reading, pdu::to_seconds(step_.now), tool_);
  step_.velocity = tool_.velocity();
  return true;
}

// Updates damping and resolution for the pose, for a device with guaranteed joint friction.
template <int axes>
void ServoStepOf<axes>::note_pose(const DeviceSample& reading) noexcept {
  if (!reading.damping && !reading.resolution) return;
  resolution_ = std::max(0.0, reading.resolution.value_or(limits_.resolution));
  port_.pose(std::clamp(reading.damping.value_or(limits_.damping), 0.0, limits_.damping),
             resolution_);
  if (!reading.damping) return;
  use_damping(port_.damping());
  static_.limit(limits_.damping > 0 ? port_.damping() / limits_.damping * static_cap_
                                    : static_cap_);
}

// The device dropped the force by itself. Up to that position the sample is a normal one; after it,
// the hand moved without a force. If the position is unknown, so is the energy exchanged with the
// hand.
template <int axes>
void ServoStepOf<axes>::drop_force(const DeviceSample& reading, const HandlePose& pose) noexcept {
  ++tally_.force_drops;
  if (const auto released = handle_.released_at(reading)) {
    tool_.move(*released);
    step_.probe = tool_.place();
    settle();
    port_.drop_force();
  } else {
    tool_.reset(pose);  // the duration of that motion is unknown
    forfeit(pose);
  }
  written_.setZero();
}

template <int axes>
void ServoStepOf<axes>::forfeit(const HandlePose& pose) noexcept {
  ToolOf<axes> there = tool_;
  there.reset(pose);
  static_.attenuate(0.0, port_);  // the energy stored in the walls may be lost too
  port_.clear();
  pressed_.place_all(static_);
  static_.reset(there);
  for (RemoteContact* remote : hands_.all()) remote->forfeit(there.place());
}

template <int axes>
void ServoStepOf<axes>::settle() noexcept {
  const Force dx = tool_.motion();
  port_.settle(dx, elapsed_, took_, held_share_);
  if constexpr (axes == 6) port_.book(-tool_.turning_cost(port_.at_handle(), elapsed_));
  pressed_.place(tool_, static_, period_, port_);
  static_.settle(tool_, step_.dt, port_);
  Vector3d change = Vector3d::Zero();
  const bool in_steps = port_.reads_in_steps();
  for (RemoteContact* remote : hands_.all()) {
    if (in_steps) change -= remote->spring().force();
    remote->settle(step_);
    if (in_steps) change += remote->spring().force();
  }
  if (in_steps) port_.follow(tool_.at_port(0, springs_.crowd_share() * held_.springs * change), dx);
  if (port_.debt() > 0) pressed_.repay(port_);
}

// The written force may be less than the port's, or lag behind it.
template <int axes>
void ServoStepOf<axes>::push_bodies(double scale) noexcept {
  const double whole = held_.force.squaredNorm();
  const double all = scale > 0.0 ? 1.0 : 0.0;
  const double share = whole > 0 ? std::max(0.0, written_.dot(held_.force) / whole) : all;
  pressed_.hold(static_, share * held_.walls, share);
}

// All springs are one force to the hand: opposite forces cancel and cost nothing.
template <int axes>
typename ServoStepOf<axes>::Load ServoStepOf<axes>::load() noexcept {
  Load load;
  static_.load(tool_, period_, load);
  springs_.load(hands_.all(),
                {tool_.at_probe(port_.spare(load.walls_slope, period_)), port_.level()}, tool_,
                step_, tally_, load);
  const double whole = axes == 3 ? step_.body_stiffness_limit : stiffness_per_damping_;
  springs_.soften(whole - load.walls_slope, tool_, step_, tally_, load);
  return load;
}

template <int axes>
void ServoStepOf<axes>::write() noexcept {
  const auto to_device = handle_.axes_in_scene().transpose();
  if constexpr (axes == 3) {
    device_.write(to_device * written_, step_.now);
  } else {
    const Wrench wrench = tool_.wrench(written_);
    device_.write_wrench(to_device * Vector3d(wrench.head<3>()),
                         to_device * Vector3d(wrench.tail<3>()), step_.now);
  }
}

template <int axes>
void ServoStepOf<axes>::note_bodies() noexcept {
  if (pressed_.bodies().empty()) return;
  if (static_.touches_others_body(*plan_) || pressed_.touches_copy(static_))
    tally_.bodies += step_.dt;
  if (static_.touches_body(*plan_)) tally_.at_bodies += step_.dt;
  if (static_.held() != nullptr) tally_.grabbed += step_.dt;
  tally_.body_energy = pressed_.work() + static_.stored();
}

template <int axes>
void ServoStepOf<axes>::publish(bool enabled) noexcept {
  const ContactResult& mesh = static_.result();
  if (mesh.in_contact) tally_.scene += step_.dt;
  note_bodies();
  // Others feel the hand at the first probe.
  const ContactResult& first = axes == 3 ? mesh : static_.walls().result();
  const Grab* const held = static_.held();
  const bool touches = first.in_contact || held != nullptr;
  const Vector3d surface = first.in_contact ? first.scp : step_.probe;
  const Vector3d scp = held != nullptr ? held->point() : surface;
  scp_motion_.add(scp, pdu::to_seconds(step_.now));
  ServoSnapshot& out = snapshots_.write_slot();
  out.time = step_.now;
  out.step = count_;
  out.device = step_.probe;
  out.scp = scp;
  out.velocity = touches ? scp_motion_.velocity() : step_.velocity;
  out.acceleration = scp_motion_.acceleration();
  out.device_velocity = step_.velocity;
  out.device_acceleration = handle_.acceleration();
  out.force = tool_.force(written_);
  if constexpr (axes == 6) {
    out.tool = tool_.state(written_);
  }
  out.mesh_force = static_.force();
  out.mesh_normal = mesh.normal;
  out.mesh_patch = mesh.in_contact ? mesh.objects[mesh.deepest].patch : 0;
  out.in_mesh_contact = mesh.in_contact;
  out.held = held == nullptr
                 ? HeldBody{}
                 : HeldBody{static_cast<std::uint16_t>(held->body() + 1), held->stiffness()};
  out.spring_share = held_.springs;
  out.crowd_share = springs_.crowd_share();
  out.extra_share = held_.extra;
  out.limit_share = limit_share_;
  out.enabled = enabled;
  out.stopped = stopped_;
  out.mesh_ledger = port_.free();
  out.trips = safety_.trips();
  out.count = 0;
  bool refused = false;
  for (const RemoteContact* remote : hands_.all()) {
    out.contacts[out.count++] = remote->account(step_, held_.extra);
    refused |= remote->refused();
  }
  if (refused) tally_.refused += step_.dt;
  out.tally = tally_;
  out.left_out = hands_.left_out();
  out.port_energy = port_.absorbed() + hands_.transferred() + static_.carried() - pressed_.work();
  out.encoder_allowance = port_.encoder_allowance();
  out.softening = springs_.crowd_share() * softening_.share();
  out.loan = port_.owed();
  out.region_loan = port_.region_loan().owed();
  out.oscillation_energy = port_.oscillations().spent() + port_.shakes_under_way(period_);
  out.late_cost = port_.late_cost();
  extremes_.note(out);
  if (trace_ != nullptr) trace_->push(out);
  snapshots_.publish();
}

template class ServoStepOf<3>;
template class ServoStepOf<6>;

}  // namespace reckon::haptics
