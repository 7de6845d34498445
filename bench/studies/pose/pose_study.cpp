// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/pose/pose_study.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "reckon/bench/statistics/quantile.hpp"
#include "reckon/deadreckon/extrapolators/adaptive_order.hpp"
#include "reckon/deadreckon/motion/acceleration_trust.hpp"
#include "reckon/deadreckon/motion/rotation.hpp"
#include "reckon/deadreckon/sending/model_choice.hpp"
#include "reckon/deadreckon/sending/update_policy.hpp"
#include "reckon/deadreckon/wire_conversion.hpp"
#include "reckon/pdu/seconds.hpp"

namespace reckon::bench {
namespace {

using deadreckon::KinematicState;
using deadreckon::MotionSample;
using deadreckon::Pose;
using deadreckon::SendReason;
using Eigen::Vector3d;

struct Update {
  double sent = 0, arrival = 0;  // [s]
  KinematicState state;
};

/// Decides and sends for one entity.
class Owner {
 public:
  Owner(const PoseSetting& setting, std::size_t index)
      : setting_(setting), policy_(policy_of(setting, index)) {}

  /// The state to send at this sample, as peers decode it, or no value.
  std::optional<KinematicState> step(const MotionSample& truth) {
    if (!setting_.model) choice_.note(truth, setting_.thresholds, *setting_.rule);
    if (looked_) policy_.look_again_after(truth.time - *looked_);
    looked_ = truth.time;
    const SendReason reason = reason_to_send(truth);
    if (reason == SendReason::none) return std::nullopt;
    const KinematicState state =
        as_received(kinematic_state(truth, setting_.model.value_or(choice_.chosen())));
    policy_.sent(state, truth.time, reason);
    last_ = truth.time;
    return state;
  }

 private:
  static deadreckon::UpdatePolicy policy_of(const PoseSetting& setting, std::size_t index) {
    const double heartbeat = deadreckon::jittered_heartbeat(
        setting.heartbeat, {1, 1, static_cast<std::uint16_t>(index & 0xFFFF)});
    if (setting.first_heartbeat > 0)
      return {setting.thresholds, heartbeat, setting.first_heartbeat, *setting.rule};
    const double steady = std::min(heartbeat, setting.heartbeat);
    return {setting.thresholds, steady, steady, *setting.rule};
  }

  SendReason reason_to_send(const MotionSample& truth) const {
    // Half a nanosecond, so that rounding of the sample times does not skip a period.
    if (setting_.period > 0) {
      const bool due = !last_ || truth.time - *last_ >= setting_.period - 5e-10;
      return due ? SendReason::heartbeat : SendReason::none;
    }
    const Pose pose{truth.position, truth.orientation, truth.velocity, truth.angular_velocity};
    return policy_.decide(pose, truth.time);
  }

  // Conversion to the wire's floats and Euler angles and back.
  static KinematicState as_received(const KinematicState& state) {
    static const deadreckon::LocalFrame frame({0.8, 0.1, 0.0});
    pdu::EntityState wire;
    KinematicState received;
    if (to_wire(state, frame, wire) != deadreckon::ConversionError::none ||
        from_wire(wire, frame, received) != deadreckon::ConversionError::none)
      return state;
    return received;
  }

  const PoseSetting& setting_;
  deadreckon::UpdatePolicy policy_;
  deadreckon::ModelChoice choice_;
  std::optional<double> last_;    // time of the last update [s]
  std::optional<double> looked_;  // time of the last check [s]
};

/// Shows one entity from the updates that arrive.
class Viewer {
 public:
  explicit Viewer(const PoseSetting& setting)
      : prediction_(setting.prediction), convergence_(convergence_of(setting)) {}

  void take(const Update& update) {
    if (known_ && update.sent <= newest_.sent) return;
    const Pose before = known_ ? shown(update.arrival) : Pose{};
    const deadreckon::MotionSample sample = motion_sample(update.state, update.sent);
    if (known_)
      order_.add(sample, told(update.sent));
    else
      order_.add(sample);
    newest_ = update;
    if (known_) convergence_.restart(before, predicted(update.arrival), update.arrival);
    known_ = true;
  }
  [[nodiscard]] bool known() const { return known_; }
  [[nodiscard]] Pose shown(double now) const { return convergence_.shown(predicted(now), now); }

 private:
  static deadreckon::ConvergenceSettings convergence_of(const PoseSetting& setting) {
    deadreckon::ConvergenceSettings settings = setting.convergence;
    if (setting.period > 0) return settings;
    settings.threshold = setting.thresholds.position;
    settings.threshold_angle = setting.thresholds.angle;
    return settings;
  }
  [[nodiscard]] Pose predicted(double now) const {
    return prediction_ == Prediction::adaptive ? order_.predict_near(told(now), now - newest_.sent)
                                               : told(now);
  }
  [[nodiscard]] Pose told(double now) const {
    return deadreckon::extrapolate_trusted(newest_.state, now - newest_.sent);
  }

  Prediction prediction_;
  deadreckon::PoseConvergence convergence_;
  deadreckon::AdaptiveOrder order_;
  Update newest_;
  bool known_ = false;
};

/// All errors of a run.
struct Errors {
  std::vector<double> position, angle, velocity_step;
};

/// Stores what a viewer draws, sample by sample.
class Drawing {
 public:
  explicit Drawing(Errors& errors) : errors_(errors) {}

  /// Returns the drawn speed, from the second sample on.
  std::optional<double> note(const MotionSample& truth, const Pose& shown) {
    errors_.position.push_back((shown.position - truth.position).norm());
    errors_.angle.push_back(deadreckon::angle_between(shown.orientation, truth.orientation));
    std::optional<double> speed;
    if (drawn_ > 0) {
      const Vector3d velocity = (shown.position - last_) / (truth.time - last_time_);
      speed = velocity.norm();
      if (drawn_ > 1) errors_.velocity_step.push_back((velocity - velocity_).norm());
      velocity_ = velocity;
    }
    last_ = shown.position;
    last_time_ = truth.time;
    ++drawn_;
    return speed;
  }

 private:
  Errors& errors_;
  Vector3d last_ = Vector3d::Zero();
  Vector3d velocity_ = Vector3d::Zero();
  double last_time_ = 0;
  std::size_t drawn_ = 0;
};

/// One entity from its owner to a viewer.
class Run {
 public:
  Run(std::size_t index, const PoseSetting& setting, const peer::Impairment& network,
      PoseResult& result, Errors& errors, const PoseObserver& observer)
      : index_(index),
        owner_(setting, index),
        viewer_(setting),
        network_(network),
        errors_(errors),
        drawing_(errors),
        result_(result),
        observer_(observer) {}

  void step(const MotionSample& truth) {
    receive(truth.time);
    if (!viewer_.known()) return send(truth);
    const Pose shown = viewer_.shown(truth.time);
    const std::optional<double> speed = drawing_.note(truth, shown);
    send(truth);
    if (observer_)
      observer_({index_, truth, shown, errors_.position.back(), errors_.angle.back(), speed, sent_,
                 lost_, arrived_});
  }

 private:
  void receive(double now) {
    const auto later = [](const Update& a, const Update& b) { return a.arrival > b.arrival; };
    std::sort(under_way_.begin(), under_way_.end(), later);
    for (; !under_way_.empty() && under_way_.back().arrival <= now; under_way_.pop_back()) {
      viewer_.take(under_way_.back());
      ++arrived_;
    }
  }

  void send(const MotionSample& truth) {
    const std::optional<KinematicState> state = owner_.step(truth);
    if (!state) return;
    const peer::Fate fate = network_.decide(index_, sent_++, pdu::from_seconds(truth.time));
    ++result_.updates;
    ++result_.by_model[static_cast<std::size_t>(state->algorithm)];
    if (fate.copies == 0) ++lost_;
    for (std::size_t copy = 0; copy < fate.copies; ++copy)
      under_way_.push_back({truth.time, truth.time + pdu::to_seconds(fate.delay[copy]), *state});
  }

  std::size_t index_;
  Owner owner_;
  Viewer viewer_;
  const peer::Impairment& network_;
  Errors& errors_;
  Drawing drawing_;
  PoseResult& result_;
  const PoseObserver& observer_;
  std::vector<Update> under_way_;
  std::uint64_t sent_ = 0, lost_ = 0, arrived_ = 0;
};

}  // namespace

ErrorSize size_of(std::vector<double>& errors) {
  ErrorSize size;
  if (errors.empty()) return size;
  double squares = 0;
  for (const double error : errors) squares += error * error;
  size.rms = std::sqrt(squares / static_cast<double>(errors.size()));
  size.p99 = quantile(errors, 0.99);
  size.max = *std::max_element(errors.begin(), errors.end());
  return size;
}

PoseResult run_pose_study(std::span<const Track> tracks, const PoseSetting& setting,
                          const peer::ImpairmentConfig& network, const PoseObserver& observer) {
  const peer::Impairment impairment(network.law, network.seed);
  PoseResult result;
  Errors errors;
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    const auto& samples = tracks[i].samples;
    Run run(i, setting, impairment, result, errors, observer);
    for (const MotionSample& truth : samples) run.step(truth);
    if (!samples.empty()) result.entity_seconds += samples.back().time - samples.front().time;
  }
  result.samples = errors.position.size();
  result.position = size_of(errors.position);
  result.angle = size_of(errors.angle);
  result.velocity_step = size_of(errors.velocity_step);
  return result;
}

}  // namespace reckon::bench
