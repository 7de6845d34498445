// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tests/fuzz/touch/hand.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "reckon/haptics/passivity/energy_port.hpp"
#include "reckon/tests/fuzz/touch/solids.hpp"

namespace reckon::fuzz {
namespace {

using std::chrono::nanoseconds;
using namespace std::chrono_literals;

constexpr double kHeld = 0.1;      // [N]
constexpr double kSettled = 1.5;   // [s]
constexpr double kTakenOff = 100;  // steps
constexpr double kSpoken = 1e-3;   // [J], threshold for the share of a model's ledger
// Share of the energy of samples whose reading failed: a light hand on a stiff grip turns round
// within two samples.
constexpr double kEstimated = 0.5;
constexpr double kTurned = 1e-4;  // [J], at 1 ms or less; it grows with the square of the period
// A grip that leads a light hand along a track: 10 N displace it by half a millimetre.
constexpr double kFirm = 20000;      // [N/m]
constexpr double kFirmDamping = 60;  // [N s/m]
constexpr double kFirmMass = 0.05;   // [kg]

double smooth(double s) {
  s = std::clamp(s, 0.0, 1.0);
  return s * s * (3 - 2 * s);
}

// -1 to 1: a stroke, a tap in each period, or a sweep there and back at one speed.
double wave(double kind, double angle) {
  const double sine = std::sin(angle);
  if (kind == 1) return sine > 0 ? std::pow(sine, 8) : 0.0;
  if (kind == 2) return 2 / std::numbers::pi * std::asin(sine);
  return sine;
}

double drawn(std::mt19937& random) { return std::uniform_real_distribution<double>(0, 1)(random); }

nanoseconds period_of(const Scenario& s, std::size_t hand) {
  const double rate = s.of_device(hand, Shared::servo_rate, Shared::other_rate);
  return nanoseconds(std::llround(1e9 / rate));
}

haptics::SimulatedDeviceConfig device_of(const Scenario& s, std::size_t hand, const Track* led) {
  haptics::SimulatedDeviceConfig config;
  config.mass = s[Shared::mass];
  config.damping = s[Shared::damping];
  config.hand_stiffness = s[Shared::grip];
  config.hand_damping = s[Shared::grip_damping];
  config.hold = s[Shared::holds] > 0 ? nanoseconds(haptics::HapticDevice::kWatchdog)
                                     : 3 * period_of(s, hand) / 2;
  config.delay_samples =
      static_cast<int>(s.of_device(hand, Shared::device_delay, Shared::other_delay));
  config.resolution = s[Shared::encoder];
  config.start.x() = home_of(s, hand);
  if (led != nullptr) {
    config.mass = kFirmMass;
    config.hand_stiffness = kFirm;
    config.hand_damping = kFirmDamping;
    config.start = led->at(0).position;
  }
  return config;
}

// Distance of `force` from any part of `held`, to which the force may fall at once [N].
double step_of(const Eigen::Vector3d& held, const Eigen::Vector3d& force) {
  const double square = held.squaredNorm();
  const double part = square > 0 ? std::clamp(held.dot(force) / square, 0.0, 1.0) : 0.0;
  return (force - part * held).norm();
}

// For a servo without this field nothing is allowed.
template <class Snapshot>
double encoder_allowance(const Snapshot& snapshot) {
  if constexpr (requires { snapshot.encoder_allowance; }) {
    return snapshot.encoder_allowance;
  } else {
    return 0.0;
  }
}

double turned_within(nanoseconds period) {
  const double longer = std::max(1.0, std::chrono::duration<double, std::milli>(period).count());
  return kTurned * longer * longer;
}

double told_in_all(const haptics::ServoTally& tally) {
  return tally.held_back.seconds + tally.crowd.seconds + tally.softened.seconds +
         tally.rate.seconds + tally.walls.seconds + tally.effects.seconds + tally.limit.seconds +
         tally.refused;
}

}  // namespace

haptics::HandTarget Track::at(double t) const {
  const auto index = static_cast<std::size_t>(std::max(0.0, t / period));
  haptics::HandTarget target;
  if (points.empty()) return target;
  if (index + 1 >= points.size()) {
    target.position = points.back();
    return target;
  }
  target.velocity = (points[index + 1] - points[index]) / period;
  target.position = points[index] + (t - static_cast<double>(index) * period) * target.velocity;
  return target;
}

void Track::slow_down(double most) {
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Eigen::Vector3d way = points[i] - points[i - 1];
    const double length = way.norm();
    if (length > most * period) points[i] = points[i - 1] + most * period / length * way;
  }
}

haptics::DeviceSample SimulatedHandle::read(nanoseconds now) noexcept {
  haptics::DeviceSample sample = SimulatedDevice::read(now);
  if (failures_ > 0) {
    --failures_;
    sample.ok = false;
  }
  return sample;
}

double home_of(const Scenario& scenario, std::size_t hand) {
  return static_cast<double>(hand) * (2 * kRadius + 1e-6 - scenario[Shared::overlap]);
}

Eigen::Vector3d way_of(const Scenario& s, std::size_t hand, double t) {
  const double in = smooth((t - s.path(hand, Path::begin)) / s.path(hand, Path::rise));
  const double angle = 2 * std::numbers::pi * s.path(hand, Path::frequency) * t;
  const double moved = wave(s.path(hand, Path::kind), angle + s.path(hand, Path::phase));
  const bool silent = s[Shared::silent_hand] == static_cast<double>(hand + 1);
  const double gone = silent ? smooth((t - s[Shared::silent_at]) / kMoved) : 0.0;
  const double press = s.path(hand, Path::press) + s.path(hand, Path::amplitude) * moved;
  return {in * press + gone * s[Shared::silent_move],
          in * s.path(hand, Path::side) * std::sin(angle), 0};
}

Hand::Hand(const Scenario& scenario, std::size_t index, const Track* led, nanoseconds begin)
    : scenario_(scenario), index_(index), period_(period_of(scenario, index)), begin_(begin) {
  const bool has_model = index == 0 && scenario.model() != Model::simulated;
  if (has_model) drawn_ = drawn_of(scenario);
  make_handle(led);
  if (model_ != nullptr) begin_ = model_->begin();
  next_ = at_ = begin_;
  haptics::ServoConfig config;
  config.period = period_;
  config.probe_radius = kRadius;
  const Eigen::Vector3d home = home_of(scenario, index) * Eigen::Vector3d::UnitX();
  haptics::Scene scene = solids_of(scenario, home, drawn_ ? &drawn_->scene() : nullptr);
  if (simulated_ != nullptr && index == 0) add_moving(scenario, home, scene);
  const auto plan = std::make_shared<const haptics::EffectPlan>(scene);
  const auto world = haptics::make_bodies(*plan, scene, paddle_of(scenario));
  servo_ = std::make_unique<haptics::ServoLoop>(handle_->device(), plan, config, world);
  const auto own = index == 0 && model_ == nullptr ? world : nullptr;
  moving_ = std::make_unique<MovingBooks>(scenario, own, servo_->static_stiffness_limit());
}

void Hand::make_handle(const Track* led) {
  const auto way = [this](double t) -> Eigen::Vector3d {
    const Eigen::Vector3d home = home_of(scenario_, index_) * Eigen::Vector3d::UnitX();
    const Eigen::Vector3d place = home + way_of(scenario_, index_, t);
    return drawn_ ? Eigen::Vector3d(place + drawn_->hand(t)) : place;
  };
  if (index_ == 0 && scenario_.model() != Model::simulated) {
    std::unique_ptr<ModelHandle> handle = model_handle(scenario_, period_, way);
    model_ = handle.get();
    handle_ = std::move(handle);
    return;
  }
  const auto target = [way, led](double t) {
    if (led != nullptr) return led->at(t);
    haptics::HandTarget wanted;
    wanted.position = way(t);
    return wanted;
  };
  auto handle = std::make_unique<SimulatedHandle>(device_of(scenario_, index_, led), target);
  simulated_ = handle.get();
  handle_ = std::move(handle);
}

double Hand::time_of(nanoseconds now) const {
  return std::chrono::duration<double>(now - begin_).count();
}

void Hand::step(nanoseconds now, std::mt19937& random) {
  stepped_ = next_ <= now;
  if (!stepped_) return;
  const double dt = std::chrono::duration<double>(now > at_ ? now - at_ : period_).count();
  const bool failed = handle_->fails();
  const double before = handle_->port_work();
  servo_->step(now);
  servo_->snapshots().update();
  snapshot_ = servo_->snapshots().read();
  at_ = now;
  note_transfer();
  keep_books(before, dt, failed);
  note_surfaces();
  if (watched_) {
    force_sum_ += dt * (model_ != nullptr ? handle_->force() : snapshot_.force).norm();
    force_time_ += dt;
    if (handle_->tells_why()) speechless_ += dt;
  }
  draw_faults(now, random);
}

void Hand::draw_faults(nanoseconds now, std::mt19937& random) {
  const double t = time_of(now);
  const Scenario& s = scenario_;
  next_ = now + period_ + handle_->silence();
  const bool calm = t >= s[Shared::calm_after];
  if (drawn(random) < s[Shared::late] && !calm) {
    next_ += nanoseconds(static_cast<std::int64_t>(1e9 * s[Shared::late_by] * drawn(random)));
  }
  if (simulated_ == nullptr) return;
  if (!simulated_->fails() && drawn(random) < s[Shared::failed] && !calm) {
    simulated_->fail(static_cast<int>(s[Shared::failed_run]));
  }
  const bool his = s[Shared::off_hand] == static_cast<double>(index_ + 1);
  simulated_->enable(!his || t < s[Shared::off_at] || t > s[Shared::off_at] + s[Shared::off_for]);
}

void Hand::note_transfer() {
  for (std::size_t i = 0; i < snapshot_.count; ++i) {
    const haptics::ContactAccount& account = snapshot_.contacts[i];
    double& known = transfer_[account.id.entity % transfer_.size()];
    transferred_ += account.received - account.given - known;
    known = account.received - account.given;
  }
}

// A force held longer than the servo assumed may release energy that no servo can know in time:
// exactly that energy is open. The energy of a sample whose reading failed is estimated.
void Hand::keep_books(double before, double dt, bool failed) {
  const double took = std::max(0.0, before - handle_->port_work());
  if (dt > 1.0001 * std::chrono::duration<double>(period_).count())
    late_cost_ = std::max(late_cost_, took);
  if (failed) failed_cost_ += kEstimated * took + turned_within(period_);
  const bool let_go = snapshot_.tally.force_drops != let_go_;
  let_go_ = snapshot_.tally.force_drops;
  if (let_go) held_.setZero();

  moving_->note(snapshot_, dt);
  const double port =
      work() + transferred_ + snapshot_.loan + snapshot_.source_energy() - moving_->gained();
  finite_ = finite_ && std::isfinite(port) && snapshot_.force.allFinite();
  if (model_ != nullptr) return keep_model_books(port, dt);
  if (!moving_->are_exact()) return note_step(dt);
  const double allowed = allowance();
  least_port_ = std::min(least_port_, port);
  short_ = std::min(short_, port + open() + allowed);
  if (snapshot_.force.norm() > kHeld) least_held_ = std::min(least_held_, port);
  if (!failed) {
    const double gap = snapshot_.port_energy - transferred_ - work() + moving_->gained();
    meter_ = std::max(meter_, gap);
    meter_short_ = std::max(meter_short_, gap - failed_cost_ - allowed);
  }
  note_step(dt);
}

void Hand::note_step(double dt) {
  excess_ = std::max(excess_, step_of(held_, snapshot_.force) - servo_->force_rate_limit() * dt);
  held_ = snapshot_.force;
}

// The servo's reading is older than the ledger, which does not include bodies.
void Hand::keep_model_books(double port, double dt) {
  const double allowed = allowance() + handle_->rounding();
  least_port_ = std::min(least_port_, port);
  if (!handle_->keeps_limits()) return;
  short_ = std::min(short_, port + allowed);
  const bool has_bodies = scenario_[Shared::drawn] == static_cast<double>(Drawn::bodies);
  const double known = has_bodies ? 1e9 : transferred_ + handle_->work_known();
  const double gap = snapshot_.port_energy - known;
  meter_ = std::max(meter_, gap);
  meter_short_ = std::max(meter_short_, gap - allowed);
  put_in_ = std::max(put_in_, port + allowed);
  if (scenario_.model() != Model::event) note_step(dt);
  if (!(handle_->force().norm() > kHeld)) return;
  least_held_ = std::min(least_held_, port);
  books_.made = std::max(books_.made, -(port + allowed));
  if (put_in_ < kSpoken) return;
  books_.left = std::min(books_.left, (port + allowed) / put_in_);
  books_.claimed = std::max(books_.claimed, gap - allowed);
}

// Energy that surfaces put into the own springs by moving, whether their force is held or not: else
// a hand that lacks energy would never believe in any. Along x a surface is `depth` beyond the
// hand. Energy that surfaces take back is not counted: an honest hand takes back more than it
// brought if energy arrives late.
void Hand::note_surfaces() {
  for (std::size_t i = 0; i < snapshot_.count; ++i) {
    const haptics::ContactAccount& account = snapshot_.contacts[i];
    Surface& last = surfaces_[account.id.entity % surfaces_.size()];
    const double force = account.asked_force.x();
    const double side = force + last.force > 0 ? 1.0 : -1.0;
    const double depth = std::max(0.0, account.depth);
    const double moved = snapshot_.device.x() - last.x + side * (depth - last.depth);
    if (last.known) seen_ += std::max(0.0, 0.5 * (force + last.force) * moved);
    last = {depth, force, snapshot_.device.x(), true};
  }
  const double t = time_of(at_);
  if (t < kSettled) return;
  unseen_ = std::max(unseen_, -work() - seen_ - haptics::EnergyPort::kUnseenPower * t);
}

double Hand::felt() const {
  double most = 0;
  for (std::size_t i = 0; i < snapshot_.count; ++i) {
    most = std::max(most, snapshot_.contacts[i].force.norm());
  }
  return most;
}

double Hand::allowance() const { return encoder_allowance(snapshot_); }

void Hand::watch() {
  watched_ = true;
  told_before_ = told_so_far();
}

double Hand::mean_force() const { return force_time_ > 0 ? force_sum_ / force_time_ : 0.0; }

// A failed reading, which is counted, removes the force for kTakenOff steps.
double Hand::told_so_far() const {
  const double told = told_in_all(snapshot_.tally) + speechless_;
  if (model_ == nullptr) return told;
  const double period = std::chrono::duration<double>(period_).count();
  return told + kTakenOff * period * static_cast<double>(snapshot_.tally.failed);
}

double Hand::told() const { return told_so_far() - told_before_; }

void Hand::judge(Outcome& out) const {
  out.least_port = std::min(out.least_port, least_port_);
  out.least_held = std::min(out.least_held, least_held_);
  out.meter = std::max(out.meter, meter_);
  out.excess = std::max(out.excess, excess_);
  out.late_cost = std::max(out.late_cost, late_cost_);
  if (index_ == 0) out.unseen = unseen_;
  if (model_ != nullptr) out.model = books_;
  const std::size_t name = index_ + 1;
  moving_->judge(out);
  if (!finite_) out.violation = fmt::format("hand {}: a force or an energy is no number", name);
  if (short_ < -kRoundOff) {
    out.violation = fmt::format("hand {}: the port lacks {:.3g} J", name, -short_);
  } else if (meter_short_ > kRoundOff) {
    out.violation = fmt::format("hand {}: the meter is {:.3g} J too high", name, meter_short_);
  } else if (excess_ > 1e-9) {
    out.violation = fmt::format("hand {}: the force grew or turned by {:.3g} N more than the limit",
                                name, excess_);
  }
}

}  // namespace reckon::fuzz
