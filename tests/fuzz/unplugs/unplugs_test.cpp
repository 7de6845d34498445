// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Some seeds of the storm of unplugs; `./run fuzz unplugs` runs thousands.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <tuple>
#include <utility>

#include "reckon/tests/fuzz/search/seeded_test.hpp"
#include "reckon/tests/fuzz/unplugs/trial.hpp"

namespace reckon::fuzz::unplugs {
namespace {

// Seeds that the verb does not try first, four for each kind of device. Each has 100 faults, most
// of them unplugs.
constexpr std::uint64_t kFirst = 1'000'654, kSeeds = 20;

TEST(Unplugs, LeaveNoForceUntilSetupIsRepeated) {
  std::array<std::uint64_t, kDeviceKinds> seeds{}, pulled{}, pressed{};
  expect_holds(kSimulation, kFirst, kSeeds, [&](const Plan& plan, const Outcome& outcome) {
    const auto kind = static_cast<std::size_t>(plan.device);
    ++seeds[kind];
    pulled[kind] += outcome.received;
    pressed[kind] += outcome.pressed;
  });
  for (std::size_t kind = 0; kind < kDeviceKinds; ++kind) {
    SCOPED_TRACE(kind);
    EXPECT_EQ(seeds[kind], kSeeds / kDeviceKinds);
    EXPECT_GT(pulled[kind], 70 * seeds[kind]);
    EXPECT_GT(pressed[kind], 4 * seeds[kind]) << "unplugged under a force";
  }
}

TEST(Unplugs, RunTheSameFromTheSameSeed) {
  std::array<bool, kDeviceKinds> is_tried{};
  for (std::uint64_t seed = 1; std::ranges::count(is_tried, false) > 0; ++seed) {
    if (!std::exchange(is_tried[static_cast<std::size_t>(plan_of(seed).device)], true))
      expect_same_again(kSimulation, seed);
  }
  EXPECT_NE(try_out(plan_of(1)).hash, try_out(plan_of(2)).hash);
}

TEST(UnplugsPlan, DrawsEveryFaultInEveryPhase) {
  std::map<std::tuple<DeviceKind, FaultKind, Phase>, unsigned> drawn;
  for (std::uint64_t seed = 1; seed <= 1'000; ++seed) {
    const Plan plan = plan_of(seed);
    for (const Fault& fault : plan.faults) ++drawn[{plan.device, fault.kind, fault.phase}];
  }
  for (const DeviceKind device : {DeviceKind::falcon, DeviceKind::polhem, DeviceKind::serial_board,
                                  DeviceKind::event_device, DeviceKind::hid_device}) {
    for (const FaultKind kind : faults_of(device)) {
      for (const Phase phase :
           {Phase::any, Phase::opening, Phase::setting_up, Phase::homing, Phase::running}) {
        if (phase == Phase::homing && renders_springs(device)) continue;
        EXPECT_GT((drawn[{device, kind, phase}]), 20U) << text_of(Fault{kind, phase});
      }
    }
  }
}

}  // namespace
}  // namespace reckon::fuzz::unplugs
