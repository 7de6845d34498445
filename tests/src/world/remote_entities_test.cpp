// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Updates of other peers: how they are read, shown and forgotten.
#include "reckon/peer/world/remote_entities.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <string_view>

#include "reckon/pdu/seconds.hpp"
#include "reckon/tests/src/support/incoming_half.hpp"
#include "reckon/tests/support/allocation_guard.hpp"

namespace reckon::peer::remote_entities_test {
namespace {

using deadreckon::AccelerationReading;
using deadreckon::KinematicState;
using deadreckon::Pose;
using Algorithm = pdu::DeadReckoningAlgorithm;
using Eigen::Vector3d;
using std::chrono::nanoseconds;

constexpr pdu::EntityId kOther{7, 8, 9};
constexpr pdu::EntityType kTank{pdu::EntityKind::platform, pdu::EntityDomain::land};
constexpr pdu::EntityType kPlane{pdu::EntityKind::platform, pdu::EntityDomain::air};

// The incoming half of a peer in a world of 100 km; the test sets the time.
class Receiver {
 public:
  explicit Receiver(const std::string& sections = "")
      : half_("[aoim]\nradius = \"100 km\"\ncell = \"10 km\"\n" + sections,
              [](const SceneFile& scene) -> RemoteSettings {
                return {scene.hand.radius, scene.convergence, scene.dead_reckoning.acceleration};
              }) {}

  // An update that is true `seconds` after the start and arrives at that time.
  void hear(const KinematicState& state, double seconds, std::uint32_t appearance = 0,
            const pdu::EntityType& type = kTank, AccelerationReading wire = {}) {
    Inbound update;
    update.has_model = haptic;
    update.model = model;
    update.state.entity_type = type;
    const nanoseconds at = pdu::from_seconds(seconds);
    half_.put_state(update, kOther, state, at, wire);
    update.state.appearance = appearance;
    half_.take(update, at);
  }
  [[nodiscard]] const RemoteEntity& row() {
    const RemoteEntity* found = half_.remote.find(kOther);
    EXPECT_NE(found, nullptr);
    static const RemoteEntity kNone;
    return found == nullptr ? kNone : *found;
  }
  [[nodiscard]] Pose shown(double seconds) { return row().shown(pdu::from_seconds(seconds)); }
  [[nodiscard]] Pose predicted(double seconds) {
    return row().predicted(pdu::from_seconds(seconds));
  }
  // Whether the entity is still present after `silence` seconds.
  [[nodiscard]] bool survives(double silence) {
    half_.remote.expire(row().last_heard + pdu::from_seconds(silence));
    return half_.remote.find(kOther) != nullptr;
  }
  [[nodiscard]] std::uint64_t count(std::string_view name) const { return half_.count(name); }

  void doubt(double seconds) { half_.remote.doubt(kOther, pdu::from_seconds(seconds)); }
  void believe(double seconds) {
    const nanoseconds now = pdu::from_seconds(seconds);
    half_.remote.believe_peer(0, now, now);
  }

  bool haptic = false;
  pdu::HapticRecord model;
  [[nodiscard]] pdu::EntityId last_refused() { return half_.remote.last_refused(); }

 private:
  test::IncomingHalf half_;
};

KinematicState state_of(Algorithm algorithm, const Vector3d& position, const Vector3d& velocity) {
  KinematicState state;
  state.algorithm = algorithm;
  state.position = position;
  state.velocity = velocity;
  return state;
}

double gap(const Pose& a, const Pose& b) { return (a.position - b.position).norm(); }

// --- the two readings of the acceleration of RVB

constexpr double kRadius = 100, kSpeed = 20, kTurn = kSpeed / kRadius;

// A steady turn about the z axis of S at t = 0: nose along x, centre at (0, 100, 0).
KinematicState steady_turn() {
  KinematicState state = state_of(Algorithm::rvb, {0, 0, 0}, {kSpeed, 0, 0});
  state.angular_velocity = {0, 0, kTurn};
  return state;
}

// Greatest distance from the exact circle over 20 s, two thirds of a turn [m].
double worst_from_circle(Receiver& receiver) {
  double worst = 0;
  for (double t = 0; t <= 20; t += 0.5) {
    const double angle = kTurn * t;
    const Vector3d on_circle(kRadius * std::sin(angle), kRadius * (1 - std::cos(angle)), 0);
    worst = std::max(worst, (receiver.predicted(1 + t).position - on_circle).norm());
  }
  return worst;
}

TEST(AccelerationReadings, InertialReadingShowsSteadyTurnsAsCircles) {
  Receiver receiver("[dead_reckoning]\nacceleration = \"inertial\"\n");
  receiver.hear(steady_turn(), 1, 0, kTank, AccelerationReading::inertial);
  EXPECT_LE(worst_from_circle(receiver), 1e-4);  // float32 rates over 20 s
}

TEST(AccelerationReadings, ComponentReadingShowsSteadyTurnsAsCircles) {
  Receiver receiver;
  receiver.hear(steady_turn(), 1);
  EXPECT_LE(worst_from_circle(receiver), 1e-4);
}

TEST(AccelerationReadings, MatterWherePeersDoNotAgree) {
  Receiver receiver;
  receiver.hear(steady_turn(), 1, 0, kTank, AccelerationReading::inertial);
  EXPECT_GT(worst_from_circle(receiver), 100);
}

// --- shown poses

TEST(RemoteEntities, ShowATeleportAtOnceWithoutOldHistory) {
  Receiver receiver("[convergence]\nprediction = \"adaptive\"\nteleport_distance = \"5 m\"\n");
  for (int i = 0; i < 4; ++i) {
    receiver.hear(state_of(Algorithm::fpw, {0.1 * i, 0, 0}, {1, 0, 0}), 1 + 0.1 * i);
  }
  EXPECT_EQ(receiver.row().order->history().size(), 3U);
  EXPECT_EQ(receiver.count("snaps"), 0U);

  receiver.hear(state_of(Algorithm::fpw, {20, 0, 0}, {1, 0, 0}), 1.4);
  EXPECT_EQ(receiver.row().order->history().size(), 1U);
  EXPECT_EQ(receiver.count("snaps"), 1U);
  for (const double t : {1.4, 1.45, 1.6}) {
    EXPECT_LE((receiver.shown(t).position - Vector3d(20 + t - 1.4, 0, 0)).norm(), 1e-5) << t;
  }
}

TEST(RemoteEntities, ConvergeToStatesNearerThanATeleport) {
  Receiver receiver(
      "[convergence]\nteleport_distance = \"5 m\"\nduration = \"200 ms\"\n"
      "longest = \"200 ms\"\n");
  receiver.hear(state_of(Algorithm::fpw, {0, 0, 0}, {1, 0, 0}), 1);
  const Pose before = receiver.shown(2);
  receiver.hear(state_of(Algorithm::fpw, {5, 0, 0}, {1, 0, 0}), 2);
  EXPECT_LE(gap(receiver.shown(2), before), 1e-9);
  EXPECT_GT(gap(receiver.shown(2.15), receiver.predicted(2.15)), 0.1);
  EXPECT_LE(gap(receiver.shown(2.2), receiver.predicted(2.2)), 1e-9);
  EXPECT_EQ(receiver.count("snaps"), 0U);
}

TEST(RemoteEntities, HaveTheCurveOfTheScene) {
  Receiver receiver("[convergence]\ncurve = \"snap\"\n");
  receiver.hear(state_of(Algorithm::fpw, {0, 0, 0}, {1, 0, 0}), 1);
  receiver.hear(state_of(Algorithm::fpw, {3, 0, 0}, {1, 0, 0}), 2);
  EXPECT_LE(gap(receiver.shown(2), receiver.predicted(2)), 1e-12);
}

// An error that decays with the earlier speed would carry the entity past the place of the freeze.
TEST(RemoteEntities, ShowAFreezeAndAResumeAtOnce) {
  for (const char* prediction : {"as_sent", "adaptive"}) {
    SCOPED_TRACE(prediction);
    Receiver receiver(std::string("[convergence]\nprediction = \"") + prediction + "\"\n");
    receiver.hear(state_of(Algorithm::fpw, {0, 0, 0}, {2, 0, 0}), 1);
    receiver.hear(state_of(Algorithm::fpw, {1, 0, 0}, {2, 0, 0}), 1.5);
    const auto stays_at = [&](const Vector3d& place, double from) {
      for (double t = from; t < from + 3; t += 0.01) {
        EXPECT_LE((receiver.shown(t).position - place).norm(), 1e-5) << t;
      }
    };
    receiver.hear(state_of(Algorithm::fpw, {2.05, 0, 0}, {2, 0, 0}), 2, pdu::kAppearanceFrozen);
    stays_at({2.05, 0, 0}, 2);
    EXPECT_TRUE(receiver.row().frozen);

    // Updates during the freeze converge as usual.
    receiver.hear(state_of(Algorithm::fpw, {2.06, 0, 0}, {2, 0, 0}), 6, pdu::kAppearanceFrozen);
    EXPECT_LE((receiver.shown(6).position - Vector3d(2.05, 0, 0)).norm(), 1e-5);
    EXPECT_EQ(receiver.count("snaps"), 1U);

    receiver.hear(state_of(Algorithm::fpw, {3, 0, 0}, {2, 0, 0}), 7);
    EXPECT_EQ(receiver.count("snaps"), 2U);
    for (const double t : {7.0, 7.05, 8.0}) {
      EXPECT_LE((receiver.shown(t).position - Vector3d(3 + 2 * (t - 7), 0, 0)).norm(), 1e-5) << t;
    }
  }
}

// Hands change their model with each touch, which is no reason to jump.
TEST(RemoteEntities, ConvergeToAnotherModelAndForgetTheHistory) {
  Receiver receiver("[convergence]\nprediction = \"adaptive\"\n");
  for (int i = 0; i < 4; ++i) {
    receiver.hear(state_of(Algorithm::fpw, {0.1 * i, 0, 0}, {1, 0, 0}), 1 + 0.1 * i);
  }
  const Pose before = receiver.shown(1.4);
  receiver.hear(state_of(Algorithm::rvw, {0.5, 0, 0}, {1, 0, 0}), 1.4);
  EXPECT_EQ(receiver.row().order->history().size(), 1U);
  EXPECT_EQ(receiver.count("snaps"), 0U);
  EXPECT_LE(gap(receiver.shown(1.4), before), 1e-9);
  EXPECT_LE(gap(receiver.shown(1.6), receiver.predicted(1.6)), 1e-9);
}

// --- prediction from the history

// RMS error of the shown position on a circle of 1 m in 4 s, FPW updates at 5 Hz, sampled at 100 Hz
// [m].
double circle_error(Receiver& receiver) {
  const double rate = 0.5 * std::numbers::pi;
  const auto place = [&](double t) { return Vector3d(std::cos(rate * t), std::sin(rate * t), 0); };
  const auto speed = [&](double t) {
    return Vector3d(-rate * std::sin(rate * t), rate * std::cos(rate * t), 0);
  };
  double sum = 0;
  int count = 0;
  for (int i = 0; i < 100; ++i) {
    const double at = 0.2 * i;
    receiver.hear(state_of(Algorithm::fpw, place(at), speed(at)), at);
    for (int k = 0; i >= 5 && k < 20; ++k, ++count) {
      const double t = at + 0.01 * k;
      sum += (receiver.shown(t).position - place(t)).squaredNorm();
    }
  }
  return std::sqrt(sum / count);
}

TEST(AdaptivePrediction, ShowsACircleBetterThanTheSentModel) {
  Receiver as_sent, adaptive("[convergence]\nprediction = \"adaptive\"\n");
  const double plain = circle_error(as_sent);
  const double chosen = circle_error(adaptive);
  std::printf("circle of 1 m in 4 s, FPW at 5 Hz: RMS %.2f mm as sent, %.2f mm adaptive\n",
              1e3 * plain, 1e3 * chosen);
  EXPECT_LT(chosen, 0.4 * plain);
  // Forces use the model as sent.
  EXPECT_LE(gap(adaptive.predicted(20), as_sent.predicted(20)), 1e-12);
}

TEST(AdaptivePrediction, AllocatesNothing) {
  Receiver receiver("[convergence]\nprediction = \"adaptive\"\n");
  const reckon::test::AllocationGuard guard;
  for (int i = 0; i < 50; ++i) {
    receiver.hear(
        state_of(i % 10 == 9 ? Algorithm::rvw : Algorithm::fpw, {0.1 * i, 0, 0}, {1, 0, 0}),
        0.1 * i);
  }
  EXPECT_EQ(guard.count(), 0U);
}

// --- entities of other tools, without a force model

TEST(RemoteEntities, ExpireAfterTheTimeoutOfTheirKind) {
  struct Case {
    const char* what;
    pdu::EntityType type;
    Vector3d velocity;
    double heartbeat;  // [s], of DIS 7
  };
  const Case cases[] = {
      {"flying plane", kPlane, {200, 0, 0}, 5},
      {"driving tank", kTank, {10, 0, 0}, 55},
      {"ship", {pdu::EntityKind::platform, pdu::EntityDomain::surface}, {5, 0, 0}, 55},
      {"missile", {pdu::EntityKind::munition, pdu::EntityDomain::air}, {300, 0, 0}, 5},
      {"walker", {pdu::EntityKind::life_form, pdu::EntityDomain::land}, {1, 0, 0}, 60},
      {"parked plane", kPlane, {0, 0, 0}, 60},
  };
  for (const Case& entity : cases) {
    SCOPED_TRACE(entity.what);
    Receiver receiver;
    receiver.hear(state_of(Algorithm::rvw, {0, 0, 0}, entity.velocity), 1, 0, entity.type);
    EXPECT_TRUE(receiver.survives(2.4 * entity.heartbeat - 0.1));
    EXPECT_FALSE(receiver.survives(2.4 * entity.heartbeat + 0.1));
    EXPECT_EQ(receiver.count("timed_out"), 1U);
  }
}

TEST(RemoteEntities, WithForceModelExpireAfterTwelveSeconds) {
  Receiver receiver;
  receiver.haptic = true;
  receiver.hear(state_of(Algorithm::fpw, {0, 0, 0}, {0, 0, 0}), 1, 0,
                {pdu::EntityKind::life_form, pdu::EntityDomain::land});
  EXPECT_TRUE(receiver.survives(11.9));
  EXPECT_FALSE(receiver.survives(12.1));
}

TEST(RemoteEntities, StopAfterTheTimeoutOfTheirKind) {
  Receiver receiver;
  receiver.hear(state_of(Algorithm::fpw, {0, 0, 0}, {100, 0, 0}), 1, 0, kPlane);
  EXPECT_NEAR(receiver.shown(1 + 12).position.x(), 1200, 1e-3);
  EXPECT_NEAR(receiver.shown(1 + 60).position.x(), 1200, 1e-3);
}

// --- force models

TEST(ForceModels, ImpossibleOnesAreRefusedAndTheLastKept) {
  Receiver receiver;
  receiver.haptic = true;
  receiver.model.kind = pdu::ForceModelKind::sphere;
  receiver.model.k1 = 500;
  receiver.model.radius = 0.01F;
  receiver.model.validity_ms = 12000;
  const KinematicState still = state_of(Algorithm::fpw, Vector3d::Zero(), Vector3d::Zero());
  receiver.hear(still, 1);
  EXPECT_EQ(receiver.row().model.k1, 500);
  EXPECT_FALSE(receiver.row().model_refused);
  const nanoseconds valid_until = receiver.row().valid_until;
  double second = 2;
  const pdu::HapticRecord good = receiver.model;
  const auto refused = [&](auto&& spoil) {
    receiver.model = good;
    spoil(receiver.model);
    receiver.hear(still, second++);
    EXPECT_TRUE(receiver.row().model_refused);
    EXPECT_EQ(receiver.row().model.k1, 500);
    EXPECT_EQ(receiver.row().valid_until, valid_until) << "it expires as the good one said";
  };
  refused([](pdu::HapticRecord& m) { m.k1 = std::numeric_limits<float>::quiet_NaN(); });
  refused([](pdu::HapticRecord& m) { m.k1 = -1; });
  refused([](pdu::HapticRecord& m) { m.k1 = 1e20F; });  // finite, but its square overflows
  EXPECT_EQ(receiver.count("models_refused"), 3u);
  EXPECT_EQ(receiver.last_refused(), kOther);
  receiver.model = good;
  receiver.model.k1 = 400;
  receiver.hear(still, second);
  EXPECT_FALSE(receiver.row().model_refused);
  EXPECT_EQ(receiver.row().model.k1, 400);
}

TEST(RemoteEntities, DoubtedOnesStopWithinHalfASecond) {
  Receiver receiver;
  receiver.hear(state_of(Algorithm::fpw, {1, 2, 3}, {2, 0, 0}), 1);
  const Pose trusted = receiver.shown(3.5);
  receiver.doubt(3.5);
  EXPECT_EQ(receiver.shown(3.5).position, trusted.position);
  Vector3d before = trusted.position;
  double speed = 2.0;
  for (double t = 3.501; t < 5; t += 0.001) {
    const Pose now = receiver.shown(t);
    const double went = (now.position - before).norm() / 0.001;
    EXPECT_LE(went, speed + 1e-6) << t;
    EXPECT_GE(went, speed - 0.0065) << "no step in velocity: 1.5 times 2 m/s in 0.5 s " << t;
    EXPECT_NEAR(now.velocity.norm(), went, 0.004) << t;
    speed = went;
    before = now.position;
  }
  EXPECT_NEAR((before - trusted.position).norm(), 0.25 * 2.0, 1e-6);
  EXPECT_EQ(receiver.shown(10).velocity, Vector3d::Zero());
}

TEST(RemoteEntities, ContinueFromTheShownPoseAfterADoubt) {
  Receiver receiver;
  const KinematicState state = state_of(Algorithm::fpw, {1, 2, 3}, {2, 0, 0});
  receiver.hear(state, 1);
  receiver.doubt(3.5);
  const Vector3d rests = receiver.shown(5).position;
  receiver.believe(5);
  EXPECT_LE((receiver.shown(5).position - rests).norm(), 1e-9);
  EXPECT_LE((receiver.shown(5.001).position - rests).norm(), 0.02) << "no jump";
  EXPECT_LE((receiver.shown(8).position - Vector3d(15, 2, 3)).norm(), 1e-6);
  EXPECT_NEAR(receiver.shown(8).velocity.x(), 2, 1e-6);
}

TEST(RemoteEntities, AnUpdateEndsADoubt) {
  Receiver receiver;
  receiver.hear(state_of(Algorithm::fpw, {1, 2, 3}, {2, 0, 0}), 1);
  receiver.doubt(3.5);
  const Vector3d rests = receiver.shown(5).position;
  receiver.hear(state_of(Algorithm::fpw, {9, 2, 3}, {2, 0, 0}), 5);
  EXPECT_EQ(receiver.row().doubted_at, RemoteEntity::kTrusted);
  EXPECT_LE((receiver.shown(5).position - rests).norm(), 1e-9);
  EXPECT_LE((receiver.shown(8).position - Vector3d(15, 2, 3)).norm(), 1e-3);
}

}  // namespace
}  // namespace reckon::peer::remote_entities_test
