// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The rights of pages: the first tab to ask gets the first free hand, no tab moves another's hand,
// and the sliders set the network's law.
#include "reckon/tools/verbs/view_controls.hpp"

#include <gtest/gtest.h>

#include <array>
#include <optional>

namespace reckon::tools {
namespace {

using namespace std::chrono_literals;

class ViewControlsTest : public ::testing::Test {
 protected:
  ViewControlsTest() {
    law_.duplicate = 0.25;
    controls_.emplace(
        law_, [this](const peer::ImpairmentLaw& law) { set_ = law; }, [this] { ++alone_; });
    for (std::size_t i = 0; i < inboxes_.size(); ++i) {
      PointerHand pointer;
      pointer.inbox = &inboxes_[i];
      pointer.origin = {0.1, 0.0, 0.0};
      controls_->add_hand(2 * i + 1, pointer);
    }
  }
  std::optional<std::uint16_t> take(std::uint64_t watcher) {
    return controls_->take_hand(watcher).hand;
  }
  void point(std::uint64_t watcher, std::uint16_t hand, bool held) {
    controls_->point(watcher, {hand, {0.3F, 0.0F, 0.0F}, held}, 0s);
  }

  peer::ImpairmentLaw law_, set_;
  int alone_ = 0;
  std::array<haptics::PointerInbox, 2> inboxes_;
  std::optional<ViewControls> controls_;
};

TEST_F(ViewControlsTest, GiveTheFirstTabTheFirstFreeHand) {
  EXPECT_TRUE(controls_->is_free(1));
  EXPECT_FALSE(controls_->is_free(0)) << "it follows no pointer";
  EXPECT_EQ(take(7), 1);
  EXPECT_EQ(take(7), 1) << "asked again";
  EXPECT_EQ(take(8), 3);
  EXPECT_EQ(take(9), std::nullopt);
  EXPECT_FALSE(controls_->is_free(1));
  controls_->give_hand(7);
  EXPECT_TRUE(controls_->is_free(1));
  EXPECT_EQ(take(9), 1);
}

TEST_F(ViewControlsTest, MoveATabsOwnHandAlone) {
  ASSERT_EQ(take(7), 1);
  point(8, 1, true);
  EXPECT_FALSE(inboxes_[0].take()) << "another's";
  point(7, 3, true);
  EXPECT_FALSE(inboxes_[1].take()) << "nobody's";
  point(7, 1, true);
  ASSERT_TRUE(inboxes_[0].take());
  EXPECT_TRUE(inboxes_[0].sample().held);
  EXPECT_NEAR(inboxes_[0].sample().position.x(), 0.2, 1e-7) << "in the device's axes";
}

TEST_F(ViewControlsTest, LetGoWhereATabGoes) {
  ASSERT_EQ(take(7), 1);
  point(7, 1, true);
  ASSERT_TRUE(inboxes_[0].take());
  controls_->give_hand(7);
  ASSERT_TRUE(inboxes_[0].take());
  EXPECT_FALSE(inboxes_[0].sample().held);
}

TEST_F(ViewControlsTest, SetTheLawAndKeepItsOtherValues) {
  EXPECT_EQ(controls_->set_network({100, 20, 0.5F, false}),
            "network: 100 ms delay, 20 ms jitter, 50 % loss");
  EXPECT_EQ(set_.delay, 100ms);
  EXPECT_EQ(set_.jitter, 20ms);
  EXPECT_EQ(set_.loss, 0.5);
  EXPECT_EQ(set_.duplicate, 0.25);
  EXPECT_EQ(controls_->network().delay_ms, 100) << "as a page that comes later is told";
  static_cast<void>(controls_->set_network({0, 0, 0, true}));
  EXPECT_EQ(set_.loss, 1.0) << "an outage";
  static_cast<void>(controls_->set_network({0, 0, 0, false}));
  EXPECT_EQ(set_.loss, 0.0);
}

TEST_F(ViewControlsTest, GoAloneOnlyWhileBodiesRest) {
  EXPECT_EQ(controls_->go_alone(), "the bodies do not rest");
  EXPECT_EQ(alone_, 0);
  controls_->set_rests(true);
  EXPECT_EQ(controls_->go_alone(), "the bodies go on without the missing peers");
  EXPECT_EQ(alone_, 1);
}

TEST_F(ViewControlsTest, ReportThatThereIsNoNetworkToChange) {
  ViewControls without(law_, nullptr, nullptr);
  EXPECT_EQ(without.set_network({100, 0, 0, false}),
            "this program has no simulated network to change");
  EXPECT_EQ(without.take_hand(1).hand, std::nullopt);
}

}  // namespace
}  // namespace reckon::tools
