// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// States of outer tiers that are kept for entities that revert to them.
#include "reckon/peer/world/held_states.hpp"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace reckon::peer {
namespace {

constexpr std::size_t kNearRows = 2;  // near rows; the cell's row follows them
constexpr aoim::GroupIndex kNearest{11}, kMiddle{21};

// A state sent at a whole number of seconds in a group.
HeldState told(unsigned second, aoim::GroupIndex group = aoim::kBaseGroup) {
  HeldState state;
  state.state.position = {static_cast<double>(second), 0, 0};
  state.timestamp = second << 20;
  state.group = group;
  state.is_heard = true;
  return state;
}

// The entities that revert when a group is left, with the time of their older state.
std::vector<std::pair<std::size_t, double>> leave(HeldStates& states, aoim::GroupIndex group,
                                                  std::size_t row) {
  std::vector<std::pair<std::size_t, double>> back;
  states.leave(group, row, [&](std::size_t place, const HeldState& held) {
    back.emplace_back(place, held.state.position.x());
  });
  return back;
}

using Back = std::vector<std::pair<std::size_t, double>>;

TEST(HeldStates, RevertToTheNewestOuterState) {
  HeldStates states(kNearRows, 4);
  states.push();
  states.note(0, kNearRows, told(1), true);
  states.note(0, 1, told(2, kMiddle), true);
  states.note(0, 0, told(3, kNearest), true);
  EXPECT_TRUE(leave(states, kMiddle, 1).empty()) << "the nearest row says what is shown";
  EXPECT_EQ(leave(states, kNearest, 0), (Back{{0, 2.0}}));
  EXPECT_TRUE(leave(states, kNearest, 0).empty()) << "it has gone back";
  EXPECT_EQ(leave(states, kMiddle, 1), (Back{{0, 1.0}}));
}

TEST(HeldStates, KeepOuterStatesOvertakenByANearerRow) {
  HeldStates states(kNearRows, 4);
  states.push();
  states.note(0, kNearRows, told(1), true);
  states.note(0, 0, told(3, kNearest), true);
  states.note(0, kNearRows, told(2), false);
  EXPECT_EQ(leave(states, kNearest, 0), (Back{{0, 2.0}}));
  states.note(0, 0, told(5, kNearest), true);
  states.note(0, kNearRows, told(4), false);
  states.note(0, kNearRows, told(2), false);
  EXPECT_EQ(leave(states, kNearest, 0), (Back{{0, 4.0}})) << "what came later and is older";
}

TEST(HeldStates, StayWhereNothingCameByARowBehind) {
  HeldStates states(kNearRows, 4);
  states.push();
  states.note(0, 0, told(3, kNearest), true);
  EXPECT_TRUE(leave(states, kNearest, 0).empty());
}

TEST(HeldStates, FollowTheRowsOfTheTable) {
  HeldStates states(kNearRows, 4);
  for (std::size_t place = 0; place < 3; ++place) {
    states.push();
    states.note(place, kNearRows, told(static_cast<unsigned>(10 + place)), true);
    states.note(place, 0, told(static_cast<unsigned>(20 + place), kNearest), true);
  }
  states.erase(0);  // the last takes its place
  EXPECT_EQ(leave(states, kNearest, 0), (Back{{0, 12.0}, {1, 11.0}}));
}

TEST(HeldStates, TakeNothingWithoutNearRows) {
  HeldStates states(0, 100'000);
  EXPECT_FALSE(states.is_on());
  states.push();
  states.erase(0);
}

}  // namespace
}  // namespace reckon::peer
