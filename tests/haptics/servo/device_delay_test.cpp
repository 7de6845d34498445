// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A device with delay and encoder steps: its own ledger never has more energy out than in, and the
// servo's meter never exceeds it. RECKON_SOAK=1 tries 2,000 seeds of each.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>
#include <tuple>

#include "reckon/tests/haptics/support/servo_bench.hpp"
#include "reckon/tests/support/soak.hpp"

namespace reckon::haptics::device_delay_test {
namespace {

using Eigen::Vector3d;
using std::chrono::nanoseconds;

constexpr double kRoundOff = 1e-9;  // [J], of sums of some joules

// The objects that touch the hand.
enum class Against { leaps, wave, liar, wall, corner };

// One hand, its device and its opponent, all drawn from a seed.
class Trial {
 public:
  Trial(Against against, int delay, double resolution, int seed)
      : against_(against),
        random_(static_cast<unsigned>(seed)),
        amplitude_(0.004 + 0.01 * part()),
        frequency_(0.3 + 2 * part()),
        stiffness_(300 + 2700 * part()),
        every_(1 + static_cast<int>(20 * part())),
        device_(device(delay, resolution, seed), script()),
        servo_(device_, EffectPlan(scene(against)), config(seed)) {
    other_.id = {2, 1, 7};
    other_.model.kind = pdu::ForceModelKind::plane;
    other_.model.normal = -Vector3d::UnitX();
    other_.has_device = seed % 3 == 0;
    other_.epoch = 1;
  }

  void run(int steps) {
    for (int i = 0; i < steps; ++i) {
      const nanoseconds now = std::chrono::milliseconds(1000 + i);
      servo_.step(now);
      servo_.snapshots().update();
      judge();
      if (against_ <= Against::liar && i % every_ == 0) update(i, now);
    }
  }

  double least = 0;      // [J], of the device's own ledger with loan and encoder allowance
  double meter = -1e9;   // [J], largest excess of the meter over ledger and allowance
  double allowance = 0;  // [J]
  double felt = 0;       // [N], mean over the last quarter

 private:
  double part() { return std::abs(std::uniform_real_distribution<double>(-1, 1)(random_)); }

  SimulatedDeviceConfig device(int delay, double resolution, int seed) {
    SimulatedDeviceConfig config;
    config.delay_samples = delay;
    config.resolution = resolution;
    config.hand_stiffness = seed % 4 == 0 ? 0 : 300 * part();
    config.hand_damping = seed % 2 == 0 ? 3 * part() : 0;
    config.max_force = 30;
    config.max_speed = 20;
    config.start.x() = -0.01;
    return config;
  }
  HandScript script() {
    const double wave = 2 * std::numbers::pi * (0.5 + 4 * part()), far = 0.02 * part();
    return [=](double t) {
      HandTarget hand;
      hand.position = Vector3d(0.008 * std::min(1.0, 4 * t) + far * std::sin(wave * t),
                               0.5 * far * std::cos(0.7 * wave * t), 0);
      return hand;
    };
  }
  static Scene scene(Against against) {
    Scene scene;
    if (against < Against::wall) return scene;
    SceneObject object;
    object.effects.of<SpringDamper>().stiffness = 20'000;
    object.name = "wall";
    object.shape = PlaneShape{-Vector3d::UnitX()};
    scene.objects.push_back(object);
    if (against == Against::wall) return scene;
    object.name = "other";
    object.shape = PlaneShape{Vector3d(-0.3, -1, 0).normalized()};
    scene.objects.push_back(object);
    return scene;
  }
  static ServoConfig config(int seed) {
    ServoConfig config;
    config.probe_radius = 0;
    if (seed % 5 == 0) config.max_force_rate = 300;
    return config;
  }

  void update(int i, nanoseconds now) {
    const double wave = 2 * std::numbers::pi * frequency_;
    const double t = 1e-3 * i;
    const bool smooth = against_ == Against::wave;
    other_.state.algorithm =
        smooth ? pdu::DeadReckoningAlgorithm::fpw : pdu::DeadReckoningAlgorithm::static_;
    other_.state.position.x() = amplitude_ * (smooth ? std::sin(wave * t) : 2 * part() - 1);
    other_.state.velocity.x() = smooth ? amplitude_ * wave * std::cos(wave * t) : 0;
    other_.state_time = now;
    other_.model.k1 = smooth ? stiffness_ : 3000 * part();
    if (against_ == Against::liar) {
      other_.given_to_us += 0.05;
      other_.need = 0.06 * part();
      other_.model.k3 = part() < 0.3 ? 1e7 : 0;
      other_.model.damping = 2 * part();
    }
    other_.model.validity = 12;
    other_.valid_until = now + std::chrono::seconds(12);
    ++other_.version;
    servo_.contacts().write(bench::only(other_));
  }

  void judge() {
    const ServoSnapshot& s = servo_.snapshots().read();
    double transferred = 0;
    for (std::size_t i = 0; i < s.count; ++i) {
      transferred += s.contacts[i].received - s.contacts[i].given;
    }
    const double books = device_.port_work() + device_.damping_loss() + transferred;
    least = std::min(least, books + s.loan + s.encoder_allowance);
    meter = std::max(meter, s.port_energy - books - s.encoder_allowance);
    allowance = s.encoder_allowance;
  }

  Against against_;
  std::mt19937 random_;
  double amplitude_, frequency_, stiffness_;
  int every_;
  SimulatedDevice device_;
  ServoLoop servo_;
  RemoteHand other_;
};

using Cell = std::tuple<Against, int, double>;

class DeviceDelay : public testing::TestWithParam<Cell> {};

TEST_P(DeviceDelay, GivesNoMoreEnergyThanItsLedgerHas) {
  const auto [against, delay, resolution] = GetParam();
  const int tried = delay > 4 ? test::tries(4, 200) : test::tries(10, 2000);
  double least = 0, meter = -1e9, allowance = 0;
  for (int seed = 1; seed <= tried; ++seed) {
    Trial trial(against, delay, resolution, seed);
    trial.run(3000);
    ASSERT_GE(trial.least, -kRoundOff) << "seed " << seed;
    ASSERT_LE(trial.meter, kRoundOff) << "seed " << seed;
    least = std::min(least, trial.least);
    meter = std::max(meter, trial.meter);
    allowance = std::max(allowance, trial.allowance);
  }
  std::printf("%d seeds: least %.2g J, meter above the books by %.2g J, encoder allowed %.2g J\n",
              tried, least, meter, allowance);
}

INSTANTIATE_TEST_SUITE_P(OfUpdatesLiesAndWalls, DeviceDelay,
                         testing::Combine(testing::Values(Against::leaps, Against::wave,
                                                          Against::liar, Against::wall,
                                                          Against::corner),
                                          testing::Values(0, 1, 2, 3, 4, 16),
                                          testing::Values(0.0, 2e-6, 2e-5, 1e-4)));

}  // namespace
}  // namespace reckon::haptics::device_delay_test
