// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Whole peers on hosts whose clocks differ, drift and leap: no shown pose jumps.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "reckon/deadreckon/motion/geocentric.hpp"
#include "reckon/deadreckon/wire_conversion.hpp"
#include "reckon/pdu/reckon/time_exchange.hpp"
#include "reckon/pdu/timestamp.hpp"
#include "reckon/tests/support/in_process.hpp"
#include "reckon/tests/support/soak.hpp"

namespace reckon::test {
namespace {

using std::chrono::microseconds;

// The moving hand and the receiving one do not touch, so that two runs differ only by time.
std::string two_hands_apart() {
  return with(
      with(kTwoHandsOnAWall, "position = [0.015, 0.0, 0.001]", "position = [0.5, 0.0, 0.001]"),
      "pool = 16", "pool = 16\nradius = \"100 m\"");
}

peer::ImpairmentLaw usual_network() {
  peer::ImpairmentLaw law;
  law.delay = milliseconds(20);
  law.jitter = milliseconds(5);
  law.loss = 0.05;
  return law;
}

// Two peers over the same network as in every other run.
class Hosts : public testing::Test {
 protected:
  Hosts() : scene_(scene_of(two_hands_apart())) {}

  void begin(InProcess& world) {
    world.network().impair(usual_network());
    world.start(0, scene_);
    world.start(1, scene_);
  }
  // The first peer's hand as shown by the second peer.
  static const peer::RemoteEntity* row(InProcess& world) {
    const auto rows = world.peer(1).model().remote().rows();
    return rows.empty() ? nullptr : &rows[0];
  }
  static Eigen::Vector3d shown(InProcess& world) {
    return row(world)->shown(world.clock().now()).position;
  }
  // Error of the time of the newest update; `ahead` is the offset of the first peer's UTC.
  static double time_error(InProcess& world, nanoseconds ahead) {
    const nanoseconds utc = world.clock().utc_now() + ahead;
    const nanoseconds age = utc - pdu::nearest_instant(row(world)->timestamp, utc);
    const nanoseconds given = world.clock().now() - row(world)->state_time;
    return 1e-9 * static_cast<double>((given - age).count());
  }

  peer::SceneFile scene_;
};

// 0.8 s apart and drifting by 50 ppm, both declaring UTC. Trusting them would show the hand 0.8 s
// wrong: some 80 mm.
TEST_F(Hosts, WithDriftingClocksShowTheSameAsOthers) {
  const int steps = tries(60'000, 120'000);
  for (const auto ahead : {milliseconds(800), milliseconds(-800)}) {
    InProcess alike(2), apart(2);
    apart.set_host_clock(0, ahead, 50e-6);
    begin(alike);
    begin(apart);
    double off = 0.0, late = 0.0;
    for (int i = 0; i < steps; ++i) {
      alike.run(1);
      apart.run(1);
      if (i < 5000) continue;
      ASSERT_NE(row(apart), nullptr);
      off = std::max(off, (shown(alike) - shown(apart)).norm());
      const nanoseconds now_ahead = apart.host_utc(0) - apart.clock().utc_now();
      if (i % 10 == 0) late = std::max(late, std::abs(time_error(apart, now_ahead)));
    }
    std::printf("hosts %+.1f s and 50 ppm apart: shown %.2f mm from hosts alike, times %.2f ms\n",
                1e-3 * static_cast<double>(ahead.count()), 1e3 * off, 1e3 * late);
    EXPECT_LT(late, 0.005) << "the jitter";
    EXPECT_LT(off, 0.001);
    EXPECT_EQ(apart.count(1, "sender_leaps"), 0u);
    EXPECT_GT(apart.count(1, "time_exchanges"), static_cast<unsigned>(steps) / 1500);
    EXPECT_EQ(apart.count(1, "time_exchanges_refused"), 0u);
  }
}

TEST_F(Hosts, WithA10SecondLeapShowNoJump) {
  for (const std::size_t link : {std::size_t{0}, std::size_t{1}}) {
    InProcess still(2), leaping(2);
    begin(still);
    begin(leaping);
    double off = 0.0;
    std::array<double, 2> step{};
    std::array<Eigen::Vector3d, 2> last;
    for (int i = 0; i < 60'000; ++i) {
      if (i == 20'000) leaping.set_host_clock(link, seconds(10));
      if (i == 30'000) leaping.set_host_clock(link, nanoseconds(0));
      if (i == 40'000) leaping.set_host_clock(link, seconds(-10));
      if (i == 50'000) leaping.set_host_clock(link, nanoseconds(0));
      still.run(1);
      leaping.run(1);
      if (i < 1000) continue;
      ASSERT_NE(row(leaping), nullptr);
      const std::array<Eigen::Vector3d, 2> now{shown(still), shown(leaping)};
      off = std::max(off, (now[0] - now[1]).norm());
      for (std::size_t k = 0; k < 2 && i > 1000; ++k) {
        step[k] = std::max(step[k], (now[k] - last[k]).norm());
      }
      last = now;
      EXPECT_LT(leaping.clock().now() - row(leaping)->last_heard,
                leaping.clock().now() - row(still)->last_heard + milliseconds(300));
    }
    std::printf(
        "leaps of host %zu: shown %.3f mm from a host that does not; largest step in 1 ms "
        "%.4f mm, %.4f without leaps\n",
        link, 1e3 * off, 1e3 * step[1], 1e3 * step[0]);
    EXPECT_LT(off, 0.002);
    EXPECT_LT(step[1], 1.2 * step[0]);
    EXPECT_EQ(leaping.count(link, "clock_leaps"), 4u);
    EXPECT_EQ(leaping.count(1 - link, "clock_leaps"), 0u);
    EXPECT_EQ(leaping.count(1, "sender_leaps"), 0u) << "what is on the wire does not leap";
    const auto said = leaping.notices(link);
    EXPECT_EQ(std::count(said.begin(), said.end(), "this host's clock leapt by +10.000 s"), 2);
  }
}

// While a peer does not follow its host's clock, it does not declare its time UTC.
TEST_F(Hosts, SendRelativeTimeAfterALeap) {
  InProcess world(2);
  world.listen(scene_);
  world.start(0, scene_);
  world.run(2000);
  world.set_host_clock(0, seconds(10));
  world.run(2000);
  world.heard().clear();
  world.run(8000);
  const auto states = world.heard_pdus<pdu::EntityState>();
  const auto trailers = world.heard_pdus<pdu::DatagramTrailer>();
  ASSERT_FALSE(states.empty());
  ASSERT_FALSE(trailers.empty());
  for (const auto& state : states) EXPECT_FALSE(pdu::is_absolute(state.header.timestamp));
  for (const auto& trailer : trailers) EXPECT_FALSE(pdu::is_absolute(trailer.header.timestamp));
}

TEST_F(Hosts, ExchangeTimesAtOnceAndThenEverySecond) {
  InProcess world(2);
  world.listen(scene_);
  begin(world);
  world.run(300);
  EXPECT_GE(world.count(0, "time_exchanges"), 1u);
  EXPECT_GE(world.count(1, "time_exchanges"), 1u);
  world.run(1'700);  // a new peer announces itself more often
  world.heard().clear();
  world.run(10'000);
  const auto exchanges = world.heard_pdus<pdu::TimeExchange>();
  EXPECT_GE(exchanges.size(), 18u);  // 9 to 11 of each, depending on the window
  EXPECT_LE(exchanges.size(), 22u);
  for (const Heard& datagram : world.heard()) {
    std::array<bool, 256> types{};
    for (const pdu::BundledPdu& pdu : pdu::BundleReader(datagram.octets)) {
      types[static_cast<std::size_t>(pdu.header.pdu_type)] = true;
    }
    EXPECT_EQ(types[143], types[140]) << "no datagram more than without them";
  }
}

// A plain DIS vehicle at 20 m/s with absolute time whose own host leaps: this time on the wire.
TEST_F(Hosts, OfPlainDisThatLeapMakeNoJump) {
  InProcess world(1);
  world.network().impair(usual_network());
  world.start(0, scene_);
  const deadreckon::LocalFrame frame(scene_.origin.latitude, scene_.origin.longitude,
                                     scene_.origin.height);
  world.run(100);
  nanoseconds ahead{0}, longest{0};
  double jump = 0.0, error = 0.0;
  Eigen::Vector3d last = Eigen::Vector3d::Zero();
  for (int i = 0; i < 60'000; ++i) {
    if (i == 20'000) ahead = seconds(10);
    if (i == 40'000) ahead = nanoseconds(0);
    const double angle = 2.0 * 1e-3 * i;  // 20 m/s on a circle of 10 m
    const Eigen::Vector3d place(10 * std::cos(angle), 10 * std::sin(angle), 0.0);
    if (i % 100 == 0) {
      deadreckon::KinematicState state;
      state.position = place;
      state.velocity = {-20 * std::sin(angle), 20 * std::cos(angle), 0.0};
      state.acceleration = {-40 * std::cos(angle), -40 * std::sin(angle), 0.0};
      state.algorithm = pdu::DeadReckoningAlgorithm::fvw;
      pdu::EntityState pdu;
      pdu.header.exercise_id = scene_.network.exercise;
      pdu.entity_id = {5, 5, 5};
      pdu.entity_type.kind = pdu::EntityKind::platform;
      pdu.header.timestamp = pdu::to_dis_timestamp(world.clock().utc_now() + ahead, true);
      ASSERT_EQ(to_wire(state, frame, pdu), deadreckon::ConversionError::none);
      world.say(pdu, scene_);
    }
    world.run(1);
    const auto rows = world.peer(0).model().remote().rows();
    if (i < 1000) continue;
    ASSERT_EQ(rows.size(), 1u);
    const nanoseconds now = world.clock().now();
    const Eigen::Vector3d shown = rows[0].shown(now).position;
    longest = std::max(longest, now - rows[0].last_heard);
    if (i > 1000) jump = std::max(jump, (shown - last).norm());
    error = std::max(error, (rows[0].predicted(now).position - place).norm());
    last = shown;
  }
  std::printf(
      "leaps on the wire, 20 m/s on a circle: largest step %.1f mm in 1 ms, predicted within "
      "%.2f m, longest without an update %.2f s\n",
      1e3 * jump, error, 1e-9 * static_cast<double>(longest.count()));
  EXPECT_EQ(world.count(0, "sender_leaps"), 2u);
  EXPECT_LT(longest, milliseconds(1000));
  EXPECT_LT(jump, 0.03) << "20 mm are its own";
  EXPECT_LT(error, 1.2) << "0.4 s beyond the last update: 80 m/s^3 t^3 / 6";
}

}  // namespace
}  // namespace reckon::test
