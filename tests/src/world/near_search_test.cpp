// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The search for bodies that hands could touch, compared with a check of every entity at every
// step.
#include "reckon/peer/world/near_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <random>
#include <vector>

#include "reckon/pdu/seconds.hpp"
#include "reckon/tests/src/support/poses.hpp"
#include "reckon/tests/support/allocation_guard.hpp"

namespace reckon::peer {
namespace {

using deadreckon::ProbeState;
using Eigen::Vector3d;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using Kind = pdu::ForceModelKind;

constexpr double kReach = 0.25;

class Random {
 public:
  explicit Random(std::uint32_t seed) : engine_(seed) {}
  std::size_t below(std::size_t n) { return engine_() % n; }
  double within(double size) {
    return std::uniform_real_distribution<double>(-size, size)(engine_);
  }
  Vector3d vector(double size) { return {within(size), within(size), within(size)}; }

 private:
  std::mt19937 engine_;
};

// A table of entities with its search.
class Crowd {
 public:
  Crowd(std::size_t capacity, std::uint32_t seed, double size)
      : table_(capacity), search_(capacity, kReach), random_(seed), size_(size) {}

  void add() {
    bool added = false;
    ++serial_;
    const pdu::EntityId id{1, static_cast<std::uint16_t>(serial_ >> 16),
                           static_cast<std::uint16_t>(serial_)};
    static_cast<void>(table_.find_or_add(id, added));
    search_.add_row();
    move(table_.rows().size() - 1);
  }
  // An update: another motion, and sometimes another or no model.
  void move(std::size_t place) {
    RemoteEntity& row = table_.rows()[place];
    deadreckon::KinematicState state;
    state.algorithm = static_cast<pdu::DeadReckoningAlgorithm>(1 + random_.below(9));
    state.position = random_.vector(size_);
    state.orientation = Eigen::Quaterniond(Eigen::AngleAxisd(
        random_.within(3), Vector3d(random_.vector(1) + Vector3d(0, 0, 2)).normalized()));
    const double speed = random_.below(3) == 0 ? 0.0 : std::pow(10.0, random_.within(1.5));
    state.velocity = random_.vector(speed);
    state.acceleration = random_.vector(speed);
    state.angular_velocity = random_.vector(random_.below(2) == 0 ? 0.0 : 2.0);
    row.state = state;
    row.state_time = now_ - milliseconds(random_.below(50));
    row.frozen = random_.below(10) == 0;
    row.timeout = random_.below(5) == 0 ? 0.3 : 12.0;
    search_.note_update(place);
    if (random_.below(2) == 0) give_model(place);
  }
  void give_model(std::size_t place) {
    deadreckon::ForceModel& model = table_.rows()[place].model;
    model.kind = static_cast<Kind>(random_.below(6));
    model.radius = 0.2 + random_.within(0.2);
    model.point = random_.vector(0.5);
    model.normal = Vector3d(random_.vector(1) + Vector3d(0, 0, 1.5)).normalized();
    table_.rows()[place].haptic = true;
    search_.note_model(place);
  }
  void erase(std::size_t place) {
    search_.erase_row(place);
    table_.erase(place);
  }
  void change_some() {
    if (random_.below(3) == 0 && size() < table_.capacity()) add();
    if (random_.below(4) == 0 && size() > 0) erase(random_.below(size()));
    if (random_.below(2) == 0 && size() > 0) move(random_.below(size()));
    if (random_.below(6) == 0 && size() > 0) give_model(random_.below(size()));
  }

  // Runs one step of the search and compares it with all rows. Returns how many were within reach.
  std::size_t step(std::span<const ProbeState> probes, nanoseconds by) {
    now_ += by;
    found_.resize(probes.size());
    search_.find(table_.rows(), probes, now_, found_);
    std::size_t all = 0;
    for (std::size_t i = 0; i < probes.size(); ++i) {
      const std::vector<double> depths = depths_of(probes[i]);
      const auto near = found_[i].bodies();
      all += depths.size();
      EXPECT_EQ(near.size() + found_[i].left_out(), depths.size());
      EXPECT_EQ(near.size(), std::min(depths.size(), haptics::kMaxRemoteHands));
      if (near.size() == depths.size()) {
        EXPECT_EQ(depths_of(near), depths);
      }
    }
    return all;
  }

  // The same for own bodies. Returns how many pairs were within reach.
  std::size_t meet(std::span<const MovingBody> bodies, nanoseconds by) {
    now_ += by;
    search_.find(table_.rows(), {}, now_, {}, bodies, hands_);
    std::size_t all = 0;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      const std::size_t near = hands_near(bodies[i]);
      std::array<ProbeState, haptics::kMaxRemoteHands> hands;
      EXPECT_EQ(hands_.of(i, hands), std::min(near, hands.size())) << "body " << i;
      all += near;
    }
    EXPECT_EQ(hands_.size(), all);
    return all;
  }

  [[nodiscard]] std::size_t size() const { return table_.rows().size(); }
  [[nodiscard]] NearSearch& search() { return search_; }
  [[nodiscard]] const NearBodies& found(std::size_t probe) const { return found_[probe]; }
  [[nodiscard]] StateTable& table() { return table_; }
  [[nodiscard]] Random& random() { return random_; }

 private:
  static std::vector<double> depths_of(std::span<const NearBody> near) {
    std::vector<double> depths;
    for (const NearBody& body : near) depths.push_back(body.depth);
    std::sort(depths.rbegin(), depths.rend());
    return depths;
  }

  std::vector<double> depths_of(const ProbeState& probe) {
    std::vector<double> depths;
    for (const RemoteEntity& row : table_.rows()) {
      if (!row.haptic) continue;
      const double depth =
          contact(row.model, row.predicted(now_), probe.position, probe.radius).depth;
      if (depth > -kReach) depths.push_back(depth);
    }
    std::sort(depths.rbegin(), depths.rend());
    return depths;
  }

  std::size_t hands_near(const MovingBody& body) {
    std::size_t near = 0;
    for (const RemoteEntity& row : table_.rows()) {
      if (!row.haptic) continue;
      const deadreckon::Pose pose = row.predicted(now_);
      const Vector3d middle = pose.position + pose.orientation * row.model.point;
      near += contact(*body.model, body.pose, middle, row.model.radius).depth > -kReach;
    }
    return near;
  }

  StateTable table_;
  NearSearch search_;
  HandsNear hands_;
  Random random_;
  double size_;
  nanoseconds now_ = std::chrono::seconds(100);
  std::uint32_t serial_ = 0;
  std::vector<NearBodies> found_;
};

// Hands that rest, stroll, strike and, rarely, jump.
void move_hands(std::span<ProbeState> hands, Random& random, double size) {
  for (ProbeState& hand : hands) {
    const std::size_t how = random.below(1000);
    if (how == 0) {
      hand.position = random.vector(size);
    } else {
      hand.position += random.vector(how < 500 ? 0.0 : how < 950 ? 0.004 : 0.1);
    }
    hand.radius = how == 1 ? 0.3 : how == 2 ? 0.01 : hand.radius;
  }
}

TEST(NearSearch, MatchesAFullSearchForHands) {
  std::size_t found = 0, steps = 0, looks = 0, rows = 0;
  for (std::uint32_t seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const double size = seed % 3 == 0 ? 3 : seed % 3 == 1 ? 30 : 300;
    Crowd crowd(200, seed, size);
    std::vector<ProbeState> hands(1 + seed % NearSearch::kMostProbes);
    for (ProbeState& hand : hands) hand.radius = 0.02;
    for (int i = 0; i < 1500 && !testing::Test::HasFailure(); ++i, ++steps) {
      if (i % 5 == 0) crowd.change_some();
      move_hands(hands, crowd.random(), size);
      found += crowd.step(hands, i % 100 == 99 ? milliseconds(700) : milliseconds(i % 4));
      rows += crowd.search().size();
    }
    looks += crowd.search().looks();
  }
  std::printf("%zu steps: %zu within reach, %zu of %zu looked at\n", steps, found, looks, rows);
  EXPECT_GT(found, 10'000U);
  EXPECT_LT(looks, rows / 2);
}

// Bodies that rest, stroll, turn, strike, jump, come and go.
void move_bodies(std::vector<MovingBody>& bodies, const deadreckon::ForceModel& model,
                 Random& random, double size) {
  for (MovingBody& body : bodies) {
    const std::size_t how = random.below(1000);
    if (how == 0) {
      body.pose.position = random.vector(size);
    } else {
      body.pose.position += random.vector(how < 500 ? 0.0 : how < 950 ? 0.004 : 0.1);
    }
    const double turn = how == 1 ? 3.0 : how < 300 ? 0.0 : how < 900 ? 0.002 : 0.05;
    body.pose.orientation =
        body.pose.orientation * Eigen::AngleAxisd(random.within(turn), Vector3d::UnitY());
  }
  if (random.below(100) == 0 && bodies.size() < 4) bodies.push_back({&model, {}});
  if (random.below(100) == 0 && !bodies.empty()) {
    bodies.erase(bodies.begin() + static_cast<std::ptrdiff_t>(random.below(bodies.size())));
  }
}

TEST(NearSearch, MatchesAFullSearchForHandsNearBodies) {
  std::size_t found = 0, looks = 0, rows = 0;
  for (std::uint32_t seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const double size = seed % 3 == 0 ? 3 : seed % 3 == 1 ? 30 : 300;
    Crowd crowd(200, seed, size);
    crowd.search().expect_bodies(4);
    deadreckon::ForceModel model;
    model.kind = static_cast<Kind>(1 + seed % 4);
    model.radius = 0.3;
    model.point = {0, 0, 0.4};
    model.normal = {0, 0.6, 0.8};
    std::vector<MovingBody> bodies(2, {&model, {}});
    for (int i = 0; i < 1500 && !testing::Test::HasFailure(); ++i) {
      if (i % 5 == 0) crowd.change_some();
      move_bodies(bodies, model, crowd.random(), size);
      found += crowd.meet(bodies, i % 100 == 99 ? milliseconds(700) : milliseconds(i % 4));
      rows += crowd.search().size();
    }
    looks += crowd.search().looks();
  }
  std::printf("%zu within reach, %zu of %zu looked at\n", found, looks, rows);
  EXPECT_GT(found, 10'000U);
  EXPECT_LT(looks, rows / 2);
}

TEST(NearSearch, ChecksDistantEntitiesRarely) {
  constexpr std::size_t kRows = 10'000;
  Crowd crowd(kRows, 1, 100'000);
  for (std::size_t i = 0; i < kRows; ++i) {
    crowd.add();
    crowd.table().rows()[i].state = test::last_sent_at(100.0 + static_cast<double>(i));
    crowd.table().rows()[i].model.kind = Kind::sphere;
    crowd.give_model(i);
    crowd.table().rows()[i].model.kind = Kind::sphere;
  }
  std::array<ProbeState, 1> hand;
  std::array<NearBodies, 1> found;
  nanoseconds now = std::chrono::seconds(100);
  const auto step = [&](double way) {
    hand[0].position.y() += way;
    now += milliseconds(2);
    crowd.search().find(crowd.table().rows(), hand, now, found);
  };
  step(0);
  EXPECT_EQ(crowd.search().looks(), kRows);
  std::uint64_t most = 0;
  for (int i = 0; i < 2000; ++i) {
    const std::uint64_t before = crowd.search().looks();
    step(i % 2 == 0 ? 0.002 : -0.002);  // 1 m/s
    most = std::max(most, crowd.search().looks() - before);
  }
  EXPECT_LE(crowd.search().looks(), 2 * kRows);  // in 4 s, each after 4 to 8 s
  EXPECT_LE(most, 10U);
}

TEST(NearSearch, FindsPlanesAndPegsByTheirSurface) {
  Crowd crowd(2, 1, 1);
  for (const Kind kind : {Kind::plane, Kind::spring_damper_region}) {
    crowd.add();
    RemoteEntity& row = crowd.table().rows().back();
    row = {};
    row.model.kind = kind;
    row.model.radius = 5;
    row.model.normal = {0, 0, 1};
    row.haptic = true;
    crowd.search().note_model(crowd.size() - 1);
  }
  std::array<ProbeState, 1> hand;
  hand[0].position = {4, 0, 0.2};
  EXPECT_EQ(crowd.step(hand, milliseconds(2)), 2U);
  hand[0].position = {400, 0, 0.2};
  EXPECT_EQ(crowd.step(hand, milliseconds(2)), 1U);
  EXPECT_EQ(crowd.found(0).bodies()[0].row->model.kind, Kind::plane);
  hand[0].position = {400, 0, 0.3};
  EXPECT_EQ(crowd.step(hand, milliseconds(2)), 0U);
}

TEST(NearSearch, KeepsTheNearestAndCountsTheRest) {
  Crowd crowd(100, 1, 1);
  for (int i = 0; i < 100; ++i) {
    crowd.add();
    RemoteEntity& row = crowd.table().rows().back();
    row.state = test::last_sent_at(0.002 * ((37 * i) % 100));
    row.model = {};
    row.model.kind = Kind::sphere;
    row.haptic = true;
    crowd.search().note_model(crowd.size() - 1);
  }
  std::array<ProbeState, 1> hand;
  EXPECT_EQ(crowd.step(hand, milliseconds(2)), 100U);
  EXPECT_EQ(crowd.found(0).left_out(), 100 - haptics::kMaxRemoteHands);
  for (std::size_t k = 0; k < haptics::kMaxRemoteHands; ++k)
    EXPECT_NEAR(crowd.found(0).bodies()[k].depth, -0.002 * static_cast<double>(k), 1e-12);
}

TEST(NearSearch, OutlivesAHandThatIsNowhere) {
  Crowd crowd(4, 1, 1);
  crowd.add();
  crowd.table().rows()[0].state = test::last_sent_at(0);
  crowd.give_model(0);
  crowd.table().rows()[0].model = {};
  crowd.table().rows()[0].model.kind = Kind::sphere;
  std::array<ProbeState, 2> hands;
  hands[0].position.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(crowd.step(hands, milliseconds(2)), 1U);
  EXPECT_EQ(crowd.found(1).bodies().size(), 1U);
  hands[1].position.x() = std::numeric_limits<double>::infinity();
  EXPECT_EQ(crowd.step(hands, milliseconds(2)), 0U);
  hands[0].position.x() = 0;
  EXPECT_EQ(crowd.step(hands, milliseconds(2)), 1U);
  EXPECT_EQ(crowd.step(std::span<ProbeState>(), milliseconds(2)), 0U);
  EXPECT_EQ(crowd.step(std::span(hands).first(1), nanoseconds(0)), 1U);
}

TEST(NearSearch, AllocatesNothing) {
  Crowd crowd(50, 1, 3);
  std::array<ProbeState, 3> hands;
  std::array<NearBodies, 3> found;
  const reckon::test::AllocationGuard guard;
  for (int i = 0; i < 500; ++i) {
    crowd.change_some();
    crowd.search().find(crowd.table().rows(), hands, milliseconds(2 * i), found);
  }
  EXPECT_EQ(guard.count(), 0U);
}

}  // namespace
}  // namespace reckon::peer
