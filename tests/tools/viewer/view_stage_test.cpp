// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/viewer/view_stage.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>

#include "reckon/pdu/seconds.hpp"
#include "reckon/tests/tools/support/driven_trucks.hpp"
#include "reckon/tests/tools/support/stage_tabs.hpp"

namespace reckon::tools::view_stage_test {
namespace {

using nlohmann::json;
using tabs::Head;
using tabs::kTick;
using tabs::LiveTrucks;
using tabs::Tab;
using trucks::kStart;
using trucks::milliseconds;
using trucks::nanoseconds;
using trucks::seconds;
using trucks::Sent;

StageOptions capture_options() {
  StageOptions options;
  options.kind = "capture";
  options.is_capture = true;
  options.history.span.reset();
  return options;
}

TEST(ViewStage, GreetsTabsThenSendsThirtyPicturesPerSecond) {
  LiveTrucks live;
  Tab tab(live.stage, false);
  tab.take();  // before anything was received
  live.run(seconds(2), {&tab});
  ASSERT_FALSE(tab.texts.empty());
  EXPECT_EQ(tab.texts[0]["type"], "hello");
  EXPECT_EQ(tab.texts[0]["version"], 4);
  EXPECT_EQ(tab.texts[0]["may_push"], false);
  EXPECT_TRUE(tab.texts[0]["origin"].is_null());
  EXPECT_EQ(tab.texts[1]["type"], "play");
  EXPECT_NEAR(tab.last("origin")["origin"]["lat"].get<double>(), 0, 0.01);
  EXPECT_EQ(tab.last("roster")["entities"].size(), 3U);
  EXPECT_NEAR(static_cast<double>(tab.pictures.size()), 61, 2);
  EXPECT_EQ(tab.head().entities, 3);
  EXPECT_EQ(tab.head().flags, kPictureLive);
  EXPECT_EQ(tab.head().epoch, tab.last("roster")["epoch"]);
  EXPECT_NEAR(tab.head().time, 2.0, 0.04);
  std::size_t numbers = 0;
  for (const json& text : tab.texts) numbers += text["type"] == "numbers" ? 1 : 0;
  EXPECT_NEAR(static_cast<double>(numbers), 8, 1);
}

TEST(ViewStage, SendsWholePicturesPeriodicallyAndOnDemand) {
  LiveTrucks live;
  Tab tab(live.stage, false);
  const auto wholes = [&](int ticks) {
    int count = 0;
    for (int i = 0; i < ticks; ++i) {
      live.run(kTick, {&tab});
      count += tab.reader.was_whole ? 1 : 0;
    }
    return count;
  };
  EXPECT_EQ(wholes(60), 1) << "the first of a tab";
  EXPECT_EQ(wholes(610), 10);
  while (tab.reader.was_whole) (void)wholes(1);
  tab.ask(12);
  EXPECT_EQ(wholes(30), 1) << "its base is lost";
  tab.ask(2, 3.25);
  EXPECT_EQ(wholes(1), 1) << "another instant";
  tab.ask(4);
  EXPECT_EQ(wholes(1), 1) << "live again";
  Tab late(live.stage, false);
  live.run(kTick, {&tab, &late});
  EXPECT_TRUE(late.reader.was_whole);
  EXPECT_FALSE(tab.reader.was_whole);
  EXPECT_EQ(late.pictures.back().size(), tab.pictures.back().size());
}

TEST(ViewStage, SendsTwoPicturesToATabWithoutDrawing) {
  LiveTrucks live;
  Tab idle(live.stage, false), busy(live.stage, false);
  idle.draws = false;
  live.run(seconds(3), {&idle, &busy});
  const std::size_t texts = idle.texts.size();
  live.run(seconds(30), {&idle, &busy});
  EXPECT_EQ(idle.pictures.size(), 2U);
  EXPECT_EQ(idle.texts.size(), texts) << "nor regular text";
  EXPECT_GT(busy.pictures.size(), 900U);
}

TEST(ViewStage, SendsTheNewestPictureToASlowTab) {
  LiveTrucks live;
  Tab slow(live.stage, false);
  slow.draws = false;
  live.run(seconds(20), {&slow});
  slow.draw(slow.head().number);
  EXPECT_TRUE(slow.watcher().under_way.empty()) << "the one before is drawn too";
  live.run(kTick, {&slow});
  EXPECT_NEAR(slow.head().time, 20.03, 0.04);
  EXPECT_NE(slow.head().flags & kPictureGap, 0) << "what was not shown is a gap";
  slow.draw(123456);
  EXPECT_EQ(slow.watcher().under_way.size(), 1U) << "a number that was never sent";
}

TEST(ViewStage, SendsLateTabsOnePictureAtATime) {
  LiveTrucks live;
  Tab late(live.stage, false);
  late.draws = false;
  live.run(seconds(1), {&late});
  ASSERT_EQ(late.watcher().under_way.size(), 2U);
  late.draw(late.head().number);
  live.run(seconds(1), {&late});
  EXPECT_EQ(late.watcher().under_way.size(), 1U) << "a second one would be old when it is drawn";
  late.draw(late.head().number);
  late.draws = true;
  live.run(seconds(1), {&late});
  late.draws = false;
  live.run(seconds(1), {&late});
  EXPECT_EQ(late.watcher().under_way.size(), 2U) << "it is in time again";
}

TEST(ViewStage, PausesOneTabWhileOthersStayLive) {
  LiveTrucks live;
  Tab one(live.stage, false), other(live.stage, false);
  live.run(seconds(5), {&one, &other});
  one.ask(3, 0.0F);
  live.run(kTick, {&one, &other});
  const Head paused = one.head();
  EXPECT_EQ(paused.flags, kPicturePaused);
  EXPECT_EQ(one.last("play")["state"], "paused");
  const std::size_t pictures = one.pictures.size();
  live.run(seconds(10), {&one, &other});
  EXPECT_LE(one.pictures.size(), pictures + 1) << "time stands still";
  EXPECT_NEAR(one.head().time, paused.time, 1e-9);
  EXPECT_NEAR(other.head().time, 15, 0.1);

  one.ask(3, 1.0F);
  live.run(seconds(2), {&one, &other});
  EXPECT_EQ(one.last("play")["state"], "playing");
  EXPECT_NEAR(one.head().time, paused.time + 2, 0.1);
  one.ask(3, 16.0F);
  live.run(seconds(2), {&one, &other});
  EXPECT_EQ(one.last("play")["state"], "live") << "it has caught up";
  one.ask(2, 3.25);
  live.run(kTick, {&one, &other});
  EXPECT_NEAR(one.head().time, 3.25, 1e-9);
  EXPECT_NE(one.head().flags & kPictureGap, 0);
  one.ask(4);
  live.run(kTick, {&one, &other});
  EXPECT_EQ(one.head().flags & kPictureLive, kPictureLive);
}

TEST(ViewStage, StepsByASecondOrByOneUpdate) {
  LiveTrucks live;
  Tab tab(live.stage, false);
  live.run(seconds(8), {&tab});
  const auto step = [&](std::int8_t which) {
    tab.ask(5, which);
    live.run(kTick, {&tab});
    return tab.head().time;
  };
  tab.ask(2, 4.0);
  live.run(kTick, {&tab});
  EXPECT_NEAR(step(1), 5.0, 1e-9);
  EXPECT_NEAR(step(-1), 4.0, 1e-9);
  EXPECT_NEAR(step(2), 4.001, 1e-9);
  EXPECT_NEAR(step(2), 4.002, 1e-9);
  EXPECT_NEAR(step(-2), 4.001, 1e-9);
  EXPECT_NEAR(step(-2), 3.503, 1e-9);
}

TEST(ViewStage, ShowsNoMoreThanTheKeptMinute) {
  LiveTrucks live;
  Tab tab(live.stage, false);
  live.run(seconds(150), {&tab});
  tab.ask(2, -1e300);
  live.run(milliseconds(600), {&tab});
  const auto span = tab.last("numbers")["span"];
  EXPECT_NEAR(span[1].get<double>(), 150.6, 0.1);
  EXPECT_LE(span[0].get<double>(), 90.6);
  EXPECT_NEAR(tab.head().time, span[0].get<double>(), 5.1);
  EXPECT_EQ(tab.head().entities, 3);
}

TEST(ViewStage, MarksAGapOfTheSource) {
  LiveTrucks live;
  Tab tab(live.stage, false);
  live.run(seconds(2), {&tab});
  EXPECT_EQ(tab.head().flags & kPictureGap, 0);
  live.stage.note_gap();
  live.run(kTick, {&tab});
  EXPECT_NE(tab.head().flags & kPictureGap, 0);
  live.run(kTick, {&tab});
  EXPECT_EQ(tab.head().flags & kPictureGap, 0);
}

TEST(ViewStage, PlaysACaptureFromBeginningToEnd) {
  ViewStage stage(capture_options());
  for (const Sent& sent : trucks::drive(2, 20)) ASSERT_TRUE(stage.take(trucks::datagram_of(sent)));
  nanoseconds now = seconds(5'000);  // of its own clock
  const auto run = [&](nanoseconds span, Tab& tab) {
    for (const nanoseconds end = now + span; now < end;) {
      stage.pass(now += kTick);
      tab.take();
    }
  };
  stage.pass(now);
  Tab tab(stage, false);
  run(seconds(3), tab);
  EXPECT_EQ(tab.texts[0]["kind"], "capture");
  EXPECT_NEAR(tab.texts[0]["span"][1].get<double>(), 19.5, 0.01);
  EXPECT_NEAR(tab.head().time, 3, 0.1);
  EXPECT_EQ(tab.head().entities, 2);
  tab.ask(3, 10.0F);
  run(seconds(3), tab);
  EXPECT_EQ(tab.last("play")["state"], "end");
  EXPECT_EQ(tab.head().flags & kPictureEnd, kPictureEnd);
  EXPECT_NEAR(tab.head().time, 19.5, 0.01);
  tab.ask(3, 0.1F);
  run(seconds(1), tab);
  EXPECT_NEAR(tab.head().time, 0.1, 0.02) << "from the begin again, slowly";
}

TEST(ViewStage, NamesTypeAndOwnerOfEachEntity) {
  LiveTrucks live;
  Tab tab(live.stage, false);
  live.run(seconds(2), {&tab});
  const json row = tab.last("roster")["entities"][0];
  EXPECT_EQ(row["type"], "Platform Land");
  EXPECT_EQ(row["type_numbers"], "1.1.0.0.0.0.0");
  EXPECT_EQ(row["peer"], "1:2");
  EXPECT_EQ(row["host"], "10.0.0.7:3000");
  constexpr std::size_t kSpeedAt = kPictureHead + 56, kAgeAt = kPictureHead + 60;
  float speed = 0, age = 0;
  std::memcpy(&speed, tab.pictures.back().data() + kSpeedAt, sizeof speed);
  std::memcpy(&age, tab.pictures.back().data() + kAgeAt, sizeof age);
  EXPECT_NEAR(speed, 10, 1e-3);
  EXPECT_NEAR(age, tab.head().time - 2.001, 1e-3) << "its last update came after 2.001 s";
}

TEST(ViewStage, ShowsTheFirstEntityBeforeItsTime) {
  ViewStage stage(capture_options());
  const Sent no_pdu{.octets = {std::byte{7}}, .time = kStart - seconds(3)};
  (void)stage.take(trucks::datagram_of(no_pdu));
  for (const Sent& sent : trucks::drive(1, 5)) (void)stage.take(trucks::datagram_of(sent));
  stage.pass(kStart);
  Tab tab(stage, false);
  tab.take();
  EXPECT_NEAR(tab.texts[0]["first_entity"].get<double>(), 3.001, 1e-9);
  nanoseconds now = kStart;
  const auto entity_at = [&](double time) {
    tab.ask(2, time);
    stage.pass(now += kTick);
    tab.take();
    EXPECT_NEAR(tab.head().time, time, 1e-9);
    return tab.pictures.back().substr(kPictureHead);
  };
  EXPECT_EQ(entity_at(0), entity_at(3.001));
  EXPECT_NE(entity_at(5), entity_at(1));
}

TEST(ViewStage, ShowsHandsAsTheyWereAtTheInstant) {
  LiveTrucks live;
  Tab tab(live.stage, false);
  live.stage.set_touch({{"left", 0.01, "simulated", 10.0}});
  for (int i = 0; i < 100; ++i) {
    HandFrame frame;
    frame.time = live.now;
    frame.hands.resize(1);
    frame.hands[0].position.x() = static_cast<float>(i);
    frame.ids = {{1, 2, 3}};
    frame.twins = {{0, -0.001 * i, static_cast<std::uint64_t>(i)}};
    live.stage.take_hands(frame);
    live.run(kTick, {&tab});
  }
  const auto x_of = [](const std::string& picture) {
    float x = 0;
    std::memcpy(&x, picture.data() + picture.size() - 72 + 8, sizeof x);
    return x;
  };
  EXPECT_EQ(tab.last("touch")["hands"][0]["name"], "left");
  EXPECT_EQ(tab.head().hands, 1);
  EXPECT_EQ(x_of(tab.pictures.back()), 99.F);
  EXPECT_LT(tab.last("numbers")["twin"][0]["energy"], -0.08);
  tab.ask(2, 0.33);
  live.run(kTick, {&tab});
  EXPECT_EQ(x_of(tab.pictures.back()), 10.F);
  live.run(ViewStage::kNumbersEvery, {&tab});
  const json twins = tab.last("numbers")["twin"];
  ASSERT_EQ(twins.size(), 1U);
  EXPECT_EQ(twins[0]["hand"], 0);
  EXPECT_EQ(twins[0]["energy"], -0.01);
  EXPECT_EQ(twins[0]["resets"], 10);
}

TEST(ViewStage, RefusesMessagesThatAreNone) {
  LiveTrucks live;
  const auto watcher = live.stage.admit(true);
  EXPECT_FALSE(live.stage.answer(*watcher, {}));
  EXPECT_FALSE(live.stage.answer(*watcher, std::array{std::byte{99}}));
}

}  // namespace
}  // namespace reckon::tools::view_stage_test
