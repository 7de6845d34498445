// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Outages of random length and delay, during which a felt hand leaves or stays. RECKON_SOAK=1 runs
// 200 of each.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <string>

#include "reckon/pdu/seconds.hpp"
#include "reckon/tests/support/in_process.hpp"
#include "reckon/tests/support/soak.hpp"

namespace reckon::test {
namespace {

// One hand comes and presses against another, with 10 mm across springs and grips.
constexpr std::string_view kPress = R"(
[scene]
name = "outage"
origin = {latitude = "47.05 deg", longitude = "8.31 deg", height = "430 m"}

[hand]
radius = "10 mm"
k1 = "300 N/m"

[aoim]
pool = 16

[[operator]]
position = [-0.1, 0.0, 0.0]
passive = true

[[operator]]
passive = true
position = [0.010, 0.0, 0.0]
stiffness = "150 N/m"
)";

constexpr double kAway = 0.1;  // [m], from the place where it presses
// Two grips and the spring between them in series [N]; the first grip is the default one.
constexpr double kRight = 0.010 / (1 / 300.0 + 1 / 300.0 + 1 / 150.0);
constexpr double kGoes = 0.15;      // [s], to leave or to come
constexpr double kPressed = 2.5;    // [s], from the start; the press is at rest by then
constexpr double kUnfelt = 1e-9;    // [N]
constexpr double kHeartbeat = 5.6;  // [s], of a resting hand, plus a margin

int outages() { return test::tries(8, 200); }

// The random values; times in seconds from the start.
struct Cut {
  double begin, length, delay, leave;
};

Cut cut_of(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto between = [&](double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(random);
  };
  Cut cut{};
  cut.begin = between(kPressed, kPressed + 1.0);
  // Outages that end about when hands in contact are doubted, about when whole peers are, and
  // longer ones are equally frequent.
  const double shortest = 0.55;
  const std::array<double, 3> longest{0.7, 2.5, 8.0};
  cut.length = between(shortest, longest[seed % longest.size()]);
  cut.delay = between(0.0003, 0.05);
  cut.leave = cut.begin + between(0.0, cut.length - kGoes - 0.05);
  return cut;
}

haptics::HandScript script_of(double leave) {
  return [leave](double time) {
    const double come = std::clamp((time - 0.5) / kGoes, 0.0, 1.0);
    const double go = std::clamp((time - leave) / kGoes, 0.0, 1.0);
    haptics::HandTarget target;
    target.position.x() = -kAway * (1.0 - come + go);
    return target;
  };
}

class CutOff {
 public:
  CutOff(const Cut& cut, double leave)
      : cut_(cut), scene_(scene_of(kPress)), world_(2), steps_(64) {
    peer::ImpairmentLaw law;
    law.delay = pdu::from_seconds(cut.delay);
    law.outages = {{pdu::from_seconds(cut.begin), pdu::from_seconds(cut.length)}};
    world_.network().impair(law);
    world_.move_by(0, script_of(leave));
    world_.start(0, scene_);
    world_.start(1, scene_);
    world_.peer(1).trace(&steps_);
  }

  // Runs one millisecond; returns the force of the first hand on the second at its end [N].
  double step() {
    world_.run(1);
    for (; const haptics::ServoSnapshot* servo = steps_.front(); steps_.pop()) {
      felt_ = 0.0;
      for (std::size_t i = 0; i < servo->count; ++i)
        felt_ += servo->contacts[i].force.norm() + servo->contacts[i].damper_force.norm();
      least_ = std::min(least_, servo->port_energy_min);
    }
    return felt_;
  }
  void run_to(double time) {
    while (now() < time) static_cast<void>(step());
  }
  // Runs until the first datagram after the outage has been processed, and the servo has stepped
  // with it.
  void run_to_first_word() {
    run_to(cut_.begin + cut_.length);
    const std::uint64_t before = world_.count(1, "datagrams_in");
    while (world_.count(1, "datagrams_in") == before) static_cast<void>(step());
    for (int i = 0; i < 2; ++i) static_cast<void>(step());
  }
  [[nodiscard]] double now() const { return 1e-3 * static_cast<double>(world_.steps()); }
  [[nodiscard]] double felt() const { return felt_; }
  [[nodiscard]] double least_energy() const { return least_; }
  // Whether the first hand's state has arrived since the outage.
  [[nodiscard]] bool is_news() {
    const auto rows = world_.peer(1).model().remote().rows();
    return !rows.empty() &&
           rows.front().last_heard > begin_ + pdu::from_seconds(cut_.begin + cut_.length);
  }

 private:
  Cut cut_;
  peer::SceneFile scene_;
  InProcess world_;
  nanoseconds begin_ = world_.clock().now();
  haptics::TraceRing steps_;
  double felt_ = 0.0;
  double least_ = 0.0;
};

std::string text_of(std::uint64_t seed, const Cut& cut) {
  return "seed " + std::to_string(seed) + ": " + std::to_string(cut.length) + " s from " +
         std::to_string(cut.begin) + " s on, gone at " + std::to_string(cut.leave) + " s, delay " +
         std::to_string(1e3 * cut.delay) + " ms";
}

// A hand that leaves during the outage is not felt after the first datagram, whether its departure
// is known or not.
void expect_no_ghost(const Cut& cut) {
  CutOff run(cut, cut.leave);
  run.run_to(cut.begin);
  ASSERT_GT(run.felt(), 0.5);
  run.run_to_first_word();
  int ghost_ms = 0;
  const double heard = run.now();
  for (double felt = run.felt(); !run.is_news(); felt = run.step()) {
    ghost_ms += felt > kUnfelt ? 1 : 0;
    ASSERT_LT(run.now(), heard + kHeartbeat);
  }
  EXPECT_EQ(ghost_ms, 0);
  run.run_to(run.now() + 0.05);
  EXPECT_EQ(run.felt(), 0.0);
  EXPECT_GE(run.least_energy(), -1e-9);
}

TEST(Outage, DepartedHandIsNotFeltAfterwards) {
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(outages()); ++seed) {
    const Cut cut = cut_of(seed);
    SCOPED_TRACE(text_of(seed, cut));
    expect_no_ghost(cut);
  }
}

// Too short for a doubt, and its peer announces itself before the hand's next state.
TEST(Outage, DepartedHandIsUnfeltAfterAnyFirstDatagram) {
  for (const Cut& cut : {Cut{2.528, 0.562, 0.0019, 2.679}, Cut{3.497, 0.586, 0.0497, 3.631}}) {
    SCOPED_TRACE(text_of(0, cut));
    expect_no_ghost(cut);
  }
}

TEST(Outage, StayingHandIsFeltAgain) {
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(outages()); ++seed) {
    const Cut cut = cut_of(seed);
    SCOPED_TRACE(text_of(seed, cut));
    CutOff run(cut, 1e9);
    run.run_to(cut.begin);
    ASSERT_GT(run.felt(), 0.5);
    run.run_to_first_word();
    run.run_to(run.now() + 2.0);
    EXPECT_NEAR(run.felt(), kRight, 0.1 * kRight);
    EXPECT_GE(run.least_energy(), -1e-9);
  }
}

}  // namespace
}  // namespace reckon::test
