// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Distance of the displayed entity from the truth, with an owner that sends by thresholds known to
// the viewer: at most the error of the prediction plus the curve's near_bound of it. Tested on
// rough motions and by a search for worse ones. All repeatable.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <deque>
#include <limits>
#include <vector>

#include "reckon/deadreckon/motion/convergence.hpp"
#include "reckon/deadreckon/motion/drm.hpp"
#include "reckon/deadreckon/motion/rotation.hpp"
#include "reckon/deadreckon/sending/update_policy.hpp"
#include "reckon/tests/deadreckon/support/oracle.hpp"

namespace reckon::deadreckon {
namespace {

using Algorithm = pdu::DeadReckoningAlgorithm;
using Eigen::Vector3d;
using test::Random;

constexpr double kTick = 1e-3;  // [s], interval of the owner's checks
constexpr std::array kModels{Algorithm::static_, Algorithm::fpw, Algorithm::rpw,
                             Algorithm::rvw,     Algorithm::fvw, Algorithm::fpb,
                             Algorithm::rpb,     Algorithm::rvb, Algorithm::fvb};

// Accelerations of an entity, applied in turn for equal times.
struct Push {
  Vector3d acceleration = Vector3d::Zero();  // [m/s^2]
  Vector3d spin = Vector3d::Zero();          // [rad/s^2]
};
struct Motion {
  std::vector<Push> pushes;
  int ticks = 1;            // duration of each push
  double fastest = 1;       // [m/s]; pushes beyond are omitted
  double fastest_turn = 1;  // [rad/s]
};

// The path of an entity under a motion.
class Body {
 public:
  void step(const Push& push, const Motion& motion) {
    const Vector3d faster = velocity + kTick * push.acceleration;
    acceleration = faster.norm() <= motion.fastest ? push.acceleration : Vector3d(-5 * velocity);
    const Vector3d spun = spin + kTick * push.spin;
    if (spun.norm() <= motion.fastest_turn) spin = spun;
    pose.position += kTick * velocity + 0.5 * kTick * kTick * acceleration;
    pose.orientation = (pose.orientation * exponential(kTick * spin)).normalized();
    velocity += kTick * acceleration;
  }
  [[nodiscard]] KinematicState told(Algorithm algorithm) const {
    KinematicState state;
    state.algorithm = algorithm;
    state.position = pose.position;
    state.orientation = pose.orientation;
    state.velocity = velocity;
    state.acceleration = acceleration;
    state.angular_velocity = spin;
    if (drm_terms(algorithm).body_axes) {
      const Eigen::Quaterniond to_body = pose.orientation.conjugate();
      state.velocity = to_body * velocity;
      state.acceleration = to_body * acceleration - spin.cross(state.velocity);
    }
    return state;
  }

  Pose pose;
  Vector3d velocity = Vector3d::Zero(), acceleration = Vector3d::Zero(), spin = Vector3d::Zero();
};

struct Setting {
  Algorithm algorithm = Algorithm::fpw;
  ConvergenceCurve curve = ConvergenceCurve::cubic;
  double threshold = 1e-3, angle = 0.05;
  bool known = true;  // whether the viewer knows the thresholds
  int delay = 0;      // [ticks]
  double loss = 0;
};

// The largest values of a run, position [m] and angle [rad].
struct Worst {
  double predicted = 0, shown = 0, step = 0;
  double predicted_angle = 0, shown_angle = 0;
  int updates = 0;
};

class Viewer {
 public:
  explicit Viewer(const Setting& setting) : convergence_(settings(setting)) {}

  void hear(const KinematicState& state, double sent, double now) {
    const Pose before = known_ ? shown(now) : Pose();
    state_ = state;
    sent_ = sent;
    if (known_) convergence_.restart(before, predicted(now), now);
    if (known_) step_ = std::max(step_, (shown(now).position - before.position).norm());
    known_ = true;
  }
  [[nodiscard]] bool known() const { return known_; }
  [[nodiscard]] Pose predicted(double now) const { return extrapolate(state_, now - sent_); }
  [[nodiscard]] Pose shown(double now) const { return convergence_.shown(predicted(now), now); }
  [[nodiscard]] double step() const { return step_; }

 private:
  static ConvergenceSettings settings(const Setting& setting) {
    ConvergenceSettings made;
    made.curve = setting.curve;
    made.teleport_distance = 1e9;  // nothing is teleported
    if (!setting.known) return made;
    made.threshold = setting.threshold;
    made.threshold_angle = setting.angle;
    return made;
  }

  PoseConvergence convergence_;
  KinematicState state_;
  double sent_ = 0, step_ = 0;
  bool known_ = false;
};

struct Packet {
  KinematicState state;
  double sent = 0;
  int arrival = 0;  // [ticks]
};

void look(const Viewer& viewer, const Pose& truth, double now, Worst& worst) {
  const Pose predicted = viewer.predicted(now), shown = viewer.shown(now);
  const auto raise = [](double& most, double value) { most = std::max(most, value); };
  raise(worst.predicted, (predicted.position - truth.position).norm());
  raise(worst.shown, (shown.position - truth.position).norm());
  raise(worst.predicted_angle, angle_between(predicted.orientation, truth.orientation));
  raise(worst.shown_angle, angle_between(shown.orientation, truth.orientation));
}

Worst run(const Motion& motion, const Setting& setting) {
  Thresholds thresholds;
  thresholds.position = setting.threshold;
  thresholds.angle = setting.angle;
  UpdatePolicy policy(thresholds, 5.0, 1.0);
  Viewer viewer(setting);
  Body body;
  Worst worst;
  Random random(7);
  std::deque<Packet> under_way;
  const int ticks = motion.ticks * static_cast<int>(motion.pushes.size());
  for (int i = 0; i < ticks; ++i) {
    const double now = i * kTick;
    if (viewer.known()) look(viewer, body.pose, now, worst);
    Pose truth = body.pose;
    truth.velocity = body.velocity;
    if (const SendReason reason = policy.decide(truth, now); reason != SendReason::none) {
      const KinematicState state = body.told(setting.algorithm);
      policy.sent(state, now, reason);
      if (random.real(0, 1) >= setting.loss) under_way.push_back({state, now, i + setting.delay});
      ++worst.updates;
    }
    for (; !under_way.empty() && under_way.front().arrival <= i; under_way.pop_front()) {
      viewer.hear(under_way.front().state, under_way.front().sent, now);
      look(viewer, body.pose, now, worst);
    }
    body.step(motion.pushes[static_cast<std::size_t>(i / motion.ticks)], motion);
  }
  worst.step = viewer.step();
  return worst;
}

// Random pushes, sometimes none. Gentle enough that the error of a prediction grows by less than
// half a threshold between two checks of the owner: beyond that it cannot keep the threshold.
Motion rough(Random& random, double hardest, double threshold, int ticks, double seconds,
             bool turns = false) {
  Motion motion;
  motion.ticks = ticks;
  motion.fastest = 0.4 * threshold / kTick;
  motion.fastest_turn = 10;
  const double most = std::min(hardest, threshold / (32 * kTick * kTick));
  motion.pushes.resize(static_cast<std::size_t>(seconds / kTick / ticks));
  for (Push& push : motion.pushes) {
    if (random.real(0, 1) < 0.3) continue;
    push.acceleration = most * random.direction();
    if (turns) push.spin = 100 * random.direction();
  }
  return motion;
}

double near_bound(ConvergenceCurve curve) {
  return kConvergenceCurves[static_cast<std::size_t>(curve)].near_bound;
}

// The guarantee: the prediction's error plus near_bound of it, and 1e-9 of it for rounding.
void expect_within(const Worst& worst, const Setting& setting) {
  ASSERT_LE(worst.predicted, 2 * setting.threshold) << "the owner does not keep it";
  ASSERT_LE(worst.predicted_angle, 2 * setting.angle);
  const double most = (1 + 1e-9) * (1 + near_bound(setting.curve));
  EXPECT_LE(worst.shown, most * std::max(worst.predicted, setting.threshold));
  EXPECT_LE(worst.shown_angle, most * std::max(worst.predicted_angle, setting.angle));
}

TEST(ShownWithin, HoldsForRoughMotions) {
  for (const ConvergenceCurveRow& row : kConvergenceCurves) {
    double most = 0;
    for (const Algorithm algorithm : kModels) {
      for (const double threshold : {1e-4, 1e-3, 1e-2, 1.0}) {
        for (const double hardest : {0.1, 1.0, 10.0, 100.0}) {
          for (const int ticks : {1, 10, 100})
            for (const bool turns : {false, true}) {
              SCOPED_TRACE(testing::Message()
                           << row.name << " DRM " << static_cast<int>(algorithm) << ' ' << threshold
                           << " m " << hardest << ' ' << ticks);
              Random random(static_cast<unsigned>(ticks));
              const Motion motion = rough(random, hardest, threshold, ticks, 1, turns);
              const Setting setting{algorithm, row.curve, threshold};
              const Worst worst = run(motion, setting);
              expect_within(worst, setting);
              if (HasFailure()) return;
              most = std::max(most, worst.shown / threshold);
            }
        }
      }
    }
    std::printf("%-10s shown within %.2f thresholds\n", row.name.data(), most);
  }
}

// Changes one push after the other and keeps changes that make the result worse.
Worst search(Motion motion, const Setting& setting, Random& random, int tries) {
  const auto badness = [&](const Worst& worst) {
    return worst.shown / std::max(worst.predicted, setting.threshold);
  };
  const double hardest = [&] {
    double most = 0;
    for (const Push& push : motion.pushes) most = std::max(most, push.acceleration.norm());
    return most;
  }();
  Worst worst = run(motion, setting);
  for (int i = 0; i < tries; ++i) {
    Motion other = motion;
    const auto place =
        static_cast<std::size_t>(random.real(0, static_cast<double>(other.pushes.size()) - 1e-6));
    const std::size_t end =
        std::min(place + 1 + static_cast<std::size_t>(random.real(0, 6)), other.pushes.size());
    Vector3d push(random.real(0, 1) < 0.5 ? hardest : -hardest, 0, 0);
    if (random.real(0, 1) < 0.2) push.setZero();
    for (std::size_t k = place; k < end; ++k) other.pushes[k] = {push, Vector3d::Zero()};
    const Worst next = run(other, setting);
    if (next.predicted > 2 * setting.threshold || badness(next) < badness(worst)) continue;
    worst = next;
    motion = other;
  }
  return worst;
}

TEST(ShownWithin, HoldsForASearchOfWorseMotions) {
  double unknown = 0;
  for (const ConvergenceCurveRow& row : kConvergenceCurves) {
    double most = 0;
    for (const Algorithm algorithm : {Algorithm::static_, Algorithm::fpw, Algorithm::rvw}) {
      for (const double hardest : {1.0, 10.0, 30.0}) {
        for (const int ticks : {1, 10}) {
          SCOPED_TRACE(testing::Message() << row.name << " DRM " << static_cast<int>(algorithm)
                                          << ' ' << hardest << ' ' << ticks);
          Random random(static_cast<unsigned>(ticks));
          const Motion motion = rough(random, hardest, 1e-3, ticks, 0.4);
          Setting setting{algorithm, row.curve};
          const Worst worst = search(motion, setting, random, 120);
          expect_within(worst, setting);
          most = std::max(most, worst.shown / setting.threshold);
          setting.known = false;
          if (row.curve == ConvergenceCurve::cubic) {
            unknown = std::max(unknown, search(motion, setting, random, 40).shown / 1e-3);
          }
        }
      }
    }
    std::printf("%-10s shown within %.2f thresholds\n", row.name.data(), most);
  }
  std::printf("cubic, threshold not known: %.2f thresholds\n", unknown);
  EXPECT_GT(unknown, 3) << "the search finds nothing any more";
}

// The error of the prediction grows until an update arrives. The rest is as above, but an update
// moves the prediction by its old error plus its new error.
TEST(ShownWithin, HoldsUnderADelay) {
  for (const ConvergenceCurveRow& row : kConvergenceCurves) {
    for (const int delay : {5, 20, 80}) {
      for (unsigned seed = 1; seed <= 10; ++seed) {
        SCOPED_TRACE(testing::Message() << row.name << ' ' << delay << " ms " << seed);
        Random random(seed);
        const double hardest = 0.05 / (1e-3 * delay);  // the error grows by less than 0.5 mm
        const Motion motion = rough(random, 0.2 * hardest, 1e-3, 50, 4);
        Setting setting{Algorithm::fpw, row.curve};
        setting.delay = delay;
        const Worst worst = run(motion, setting);
        EXPECT_LE(worst.shown, (1 + 2 * near_bound(row.curve)) * worst.predicted);
      }
    }
  }
}

// With lost updates an error may last; the displayed pose still continues without a step.
TEST(ShownWithin, RecoversFromLossWithoutAStep) {
  for (const ConvergenceCurveRow& row : kConvergenceCurves) {
    if (row.continuity < 0) continue;
    for (unsigned seed = 1; seed <= 20; ++seed) {
      Random random(seed);
      const Motion motion = rough(random, 0.5, 1e-3, 50, 8);
      Setting setting{Algorithm::fpw, row.curve};
      setting.loss = 0.3;
      const Worst lossy = run(motion, setting);
      EXPECT_LE(lossy.step, 2e-3 + 1e-9) << row.name << ' ' << seed;
      EXPECT_GT(lossy.predicted, 2e-3);
    }
  }
}

}  // namespace
}  // namespace reckon::deadreckon
