// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/delivery/delivery_study.hpp"

#include <gtest/gtest.h>

namespace reckon::bench {
namespace {

TEST(DeliveryStudy, AssuredInteractionsMeetTheirBars) {
  for (const auto& [loss, p99_ms, most] :
       {std::tuple{0.0, 3.0, 1.01}, {0.2, 10.0, 2.5}, {0.3, 15.0, 4.0}}) {
    const Deliveries found = measure_deliveries({loss, std::chrono::seconds(20), 3});
    EXPECT_EQ(found.sent, 1000U);
    EXPECT_EQ(found.missed, 0U) << loss;
    EXPECT_EQ(found.doubled, 0U) << loss;
    EXPECT_LE(found.p99_ms, p99_ms) << loss;
    EXPECT_LE(found.transmissions, most) << loss;
    EXPECT_NEAR(found.best_effort_lost, loss, 0.05);
    // Of a run of 20 s, chance alone changes this quantile by some 5 %.
    EXPECT_NEAR(found.age_p99_ms, found.age_without_p99_ms, 0.12 * found.age_without_p99_ms);
  }
}

}  // namespace
}  // namespace reckon::bench
