// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A visitor among entities at rest whose owners send once a minute: it leaves and returns, or
// connects through a switch that opens its port late.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/federate.hpp"
#include "reckon/peer/joined_peer.hpp"
#include "reckon/peer/network/simulated_network.hpp"
#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/tests/integration/losing_link.hpp"
#include "reckon/tests/support/soak.hpp"
#include "reckon/tests/support/tier_rows.hpp"

namespace reckon::test::visitor_test {
namespace {

using namespace std::chrono_literals;
using Eigen::Vector3d;
using std::chrono::nanoseconds;

constexpr std::uint16_t kSite = 4;
constexpr std::size_t kOwners = 3, kEach = 10;
constexpr std::size_t kAll = kOwners * kEach;
constexpr nanoseconds kLook = 10ms;

// Owners of entities at rest within 60 m of the origin, and a visitor with an entity that drives.
class Visit {
 public:
  /// @param middle of the entities at rest. A peer receives the scene's origin until it owns
  ///     something
  explicit Visit(const std::string& aoim, nanoseconds join_delay = 0ns, nanoseconds before = 3s,
                 const Vector3d& middle = Vector3d::Zero())
      : scene_(peer::parse_scene_file("[scene]\norigin = { latitude = \"47 deg\", longitude = "
                                      "\"8 deg\" }\n[aoim]\n" +
                                          aoim,
                                      "visit.toml")),
        clock_(1s, 1h),
        network_(options(join_delay), clock_) {
    peer::ImpairmentLaw law;
    law.delay = 5ms;
    network_.impair(law);
    for (std::size_t i = 0; i <= kOwners; ++i)
      links_.push_back(std::make_unique<LosingLink>(network_.link(i)));
    for (std::size_t owner = 0; owner < kOwners; ++owner) {
      join();
      for (std::size_t i = 0; i < kEach; ++i) {
        const double turn = 0.7 * static_cast<double>(owner * kEach + i);
        const Vector3d beside(-15 * std::cos(turn), 15 * std::sin(turn), 0);
        federates_.back()->register_object(thing(), at(middle + beside));
      }
    }
    pass(before, before > 3s ? 10 * kLook : kLook);
  }

  void come(const Vector3d& to) {
    place_ = to;
    join();
    federates_.back()->subscribe(peer::EntityClass{});
    federates_.back()->on_discover([this](const peer::RemoteObject&) { ++discovered; });
    federates_.back()->on_remove([this](const peer::RemoteObject&, peer::Removal) { ++removed; });
    car_ = federates_.back()->register_object(thing(), at(to));
  }
  void drive(const Vector3d& to, double pace) {
    const Vector3d from = place_;
    const nanoseconds begin = clock_.now();
    const double length = (to - from).norm();
    for (double gone = 0.0; gone < length;) {
      gone = std::min(pace * pdu::to_seconds(clock_.now() + kLook - begin), length);
      place_ = from + gone / length * (to - from);
      peer::EntityTruth truth = at(place_);
      truth.velocity = pace / length * (to - from);
      federates_.back()->update_attributes(car_, truth);
      pass(kLook);
    }
    stand_at(to);
  }
  void stand_at(const Vector3d& place) {
    place_ = place;
    federates_.back()->update_attributes(car_, at(place));
    pass(kLook);
  }
  void pass(nanoseconds span, nanoseconds look = kLook) {
    for (const nanoseconds end = clock_.now() + span; clock_.now() < end;) {
      clock_.advance(look);
      for (auto& federate : federates_) federate->step();
    }
  }
  [[nodiscard]] std::size_t shown() const { return federates_.back()->size(); }
  /// Time until all are shown [s], at most `limit`.
  [[nodiscard]] double until_all(nanoseconds limit) {
    const nanoseconds begin = clock_.now();
    while (shown() < kAll && clock_.now() - begin < limit) pass(kLook);
    return pdu::to_seconds(clock_.now() - begin);
  }
  [[nodiscard]] std::uint64_t sent_by_owners() {
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < kOwners; ++i)
      sum += federates_[i]->peer().counters().find("updates_out")->value();
    return sum;
  }
  [[nodiscard]] std::uint64_t count(std::string_view name) {
    return federates_.back()->peer().counters().find(name)->value();
  }

  /// The link of an owner, by number; the visitor's follows them.
  [[nodiscard]] LosingLink& link(std::size_t number) { return *links_[number]; }

  std::size_t discovered = 0, removed = 0;

 private:
  static peer::SimulatedNetworkOptions options(nanoseconds join_delay) {
    peer::SimulatedNetworkOptions options;
    options.links = kOwners + 1;
    options.join_delay = join_delay;
    return options;
  }
  static peer::EntityDescription thing() {
    peer::EntityDescription thing;
    thing.type = {pdu::EntityKind::platform, pdu::EntityDomain::land, 225, 1, 0, 0, 0};
    thing.dead_reckoning.thresholds.position = 0.1;
    thing.dead_reckoning.heartbeat = 60s;
    return thing;
  }
  [[nodiscard]] peer::EntityTruth at(const Vector3d& place) const {
    peer::EntityTruth truth;
    truth.time = clock_.now();
    truth.position = place;
    return truth;
  }
  void join() {
    const std::size_t number = federates_.size();
    peer::FederateOptions options;
    options.name = "visit";
    options.scene = scene_;
    options.site = kSite;
    options.application = static_cast<std::uint16_t>(number + 1);
    federates_.push_back(std::make_unique<peer::Federate>(options, *links_[number], clock_,
                                                          static_cast<std::uint32_t>(number + 1)));
    federates_.back()->publish(peer::EntityClass{});
  }

  peer::SceneFile scene_;
  peer::ManualClock clock_;
  peer::SimulatedNetwork network_;
  std::vector<std::unique_ptr<LosingLink>> links_;
  std::vector<std::unique_ptr<peer::Federate>> federates_;
  peer::ObjectHandle car_{};
  Vector3d place_ = Vector3d::Zero();
};

const std::string kSquares = "scheme = \"square\"\ncell = 100\nradius = 150\n";
const std::string kHexagons = "scheme = \"hexagonal\"\ncell = 60\nradius = 150\n";
const std::string kTree =
    "scheme = \"quadtree\"\nradius = 150\npool = 64\n[aoim.quadtree]\nside = 8000\nleaves = "
    "\"3000 0333\"\n";
// A hall with a long road to the east, and a store behind its wall in the north.
const std::string kHouse = R"(scheme = "locales"
radius = 150
[[aoim.locale]]
name = "hall"
size = [40, 40, 0]
neighbours = "road"
[[aoim.locale]]
name = "road"
origin = [1520, 0, 0]
size = [3000, 40, 0]
[[aoim.locale]]
name = "store"
origin = [0, 40, 0]
size = [40, 40, 0]
)";

TEST(Visitors, NoLongerShowEntitiesTheyLeave) {
  for (const std::string& aoim :
       {kSquares, kHexagons, kTree, kHouse, kOwnTiers + kSquares, "leaders = true\n" + kSquares,
        "leaders = true\nhand_out = true\n" + kSquares, kTouchTier + kSquares}) {
    SCOPED_TRACE(aoim);
    Visit visit(aoim);
    visit.come({5, 0, 0});
    ASSERT_LT(visit.until_all(10s), 4.0);
    for (int round = 1; round <= 2; ++round) {
      visit.drive({100, 0, 0}, 40);
      EXPECT_EQ(visit.shown(), kAll) << "round " << round;
      visit.drive({200, 0, 0}, 40);
      EXPECT_EQ(visit.shown(), 0U) << "round " << round;
      visit.drive({3000, 0, 0}, 400);
      EXPECT_EQ(visit.shown(), 0U) << "round " << round;
      EXPECT_EQ(visit.removed, round * kAll) << "each is told once";
      visit.drive({200, 0, 0}, 400);
      EXPECT_EQ(visit.shown(), 0U) << "round " << round;
      visit.drive({100, 0, 0}, 20);
      EXPECT_EQ(visit.shown(), kAll) << "round " << round;
      EXPECT_EQ(visit.discovered, (round + 1) * kAll);
    }
  }
}

// The entities are received, but too far away to be shown.
TEST(Visitors, NeedNoIntroductionAfterAShortDistance) {
  Visit visit("pool = 1\n" + kSquares);
  visit.come({5, 0, 0});
  ASSERT_LT(visit.until_all(10s), 1.0);
  visit.pass(33s);  // states have been repeated after 1, 2, 4, 8 and 16 s
  const std::uint64_t sent = visit.sent_by_owners();
  visit.drive({190, 0, 0}, 20);
  EXPECT_EQ(visit.shown(), 0U);
  visit.drive({120, 0, 0}, 20);
  visit.pass(1s);
  EXPECT_EQ(visit.shown(), kAll);
  EXPECT_EQ(visit.count("entered"), kAll);
  EXPECT_EQ(visit.sent_by_owners(), sent);
}

TEST(Visitors, NoLongerShowEntitiesBehindAWall) {
  Visit visit(kHouse);
  visit.come({0, 19, 0});
  ASSERT_LT(visit.until_all(10s), 1.0);
  visit.pass(3s);
  visit.stand_at({0, 25, 0});  // through the wall, into the store
  visit.pass(3s);              // it stays a member for 2 s
  EXPECT_EQ(visit.shown(), 0U);
  visit.stand_at({0, 19, 0});
  visit.pass(300ms);
  EXPECT_EQ(visit.shown(), kAll);
}

TEST(Visitors, SeeAllWhereNothingIsFar) {
  Visit visit("pool = 1\nscheme = \"square\"\ncell = \"100 km\"\nradius = \"100 km\"\n");
  visit.come({5, 0, 0});
  ASSERT_LT(visit.until_all(10s), 1.0);
  visit.drive({3000, 0, 0}, 400);
  visit.drive({0, 0, 0}, 400);
  EXPECT_EQ(visit.shown(), kAll);
  EXPECT_EQ(visit.removed, 0U);
  EXPECT_EQ(visit.discovered, kAll);
}

const Vector3d kElsewhere(650, 0, 0);

// The port opens late: earlier datagrams are lost, and owners repeat them, or are asked again.
TEST(Visitors, BehindASlowSwitchGetRepeatedStates) {
  std::printf(
      "  a join takes | a newcomer sees all after | who arrives | who drives up at 20 m/s\n");
  for (const auto& [delay, limit] :
       {std::pair{0ms, 0.2}, {50ms, 0.5}, {200ms, 0.8}, {500ms, 1.2}, {1500ms, 2.3}}) {
    Visit start(kSquares, delay);
    start.come({5, 0, 0});
    const double after = start.until_all(90s);
    Visit arrive(kSquares, delay, 75s, kElsewhere);
    arrive.come(-kElsewhere);
    arrive.pass(35s, 10 * kLook);
    arrive.stand_at(kElsewhere);
    const double arrived = arrive.until_all(90s);
    Visit drive(kSquares, delay, 3s, kElsewhere);
    drive.come(-kElsewhere);
    drive.pass(4s);
    drive.drive(kElsewhere - Vector3d(134.5, 0, 0), 20);  // now the farthest is within the radius
    const double late = drive.until_all(90s);
    std::printf("  %9d ms | %23.2f s | %.2f s | %.2f s late\n", static_cast<int>(delay / 1ms),
                after, arrived, late);
    EXPECT_LT(after, limit);
    EXPECT_LT(arrived, limit);
    EXPECT_LT(late, limit);
  }
}

// One datagram of an arrival is lost.
struct Coming {
  const char* name;
  std::string aoim;
  bool arrives = false;  // arrives where it has received nothing yet; else starts there
  double away = 0.0;     // [m] from the centre of the entities at rest
};

// A visitor comes to entities long at rest; returns the time until it shows all [s].
double seen_all_after(const Coming& coming, std::size_t link, const OneLost& lost,
                      std::size_t& counted) {
  Visit visit(coming.aoim, 0ns, 75s, coming.arrives ? kElsewhere : Vector3d::Zero());
  const auto lose = [&] {
    OneLost at = lost;
    if (link < kOwners) at.from = peer::IpEndpoint::v4(0xc6120001 + kOwners, 3000);
    visit.link(link).lose(at);
  };
  if (coming.arrives) {
    visit.come(-kElsewhere);
    visit.pass(35s, 10 * kLook);
    lose();
    visit.stand_at(kElsewhere - Vector3d(coming.away, 0, 0));  // all at once
  } else {
    lose();
    visit.come({5, 0, 0});
  }
  const double after = visit.until_all(90s);
  counted = visit.link(link).counted();
  return after;
}

// A gate loses every fourth.
TEST(Visitors, ShowAllWithinASecondDespiteALoss) {
  constexpr std::size_t kMost = 60;
  const std::size_t step = tries<std::size_t>(4, 1);
  std::printf("  coming | datagrams lost in turn | sees all after, worst | by loss of\n");
  for (const Coming& coming :
       {Coming{"starts", kSquares},
        {"arrives", kSquares, true},
        {"starts, near groups", kOwnTiers + kSquares},
        {"arrives, near groups", kOwnTiers + kSquares, true},
        {"arrives far, near groups", kOwnTiers + kSquares, true, 120},
        {"starts, residual", kSquares + "[network]\ncompression = \"residual\"\n"},
        {"arrives, residual", kSquares + "[network]\ncompression = \"residual\"\n", true}}) {
    std::size_t runs = 0;
    double worst = 0.0;
    std::string by;
    for (std::size_t link = 0; link <= kOwners + 1; ++link) {
      const bool sends = link > kOwners;
      const std::size_t of = std::min(link, kOwners);
      std::size_t counted = kMost;
      for (std::size_t place = link % step; place < std::min(counted, kMost); place += step) {
        const OneLost lost{sends ? OneLost::Way::sent : OneLost::Way::received, {}, place};
        const double after = seen_all_after(coming, of, lost, counted);
        ++runs;
        if (after <= worst) continue;
        worst = after;
        by = (sends            ? "sent "
              : link < kOwners ? "at an owner "
                               : "at the newcomer ") +
             std::to_string(place);
      }
    }
    std::printf("  %s | %zu | %.2f s | %s\n", coming.name, runs, worst, by.c_str());
    EXPECT_LT(worst, 1.0) << coming.name;
  }
}

}  // namespace
}  // namespace reckon::test::visitor_test
