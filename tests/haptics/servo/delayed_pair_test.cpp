// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Two hands press and push each other over a bad line, each through a device with delay and encoder
// steps: energy is transferred, never copied, by the ledgers of either device and of both.
// RECKON_SOAK=1 tries 2,000 seeds of each.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <deque>
#include <numbers>
#include <random>
#include <tuple>
#include <utility>

#include "reckon/haptics/devices/simulated_device.hpp"
#include "reckon/haptics/passivity/energy_port.hpp"
#include "reckon/haptics/passivity/held_forces.hpp"
#include "reckon/haptics/servo/servo_loop.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/tests/support/soak.hpp"

namespace reckon::haptics::delayed_pair_test {
namespace {

using Eigen::Vector3d;
using std::chrono::nanoseconds;

constexpr double kRoundOff = 1e-9;        // [J], of sums of some joules
constexpr double kTotalRoundOff = 1e-12;  // [J], of a running total of some tenths of a joule
constexpr double kRadius = 0.02;          // [m], of each hand
constexpr int kSteps = 2000;

constexpr std::array kDelays{0, 1, 2, 3, 4, 16};           // [samples]
constexpr std::array kResolutions{0.0, 2e-6, 2e-5, 1e-4};  // [m]

struct DeviceStep {
  int delay = 0;          // [samples]
  double resolution = 0;  // [m]
};

// The energy results of a run.
struct Books {
  double least = 1e9;      // [J], of one device with loan and encoder allowance
  double least_sum = 1e9;  // [J], of both without the transfer between them
  double meter = -1e9;     // [J], largest excess of a meter over its device's ledger and allowance
  double received = -1e9;  // [J], largest excess of one's received energy over the other's given
                           // energy
  double transferred = 0;  // [J], largest amount given by one
  double shown = 0;        // [N], greatest force
  double allowance = 0;    // [J], largest allowance for the steps of one encoder

  void take(const Books& other) {
    least = std::min(least, other.least);
    least_sum = std::min(least_sum, other.least_sum);
    meter = std::max(meter, other.meter);
    received = std::max(received, other.received);
    transferred = std::max(transferred, other.transferred);
    shown = std::max(shown, other.shown);
    allowance = std::max(allowance, other.allowance);
  }
};

// One hand, its device and its servo.
struct Player {
  Player(const SimulatedDeviceConfig& config, HandScript script, const ServoConfig& servo_config)
      : device(config, std::move(script)), servo(device, EffectPlan(), servo_config) {}

  SimulatedDevice device;
  ServoLoop servo;
  RemoteHand told;                 // state of this hand as known to the other
  double given = 0, received = 0;  // [J], of the account with the other
};

// Two of them and the line between them, all drawn from a seed.
class PressedPair {
 public:
  PressedPair(DeviceStep first, int seed)
      : random_(static_cast<unsigned>(seed)),
        any_order_(seed % 4 == 0),
        cut_(seed % 5 == 0),
        delay_(0.08 * part()),
        loss_(0.3 * part()),
        period_(seed % 3 == 0 ? 20 : 1 + static_cast<int>(60 * part())),
        players_{player(0, first), player(1, seed % 2 == 0 ? first : any_device())} {
    RemoteHand hand;
    hand.state.algorithm = pdu::DeadReckoningAlgorithm::fpw;
    hand.model.kind = pdu::ForceModelKind::sphere;
    hand.model.radius = kRadius;
    hand.model.damping = seed % 3 == 1 ? 2 * part() : 0;
    hand.model.kinetic_friction = seed % 7 == 0 ? part() : 0;
    hand.model.static_friction = 1.5 * hand.model.kinetic_friction;
    hand.model.k3 = seed % 6 == 0 ? 1e7 * part() : 0;
    stiffness_ = 200 + 1800 * part();
    for (std::size_t i = 0; i < 2; ++i) {
      players_[i].told = hand;
      players_[i].told.id = {1, 1, static_cast<std::uint16_t>(i + 1)};
    }
  }

  const Books& run() {
    for (int step = 0; step < kSteps; ++step) {
      now_ = std::chrono::milliseconds(1000 + step);
      for (std::size_t i = 0; i < 2; ++i) {
        deliver(i);
        players_[i].servo.step(now_);
        players_[i].servo.snapshots().update();
      }
      judge();
      const bool silent = cut_ && step > 700 && step < 1600;
      for (std::size_t i = 0; i < 2; ++i) {
        if ((step + 7 * static_cast<int>(i)) % period_ == 0) send(i, silent);
      }
    }
    return books_;
  }

 private:
  struct Datagram {
    nanoseconds arrival;
    RemoteHand hand;
  };

  double part() { return std::uniform_real_distribution<double>(0, 1)(random_); }

  template <typename List>
  auto any_of(const List& list) {
    return list[static_cast<std::size_t>(part() * static_cast<double>(list.size()))];
  }
  DeviceStep any_device() {
    const int delay = any_of(kDelays);
    return {delay, any_of(kResolutions)};
  }

  // They are side by side along x and touch at rest.
  Player player(int side, DeviceStep step) {
    SimulatedDeviceConfig device;
    device.delay_samples = step.delay;
    device.resolution = step.resolution;
    device.mass = 0.05 + 0.2 * part();
    device.damping = 0.3 + 2 * part();
    device.hand_stiffness = 50 + 600 * part();
    device.hand_damping = 4 * part();
    device.max_force = 30;
    device.max_speed = 20;
    const double inwards = side == 0 ? 1 : -1;
    device.start.x() = inwards * -(kRadius + 0.01);
    const double press = 0.02 * part(), sweep = 0.02 * part(), across = 0.01 * part();
    const double wave = 2 * std::numbers::pi * (0.3 + 4 * part()), quick = 1 + 8 * part();
    const auto script = [=](double t) {
      HandTarget hand;
      hand.position.x() = inwards * (-(kRadius + 0.01) + (0.01 + press) * std::min(1.0, quick * t) +
                                     sweep * std::sin(wave * t));
      hand.position.y() = across * std::sin(0.7 * wave * t);
      return hand;
    };
    ServoConfig servo;
    servo.probe_radius = kRadius;
    return Player(device, script, servo);
  }

  // Stale updates are dropped, except on lines that pass on every update.
  void deliver(std::size_t to) {
    auto& line = lines_[to];
    for (auto it = line.begin(); it != line.end();) {
      if (it->arrival > now_) {
        ++it;
        continue;
      }
      if (any_order_ || it->hand.version > heard_[to]) {
        heard_[to] = std::max(heard_[to], it->hand.version);
        ContactSet set;
        set.count = 1;
        set.hands[0] = it->hand;
        players_[to].servo.contacts().write(set);
      }
      it = line.erase(it);
    }
  }

  void send(std::size_t from, bool silent) {
    Player& player = players_[from];
    const ServoSnapshot& s = player.servo.snapshots().read();
    RemoteHand& hand = player.told;
    hand.state.position = s.device;
    hand.state.velocity = s.device_velocity;
    hand.state_time = now_;
    hand.model.k1 = std::min(stiffness_, player.servo.remote_stiffness_limit()) * s.softening;
    hand.valid_until = now_ + std::chrono::milliseconds(720);  // twelve updates 60 ms apart
    hand.given_to_us = player.given;
    hand.need = s.count > 0 ? s.contacts[0].need : 0;
    hand.spring_need = s.count > 0 ? s.contacts[0].spring_need : 0;
    ++hand.version;
    if (silent || part() < loss_) return;
    lines_[1 - from].push_back({now_ + late(), hand});
    if (part() < 0.1) lines_[1 - from].push_back({now_ + 2 * late(), hand});  // duplicated
  }
  nanoseconds late() { return pdu::from_seconds(delay_ * (0.5 + part())); }

  void judge() {
    double sum = 0;
    for (Player& player : players_) {
      const ServoSnapshot& s = player.servo.snapshots().read();
      if (s.count > 0) {
        player.given = s.contacts[0].given;
        player.received = s.contacts[0].received;
      }
      const double own = player.device.port_work() + player.device.damping_loss();
      const double books = own + player.received - player.given;
      books_.least = std::min(books_.least, books + s.loan + s.encoder_allowance);
      books_.meter = std::max(books_.meter, s.port_energy - books - s.encoder_allowance);
      books_.transferred = std::max(books_.transferred, player.given);
      books_.shown = std::max(books_.shown, s.force.norm());
      books_.allowance = std::max(books_.allowance, s.encoder_allowance);
      sum += own + s.loan + s.encoder_allowance;
    }
    books_.least_sum = std::min(books_.least_sum, sum);
    for (std::size_t i = 0; i < 2; ++i) {
      books_.received = std::max(books_.received, players_[i].received - players_[1 - i].given);
    }
  }

  std::mt19937 random_;
  bool any_order_, cut_;
  double delay_;          // [s], +-50 % each
  double loss_;           // probability
  int period_;            // [steps], between two updates
  double stiffness_ = 0;  // [N/m], of both
  std::array<Player, 2> players_;
  std::array<std::deque<Datagram>, 2> lines_;
  std::array<std::uint32_t, 2> heard_{};
  nanoseconds now_{0};
  Books books_;
};

class DelayedPair : public testing::TestWithParam<std::tuple<int, double>> {};

// One device is the cell's; in every second run the other one is too, otherwise it is any.
TEST_P(DelayedPair, TakeNoMoreEnergyThanTheyPutIn) {
  const auto [delay, resolution] = GetParam();
  const int tried = delay > 4 ? test::tries(2, 200) : test::tries(10, 2000);
  Books all;
  for (int seed = 1; seed <= tried; ++seed) {
    PressedPair pair({delay, resolution}, seed);
    const Books books = pair.run();
    ASSERT_GE(books.least, -kRoundOff) << "seed " << seed;
    ASSERT_GE(books.least_sum, -kRoundOff) << "seed " << seed;
    ASSERT_LE(books.meter, kRoundOff) << "seed " << seed;
    ASSERT_LE(books.received, kTotalRoundOff) << "seed " << seed;
    all.take(books);
  }
  std::printf(
      "%d seeds: least %.2g J, of both %.2g J, meter above the books by %.2g J, most given %.2g J, "
      "peak %.1f N, encoder allowed %.2g J\n",
      tried, all.least, all.least_sum, all.meter, all.transferred, all.shown, all.allowance);
  // They do push each other. With 16 samples of delay they render some 30 N/m, and few of them give
  // anything.
  if (tried >= 10) {
    EXPECT_GT(all.transferred, 1e-4);
  }
}

INSTANTIATE_TEST_SUITE_P(OverBadLines, DelayedPair,
                         testing::Combine(testing::ValuesIn(kDelays),
                                          testing::ValuesIn(kResolutions)));

// The hand takes the maximum energy of each force that arrives at the handle, while others request
// all that there is: the port covers an earlier force until it has left the handle.
TEST(ForcesUnderWay, AreCoveredWhileOthersRequestAllEnergy) {
  constexpr double kDamping = 1, kPeriod = 1e-3;
  for (const int delay : {0, 1, 2, 3, 4, 16}) {
    EnergyPort port(kDamping, delay);
    HeldForces held(delay);
    PortLoad load;
    load.springs.x() = 2;
    load.stored = 0.01;
    Vector3d chosen = Vector3d::Zero();
    port.credit(0.03);
    double least = 1e9;
    for (int step = 0; step < 2 * delay + 3; ++step) {
      const bool emptied = step > delay;
      held.write(chosen);
      const double taken = emptied ? kPeriod / (2 * kDamping) : 0;  // [m/N], the most
      port.settle(taken * held.at_handle(), kPeriod);
      least = std::min(least, port.level());
      if (emptied) port.give(1);
      chosen = port.hold(emptied ? PortLoad{} : load, kPeriod).force;
    }
    EXPECT_GE(least, -kTotalRoundOff) << delay << " samples";
  }
}

}  // namespace
}  // namespace reckon::haptics::delayed_pair_test
