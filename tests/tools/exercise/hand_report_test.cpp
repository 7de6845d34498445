// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The end of a run: the reduction of the hands' forces, and the hands that they touched.
#include "reckon/tools/exercise/hand_report.hpp"

#include <gmock/gmock.h>

#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "reckon/tests/tools/support/captured_console.hpp"

namespace reckon::tools {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

class HandReport : public testing::Test {
 protected:
  explicit HandReport() {
    for (std::size_t i = 0; i < views_.size(); ++i) {
      views_[i].id = {1, static_cast<std::uint16_t>(i + 1), 1};
      views_[i].servo.tally.hands = 10;
      hands_.push_back(&views_[i]);
    }
  }
  [[nodiscard]] std::string text() const {
    const test::CapturedStream out;
    print_hands(out.file(), hands_);
    return out.text();
  }

  std::array<peer::HandView, 8> views_;
  Hands hands_;
};

TEST_F(HandReport, IsEmptyWithoutReductions) { EXPECT_EQ(text(), ""); }

TEST_F(HandReport, ReportsTimeAndAmountOfHeldBackContacts) {
  views_[1].servo.tally.held_back = {2.0, 0.4, 2.3};
  views_[2].servo.tally.held_back = {0.4, 0.1, 0.5};
  EXPECT_THAT(text(),
              HasSubstr("held back                  3 % of the time in contact with hands, at "
                        "worst 40 % of 2.3 N displayed: energy was short (1:2:1, 1:3:1)"));
  EXPECT_THAT(text(), Not(HasSubstr("crowded")));
  views_[3].servo.tally.guests = {1.0, 0.0, 3.0};
  EXPECT_THAT(text(),
              HasSubstr("guests held back           1.2 % of the time in contact with hands, at "
                        "worst 0 % of 3 N displayed: energy was short, with hands (1:4:1)"));
  views_[5].servo.tally.crowd = {1.0, 0.5, 4.0};
  views_[6].servo.tally.effects = {1.5, 0.0, 0.2};
  EXPECT_THAT(text(), AllOf(HasSubstr("crowded"), HasSubstr("50 % of 4 N displayed"),
                            HasSubstr("held forces cut            1.5 s, at worst 0 % of 0.2 N")));
}

TEST_F(HandReport, ReportsHowLongTheDeviceLimitCutForces) {
  views_[2].servo.tally.limit = {0.25, 0.8, 12.5};
  EXPECT_THAT(text(), HasSubstr("force cut                  0.25 s, at worst 80 % of 12.5 N "
                                "displayed: it exceeded the limit of the device (1:3:1)"));
  const auto json = nlohmann::json::parse(hands_json(hands_));
  EXPECT_EQ(json[2]["force_cut"]["s"], 0.25);
  EXPECT_EQ(json[2]["force_cut"]["worst_asked_n"], 12.5);
}

TEST_F(HandReport, NamesHandsWithoutContact) {
  for (const std::size_t i : {0U, 2U}) views_[i].servo.tally.hands = 0;
  EXPECT_THAT(text(), HasSubstr("touched nobody             1:1:1, 1:3:1\n"));
  for (peer::HandView& hand : views_) hand.servo.tally.hands = 0;
  EXPECT_THAT(text(), HasSubstr("no hand touched another"));
}

TEST_F(HandReport, CountsBodiesOfOthersAsTouched) {
  for (peer::HandView& hand : views_) hand.servo.tally.hands = 0;
  views_[1].servo.tally.bodies = 2.5;
  EXPECT_THAT(text(),
              AllOf(HasSubstr("touched nobody             1:1:1, 1:3:1, 1:4:1, 1:5:1 and 3"),
                    Not(HasSubstr("no hand"))));
  const auto json = nlohmann::json::parse(hands_json(hands_));
  EXPECT_EQ(json[1]["touching_bodies_s"], 2.5);
  EXPECT_EQ(json[0]["touching_bodies_s"], 0);
  for (peer::HandView& hand : views_) hand.servo.tally.bodies = 2.5;
  EXPECT_EQ(text(), "");
}

TEST_F(HandReport, ReportsSoftenedStiffnessOnceForAllHands) {
  for (peer::HandView& hand : views_) {
    hand.stiffness.walls_asked = 20000;
    hand.stiffness.walls = 1425;
  }
  views_[3].stiffness.hand_asked = 1500;
  views_[3].stiffness.hands = 950;
  views_[2].stiffness.regions_asked = 3000;
  views_[2].stiffness.regions = 475;
  EXPECT_THAT(text(), AllOf(HasSubstr("walls 1425 of 20000 N/m\n"),
                            HasSubstr("regions 475 of 3000 N/m (1:3:1)\n"),
                            HasSubstr("hands 950 of 1500 N/m (1:4:1)\n")));
  views_[3].stiffness.hand_asked = 500;
  views_[3].stiffness.hand_k3 = 1.5e7;
  EXPECT_THAT(softer_than_asked(views_[3].stiffness),
              ElementsAre("walls 1425 of 20000 N/m", "hands harden up to 950 N/m, 3.16 mm deep"));
}

TEST_F(HandReport, CountsLateStepsFailedReadingsAndRefusedRecords) {
  views_[0].servo.tally.late = 7;
  views_[4].servo.tally.late = 5;
  views_[4].servo.tally.force_drops = 3;
  views_[4].servo.tally.failed = 2;
  views_[4].servo.tally.refused = 0.5;
  EXPECT_THAT(text(), AllOf(HasSubstr("12; in 3 of them, the device had dropped its force"),
                            HasSubstr("failed readings            2 "),
                            HasSubstr("for 0.5 s, a force model near a hand")));
}

TEST_F(HandReport, ReportsHowOftenAndLongForcesWereStopped) {
  for (peer::HandView& hand : views_) {
    hand.servo.tally.stops = 2;
    hand.servo.tally.stopped = 3.25;
  }
  EXPECT_THAT(text(), HasSubstr("forces stopped             2 times, 3.25 s in all\n"));
  const auto json = nlohmann::json::parse(hands_json(hands_));
  EXPECT_EQ(json[1]["stops"], 2);
  EXPECT_EQ(json[1]["stopped_s"], 3.25);
}

TEST_F(HandReport, HasEveryHandWithBothNumbersInJson) {
  views_[3].stiffness.walls_asked = 20000;
  views_[3].stiffness.walls = 1425;
  views_[3].servo.tally.held_back = {2.0, 0.4, 2.3};
  views_[3].servo.tally.force_drops = 3;
  const auto json = nlohmann::json::parse(hands_json(hands_));
  ASSERT_EQ(json.size(), views_.size());
  EXPECT_EQ(json[3]["id"], "1:4:1");
  EXPECT_EQ(json[3]["walls_n_m"], 1425);
  EXPECT_EQ(json[3]["walls_asked_n_m"], 20000);
  EXPECT_EQ(json[3]["held_back"]["s"], 2.0);
  EXPECT_EQ(json[3]["held_back"]["worst_share"], 0.4);
  EXPECT_EQ(json[3]["held_back"]["worst_asked_n"], 2.3);
  EXPECT_EQ(json[3]["let_go"], 3);
  EXPECT_TRUE(json[0]["hand_straight_from_m"].is_null());
}

}  // namespace
}  // namespace reckon::tools
