// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Whole peers whose scene tells those who are near by groups of their own what the others need not
// know ([aoim] near_groups): nobody is shown worse than the row of the channels says that is so far
// away, whoever moves, leaps, or loses something.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <memory>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/federate.hpp"
#include "reckon/peer/network/simulated_network.hpp"

namespace reckon::test {
namespace {

using namespace std::chrono_literals;
using Eigen::Vector3d;
using std::chrono::nanoseconds;

constexpr double kThreshold = 0.2;  // [m]
constexpr double kSenses = 200.0, kEnd = 40.0, kMiddle = 100.0;
constexpr nanoseconds kStep = 20ms;
// What was heard outside the radius and comes in is seen to be there a little later, at 100 m/s
// too.
constexpr double kEntering = 30.0;  // [m]
// What is under way for 5 ms, decided once in 20 ms and sent thirty times a second at most is off
// by so much more [m], as sharply as anything turns here.
constexpr double kSlack = 0.15;

peer::SceneFile field(bool near_groups) {
  constexpr double kForever = std::numeric_limits<double>::infinity();
  peer::SceneFile scene = peer::dis_exercise(1, 0.82, 0.145);
  scene.network.interop = false;
  scene.aoim.cell = 50.0;
  scene.aoim.radius = kSenses;
  scene.aoim.awareness.channels = true;
  scene.aoim.awareness.rows = {{kEnd, aoim::Body::full, 30.0, 30.0, 144.0, false, 1.0},
                               {kMiddle, aoim::Body::approximate, 10.0, 10.0, 144.0, false, 4.0},
                               {kForever, aoim::Body::rigid, 10.0, 10.0, 144.0, false, 10.0}};
  scene.aoim.near_groups = near_groups;
  scene.hash = peer::scene_hash(scene);
  return scene;
}

/// Where something is at a time [s].
using Path = std::function<Vector3d(double)>;

peer::EntityTruth truth_of(const Path& path, nanoseconds now) {
  constexpr double kAside = 1e-3;
  const double t = pdu::to_seconds(now);
  const Vector3d before = path(t - kAside), at = path(t), after = path(t + kAside);
  peer::EntityTruth truth;
  truth.time = now;
  truth.position = at;
  truth.velocity = (after - before) / (2 * kAside);
  truth.acceleration = (after - 2 * at + before) / (kAside * kAside);
  return truth;
}

/// Slowly through the field, and to and fro meanwhile, as people do in a melee: its velocity tells
/// where it will be for a third of a second.
Path wander(std::mt19937& random, double side) {
  std::uniform_real_distribution<double> share(0.0, 1.0);
  const auto swing = [&] {
    const double reach = 3.0 + 7.0 * share(random), speed = 3.0 + 4.0 * share(random);
    const double phase = 2 * std::numbers::pi * share(random), middle = side * share(random);
    return [=](double t) {
      return middle + 50.0 * std::sin(0.04 * t + phase) + reach * std::sin(speed / reach * t);
    };
  };
  const auto x = swing(), y = swing();
  return [=](double t) { return Vector3d(x(t), y(t), 0.0); };
}

/// Of what one peer shows of others.
struct Looks {
  std::size_t all = 0, missing = 0, beyond = 0, near_beyond = 0;
  double worst = 0.0;       ///< error over what its row allows
  double near_worst = 0.0;  ///< error [m] in the nearest row
};

/// Federates with something each that moves along a path.
class Field {
 public:
  explicit Field(const peer::SceneFile& scene, std::vector<Path> paths, std::uint64_t seed = 1,
                 double loss = 0.0, nanoseconds jitter = {})
      : scene_(scene), paths_(std::move(paths)), clock_(1s, 1h), network_(options(seed), clock_) {
    peer::ImpairmentLaw law;
    law.delay = 5ms;
    law.loss = loss;
    law.jitter = jitter;
    network_.impair(law);
    for (std::size_t i = 0; i < paths_.size(); ++i) join(i);
  }

  void run(nanoseconds span) {
    for (const nanoseconds end = clock_.now() + span; clock_.now() < end;) {
      clock_.advance(kStep);
      for (std::size_t i = 0; i < paths_.size(); ++i) {
        federates_[i]->update_attributes(things_[i], truth_of(paths_[i], clock_.now()));
      }
      for (auto& federate : federates_) federate->step();
      if (looks_) look();
    }
  }
  /// From now on what is shown is looked at in each step.
  void begin() {
    looks_ = true;
    seen_ = {};
    before_ = {heard("datagrams_in"), heard("octets_in"), heard("updates_out")};
  }
  [[nodiscard]] const Looks& seen() const { return seen_; }
  [[nodiscard]] std::uint64_t datagrams() { return heard("datagrams_in") - before_[0]; }
  [[nodiscard]] std::uint64_t octets() { return heard("octets_in") - before_[1]; }
  [[nodiscard]] std::uint64_t updates() { return heard("updates_out") - before_[2]; }
  std::uint64_t count(std::size_t i, const char* counter) {
    const peer::Counter* found = federates_[i]->peer().counters().find(counter);
    return found == nullptr ? 0 : found->value();
  }
  std::uint64_t heard(const char* counter) {
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < paths_.size(); ++i) sum += count(i, counter);
    return sum;
  }
  void set_path(std::size_t i, Path path) { paths_[i] = std::move(path); }
  [[nodiscard]] double time() const { return pdu::to_seconds(clock_.now()); }
  /// An azimuth of the thing of one, and what another shows of it [rad]; far off where it knows
  /// none.
  void turn(std::size_t i, double azimuth, double rate) {
    parts_[i].set({kTurret, 0, deadreckon::PartMetric::azimuth, 0, azimuth, rate});
    federates_[i]->update_parts(things_[i], parts_[i]);
  }
  [[nodiscard]] double shown_azimuth(std::size_t watcher, std::size_t other) {
    const peer::ShownParts shown = federates_[watcher]->peer().model().remote().parts(
        federates_[other]->peer().model().own_id(), clock_.now());
    return shown.empty() ? 1e9 : shown[0].value;
  }
  /// Of what `watcher` has of another [m].
  [[nodiscard]] double error(std::size_t watcher, std::size_t other) {
    const peer::RemoteEntity* row = row_of(watcher, other);
    if (row == nullptr) return 1e9;
    return (row->predicted(clock_.now()).position - paths_[other](time())).norm();
  }

 private:
  peer::SimulatedNetworkOptions options(std::uint64_t seed) const {
    peer::SimulatedNetworkOptions options;
    options.links = paths_.size();
    options.seed = seed;
    options.datagrams_in_flight = 4096;
    return options;
  }
  void join(std::size_t i) {
    peer::FederateOptions options;
    options.name = "FED" + std::to_string(i + 1);
    options.scene = scene_;
    options.application = static_cast<std::uint16_t>(i + 1);
    federates_.push_back(std::make_unique<peer::Federate>(options, network_.link(i), clock_,
                                                          static_cast<std::uint32_t>(i + 1)));
    federates_.back()->publish(peer::EntityClass{});
    federates_.back()->subscribe(peer::EntityClass{});
    peer::EntityDescription thing;
    thing.type = {pdu::EntityKind::platform, pdu::EntityDomain::land, 225, 7, 1, 0, 0};
    thing.dead_reckoning.algorithm = pdu::DeadReckoningAlgorithm::fpw;
    thing.dead_reckoning.thresholds.position = kThreshold;
    things_.push_back(federates_.back()->register_object(thing, truth_of(paths_[i], clock_.now())));
  }
  [[nodiscard]] const peer::RemoteEntity* row_of(std::size_t watcher, std::size_t other) {
    return federates_[watcher]->peer().model().remote().find(
        federates_[other]->peer().model().own_id());
  }
  void look() {
    for (std::size_t a = 0; a < paths_.size(); ++a) {
      for (std::size_t b = 0; b < paths_.size(); ++b) {
        const double away = (paths_[a](time()) - paths_[b](time())).norm();
        if (a != b && away < kSenses - kEntering) look_at(a, b, away);
      }
    }
  }
  void look_at(std::size_t watcher, std::size_t other, double away) {
    ++seen_.all;
    const peer::RemoteEntity* row = row_of(watcher, other);
    if (row == nullptr) {
      ++seen_.missing;
      return;
    }
    const double coarser = away <= kEnd ? 1.0 : away <= kMiddle ? 4.0 : 10.0;
    const double off = error(watcher, other), share = off / (coarser * kThreshold + kSlack);
    seen_.beyond += share > 1.0;
    seen_.near_beyond += share > 1.0 && away <= kEnd;
    seen_.worst = std::max(seen_.worst, share);
    if (away <= kEnd) seen_.near_worst = std::max(seen_.near_worst, off);
  }

  peer::SceneFile scene_;
  std::vector<Path> paths_;
  peer::ManualClock clock_;
  peer::SimulatedNetwork network_;
  std::vector<std::unique_ptr<peer::Federate>> federates_;
  std::vector<peer::ObjectHandle> things_;
  bool looks_ = false;
  Looks seen_;
  static constexpr std::uint32_t kTurret = 128;  // SISO UID 59
  std::map<std::size_t, deadreckon::PartState> parts_;
  std::array<std::uint64_t, 3> before_{};
};

std::vector<Path> crowd(std::size_t count, double side, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<Path> paths;
  for (std::size_t i = 0; i < count; ++i) paths.push_back(wander(random, side));
  return paths;
}

TEST(NearGroups, SpareACrowdWhatTheFarNeedNotKnowAndShowNobodyWorseThanItsRow) {
  std::uint64_t datagrams[2], octets[2], updates[2];
  for (const bool near : {false, true}) {
    Field place(field(near), crowd(64, 400.0, 1));
    place.run(4s);
    place.begin();
    place.run(8s);
    datagrams[near] = place.datagrams();
    octets[near] = place.octets();
    updates[near] = place.updates();
    const Looks& seen = place.seen();
    std::printf(
        "[ residual ] %s: %.1f datagrams/s and %.0f octets/s heard, %.2f updates/s sent by each; "
        "%zu looks, %zu missing, %zu beyond their row, at most %.2f of it; %.2f m in the nearest\n",
        near ? "near groups" : "one stream", static_cast<double>(datagrams[near]) / 64 / 8,
        static_cast<double>(octets[near]) / 64 / 8, static_cast<double>(updates[near]) / 64 / 8,
        seen.all, seen.missing, seen.beyond, seen.worst, seen.near_worst);
    EXPECT_EQ(seen.beyond, 0u);
    EXPECT_EQ(seen.missing, 0u);
    EXPECT_EQ(place.heard("datagrams_lost"), 0u);
  }
  EXPECT_LT(1.2 * static_cast<double>(datagrams[1]), static_cast<double>(datagrams[0]));
}

TEST(NearGroups, SayTheSameOctetsAsBeforeWhereThereAreNone) {
  peer::SceneFile plain = field(false);
  for (aoim::Channel& row : plain.aoim.awareness.rows) row.coarser = 1.0;
  plain.hash = peer::scene_hash(plain);
  Field coarse(field(false), crowd(6, 150.0, 2)), fine(plain, crowd(6, 150.0, 2));
  EXPECT_EQ(field(false).hash, plain.hash);
  for (Field* place : {&coarse, &fine}) place->run(10s);
  EXPECT_EQ(coarse.heard("octets_out"), fine.heard("octets_out"));
  EXPECT_EQ(coarse.heard("updates_near"), 0u);
}

// What loss does to one stream it does to several, and no more.
TEST(NearGroups, SufferNoMoreFromLossAndDisorderThanOneStream) {
  constexpr double kLoss = 0.05;
  std::size_t all[2] = {}, beyond[2] = {}, near_beyond[2] = {}, missing[2] = {};
  for (const bool near : {false, true}) {
    for (unsigned seed = 1; seed <= 10; ++seed) {
      Field place(field(near), crowd(12, 150.0, seed), seed, kLoss, 30ms);
      place.run(4s);
      place.begin();
      place.run(8s);
      all[near] += place.seen().all;
      beyond[near] += place.seen().beyond;
      near_beyond[near] += place.seen().near_beyond;
      missing[near] += place.seen().missing;
    }
    std::printf(
        "[ residual ] 5 %% loss, 30 ms of jitter, %s: %zu of %zu looks beyond, %zu of them in the "
        "nearest row, %zu missing\n",
        near ? "near groups" : "one stream", beyond[near], all[near], near_beyond[near],
        missing[near]);
  }
  EXPECT_EQ(missing[1], 0u);
  EXPECT_LE(static_cast<double>(near_beyond[1]), 1.5 * static_cast<double>(near_beyond[0]));
  // One stream shows the far better than their row asks for, so that it can lose some.
  EXPECT_LE(static_cast<double>(beyond[1]), kLoss * static_cast<double>(all[1]));
}

/// A weave about a line: what is told of it at any instant leads away from it.
Path weave(double reach, double speed) {
  return [=](double t) { return Vector3d(speed * t, reach * std::sin(3.0 * t), 0.0); };
}
/// Straight on, but for a bump to one side now and then: too small for the far to be told of, and
/// what the near are told in it leads away.
Path bump(double reach, double speed) {
  return [=](double t) {
    const double phase = std::min(std::fmod(t, 3.0), 1.0),
                 wave = std::sin(std::numbers::pi * phase);
    return Vector3d(speed * t, reach * wave * wave, 0.0);
  };
}
/// Straight on, and to one side or the other for some seconds, which the far need not know.
Path sidestep(double reach, double speed) {
  return [=](double t) {
    const double at = std::fmod(t, 10.0), share = std::clamp(at < 5.0 ? at : 6.0 - at, 0.0, 1.0);
    return Vector3d(speed * t, reach * share * share * (3.0 - 2.0 * share), 0.0);
  };
}
Path stand(const Vector3d& place) {
  return [=](double) { return place; };
}

// 100 m/s towards what weaves, and past it: the nearest row holds from its first look on.
TEST(NearGroups, AreJoinedAheadByWhoClosesInAtAHundredMetresASecond) {
  Field place(field(true), {weave(1.0, 2.0), stand({0, 20, 0}),
                            [](double t) { return Vector3d(-1500.0 + 100.0 * t, 10.0, 0.0); }});
  place.run(12s);
  place.begin();
  place.run(6s);
  const Looks& seen = place.seen();
  std::printf("[ residual ] at 100 m/s: %zu looks, %zu beyond, at most %.2f of the row\n", seen.all,
              seen.beyond, seen.worst);
  EXPECT_EQ(seen.beyond, 0u);
  EXPECT_EQ(seen.missing, 0u);
}

// A third of a second after it leapt a peer is told all that those know who are there.
TEST(NearGroups, TellALeapedFocusWhatThoseNearKnow) {
  Field place(field(true),
              {sidestep(0.6, 0.5), stand({20, 20, 0}), stand({150, 0, 0}), stand({-140, 30, 0})});
  place.run(6s);
  for (int leap = 0; leap < 20; ++leap) {
    place.set_path(2, stand(leap % 2 == 0 ? Vector3d(40, 0, 0) : Vector3d(150, 0, 0)));
    place.run(340ms);
    place.begin();
    place.run(1560ms);
    EXPECT_EQ(place.seen().beyond, 0u) << leap << ": " << place.seen().worst;
    EXPECT_EQ(place.seen().missing, 0u) << leap;
  }
}

// Who goes away while another stays has heard what those behind it have not: it goes back to what
// its row is kept right by, or it would be led astray until that is told anew.
TEST(NearGroups, LeaveNobodyWithAStateThatNobodyKeepsRight) {
  double worst = 0.0;
  for (int turn = 0; turn < 40; ++turn) {
    Field place(field(true), {bump(0.6, 1.0), stand({10, 20, 0}), stand({10, -20, 0})});
    place.run(10s + turn * 75ms);
    const double left = place.time();
    // Away by 120 m in 6 s, without a jerk.
    place.set_path(2, [left](double t) {
      const double share = std::min((t - left) / 6.0, 1.0);
      return Vector3d(10.0, -20.0 - 60.0 * (1.0 - std::cos(std::numbers::pi * share)), 0.0);
    });
    place.begin();
    place.run(9s);
    worst = std::max(worst, place.seen().worst);
    EXPECT_EQ(place.seen().beyond, 0u) << turn << ": " << place.seen().worst;
  }
  std::printf("[ residual ] gone away: at most %.2f of the row\n", worst);
}

// Nobody is near any more: what the near were told alone is told to all once.
TEST(NearGroups, AreSilentWhereNobodyIsNear) {
  Field place(field(true), {weave(1.0, 2.0), stand({0, 190, 0})});
  place.run(5s);
  const std::uint64_t before = place.count(0, "updates_near");
  place.run(5s);
  EXPECT_EQ(place.count(0, "updates_near"), before);
  place.set_path(1, stand({10, 20, 0}));
  place.run(5s);
  EXPECT_GT(place.count(0, "updates_near"), before + 4);
}

// A budget takes near groups from who cannot take what they say; another there keeps them.
TEST(NearGroups, AreLeftByAReceiverWithoutTheBudget) {
  peer::SceneFile poor = field(true), rich = field(true);
  poor.aoim.awareness.budget = 2000.0;
  std::uint64_t octets[2];
  for (const bool is_poor : {false, true}) {
    Field place(is_poor ? poor : rich, crowd(12, 60.0, 3));
    place.run(6s);
    place.begin();
    place.run(8s);
    octets[is_poor] = place.octets();
  }
  std::printf("[ residual ] budget of 2 kB/s: %.0f octets/s heard, %.0f without\n",
              static_cast<double>(octets[1]) / 12 / 8, static_cast<double>(octets[0]) / 12 / 8);
  EXPECT_LT(1.2 * static_cast<double>(octets[1]), static_cast<double>(octets[0]));
}

// Where the near row holds all of the radius nobody is spared anything, and nobody shown worse.
TEST(NearGroups, ShowAllAsOneStreamDoesWhereTheNearRowHoldsTheRadius) {
  peer::SceneFile wide = field(true);
  wide.aoim.awareness.rows.front().farthest = 250.0;
  wide.aoim.awareness.rows[1].farthest = 300.0;
  wide.hash = peer::scene_hash(wide);
  Field place(wide, crowd(10, 150.0, 4));
  place.run(4s);
  place.begin();
  place.run(6s);
  EXPECT_EQ(place.seen().missing, 0u);
  EXPECT_LT(place.seen().near_worst, kThreshold + kSlack);
  EXPECT_EQ(place.seen().beyond, 0u);
}

// Parts are told to the rows that have bodies with parts, and to who comes into one of them.
TEST(NearGroups, CarryThePartsOfBodiesToThoseWhoseRowHasThem) {
  Field place(field(true),
              {stand({0, 0, 0}), stand({20, 0, 0}), stand({0, 80, 0}), stand({0, -185, 0})});
  place.run(6s);
  const std::uint64_t before = place.count(3, "updates_in");
  const auto swing = [&](nanoseconds span) {
    for (const double end = place.time() + pdu::to_seconds(span); place.time() < end;) {
      place.turn(0, std::sin(2.0 * place.time()), 2.0 * std::cos(2.0 * place.time()));
      place.run(kStep);
    }
  };
  swing(6s);
  const double truth = std::sin(2.0 * place.time());
  EXPECT_NEAR(place.shown_azimuth(1, 0), truth, 0.15);
  EXPECT_NEAR(place.shown_azimuth(2, 0), truth, 0.15);
  EXPECT_GT(place.count(0, "updates_near"), 5u);
  EXPECT_LE(place.count(3, "updates_in") - before, 6u) << "heartbeats alone";
  place.set_path(3, stand({0, -15, 0}));
  swing(1s);
  EXPECT_NEAR(place.shown_azimuth(3, 0), std::sin(2.0 * place.time()), 0.15);
}

TEST(NearGroups, CarryCompressedStatesByTheKeysOfTheCell) {
  for (const pdu::CompressedForm form :
       {pdu::CompressedForm::compact, pdu::CompressedForm::delta}) {
    peer::SceneFile scene = field(true);
    scene.network.compression = form;
    scene.hash = peer::scene_hash(scene);
    Field place(scene, crowd(16, 150.0, 5));
    place.run(4s);
    place.begin();
    place.run(6s);
    EXPECT_EQ(place.seen().beyond, 0u) << static_cast<int>(form) << ": " << place.seen().worst;
    EXPECT_EQ(place.seen().missing, 0u) << static_cast<int>(form);
    EXPECT_GT(place.heard("updates_near"), 100u) << static_cast<int>(form);
  }
}

}  // namespace
}  // namespace reckon::test
