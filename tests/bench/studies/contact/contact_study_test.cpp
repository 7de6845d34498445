// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The twins against closed forms; whole peers in contact, and their report.
#include "reckon/bench/studies/contact/contact_study.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "reckon/bench/studies/contact/contact_report.hpp"
#include "reckon/bench/studies/contact/contact_run.hpp"

namespace reckon::bench {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

ContactScene scene_named(std::string_view name) {
  const auto scenes = contact_scenes();
  const auto found = std::find_if(scenes.begin(), scenes.end(),
                                  [&](const ContactScene& scene) { return scene.name == name; });
  EXPECT_NE(found, scenes.end()) << name;
  return *found;
}

std::vector<ContactRow> rows_of(std::string_view name, std::vector<ContactSending> sendings,
                                double longest, const peer::ImpairmentConfig& network = {}) {
  const ContactScene scene = scene_named(name);
  return run_contact_study(std::span(&scene, 1), sendings, network, longest);
}

// Grip, contact and grip in series: F = d / (1/k + 1/K + 1/k).
TEST(Twins, HoldTheForceOfSpringsInSeries) {
  for (const auto& [name, depth] : {std::pair{"press-10", 0.01}, std::pair{"press-20", 0.02}}) {
    const ContactScene contact = scene_named(name);
    const ContactRecord twin = run_twins(scene_of(contact), 500, scripts_of(contact), 6.5);
    const double force = depth / (2 / 300.0 + 1 / 500.0);
    EXPECT_NEAR(twin.force(6400, 0, 1).norm(), force, 1e-3 * force) << name;
    EXPECT_NEAR(twin.force(6400, 1, 0).norm(), force, 1e-3 * force) << name;
    EXPECT_EQ(twin.force(1000, 0, 1).norm(), 0) << name;
  }
}

// Without network and energy port the peers' forces cannot be nearer than this.
TEST(ContactStudy, WithoutDelayPressesMatchTheTwins) {
  const auto rows = rows_of("press-10", {{0.015, 0}}, 9);
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_GT(rows[0].from_shown.samples, 5000U);
  EXPECT_LT(*rows[0].from_twin, 0.15);
  EXPECT_LT(rows[0].from_shown.rms, 0.1);
  EXPECT_EQ(rows[0].asked, rows[0].shown);
  EXPECT_EQ(rows[0].from_asked.p99, rows[0].from_shown.p99);
  EXPECT_GT(rows[0].times_fewer(), 5);
  EXPECT_GT(rows[0].servo_step_ns, 0);
}

TEST(ContactStudy, DistinguishesRequestedFromRenderedStiffness) {
  const auto rows = rows_of("press-stiff", {{0.2, 0}}, 9);
  EXPECT_EQ(rows[0].asked, 1500);
  EXPECT_NEAR(rows[0].shown, 950, 1);
  // Springs in series hold 1.3 N at 950 N/m; at 1500 N/m the same overlap gives more.
  const double held = 0.01 / (2 / 300.0 + 1 / 950.0);
  EXPECT_NEAR(rows[0].from_asked.p50, held * (1500 / 950.0 - 1), 0.05);
  EXPECT_LT(rows[0].from_shown.p50, 0.02);
  EXPECT_THAT(contact_text(rows, {}), HasSubstr("1500 N/m, of which the devices can display 950"));
}

TEST(ContactStudy, DelayAndALowRateIncreaseForceErrors) {
  const auto near = rows_of("stroke-1.5", {{0.015, 0}, {0, 50}}, 11.5);
  const auto far = rows_of("stroke-1.5", {{0.015, 0}}, 11.5, {peer::delayed_by(0.05)});
  EXPECT_LT(near[0].from_shown.rms, near[1].from_shown.rms);
  EXPECT_LT(2 * near[0].from_shown.rms, far[0].from_shown.rms);
  ASSERT_TRUE(far[0].stroke);
  EXPECT_LT((*far[0].stroke)[1].phase, (*near[0].stroke)[1].phase);
  // Both hands at the rate, plus updates for events.
  EXPECT_GT(near[1].packets_per_s, 80);
  EXPECT_LT(near[1].packets_per_s, 200);
}

TEST(ContactStudy, IsDeterministicExceptForTimes) {
  auto once = rows_of("tap", {{0.05, 0}, {0.1, 0}}, 4, {peer::delayed_by(0.005, 0.3, 0.1), 7});
  auto again = rows_of("tap", {{0.05, 0}, {0.1, 0}}, 4, {peer::delayed_by(0.005, 0.3, 0.1), 7});
  for (auto* rows : {&once, &again})
    for (ContactRow& row : *rows) row.servo_step_ns = 0;
  EXPECT_EQ(contact_json(once, {}), contact_json(again, {}));
  EXPECT_EQ(contact_csv(once, {}), contact_csv(again, {}));
}

TEST(ContactStudy, StopsOnRequest) {
  const ContactScene scene = scene_named("tap");
  const std::vector<ContactSending> sendings(5, {0.1, 0});
  const auto rows = run_contact_study(std::span(&scene, 1), sendings, {}, 1,
                                      [](std::size_t done, std::size_t) { return done == 0; });
  EXPECT_GT(rows.size(), 0U);
  EXPECT_LT(rows.size(), 5U);
}

// --- the report ---

ContactRow row_of(double threshold, double packets, double p99) {
  ContactRow row;
  row.scene = "tap";
  row.sending = {threshold, 0};
  row.hands = 2;
  row.asked = row.shown = 500;
  row.packets_per_s = packets;
  row.from_shown = {0.5 * p99, p99, 2 * p99, 0.6 * p99, 0.02, 100};
  return row;
}

TEST(ContactReport, ReportsAWideThresholdThatIsWorse) {
  std::vector<ContactRow> rows{row_of(0.01, 20, 0.1), row_of(0.2, 25, 0.3)};
  rows[1].beaten = true;
  EXPECT_THAT(
      contact_text(rows, {}),
      HasSubstr(
          "200 mN is worse than 10 mN in both: 25 packets/s against 20, P99 300 mN against 100."));
  rows[1] = row_of(0.2, 10, 0.3);
  EXPECT_THAT(contact_text(rows, {}), Not(HasSubstr("worse")));
}

TEST(ContactReport, MarksNoticeableErrorsAndAbsentContact) {
  std::vector<ContactRow> rows{row_of(0.01, 20, 0.1), row_of(0.2, 25, 0.3)};
  rows[1].from_shown = {};
  const std::string text = contact_text(rows, {peer::delayed_by(0.005, 0.3, 0.1), 7});
  EXPECT_THAT(text, HasSubstr("2.0 % !"));
  EXPECT_THAT(text, HasSubstr("did not touch"));
  EXPECT_THAT(text, HasSubstr("delay 5 ms +-30 %, 10 % lost; seed 7"));
}

TEST(ContactReport, JsonAndCsvHaveAColumnPerValue) {
  std::vector<ContactRow> rows{row_of(0.01, 20, 0.1), row_of(0.2, 25, 0.3)};
  rows[0].stroke = {{{1.1, -0.2}, {0.9, 0.1}}};
  rows[0].from_twin = 0.07;
  std::istringstream lines(contact_json(rows, {}));
  std::string line;
  std::getline(lines, line);
  const auto first = nlohmann::json::parse(line);
  EXPECT_EQ(first["kind"], "contact");
  EXPECT_EQ(first["stroke"][1]["gain"], 0.9);
  EXPECT_EQ(first["error_shown_n"]["p99"], 0.1);
  EXPECT_EQ(first["twin_rms_n"], 0.07);
  std::getline(lines, line);
  EXPECT_TRUE(nlohmann::json::parse(line)["stroke"].is_null());
  std::istringstream table(contact_csv(rows, {}));
  std::ptrdiff_t columns = -1;
  while (std::getline(table, line)) {
    const auto commas = std::count(line.begin(), line.end(), ',');
    if (columns >= 0) {
      EXPECT_EQ(commas, columns) << line;
    }
    columns = commas;
  }
}

}  // namespace
}  // namespace reckon::bench
