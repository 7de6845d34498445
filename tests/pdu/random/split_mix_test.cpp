// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/pdu/random/split_mix.hpp"

#include <gtest/gtest.h>

namespace reckon::pdu {
namespace {

// The first outputs of the authors' generator for seed 1234567; other implementations print the
// same.
TEST(SplitMix, EqualsTheReferenceImplementation) {
  std::uint64_t state = 1234567;
  for (const std::uint64_t draw : {6457827717110365317U, 3203168211198807973U, 9817491932198370423U,
                                   4593380528125082431U, 16408922859458223821U}) {
    EXPECT_EQ(split_mix(state), draw);
    state += kGoldenStep;
  }
}

TEST(SplitMix, OutputFunctionMapsZeroToZero) { EXPECT_EQ(mixed_bits(0), 0U); }

TEST(SplitMix, GivesNumbersFromZeroToBelowOne) {
  EXPECT_EQ(unit_of(0), 0.0);
  EXPECT_LT(unit_of(~std::uint64_t{0}), 1.0);
  EXPECT_EQ(unit_of(std::uint64_t{1} << 63), 0.5);
}

}  // namespace
}  // namespace reckon::pdu
