// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/exchange/triple_buffer.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <thread>

namespace reckon::haptics {
namespace {

TEST(TripleBuffer, ShowsTheInitialValueUntilSomethingIsPublished) {
  TripleBuffer<int> buffer(7);
  EXPECT_FALSE(buffer.update());
  EXPECT_EQ(buffer.read(), 7);
}

TEST(TripleBuffer, GivesTheNewestOfManyPublicationsOnce) {
  TripleBuffer<int> buffer;
  for (int i = 1; i <= 5; ++i) buffer.write(i);
  EXPECT_TRUE(buffer.update());
  EXPECT_EQ(buffer.read(), 5);
  EXPECT_FALSE(buffer.update());
  EXPECT_EQ(buffer.read(), 5);
}

TEST(TripleBuffer, KeepsTheReadValueDuringLaterWrites) {
  TripleBuffer<int> buffer;
  buffer.write(1);
  buffer.update();
  for (int i = 2; i < 10; ++i) {
    buffer.write(i);
    EXPECT_EQ(buffer.read(), 1);
  }
}

TEST(TripleBuffer, NeverShowsATornOrOlderValue) {
  using Block = std::array<std::uint64_t, 64>;
  constexpr std::uint64_t kLast = 50000;
  TripleBuffer<Block> buffer(Block{});
  std::thread writer([&] {
    for (std::uint64_t i = 1; i <= kLast; ++i) {
      buffer.write_slot().fill(i);
      buffer.publish();
    }
  });
  std::uint64_t last = 0, torn = 0, backwards = 0;
  while (last < kLast) {
    if (!buffer.update()) continue;
    const Block& block = buffer.read();
    for (const std::uint64_t v : block) torn += v != block[0] ? 1 : 0;
    backwards += block[0] <= last ? 1 : 0;
    last = block[0];
  }
  writer.join();
  EXPECT_EQ(torn, 0u);
  EXPECT_EQ(backwards, 0u);
}

}  // namespace
}  // namespace reckon::haptics
