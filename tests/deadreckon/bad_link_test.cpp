// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// An owner, a link with delay, loss, duplicates and reordering, and a viewer that takes the newest
// update and lets the error converge: updates from 0.2 Hz to 1 kHz. All repeatable.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <vector>

#include "reckon/deadreckon/motion/convergence.hpp"
#include "reckon/deadreckon/motion/drm.hpp"
#include "reckon/deadreckon/motion/rotation.hpp"
#include "reckon/deadreckon/sending/update_policy.hpp"
#include "reckon/tests/deadreckon/support/oracle.hpp"

namespace reckon::deadreckon::bad_link_test {
namespace {

using Eigen::Vector3d;
using test::Random;

constexpr double kTick = 1e-3;  // [s]
constexpr double kRun = 60;     // [s]
constexpr double kStops = 45;   // the entity stops here

// A weave of 5 m at 0.8 rad/s along x at 20 m/s, with a sway of 0.5 rad.
constexpr double kJerk = 5 * 0.8 * 0.8 * 0.8;          // at most [m/s^3]
constexpr double kTurnAcceleration = 0.5 * 0.6 * 0.6;  // at most [rad/s^2]
constexpr double kRounding = 1e-4;                     // [m] float32 velocity times age

Vector3d as_floats(const Vector3d& v) { return v.cast<float>().cast<double>(); }

// The owner's state at `t`; velocity and acceleration with the rounding of the wire.
KinematicState weave(double t) {
  KinematicState s;
  s.algorithm = pdu::DeadReckoningAlgorithm::rvw;
  s.position = {20 * t, 5 * std::sin(0.8 * t), 0};
  s.velocity = as_floats({20, 4 * std::cos(0.8 * t), 0});
  s.acceleration = as_floats({0, -3.2 * std::sin(0.8 * t), 0});
  s.orientation = exponential({0, 0, 0.5 * std::sin(0.6 * t)});
  s.angular_velocity = as_floats({0, 0, 0.3 * std::cos(0.6 * t)});
  return s;
}

KinematicState standing() {
  KinematicState s = weave(kStops);
  s.velocity.setZero();
  s.acceleration.setZero();
  s.angular_velocity.setZero();
  return s;
}

KinematicState owner_at(double t) { return t < kStops ? weave(t) : standing(); }

struct Packet {
  double arrival, sent;
  KinematicState state;
};

struct LinkLaw {
  double delay = 0.08, jitter = 0.06;  // [s]: 20 to 140 ms, so packets overtake each other
  double loss = 0, doubles = 0;
};

class Link {
 public:
  explicit Link(const LinkLaw& law) : law_(law) {}

  void send(const KinematicState& state, double now) {
    const bool lost = random_.real(0, 1) < law_.loss;
    lost_in_a_row_ = lost ? lost_in_a_row_ + 1 : 0;
    longest_loss_ = std::max(longest_loss_, lost_in_a_row_);
    if (lost) return;
    const int copies = random_.real(0, 1) < law_.doubles ? 2 : 1;
    for (int i = 0; i < copies; ++i) {
      const double delay = law_.delay + random_.real(-law_.jitter, law_.jitter);
      under_way_.push_back({now + delay, now, state});
    }
  }
  // Packets that arrive by `now`, in the order of arrival.
  std::vector<Packet> receive(double now) {
    const auto split = std::partition(under_way_.begin(), under_way_.end(),
                                      [&](const Packet& p) { return p.arrival > now; });
    std::vector<Packet> arrived(split, under_way_.end());
    under_way_.erase(split, under_way_.end());
    std::sort(arrived.begin(), arrived.end(),
              [](const Packet& a, const Packet& b) { return a.arrival < b.arrival; });
    return arrived;
  }
  [[nodiscard]] int longest_loss() const { return longest_loss_; }
  [[nodiscard]] double longest_delay() const { return law_.delay + law_.jitter; }

 private:
  LinkLaw law_;
  Random random_{11};
  std::vector<Packet> under_way_;
  int lost_in_a_row_ = 0, longest_loss_ = 0;
};

// Takes the newest update only, and compares the displayed pose with the bounds of its curve.
class Viewer {
 public:
  explicit Viewer(const ConvergenceCurveRow& row) : row_(row), convergence_(settings(row)) {}

  void hear(const Packet& packet, double now) {
    if (known_ && packet.sent <= sent_) {
      ++passed_over_;
      return;
    }
    const Pose shown = known_ ? this->shown(now) : extrapolate(packet.state, now - packet.sent);
    carried_ = acceleration_under_way(now);
    state_ = packet.state;
    sent_ = packet.sent;
    known_ = true;
    const Pose after = predicted(now);
    convergence_.restart(shown, after, now);
    error_ = (shown.position - after.position).norm();
    rate_ = (shown.velocity - after.velocity).norm();
    if (row_.continuity >= 0) {
      ASSERT_LE((this->shown(now).position - shown.position).norm(), 1e-9) << row_.name;
    }
    if (row_.continuity >= 1) {
      ASSERT_LE((this->shown(now).velocity - shown.velocity).norm(), 1e-9) << row_.name;
    }
  }

  [[nodiscard]] bool known() const { return known_; }
  [[nodiscard]] double age(double now) const { return now - sent_; }
  [[nodiscard]] Pose predicted(double now) const { return extrapolate(state_, now - sent_); }
  [[nodiscard]] Pose shown(double now) const { return convergence_.shown(predicted(now), now); }
  [[nodiscard]] int passed_over() const { return passed_over_; }
  // Largest permitted distance of the curve from the prediction, and largest speed of its approach.
  [[nodiscard]] double farthest() const {
    return row_.error_bound * error_ + row_.rate_bound * rate_ * convergence_.duration() +
           0.0174 * carried_ * convergence_.duration() * convergence_.duration();
  }
  [[nodiscard]] double fastest() const {
    return row_.speed_error * error_ / convergence_.duration() + row_.speed_rate * rate_ +
           0.068 * carried_ * convergence_.duration();
  }

 private:
  // Of the decaying error, which the quintic continues. [m/s^2]
  [[nodiscard]] double acceleration_under_way(double now) const {
    if (row_.continuity < 2 || !convergence_.converging(now)) return 0;
    constexpr double h = 1e-6;
    const auto rate = [&](double t) -> Vector3d {
      return shown(t).velocity - predicted(t).velocity;
    };
    return (rate(now) - rate(now - h)).norm() / h * 1.01;  // to first order in h
  }
  static ConvergenceSettings settings(const ConvergenceCurveRow& row) {
    ConvergenceSettings made;
    made.curve = row.curve;
    made.teleport_distance = 1e6;  // nothing here is teleported
    return made;
  }

  const ConvergenceCurveRow& row_;
  PoseConvergence convergence_;
  KinematicState state_;
  double sent_ = 0;
  bool known_ = false;
  double error_ = 0, rate_ = 0, carried_ = 0;
  int passed_over_ = 0;
};

struct Seen {
  double worst_predicted = 0, worst_shown = 0;  // [m], while the entity moves
  double at_rest = 0;                           // [m], shown, in the last second
  double oldest = 0;                            // [s], age of the newest update
  int passed_over = 0;
};

// No jump: the step is at most the prediction's own plus the approach permitted by the curve.
void check_way(const Viewer& viewer, const Pose& before, double now) {
  const double speed = std::max(viewer.predicted(now).velocity.norm(),
                                viewer.predicted(now - kTick).velocity.norm());
  const double way = (viewer.shown(now).position - before.position).norm();
  ASSERT_LE(way, (speed + viewer.fastest()) * kTick + 1e-9) << now;
}

// Invariants at every instant, whatever the link does.
void check(const Viewer& viewer, double now, Seen& seen) {
  const KinematicState truth = owner_at(now);
  const Pose predicted = viewer.predicted(now), shown = viewer.shown(now);
  ASSERT_TRUE(is_finite(predicted) && is_finite(shown)) << now;
  const double age = viewer.age(now);
  const double off = (predicted.position - truth.position).norm();
  const double shown_off = (shown.position - truth.position).norm();
  ASSERT_LE(shown_off, off + viewer.farthest() + 1e-9) << now;
  seen.oldest = std::max(seen.oldest, age);
  if (now > kRun - 1) seen.at_rest = std::max(seen.at_rest, shown_off);
  if (now >= kStops) return;
  ASSERT_LE(off, kJerk * age * age * age / 6 + kRounding) << now;
  ASSERT_LE(angle_between(predicted.orientation, truth.orientation),
            0.5 * kTurnAcceleration * age * age + kRounding)
      << now;
  seen.worst_predicted = std::max(seen.worst_predicted, off);
  seen.worst_shown = std::max(seen.worst_shown, shown_off);
}

// `send(now)` is the update of this tick, if any.
template <typename Send>
Seen run(const ConvergenceCurveRow& row, Link& link, Send&& send) {
  Viewer viewer(row);
  Seen seen;
  Pose before;
  for (int i = 0; i * kTick < kRun && !testing::Test::HasFatalFailure(); ++i) {
    const double now = i * kTick;
    if (const std::optional<KinematicState> update = send(now)) link.send(*update, now);
    if (viewer.known()) check_way(viewer, before, now);
    for (const Packet& packet : link.receive(now)) viewer.hear(packet, now);
    if (!viewer.known()) continue;
    check(viewer, now, seen);
    before = viewer.shown(now);
  }
  seen.passed_over = viewer.passed_over();
  return seen;
}

auto periodic(double rate) {
  return [due = 0.0, rate](double now) mutable -> std::optional<KinematicState> {
    if (now < due - 1e-9) return std::nullopt;
    due += 1 / rate;
    return owner_at(now);
  };
}

// The owner's policy; counts its updates.
class Owner {
 public:
  Owner(double threshold, double heartbeat) : policy_(thresholds(threshold), heartbeat) {}

  std::optional<KinematicState> operator()(double now) {
    const KinematicState state = owner_at(now);
    const SendReason reason = policy_.decide(extrapolate(state, 0), now);
    if (reason == SendReason::none) return std::nullopt;
    policy_.sent(state, now, reason);
    ++updates_;
    return state;
  }
  [[nodiscard]] int updates() const { return updates_; }

 private:
  static Thresholds thresholds(double position) {
    Thresholds made;
    made.position = position;
    return made;
  }
  UpdatePolicy policy_;
  int updates_ = 0;
};

TEST(BadLink, UpdatesAtAnyRateStayWithinBounds) {
  for (const double rate : {0.2, 1.0, 5.0, 20.0, 100.0, 1000.0}) {
    for (const double loss : {0.0, 0.3}) {
      for (const ConvergenceCurveRow& row : kConvergenceCurves) {
        SCOPED_TRACE(testing::Message() << rate << " Hz, loss " << loss << ", " << row.name);
        LinkLaw law;
        law.loss = loss;
        law.doubles = 0.1;
        Link link(law);
        const Seen seen = run(row, link, periodic(rate));
        if (HasFatalFailure()) return;
        EXPECT_LE(seen.oldest, (link.longest_loss() + 1) / rate + link.longest_delay() + 2 * kTick);
        if (rate >= 1) {
          EXPECT_GT(seen.passed_over, 0);
        }
        if (row.curve == ConvergenceCurve::cubic)
          std::printf("%6.1f Hz, loss %.1f: predicted within %.4f m, shown within %.4f m\n", rate,
                      loss, seen.worst_predicted, seen.worst_shown);
      }
    }
  }
}

TEST(BadLink, WithoutLossOnlyDelayExceedsTheThreshold) {
  constexpr double threshold = 0.1, heartbeat = 2;
  for (const ConvergenceCurveRow& row : kConvergenceCurves) {
    SCOPED_TRACE(row.name);
    Link link({});
    Owner owner(threshold, heartbeat);
    const Seen seen = run(row, link, owner);
    if (HasFatalFailure()) return;
    // The owner detects the crossing within a tick. Until the update arrives the error grows by at
    // most the speed that the jerk has built up since the old update.
    const double growth = 0.5 * kJerk * seen.oldest * seen.oldest;
    EXPECT_LE(seen.worst_predicted, threshold + growth * (link.longest_delay() + 2 * kTick));
    EXPECT_LE(seen.at_rest, 1e-3);
    EXPECT_LT(owner.updates(), 150);
    std::printf("%s: %d updates, predicted within %.3f m, shown within %.3f m\n", row.name.data(),
                owner.updates(), seen.worst_predicted, seen.worst_shown);
  }
}

TEST(BadLink, WithLossAgeIsBoundedByLostHeartbeats) {
  constexpr double threshold = 0.1, heartbeat = 2;
  for (const ConvergenceCurveRow& row : kConvergenceCurves) {
    SCOPED_TRACE(row.name);
    LinkLaw law;
    law.loss = 0.3;
    law.doubles = 0.1;
    Link link(law);
    Owner owner(threshold, heartbeat);
    const Seen seen = run(row, link, owner);
    if (HasFatalFailure()) return;
    const double silence = (link.longest_loss() + 1) * (heartbeat + 2 * kTick);
    EXPECT_LE(seen.oldest, silence + link.longest_delay());
    // It stops at kStops; a heartbeat repairs a missed update.
    ASSERT_LE(kStops + silence + link.longest_delay() + 0.5, kRun - 1);
    EXPECT_LE(seen.at_rest, 1e-3);
    std::printf("%s: %d updates, up to %d lost in a row, predicted within %.3f m, shown %.3f m\n",
                row.name.data(), owner.updates(), link.longest_loss(), seen.worst_predicted,
                seen.worst_shown);
  }
}

TEST(BadLink, DuplicateAndStaleUpdatesChangeNoBit) {
  for (const ConvergenceCurveRow& row : kConvergenceCurves) {
    Viewer clean(row), disturbed(row);
    for (int i = 0; i < 500; ++i) {
      const double sent = 0.2 * i, now = sent + 0.05;
      const Packet packet{now, sent, weave(sent)};
      const Packet late{now, sent - 0.1, weave(sent - 0.1)};
      clean.hear(packet, now);
      disturbed.hear(packet, now);
      disturbed.hear(packet, now);
      disturbed.hear(late, now + 0.01);
      disturbed.hear(packet, now + 0.02);
      const Pose a = clean.shown(now + 0.03), b = disturbed.shown(now + 0.03);
      ASSERT_EQ(a.position, b.position) << row.name;
      ASSERT_EQ(a.velocity, b.velocity) << row.name;
      ASSERT_EQ(a.orientation.coeffs(), b.orientation.coeffs()) << row.name;
    }
    EXPECT_EQ(disturbed.passed_over(), 1500);
  }
}

// Each update restarts the curve; a thousand a second must not keep the error from decaying.
TEST(BadLink, ErrorDecaysAtAThousandUpdatesASecond) {
  for (const ConvergenceCurveRow& row : kConvergenceCurves) {
    Viewer viewer(row);
    KinematicState wrong = weave(0);
    wrong.position.y() += 1;
    viewer.hear({0, -kTick, wrong}, 0);
    const double enough = 2 * ConvergenceSettings().longest;
    double left = 1, worst = 0;
    for (int i = 0; i * kTick < enough; ++i) {
      const double now = i * kTick;
      viewer.hear({now, now, weave(now)}, now);
      left = (viewer.shown(now).position - weave(now).position).norm();
      worst = std::max(worst, left);
    }
    std::printf("%s: of 1 m %.5f m are left after %.1f s, never more than %.3f m\n",
                row.name.data(), left, enough, worst);
    EXPECT_LE(left, 0.01);
    EXPECT_LE(worst, 1.05);
  }
}

}  // namespace
}  // namespace reckon::deadreckon::bad_link_test
