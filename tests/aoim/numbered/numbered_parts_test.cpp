// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <random>

#include "reckon/aoim/numbered/due_parts.hpp"
#include "reckon/aoim/numbered/missing_parts.hpp"

namespace reckon::aoim {
namespace {

TEST(NumberedParts, WholeArrivesThroughLossByRequests) {
  std::mt19937 random(7);
  for (const std::size_t parts : {1, 2, 63, 64, 65, 200, 4096}) {
    DueParts due;
    MissingParts missing;
    due.begin(parts);
    missing.begin(parts);
    std::size_t sent = 0, rounds = 0;
    while (missing.missing() > 0 && ++rounds < 100) {
      for (; due.left() > 0; ++sent) {
        const std::size_t part = due.take();
        if (random() % 100 < 30) continue;
        EXPECT_TRUE(missing.take(part));
      }
      std::size_t from = 0;
      do {
        const PartRequest request = missing.request(from);
        due.request(request);
        from = missing.behind(request);
      } while (from > 0);
      EXPECT_EQ(due.left(), missing.missing()) << "exactly what is missing is due";
    }
    EXPECT_EQ(missing.missing(), 0U) << parts << " parts";
    EXPECT_LE(sent, 2 * parts + 20) << "nothing is sent twice without a loss";
  }
}

TEST(NumberedParts, RefusePartsOutsideTheWhole) {
  DueParts due;
  MissingParts missing;
  due.begin(3);
  missing.begin(3);
  while (due.left() > 0) static_cast<void>(due.take());
  due.request({2, ~std::uint64_t{0}});
  EXPECT_EQ(due.left(), 1U);
  EXPECT_EQ(due.take(), 2U);
  due.request({1'000'000, 1});
  EXPECT_EQ(due.left(), 0U);
  EXPECT_FALSE(missing.take(3));
  EXPECT_TRUE(missing.take(1));
  EXPECT_FALSE(missing.take(1));
  EXPECT_EQ(missing.request(1).first, 2U) << "the request begins with a missing part";
  EXPECT_EQ(missing.request(900).parts, 0U);
}

}  // namespace
}  // namespace reckon::aoim
