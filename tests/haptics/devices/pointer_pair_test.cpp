// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A hand moved by a pointer, and another hand, over a network: two servos in simulated time.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>

#include "reckon/haptics/devices/pointer_device.hpp"
#include "reckon/tests/haptics/support/hands_in_a_row.hpp"
#include "reckon/tests/haptics/support/pointer_play.hpp"
#include "reckon/tests/support/soak.hpp"

namespace reckon::haptics::pointer_pair_test {
namespace {

using Eigen::Vector3d;

constexpr double kPassive = -1e-9;  // [J]
constexpr double kTouch = 0.04;     // [m], between two hands that touch
constexpr double kOverlap = 0.02;   // [m], of the goals of both

/// The first hand follows a pointer; in every other seed the second one does too, otherwise it
/// approaches and presses.
class PointerPair {
 public:
  explicit PointerPair(unsigned seed)
      : row_(hands(seed % 2 == 0), line(seed), seed),
        plays_{PointerPlay(seed), PointerPlay(~seed)} {}

  void play(int ms) {
    for (int i = 0; i < ms; ++i) {
      for (std::size_t hand = 0; hand < 2; ++hand) {
        if (pointers_[hand] == nullptr) continue;
        plays_[hand].at(i, [&](const PointerSample& s) { pointers_[hand]->inbox().put(s); });
      }
      step();
    }
  }
  /// Pointers rest, the second one at its start.
  void hold(const Vector3d& first, int ms) {
    for (int i = 0; i < ms; ++i) {
      if (i % 16 == 0) pointers_[0]->inbox().put({first, true});
      if (i % 16 == 0 && pointers_[1] != nullptr) pointers_[1]->inbox().put({second_wants(), true});
      step();
    }
  }

  [[nodiscard]] HandsInARow& row() { return row_; }
  [[nodiscard]] double least() const { return least_; }
  [[nodiscard]] double peak() const { return peak_; }
  [[nodiscard]] bool finite() const { return finite_; }
  /// Final position of the second hand without contact.
  [[nodiscard]] Vector3d second_wants() const {
    return {kTouch - (pointers_[1] == nullptr ? kOverlap : 0.0), 0, 0};
  }

 private:
  static RowLine line(unsigned seed) {
    constexpr std::array kDelays{0.0, 0.02, 0.1};
    RowLine line;
    line.delay = kDelays[seed % 3];
    line.loss = seed % 5 == 0 ? 0.0 : 0.2;
    return line;
  }

  RowHands hands(bool both) {
    RowHands hands;
    hands.friction = 0.3;
    hands.target = [](std::size_t hand, double t) {
      return hand == 1 ? -kOverlap * smooth(2 * t) : 0.0;
    };
    hands.make = [this, both](std::size_t hand, const SimulatedDeviceConfig& config) {
      if (hand == 1 && !both) return std::unique_ptr<SimulatedDevice>();
      auto made = std::make_unique<PointerDevice>(config, 0.5);
      pointers_[hand] = made.get();
      return std::unique_ptr<SimulatedDevice>(std::move(made));
    };
    return hands;
  }

  void step() {
    row_.step();
    double sum = 0;
    for (std::size_t hand = 0; hand < 2; ++hand) {
      const SimulatedDevice& device = row_.device(hand);
      const ServoSnapshot& s = row_.snapshot(hand);
      const double port = device.port_work() + device.damping_loss();
      double transferred = 0;
      for (std::size_t i = 0; i < s.count; ++i)
        transferred += s.contacts[i].received - s.contacts[i].given;
      least_ = std::min(least_, port + transferred + s.loan);
      sum += port + s.loan;
      peak_ = std::max(peak_, device.force().norm());
      finite_ = finite_ && device.position().allFinite() && s.force.allFinite();
    }
    least_ = std::min(least_, sum);
  }

  std::array<PointerDevice*, 2> pointers_{};  // owned by row_
  HandsInARow row_;
  std::array<PointerPlay, 2> plays_;
  double least_ = 0, peak_ = 0;
  bool finite_ = true;
};

TEST(PointerPair, MakesNoEnergyBetweenTwoHands) {
  double least = 0, peak = 0, least_felt = 1e9;
  for (unsigned seed = 1; seed <= test::tries(150U, 1000U); ++seed) {
    PointerPair pair(seed);
    pair.play(1500);
    ASSERT_GE(pair.least(), kPassive) << "seed " << seed;
    ASSERT_LE(pair.peak(), 10.0 + 1e-9) << "seed " << seed;
    ASSERT_TRUE(pair.finite()) << "seed " << seed;

    // It still works: it moves away from the other hand. In every seventh seed it returns and
    // presses, for the time that energy needs both ways on the worst line.
    const Vector3d other = pair.second_wants();
    const Vector3d away = (pair.row().device(0).position() - other).normalized();
    pair.hold(other + 0.15 * away, 1300);
    ASSERT_LE((pair.row().device(0).position() - other - 0.15 * away).norm(), 1e-4)
        << "seed " << seed;
    if (seed % 7 == 0) {
      pair.hold(other + kOverlap * away, 3000);
      least_felt = std::min({least_felt, pair.row().felt(0), pair.row().felt(1)});
    }
    ASSERT_GE(pair.least(), kPassive) << "seed " << seed;
    least = std::min(least, pair.least());
    peak = std::max(peak, pair.peak());
  }
  std::printf("least %.2g J, most %.2f N; then each hand feels %.2f N at least\n", least, peak,
              least_felt);
  EXPECT_GT(least_felt, 0.5);
}

}  // namespace
}  // namespace reckon::haptics::pointer_pair_test
