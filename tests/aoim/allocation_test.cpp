// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "reckon/aoim/area_of_interest_manager.hpp"
#include "reckon/tests/aoim/support/samples.hpp"
#include "reckon/tests/support/allocation_guard.hpp"

namespace reckon::aoim {
namespace {

using namespace test;

constexpr std::size_t kStates = 50;

/// A peer with moving entities and a second one that receives it, one step per millisecond.
class Pair {
 public:
  Pair() : a_({}, presence_of(1, 11)), b_({}, presence_of(2, 22)), record_(haptic_record(100.0F)) {
    for (std::size_t i = 0; i < kStates; ++i) {
      states_[i] = entity_state(static_cast<std::uint16_t>(i + 1));
    }
    a_.start(nanoseconds(0));
    b_.start(nanoseconds(0));
  }
  void step(int ms) {
    const nanoseconds now = milliseconds(ms);
    const double t = 1e-3 * ms;
    const Position centre{300.0 * std::cos(0.1 * t), 300.0 * std::sin(0.1 * t), 0.0};
    const Focus focus{centre, 30.0, 200.0};
    a_.listen(kCellTier, {&focus, 1}, now);
    b_.listen(kCellTier, {&focus, 1}, now);
    for (std::size_t i = 0; i < kStates; ++i) {
      const Position position{centre.x + static_cast<double>(i), centre.y, 0.0};
      const bool haptic = i == 0;
      if (!haptic && (ms + static_cast<int>(i)) % 33 != 0) continue;
      const auto records =
          haptic ? std::span<const std::byte>(record_) : std::span<const std::byte>();
      a_.send(kCellTier, StatePayload{states_[i], records}, position,
              haptic ? now : now + milliseconds(5));
      used_ += is_accepted(b_.sight().judge(position, 0.0, 1, true)) ? 1 : 0;
    }
    a_.step(now, [&](GroupIndex group, std::span<const std::byte> datagram) {
      b_.receive(group, datagram, now);
    });
    b_.step(now, [&](GroupIndex group, std::span<const std::byte> datagram) {
      a_.receive(group, datagram, now);
    });
    (void)a_.take_events();
    (void)b_.take_events();
  }
  const AreaOfInterestManager& b() const { return b_; }
  std::size_t used() const { return used_; }

 private:
  AreaOfInterestManager a_, b_;
  std::array<pdu::EntityState, kStates> states_;
  Octets record_;
  std::size_t used_ = 0;
};

TEST(AreaOfInterestManager, AllocatesNothingInSteadyState) {
  Pair pair;
  for (int ms = 0; ms < 100; ++ms) pair.step(ms);
  const reckon::test::AllocationGuard guard;
  for (int ms = 100; ms < 20000; ++ms) pair.step(ms);
  EXPECT_EQ(guard.count(), 0u);
  EXPECT_GT(pair.b().incoming(IncomingVerdict::use), 10000u);
  EXPECT_GT(pair.used(), 0u);
  EXPECT_EQ(pair.b().sequences().counts().lost, 0u);
}

}  // namespace
}  // namespace reckon::aoim
