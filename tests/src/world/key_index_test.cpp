// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/world/key_index.hpp"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <utility>

#include "reckon/tests/support/allocation_guard.hpp"

namespace reckon::peer {
namespace {

/// Applies the same random operations to the index and a std::map; `range` limits the keys, so that
/// they repeat.
void expect_map(KeyIndex& index, std::uint64_t range, std::uint64_t stride, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<std::uint64_t> number(0, range - 1);
  std::map<std::uint64_t, std::uint32_t> map;
  for (std::uint32_t i = 0; i < 4000; ++i) {
    const std::uint64_t key = stride * number(random);
    if (i % 3 == 2) {
      index.erase(key);
      map.erase(key);
    } else {
      index.put(key, i);
      map[key] = i;
    }
    if (i % 97 != 0) continue;
    ASSERT_EQ(index.size(), map.size());
    for (std::uint64_t k = 0; k < range; ++k) {
      const auto known = map.find(stride * k);
      ASSERT_EQ(index.find(stride * k), known == map.end() ? KeyIndex::kNone : known->second);
    }
  }
}

TEST(KeyIndex, BehavesAsAMapBeyondItsRoom) {
  for (std::uint32_t seed = 1; seed <= 10; ++seed) {
    for (const std::size_t room : {0U, 1U, 7U, 64U}) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", room " << room);
      KeyIndex index(room);
      expect_map(index, 64, 1, seed);
    }
  }
}

TEST(KeyIndex, BehavesAsAMapWhenAllKeysCollide) {
  // Multiples of the inverse of the hash factor: all of them map to the first slots.
  constexpr std::uint64_t kInverse = 0xF1DE83E19937733DULL;
  static_assert(kInverse * 0x9E3779B97F4A7C15ULL == 1);
  KeyIndex index(64);
  expect_map(index, 64, kInverse, 3);
}

TEST(KeyIndex, FindsTheRestAfterMassErasureAndReinsertion) {
  KeyIndex index(400'000);
  for (int round = 0; round < 2; ++round) {
    for (std::uint64_t key = 0; key < 400'000; ++key) index.put(key * 7, key);
    for (std::uint64_t key = 0; key < 400'000; ++key) {
      if (key % 1000 != 0) index.erase(key * 7);
    }
    ASSERT_EQ(index.size(), 400u);
    for (std::uint64_t key = 0; key < 400'000; ++key)
      ASSERT_EQ(index.find(key * 7), key % 1000 == 0 ? key : KeyIndex::kNone);
  }
}

TEST(KeyIndex, AllocatesNothingWithinItsInitialRoom) {
  KeyIndex index(256);
  const reckon::test::AllocationGuard guard;
  for (std::uint64_t key = 1; key <= 5000; ++key) {
    index.put(key << 16, key);
    if (key >= 256) index.erase((key - 255) << 16);
  }
  EXPECT_EQ(guard.count(), 0U);
  EXPECT_EQ(index.room(), 256U);  // its initial reservation, which the guard does not see
  EXPECT_EQ(index.size(), 255U);
  EXPECT_EQ(index.find(5000U << 16), 5000U);
}

TEST(KeyIndex, IsAValue) {
  KeyIndex index(10);
  for (std::uint64_t key = 0; key < 700; ++key) index.put(key, key);
  KeyIndex copy = index;
  KeyIndex other(1);
  other = copy;
  index.put(3, 1000);
  copy.erase(4);
  for (std::uint64_t key = 0; key < 2000; ++key) other.put(key, key + 1);
  EXPECT_EQ(index.find(3), 1000U);
  EXPECT_EQ(index.find(4), 4U);
  EXPECT_EQ(copy.find(3), 3U);
  EXPECT_EQ(copy.find(4), KeyIndex::kNone);
  EXPECT_EQ(copy.size(), 699U);
  EXPECT_EQ(other.find(3), 4U);
  EXPECT_EQ(other.size(), 2000U);
  const KeyIndex moved = std::move(copy);
  EXPECT_EQ(moved.find(699), 699U);
}

TEST(KeyIndex, KeepsItsKeysAtEachGrowth) {
  KeyIndex index(5000);
  for (std::uint64_t key = 0; key < 20'000; ++key) {
    index.put(key << 20, key);
    if (key + 1 == 5000) {
      EXPECT_EQ(index.room(), 8192U);
    }
  }
  EXPECT_GE(index.room(), 20'000U);
  for (std::uint64_t key = 0; key < 20'000; ++key) ASSERT_EQ(index.find(key << 20), key);
}

}  // namespace
}  // namespace reckon::peer
