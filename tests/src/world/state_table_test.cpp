// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/world/state_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <map>
#include <random>
#include <set>

#include "reckon/deadreckon/motion/acceleration_trust.hpp"
#include "reckon/tests/support/allocation_guard.hpp"

namespace reckon::peer {
namespace {

// Applies the same random operations to the table and a std::map.
class Twins {
 public:
  Twins(std::size_t capacity, std::uint32_t seed) : table_(capacity), random_(seed) {}

  // IDs from a small range repeat; the range decides how full the table gets.
  pdu::EntityId draw(std::uint16_t range) {
    std::uniform_int_distribution<int> number(1, range);
    return {static_cast<std::uint16_t>(number(random_)),
            static_cast<std::uint16_t>(number(random_)),
            static_cast<std::uint16_t>(number(random_))};
  }

  void add(const pdu::EntityId& id) {
    bool added = false;
    RemoteEntity* row = table_.find_or_add(id, added);
    const bool known = map_.count(id) > 0;
    if (!known && map_.size() == table_.capacity()) {
      EXPECT_EQ(row, nullptr);
      return;
    }
    ASSERT_NE(row, nullptr);
    EXPECT_EQ(added, !known);
    if (added) {
      EXPECT_EQ(row->updates, 0u);  // a new row is empty
    }
    row->updates = map_[id] = ++stamp_;
  }
  void erase(const pdu::EntityId& id) {
    if (const RemoteEntity* row = table_.find(id)) table_.erase(table_.place_of(*row));
    map_.erase(id);
  }
  void step(std::uint16_t range, double adding) {
    const pdu::EntityId id = draw(range);
    std::bernoulli_distribution add_now(adding);
    add_now(random_) ? add(id) : erase(id);
  }

  void expect_equal() {
    ASSERT_EQ(table_.rows().size(), map_.size());
    std::set<pdu::EntityId> seen;
    for (const RemoteEntity& row : table_.rows()) {
      ASSERT_TRUE(seen.insert(row.id).second);
      const auto known = map_.find(row.id);
      ASSERT_NE(known, map_.end());
      EXPECT_EQ(row.updates, known->second);
    }
    for (const auto& [id, stamp] : map_) {
      const RemoteEntity* row = table_.find(id);
      ASSERT_NE(row, nullptr);
      EXPECT_EQ(row->updates, stamp);
    }
  }

 private:
  StateTable table_;
  std::map<pdu::EntityId, std::uint64_t> map_;
  std::mt19937 random_;
  std::uint64_t stamp_ = 0;
};

// A bounce with 600 m/s^2 whose next update is lost.
RemoteEntity bounced(std::uint32_t epoch) {
  RemoteEntity row;
  row.epoch = epoch;
  deadreckon::KinematicState state;
  state.algorithm = pdu::DeadReckoningAlgorithm::rvw;
  state.velocity = {0, 0, 5};
  state.acceleration = {0, 0, 600};
  row.state = state;
  return row;
}

TEST(RemoteEntity, OfAPeerIsNotAcceleratedForEver) {
  const RemoteEntity row = bounced(1);
  const deadreckon::Pose pose = row.predicted(std::chrono::seconds(1));
  EXPECT_EQ(pose.position, deadreckon::extrapolate_trusted(*row.state, 1).position);
  EXPECT_LT(pose.position.z(), 6);
}

TEST(RemoteEntity, OfAnotherProgramIsExtrapolatedByTheStandard) {
  const RemoteEntity row = bounced(0);
  EXPECT_EQ(row.predicted(std::chrono::seconds(1)).position.z(), 305);
}

TEST(StateTable, BehavesAsAMapUnderRandomOperations) {
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    Twins twins(64, seed);
    for (int i = 0; i < 4000; ++i) {
      twins.step(5, 0.5);
      if (i % 50 == 0) twins.expect_equal();
    }
    twins.expect_equal();
  }
}

TEST(StateTable, BehavesAsAMapWhileItIsFull) {
  for (std::uint32_t seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE(seed);
    Twins twins(32, seed);
    for (int i = 0; i < 4000; ++i) twins.step(8, 0.8);
    twins.expect_equal();
  }
}

TEST(StateTable, RefusesRowsBeyondItsCapacity) {
  StateTable table(3);
  bool added = false;
  for (std::uint16_t i = 1; i <= 3; ++i) ASSERT_NE(table.find_or_add({1, 1, i}, added), nullptr);
  EXPECT_EQ(table.find_or_add({1, 1, 4}, added), nullptr);
  EXPECT_EQ(table.rows().size(), 3u);
  table.erase(table.place_of(*table.find({1, 1, 2})));
  EXPECT_NE(table.find_or_add({1, 1, 4}, added), nullptr);
  EXPECT_EQ(table.find({1, 1, 2}), nullptr);
}

// Resident memory of this process [pages].
std::size_t resident() {
  std::ifstream file("/proc/self/statm");
  std::size_t all = 0, pages = 0;
  file >> all >> pages;
  return pages;
}

TEST(StateTable, TouchesNoMemoryThatItDoesNotUse) {
  constexpr std::size_t kRows = 200'000;
  const std::size_t before = resident();
  StateTable table(kRows);
  bool added = false;
  for (std::uint16_t i = 1; i <= 100; ++i) ASSERT_NE(table.find_or_add({1, 1, i}, added), nullptr);
  const std::size_t after = std::max(before, resident());
  // A sanitizer uses an eighth of the reserved memory for itself.
  EXPECT_LT(4096 * (after - before), kRows * sizeof(RemoteEntity) / 4);
}

TEST(StateTable, AllocatesOnlyAtConstruction) {
  StateTable table(256);
  const reckon::test::AllocationGuard guard;
  bool added = false;
  for (std::uint16_t i = 1; i <= 1000; ++i) {
    static_cast<void>(table.find_or_add({i, 2, 3}, added));
    if (i > 100)
      table.erase(table.place_of(*table.find({static_cast<std::uint16_t>(i - 100), 2, 3})));
  }
  EXPECT_EQ(guard.count(), 0u);
}

}  // namespace
}  // namespace reckon::peer
