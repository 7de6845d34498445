// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/servo/servo_loop.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <utility>

#include "reckon/haptics/contact/energy_exchange.hpp"
#include "reckon/haptics/passivity/rate_limit.hpp"
#include "reckon/haptics/servo/servo_limits.hpp"
#include "reckon/pdu/seconds.hpp"

namespace reckon::haptics {
namespace {

using std::chrono::nanoseconds;

constexpr double kToSpare = 1.05;   // times the energy that the whole force needs
constexpr double kSafeSpeed = 1.0;  // [m/s], into the stiffest wall, or of a yielding hand
constexpr int kHoldSteps = 100;     // of zero force after a trip
constexpr double kStill = 0.02;     // [m/s], a hand with a tremor is at rest too
constexpr double kRest = 1.0;       // [s]
constexpr double kReadFor = 0.002;  // [s]: within it an encoder step may be no motion

double greatest_eigenvalue(const Eigen::Matrix3d& symmetric) {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(symmetric, Eigen::EigenvaluesOnly);
  return (1.0 + 1e-9) * solver.eigenvalues()(2);
}

}  // namespace

ServoLoop::ServoLoop(HapticDevice& device, EffectPlan plan, const ServoConfig& config)
    : ServoLoop(device, std::make_shared<const EffectPlan>(std::move(plan)), config) {}

ServoLoop::ServoLoop(HapticDevice& device, std::shared_ptr<const EffectPlan> plan,
                     const ServoConfig& config)
    : device_(device),
      limits_(checked_limits(device.limits())),
      config_(checked_config(config)),
      plan_(checked_plan(std::move(plan))),
      period_(pdu::to_seconds(config.period)),
      stiffness_per_damping_(stiffness_per_damping(config_, limits_)),
      static_cap_(static_cap(*plan_, limits_, stiffness_per_damping_)),
      max_rate_(
          std::min(config_.max_force_rate, stiffness_per_damping_ * limits_.damping * kSafeSpeed)),
      max_power_(std::min(config_.max_power, limits_.max_force * kSafeSpeed)),
      static_(*plan_, static_cap_, config_.contact_radius),
      port_(limits_.damping, limits_.delay_samples, limits_.resolution),
      safety_(std::min(limits_.max_force, config_.max_force), max_power_, limits_.max_speed,
              kHoldSteps) {
  port_.limit_received_power(config_.max_received_power);
  step_.period = period_;
  step_.probe_radius = config_.probe_radius;
  step_.force_limit = std::min(limits_.max_force, config_.max_force);
  step_.stiffness_limit = remote_stiffness_limit();
  step_.body_stiffness_limit = body_stiffness_limit();
  step_.damping = limits_.damping;
}

double ServoLoop::remote_stiffness_limit() const noexcept {
  const double cap = 0.5 * stiffness_per_damping_ * limits_.damping;
  return limits_.max_stiffness > 0 ? std::min(cap, limits_.max_stiffness) : cap;
}

double ServoLoop::body_stiffness_limit() const noexcept {
  const double cap = stiffness_per_damping_ * limits_.damping;
  return limits_.max_stiffness > 0 ? std::min(cap, limits_.max_stiffness) : cap;
}

void ServoLoop::step(nanoseconds now) noexcept {
  const DeviceSample reading = device_.read(now);
  step_.now = now;
  note_time();
  if (sample(reading)) settle();
  const Admission admission = safety_.admit(reading, step_.velocity);
  const bool enabled = admission == Admission::shown;
  step_.transfer = config_.transfer && enabled;

  port_.wait(step_.dt);
  if (contacts_.update()) take_contacts();
  advance();

  PortLoad wanted = load();
  if (step_.transfer) {
    step_.engaged = exchange(wanted);
  } else {
    // Without forces the hand needs no energy: what others gave it would be lost.
    for (RemoteContact* remote : near()) remote->ask_nothing();
  }
  const Eigen::Vector3d force = hold(wanted);
  if (enabled && static_.share() < 1.0) {
    tally_.walls.note(static_.share(), static_.asked(), step_.dt);
  }
  const RegionForces& regions = static_.regions();
  if (regions.share() < 1.0 && enabled) {
    tally_.effects.note(regions.share(), regions.asked(), step_.dt);
  }
  const double scale = enabled ? safety_.scale(force, step_.velocity) : 0.0;
  note_limit(force, scale);
  if (scale < 1.0) port_.attenuate(scale);
  if (scale < 1.0 && admission != Admission::paused) reduce(scale);
  written_ = scale > 0.0 ? Eigen::Vector3d(scale * force) : Eigen::Vector3d::Zero();
  device_.write(config_.device_orientation.conjugate() * written_, now);
  publish(written_, enabled);
  ++count_;
}

bool ServoLoop::has_near() noexcept {
  if (near_count_ > 0 || !written_.isZero(0.0)) return true;
  if (count_ >= next_search_) {
    next_search_ = count_ + 8;
    near_surface_ = plan_->has_within(step_.probe, kSoonFelt + config_.probe_radius);
  }
  return near_surface_;
}

double ServoLoop::sure_speed() const noexcept {
  return std::max(0.0, step_.velocity.norm() - limits_.resolution / kReadFor);
}

// Energy has been short for a second while the hand held still in touch, so that nobody will supply
// it. Hands that part and meet again ring, and would go on for as long as a loan pays.
bool ServoLoop::at_rest() noexcept {
  const bool touches = std::ranges::any_of(near(), &RemoteContact::touching);
  const bool is = touches && softening_.share() < 1.0 && sure_speed() <= kStill;
  rested_ = is ? rested_ + step_.dt : 0.0;
  return rested_ >= kRest;
}

std::size_t ServoLoop::exchange(const PortLoad& load) noexcept {
  const bool rests = at_rest();
  const double walls = static_.lacks();
  // Without neighbours, loan or debt there is nothing to do.
  if (near_count_ == 0 && !(walls > 0) && !(port_.owed() > 0)) return 0;
  const double spare = port_.spare(load.walls_slope, period_);
  return exchange_energy(near(), port_, {spare, walls, sure_speed(), rests, step_.dt});
}

// A contact whose force is cut to zero lets go, and fades in again from there.
void ServoLoop::reduce(double scale) noexcept {
  static_.attenuate(scale, port_);
  if (scale > 0.0) return;
  static_.drop();
  for (RemoteContact* remote : near()) remote->drop();
}

// A cut lowers the gain of the walls, which at once begins to rise again. Their full force is
// therefore greater than the force of this step.
void ServoLoop::note_limit(const Eigen::Vector3d& force, double scale) noexcept {
  limit_share_ = 1.0;
  if (!(scale > 0.0) || scale >= 1.0) return;
  const double asked = (force + static_.held_back()).norm();
  limit_share_ = std::min(1.0, scale * force.norm() / asked);
  tally_.limit.note(limit_share_, asked, step_.dt);
}

// A sample shorter than the real one would credit too much damping.
void ServoLoop::note_time() noexcept {
  if (count_ > 0 && 2 * (step_.now - stepped_at_) > 3 * config_.period) ++tally_.late;
  elapsed_ =
      count_ > 0 ? std::max(pdu::to_seconds(step_.now - stepped_at_), 0.1 * period_) : period_;
  stepped_at_ = step_.now;
}

// A failed reading leaves the hand where it was; the held force is cut in this step.
bool ServoLoop::sample(const DeviceSample& reading) noexcept {
  step_.dt = period_;
  if (!reading.ok || !reading.position.allFinite()) {
    ++tally_.failed;
    port_.miss(elapsed_);
    return false;
  }
  const Eigen::Vector3d probe =
      config_.device_origin + config_.device_orientation * reading.position;
  step_.dt = started_ ? std::max(pdu::to_seconds(step_.now - sampled_at_), 0.1 * period_) : period_;
  sampled_at_ = step_.now;
  if (!started_) start(probe);
  if (reading.watchdog) let_go(reading, probe);
  last_probe_ = step_.probe;
  step_.probe = probe;
  device_motion_.add(probe, pdu::to_seconds(step_.now));
  step_.velocity = reading.has_velocity && reading.velocity.allFinite()
                       ? Eigen::Vector3d(config_.device_orientation * reading.velocity)
                       : device_motion_.velocity();
  return true;
}

// The device dropped the force by itself. Up to that place the sample is a normal one, and after it
// the hand moved without a force. If the place is unknown, the energy exchanged with the hand is
// unknown too.
void ServoLoop::let_go(const DeviceSample& reading, const Eigen::Vector3d& probe) noexcept {
  ++tally_.let_go;
  if (reading.released_at && reading.released_at->allFinite()) {
    last_probe_ = step_.probe;
    step_.probe = config_.device_origin + config_.device_orientation * *reading.released_at;
    settle();
    port_.let_go();
  } else {
    forfeit(probe);
  }
  written_.setZero();
}

void ServoLoop::forfeit(const Eigen::Vector3d& probe) noexcept {
  port_.clear();
  static_.reset(probe);
  for (RemoteContact* remote : near()) remote->forfeit(probe);
}

void ServoLoop::start(const Eigen::Vector3d& device) noexcept {
  started_ = true;
  step_.probe = device;
  forfeit(device);
}

void ServoLoop::settle() noexcept {
  const Eigen::Vector3d dx = step_.probe - last_probe_;
  port_.settle(dx, elapsed_);
  static_.settle(step_.probe, step_.dt, port_);
  Eigen::Vector3d change = Eigen::Vector3d::Zero();
  const bool in_steps = port_.reads_in_steps();
  for (RemoteContact* remote : near()) {
    if (in_steps) change -= remote->spring().force();
    remote->settle(step_);
    if (in_steps) change += remote->spring().force();
  }
  if (in_steps) port_.follow(crowd_share_ * held_.springs * change, dx);
}

PairAccount& ServoLoop::pair_of(const pdu::EntityId& id) noexcept {
  PairAccount* oldest = &pairs_[0];
  for (PairAccount& pair : pairs_) {
    if (pair.used && pair.id == id) return pair;
    const bool older = pair.used ? pair.last_step < oldest->last_step : oldest->used;
    if (older) oldest = &pair;
  }
  *oldest = PairAccount{};
  return *oldest;
}

// Sets mostly keep their order, so that the search begins at the hand's place in the last set.
RemoteContact* ServoLoop::slot_of(const pdu::EntityId& id, std::size_t at) noexcept {
  RemoteContact* guess = placed_[at];
  if (guess != nullptr && guess->occupied() && guess->id() == id) return guess;
  for (RemoteContact* remote : near()) {
    if (remote->id() == id) return remote;
  }
  return nullptr;
}

RemoteContact* ServoLoop::take_slot() noexcept {
  if (near_count_ >= config_.max_contacts) return nullptr;
  std::size_t slot = 0;
  while (slot < near_count_ && near_[slot] == &remote_[slot]) ++slot;
  std::copy_backward(near_.begin() + static_cast<std::ptrdiff_t>(slot),
                     near_.begin() + static_cast<std::ptrdiff_t>(near_count_),
                     near_.begin() + static_cast<std::ptrdiff_t>(near_count_) + 1);
  ++near_count_;
  return near_[slot] = &remote_[slot];
}

void ServoLoop::take_contacts() noexcept {
  const ContactSet& set = contacts_.read();
  frozen_ = set.frozen;
  left_out_ = set.left_out;
  for (RemoteContact* remote : near()) remote->leave();  // except those in the set
  for (std::size_t i = 0; i < std::min(set.count, kMaxRemoteHands); ++i) {
    if (!place(set.hands[i], i)) ++left_out_;
  }
}

bool ServoLoop::place(const RemoteHand& hand, std::size_t at) noexcept {
  RemoteContact* slot = slot_of(hand.id, at);
  if (slot != nullptr) {
    slot->come_back(hand, step_);
  } else if ((slot = take_slot()) != nullptr) {
    PairAccount& account = pair_of(hand.id);
    resting_ -= account.received - account.given;
    slot->begin(hand, account, step_);
    slot->keep_account(count_);
  }
  placed_[at] = slot;
  return slot != nullptr;
}

void ServoLoop::advance() noexcept {
  for (RemoteContact* remote : near()) {
    remote->keep_account(count_);
    remote->claim(port_);
    remote->predict(step_, frozen_);
  }
  drop_faded();
  for (RemoteContact* remote : near()) remote->advance(step_);
}

void ServoLoop::drop_faded() noexcept {
  std::size_t kept = 0;
  for (RemoteContact* remote : near()) {
    if (remote->faded() && !remote->touching()) {
      resting_ += remote->pair().received - remote->pair().given;
      remote->clear();
    } else {
      near_[kept++] = remote;
    }
  }
  near_count_ = kept;
}

// All springs are one force to the hand: opposite forces cancel and cost nothing.
PortLoad ServoLoop::load() noexcept {
  PortLoad load;
  static_.load(step_.velocity, period_, load);
  Eigen::Matrix3d slopes = Eigen::Matrix3d::Zero();
  std::size_t touched = 0;
  for (const RemoteContact* remote : near()) {
    if (!remote->touching()) continue;
    const ContactSpring& spring = remote->spring();
    load.springs += spring.force();
    load.stored += spring.stored();
    load.extra += remote->damper(step_);
    load.springs_slope = std::max(load.springs_slope, spring.greatest_slope());
    slopes += spring.slope();
    ++touched;
  }
  if (touched > 0) tally_.hands += step_.dt;
  if (touched > 1) load.springs_slope = greatest_eigenvalue(slopes);
  soften_crowd(load);
  return load;
}

// If the springs together are stiffer than the device can show, they would buzz at the expense of
// the ledger. So all are softened by the same factor.
void ServoLoop::soften_crowd(PortLoad& load) noexcept {
  const double most = body_stiffness_limit() - load.walls_slope;
  const double goal = load.springs_slope > most ? std::max(0.0, most) / load.springs_slope : 1.0;
  const double step = step_.dt / RemoteContact::kRamp;
  crowd_share_ += std::clamp(goal - crowd_share_, -step, step);
  tally_.crowd.note_force(crowd_share_, load.springs, step_.dt);
  load.springs *= crowd_share_;
  load.stored *= crowd_share_;
  load.springs_slope *= crowd_share_;
}

Eigen::Vector3d ServoLoop::hold(PortLoad& load) noexcept {
  held_ = port_.hold(load, period_);
  if (held_.walls < 1.0) {
    static_.attenuate(held_.walls, port_);
    load.walls *= held_.walls;
    load.walls_slope *= held_.walls;
    load.walls_stored *= held_.walls;
  }
  tally_.held_back.note_force(held_.springs, load.springs, step_.dt);
  tally_.effects.note_force(held_.extra, load.extra, step_.dt);
  static_.shown(held_.extra);
  const Eigen::Vector3d force = keep_rate(load, held_.force);
  const double whole = held_.force.norm();
  const double reached = whole > 0 ? std::min(1.0, force.norm() / whole) : 1.0;
  const double share = crowd_share_ * held_.springs * reached;
  for (RemoteContact* remote : near()) remote->shown(share, port_.free());
  tally_.rate.note(reached, whole, step_.dt);
  if (softening_.share() < 1.0) {
    tally_.softened.note(softening_.share(), load.springs.norm() / softening_.share(), step_.dt);
  }
  soften(load, held_.springs);
  return force;
}

// A crease, an edge or a quick blow turns the force within one sample. The force follows at a
// limited rate, which the port accounts for like any held force. If the energy does not allow that,
// the whole force is reduced.
Eigen::Vector3d ServoLoop::keep_rate(const PortLoad& load, const Eigen::Vector3d& wanted) noexcept {
  if (!wanted.allFinite()) return wanted;  // safety handles it
  const double most = max_rate_ * elapsed_;
  const Eigen::Vector3d near_by = nearest_in_reach(written_, wanted, most);
  if (near_by == wanted || port_.hold_instead(load, near_by, period_)) return near_by;
  const double part = part_in_reach(written_, wanted, most);
  static_.attenuate(part, port_);
  port_.attenuate(part);
  return part * wanted;
}

void ServoLoop::soften(const PortLoad& load, double held) noexcept {
  double whole = 0.0;  // [J]
  if (load.stored > 0) {
    const double pays = port_.spare(load.walls_slope, period_);
    if (pays > 0) whole = load.springs.squaredNorm() / (4 * pays);
  }
  softening_.learn(held, port_.level() > kToSpare * whole, load.stored > 0, step_.dt);
  step_.softening = softening_.share();
}

}  // namespace reckon::haptics
