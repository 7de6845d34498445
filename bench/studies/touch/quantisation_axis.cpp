// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Quantisation: motion, force model and timestamps of a remote hand as rounded on the wire, felt by
// a probe that does not move.
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <memory>
#include <numbers>

#include "reckon/bench/studies/touch/touch_study.hpp"
#include "reckon/deadreckon/force/force_model.hpp"
#include "reckon/deadreckon/motion/drm.hpp"
#include "reckon/deadreckon/motion/geocentric.hpp"
#include "reckon/deadreckon/wire_conversion.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/pdu/timestamp.hpp"

namespace reckon::bench {
namespace {

using deadreckon::ForceModel;
using deadreckon::KinematicState;
using Eigen::Vector3d;

constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kRadius = 0.02, kStiffness = 800.1;  // [m]; [N/m], not representable as float32
constexpr double kDepth = 0.004;                      // [m]
constexpr std::size_t kSteps = 4000;                  // [ms]
constexpr std::size_t kUpdate = 20;                   // [ms] between updates

/// An update and its time of validity [s].
struct Update {
  KinematicState state;
  ForceModel model;
  double time = 0;
};

/// The remote hand swings in the probe at 2 Hz, kDepth +- 3 mm deep.
Update update_at(double time, double phase) {
  const double w = kTurn * 2, angle = w * time + phase, swing = 0.003;
  Update update;
  update.time = time;
  update.state.algorithm = pdu::DeadReckoningAlgorithm::rvw;
  const Vector3d axis = Vector3d(0.6, 0.64, 0.48);
  update.state.position = (2 * kRadius - kDepth + swing * std::sin(angle)) * axis;
  update.state.velocity = swing * w * std::cos(angle) * axis;
  update.state.acceleration = -swing * w * w * std::sin(angle) * axis;
  update.model.kind = pdu::ForceModelKind::sphere;
  update.model.radius = kRadius;
  update.model.k1 = kStiffness;
  return update;
}

using Round = Update (*)(Update update);

const deadreckon::LocalFrame& frame() {
  static const deadreckon::LocalFrame frame(0.83, 0.15, 400);
  return frame;
}

Update as_it_is(Update update) { return update; }

Update with_wire_time(Update update) {
  const std::uint32_t stamp = pdu::to_dis_timestamp(pdu::from_seconds(update.time), false);
  update.time = 1e-9 * static_cast<double>(pdu::past_the_hour(stamp).count());
  return update;
}

Update with_wire_fields(Update update) {
  pdu::EntityState entity;
  pdu::HapticRecord record;
  static_cast<void>(deadreckon::to_wire(update.state, frame(), entity));
  static_cast<void>(deadreckon::from_wire(entity, frame(), update.state));
  static_cast<void>(deadreckon::to_wire(update.model, record));
  static_cast<void>(deadreckon::from_wire(record, update.model));
  return update;
}

Update as_on_the_wire(Update update) { return with_wire_fields(with_wire_time(update)); }

Update with_milliseconds(Update update) {
  update.time = 1e-3 * std::floor(1e3 * update.time);
  return update;
}

Update with_float_location(Update update) {
  update.state.position = update.state.position.cast<float>().cast<double>();
  return update;
}

Update with_float_geocentric(Update update) {
  update.state.position = frame().scene_from_world(
      frame().world_from_scene(update.state.position).cast<float>().cast<double>());
  return update;
}

/// Evaluates the last update each millisecond.
class Evaluator {
 public:
  Evaluator(Round round, double phase) : round_(round), phase_(phase) {}
  Vector3d step(std::size_t at) {
    // Not at whole milliseconds, as with real clocks.
    const double now = 1e-3 * static_cast<double>(at) + 0.00037;
    if (at % kUpdate == 0) last_ = round_(update_at(now, phase_));
    return deadreckon::evaluate(last_.model, extrapolate(last_.state, now - last_.time),
                                Vector3d::Zero(), Vector3d::Zero(), kRadius);
  }

 private:
  Round round_;
  double phase_;
  Update last_;
};

}  // namespace

TouchCase quantisation_case(const TouchConditions& conditions) {
  const double phase = phase_of(conditions.seed, 1);
  TouchCase made;
  made.truth = fmt::format(
      "a hand of {} N/m that oscillates in a probe at 2 Hz, 1 to 7 mm deep, an update (DRM 4) "
      "every {} ms: all in double",
      kStiffness, kUpdate);
  made.remark = "Location: float64 and geocentric on the wire; the last two rows show the reason.";
  struct Choice {
    std::string_view name;
    Round round;
  };
  for (const auto& [name, round] :
       {Choice{"double", as_it_is}, Choice{"as on the wire", as_on_the_wire},
        Choice{"fields of the wire only", with_wire_fields},
        Choice{"times to 1.68 us only", with_wire_time}, Choice{"times to 1 ms", with_milliseconds},
        Choice{"location float32, local", with_float_location},
        Choice{"location float32, geocentric", with_float_geocentric}}) {
    TouchSetting setting{std::string(name), {}, {}};
    Evaluator once(round, phase);
    for (std::size_t i = 0; i < kSteps; ++i) setting.forces.push_back(once.step(i));
    setting.run = [evaluator = Evaluator(round, phase),
                   at = std::size_t{0}](std::size_t steps) mutable {
      double sum = 0;
      for (std::size_t i = 0; i < steps; ++i, at = at + 1 == kSteps ? 0 : at + 1)
        sum += evaluator.step(at).x();
      return sum;
    };
    made.settings.push_back(std::move(setting));
  }
  made.force = made.settings.front().forces;
  return made;
}

}  // namespace reckon::bench
