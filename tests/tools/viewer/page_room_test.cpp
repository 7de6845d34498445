// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Access to the page of a program, and the room that strangers may use.
#include <gmock/gmock.h>

#include <memory>
#include <string>
#include <vector>

#include "reckon/tests/tools/support/served_page.hpp"

namespace reckon::tools {
namespace {

using served::answer_to;
using served::Client;
using served::kMostRounds;
using served::request;
using served::Served;
using served::status_of;
using served::Tab;
using ::testing::HasSubstr;

constexpr const char* kWord = "?word=1f2e";
constexpr int kTicksASecond = 30;

/// Reads until the server closes the connection; returns the text of the last message.
std::string last_words(Tab& tab) {
  for (int i = 0; i < kMostRounds && tab.take(); ++i) continue;
  if (tab.texts.empty() || tab.texts.back()["type"] != "bye") return {};
  return tab.texts.back()["text"];
}

TEST(PageRoom, KeyNeedsTheWordToLook) {
  Served served(3, "SECRET", {.needs_word = true});
  for (const std::string query : {"", "?word=", "?word=1f2f", "?word=1f2e0"}) {
    Tab stranger(served, query);
    for (int i = 0; i < 3; ++i) served.tick();
    EXPECT_EQ(last_words(stranger), "this exercise has a key: open the address that Reckon printed")
        << query;
    EXPECT_TRUE(stranger.closed);
    EXPECT_EQ(stranger.texts.size(), 1U) << "and nothing of the exercise";
    EXPECT_TRUE(stranger.pictures.empty());
  }
  EXPECT_EQ(status_of(answer_to(served, request(served, "GET /main.js"))), "HTTP/1.1 200");
  Tab own(served, kWord);
  served.tick();
  own.take();
  EXPECT_FALSE(own.pictures.empty());
}

TEST(PageRoom, NinthHeadOfAnAddressEndsItsOldest) {
  Served served;
  std::vector<std::unique_ptr<Client>> silent;
  Client elsewhere(served, 0, 2);
  for (std::size_t i = 0; i < ViewServer::kMostHeads; ++i)
    silent.push_back(std::make_unique<Client>(served));
  EXPECT_EQ(status_of(answer_to(served, request(served, "GET /"))), "HTTP/1.1 200");
  EXPECT_TRUE(silent.front()->hangs_up());
  for (std::size_t i = 1; i < silent.size(); ++i) EXPECT_TRUE(silent[i]->receive()) << i;
  EXPECT_TRUE(elsewhere.receive()) << "its address has one";
}

TEST(PageRoom, FullServerEndsTheOldestHead) {
  Served served;
  std::vector<std::unique_ptr<Client>> silent;
  for (std::size_t i = 0; i < ViewServer::kMostConnections; ++i)
    silent.push_back(std::make_unique<Client>(
        served, 0, static_cast<std::uint32_t>(2 + i / ViewServer::kMostHeads)));
  for (const auto& one : silent) EXPECT_TRUE(one->receive());
  Tab own(served, kWord);
  served.tick();
  own.take();
  EXPECT_FALSE(own.pictures.empty());
  EXPECT_TRUE(silent.front()->hangs_up());
  EXPECT_TRUE(silent.back()->receive());
}

TEST(PageRoom, NinthStrangerOfAnAddressIsTurnedAway) {
  Served served;
  std::vector<std::unique_ptr<Tab>> tabs;
  for (std::size_t i = 0; i < ViewServer::kMostStrangers; ++i)
    tabs.push_back(std::make_unique<Tab>(served));
  Tab ninth(served);
  EXPECT_THAT(last_words(ninth),
              HasSubstr("your address has the maximum of 8 tabs without the word"));
  Tab elsewhere(served, "", 0, 2), own(served, kWord);
  EXPECT_EQ(served.server.tabs(), ViewServer::kMostStrangers + 2);
}

TEST(PageRoom, TabWithTheWordDisplacesTheOldestStranger) {
  Served served;
  Tab first_own(served, kWord);
  std::vector<std::unique_ptr<Tab>> strangers;
  for (std::size_t i = 1; i < ViewServer::kMostTabs; ++i)
    strangers.push_back(std::make_unique<Tab>(
        served, "", 0, static_cast<std::uint32_t>(2 + i / ViewServer::kMostStrangers)));
  EXPECT_EQ(served.server.tabs(), ViewServer::kMostTabs);
  Tab late(served, "", 0, 200), own(served, kWord);
  EXPECT_THAT(last_words(late), HasSubstr("the maximum of 64 tabs is open"));
  served.tick();
  own.take();
  EXPECT_FALSE(own.pictures.empty());
  EXPECT_EQ(last_words(*strangers.front()), "a tab with the word replaced this one");
  EXPECT_TRUE(strangers.back()->take());
  EXPECT_TRUE(first_own.take());
  EXPECT_EQ(served.server.tabs(), ViewServer::kMostTabs);
}

TEST(PageRoom, StrangerThatDrawsNothingEndsAfterTenSeconds) {
  Served served(200);
  Tab silent(served), unread(served, "", 4096), own(served, kWord), busy(served);
  for (int i = 0; i < 99 * kTicksASecond / 10; ++i) {
    served.tick();
    busy.take();
    busy.draw();
  }
  EXPECT_EQ(served.server.tabs(), 4U) << "9.9 s";
  for (int i = 0; i < kTicksASecond; ++i) {
    served.tick();
    busy.take();
    busy.draw();
  }
  EXPECT_EQ(served.server.tabs(), 2U) << "10.9 s";
  EXPECT_TRUE(silent.hangs_up());
  EXPECT_TRUE(unread.hangs_up());
  EXPECT_TRUE(own.take());
  EXPECT_TRUE(busy.take());
}

TEST(PageRoom, PausedStrangerOwesNoDrawing) {
  Served served;
  Tab paused(served);
  served.tick();
  paused.take();
  paused.frame(std::string("\x03\0\0\0\0", 5));  // speed 0
  for (int i = 0; i < 12 * kTicksASecond; ++i) {
    served.tick();
    paused.take();
    if (i < kTicksASecond) paused.draw();
  }
  EXPECT_TRUE(paused.take());
}

}  // namespace
}  // namespace reckon::tools
