// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/tiers/join_announcer.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cstddef>
#include <span>
#include <vector>

#include "reckon/aoim/cells/cell_grid.hpp"

namespace reckon::aoim::join_announcer_test {
namespace {

using std::chrono::seconds;

// Requests of one step as seen by a peer that identifies a request by sender and time, cell by
// cell.
class Listener {
 public:
  std::vector<pdu::CellIndex> hear(JoinAnnouncer& announcer, seconds now) {
    ControlStamp stamp;
    stamp.epoch = 11;
    stamp.utc = now;
    std::vector<pdu::CellIndex> cells;
    announcer.step(now, stamp, [&](std::span<const std::byte> octets) {
      pdu::CellMembership membership;
      ASSERT_EQ(pdu::decode(octets, membership), pdu::DecodeError::none);
      if (!heard_.note(membership.epoch, membership.since)) return;
      for (const pdu::CellIndex& cell : pdu::records_of<pdu::CellIndex>(membership.cells))
        cells.push_back(cell);
    });
    return cells;
  }

 private:
  ReceivedAsks heard_;
};

using Cells = std::vector<pdu::CellIndex>;

// A leader that gives up cells asks for each of them, in one step or in several at one instant.
TEST(JoinAnnouncer, GivesRequestsOfOneInstantDistinctTimes) {
  JoinAnnouncer announcer(TierTable({}, 16), 16);
  Listener listener;
  announcer.ask_once(kCellTier, {1, 2});
  EXPECT_EQ(listener.hear(announcer, seconds(1)), (Cells{{1, 2}}));
  announcer.ask_once(kCellTier, {3, 4});
  EXPECT_EQ(listener.hear(announcer, seconds(1)), (Cells{{3, 4}})) << "in the next step";
  announcer.asks().join({3}, {5, 6}, true, seconds(1));
  announcer.ask_once(kCellTier, {7, 8});
  EXPECT_EQ(listener.hear(announcer, seconds(1)), (Cells{{5, 6}, {7, 8}})) << "of a joined cell";
  announcer.asks().leave({3});
  announcer.asks().join({3}, {9, 9}, true, seconds(1));
  EXPECT_EQ(listener.hear(announcer, seconds(1)), (Cells{{9, 9}})) << "after one that was left";
}

TEST(JoinAnnouncer, SplitsAThousandReleasedCellsIntoRequests) {
  JoinAnnouncer announcer(TierTable({}, 1000), 1000);
  Listener listener;
  for (int i = 0; i < 1000; ++i) announcer.ask_once(kCellTier, {i, -i});
  EXPECT_EQ(listener.hear(announcer, seconds(1)).size(), 1000U);
  EXPECT_FALSE(announcer.is_pending());
}

}  // namespace
}  // namespace reckon::aoim::join_announcer_test
