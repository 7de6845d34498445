// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/world/due_column.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <vector>

#include "reckon/tests/support/allocation_guard.hpp"

namespace reckon::peer {
namespace {

using std::chrono::nanoseconds;

// The places that a pass finds; each becomes due again after `later`.
std::vector<std::size_t> found_in(DueColumn& dues, nanoseconds now, nanoseconds later) {
  std::vector<std::size_t> found;
  for (std::size_t i = dues.next_due(now, 0); i < dues.size(); i = dues.next_due(now, i)) {
    found.push_back(i);
    dues.set(i, later);
  }
  return found;
}

// Applies the same random operations to the column and a plain vector.
void expect_vector(std::uint32_t seed, std::size_t rows) {
  std::mt19937 random(seed);
  const auto below = [&](std::size_t n) { return random() % n; };
  DueColumn dues(rows);
  std::vector<nanoseconds> plain;
  nanoseconds now(0);
  for (int i = 0; i < 20'000; ++i) {
    const nanoseconds due = now + nanoseconds(static_cast<int>(below(400)) - 100);
    if (const auto what = below(4); what < 2 && plain.size() < rows) {
      dues.push(due);
      plain.push_back(due);
    } else if (what == 2 && !plain.empty()) {
      const std::size_t place = below(plain.size());
      dues.set(place, due);
      plain[place] = due;
    } else if (!plain.empty()) {
      const std::size_t place = below(plain.size());
      dues.erase(place);
      plain[place] = plain.back();
      plain.pop_back();
    }
    if (i % 7 != 0) continue;
    now += nanoseconds(below(40));
    std::vector<std::size_t> expected;
    for (std::size_t k = 0; k < plain.size(); ++k)
      if (plain[k] <= now) expected.push_back(k);
    const nanoseconds later = now + nanoseconds(1 + below(300));
    ASSERT_EQ(found_in(dues, now, later), expected) << "operation " << i;
    for (const std::size_t k : expected) plain[k] = later;
    ASSERT_EQ(dues.size(), plain.size());
  }
}

TEST(DueColumn, FindsTheSameAsAVector) {
  for (std::uint32_t seed = 1; seed <= 5; ++seed) {
    for (const std::size_t rows : {1U, 63U, 64U, 65U, 1000U}) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", rows " << rows);
      expect_vector(seed, rows);
    }
  }
}

TEST(DueColumn, FindsEachOnceDuringErasure) {
  DueColumn dues(1000);
  std::vector<int> names;  // moves as the rows do
  for (int i = 0; i < 1000; ++i) {
    dues.push(nanoseconds(i % 3));
    names.push_back(i);
  }
  std::set<int> gone;
  for (std::size_t i = dues.next_due(nanoseconds(1), 0); i < dues.size();
       i = dues.next_due(nanoseconds(1), i)) {
    EXPECT_TRUE(gone.insert(names[i]).second);
    names[i] = names.back();
    names.pop_back();
    dues.erase(i);
  }
  EXPECT_EQ(gone.size(), 667U);
  EXPECT_TRUE(std::all_of(gone.begin(), gone.end(), [](int name) { return name % 3 < 2; }));
}

TEST(DueColumn, IsEmptyAtFirstAndAgain) {
  DueColumn dues(2);
  EXPECT_EQ(dues.next_due(nanoseconds::max(), 0), 0U);
  dues.push(nanoseconds(1));
  dues.erase(0);
  EXPECT_EQ(dues.next_due(nanoseconds::max(), 0), 0U);
}

TEST(DueColumn, AllocatesOnlyAtConstruction) {
  DueColumn dues(300);
  const reckon::test::AllocationGuard guard;
  for (int round = 0; round < 3; ++round) {
    for (int i = 0; i < 300; ++i) dues.push(nanoseconds(i));
    while (dues.size() > 0) dues.erase(0);
  }
  EXPECT_EQ(guard.count(), 0U);
}

}  // namespace
}  // namespace reckon::peer
