// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/viewer/view_server.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "reckon/tests/tools/support/served_page.hpp"
#include "reckon/tools/viewer/web/message_deflate.hpp"

namespace reckon::tools::view_server_test {
namespace {

using served::answer_to;
using served::Client;
using served::kMostRounds;
using served::request;
using served::Served;
using served::status_of;
using served::Tab;
using served::upgrade;

TEST(ViewServer, ServesThePagesFilesWithTheirPolicy) {
  Served served;
  const std::string page = answer_to(served, request(served, "GET /"));
  EXPECT_EQ(status_of(page), "HTTP/1.1 200");
  EXPECT_NE(page.find("Content-Type: text/html; charset=utf-8\r\n"), std::string::npos);
  EXPECT_NE(page.find("Content-Encoding: gzip\r\n"), std::string::npos);
  EXPECT_NE(page.find("Content-Security-Policy: default-src 'none'; script-src 'self'; "
                      "style-src 'self'; connect-src 'self'; img-src data:; "
                      "frame-ancestors 'none'; base-uri 'none'"),
            std::string::npos);
  EXPECT_NE(page.find("X-Content-Type-Options: nosniff\r\n"), std::string::npos);
  EXPECT_NE(page.find("Cross-Origin-Resource-Policy: same-origin\r\n"), std::string::npos);
  EXPECT_EQ(page.substr(page.find("\r\n\r\n") + 4, 2), "\x1F\x8B");
  EXPECT_EQ(status_of(answer_to(served, request(served, "GET /main.js"))), "HTTP/1.1 200");
  EXPECT_EQ(status_of(answer_to(served, request(served, "GET /?x=1"))), "HTTP/1.1 200");
  const std::string frame = answer_to(served, request(served, "GET /frame.html"));
  EXPECT_EQ(frame.find("Content-Encoding"), std::string::npos);
  EXPECT_TRUE(frame.substr(frame.find("\r\n\r\n") + 4).starts_with("<!doctype html>"));
  EXPECT_TRUE(frame.ends_with("</html>\n"));
}

TEST(ViewServer, ServesNothingElse) {
  Served served;
  for (const std::string line :
       {"GET /../etc/passwd", "GET /..%2f..%2fetc/passwd", "GET /index.html/..", "GET //", "POST /",
        "PUT /main.js", "OPTIONS /", "GET /main.js.gz"})
    EXPECT_EQ(status_of(answer_to(served, request(served, line))), "HTTP/1.1 404") << line;
}

TEST(ViewServer, IsNotReachedByAnotherName) {
  Served served;
  const std::string port = ":" + std::to_string(served.server.port());
  for (const std::string& host :
       {"evil.example" + port, "127.0.0.1.evil.example" + port, "127.0.0.2" + port,
        std::string("127.0.0.1"), std::string("127.0.0.1:1"), std::string()}) {
    EXPECT_EQ(status_of(answer_to(served, request(served, "GET /", {{"Host", host}}))),
              "HTTP/1.1 403")
        << host;
    EXPECT_EQ(status_of(answer_to(served,
                                  upgrade(served, {{"Host", host}, {"Origin", "http://" + host}}))),
              "HTTP/1.1 403")
        << host;
  }
  EXPECT_EQ(status_of(answer_to(served, request(served, "GET /", {{"Host", "localhost" + port}}))),
            "HTTP/1.1 200");
}

TEST(ViewServer, OpensNoStreamForPagesOfOthers) {
  Served served;
  const std::string other = "http://127.0.0.1:" + std::to_string(served.server.port() + 1);
  for (const std::string& origin : {std::string("http://evil.example"), std::string("null"), other})
    EXPECT_EQ(status_of(answer_to(served, upgrade(served, {{"Origin", origin}}))), "HTTP/1.1 403")
        << origin;
  EXPECT_EQ(status_of(answer_to(served, upgrade(served, {{"Origin", ""}}))), "HTTP/1.1 400");
  EXPECT_EQ(served.server.tabs(), 0U);
  EXPECT_EQ(served.server.counts().refused, 4U);
}

TEST(ViewServer, OpensNoStreamWithoutTheHandshakeOfRfc6455) {
  Served served;
  for (const auto& [name, value] :
       std::map<std::string, std::string>{{"Upgrade", "h2c"},
                                          {"Connection", "close"},
                                          {"Sec-WebSocket-Key", "short"},
                                          {"Sec-WebSocket-Version", "8"}})
    EXPECT_EQ(status_of(answer_to(served, upgrade(served, {{name, value}}))), "HTTP/1.1 400")
        << name;
}

TEST(ViewServer, ClosesOnLongHeadsAndSilentClients) {
  Served served;
  Client long_winded(served);
  long_winded.send(request(served, "GET /", {{"Cookie", std::string(20'000, 'x')}}));
  EXPECT_TRUE(long_winded.hangs_up());
  EXPECT_EQ(long_winded.in, "");

  Client silent(served);
  silent.send("GET / HT");
  for (int i = 0; i < 140; ++i) served.tick();
  EXPECT_TRUE(silent.receive()) << "4.7 s";
  for (int i = 0; i < 20; ++i) served.tick();
  EXPECT_TRUE(silent.hangs_up()) << "5.3 s";
}

TEST(ViewServer, GivesMarkupInMarkingsAsText) {
  Served served(1, "</script><b");
  Tab tab(served);
  EXPECT_NE(tab.head.find("Sec-WebSocket-Accept: s3pPLMBiTxaQ9kYGzzhZRbK+xOo="), std::string::npos);
  tab.take();
  bool is_named = false;
  for (const auto& text : tab.texts)
    if (text["type"] == "roster") is_named = text["entities"][0]["marking"] == "</script><b";
  EXPECT_TRUE(is_named);
}

TEST(ViewServer, SendsAPictureEachTickToDrawingTabs) {
  Served served;
  Tab tab(served);
  for (int i = 0; i < 30; ++i) {
    served.tick();
    ASSERT_TRUE(tab.take());
    ASSERT_FALSE(tab.pictures.empty());
    EXPECT_EQ(tab.pictures.back().size(), 32U + 3 * 64);
    tab.draw();
  }
  EXPECT_NEAR(static_cast<double>(tab.pictures.size()), 31, 1);
}

TEST(ViewServer, SendsTwoPicturesToAStalledTab) {
  Served served(200);
  Tab stalled(served, "", 4096), busy(served);
  for (int i = 0; i < 3; ++i) served.tick();
  const auto octets = served.server.counts().octets;
  for (int i = 0; i < 100; ++i) {
    served.tick();
    busy.take();
    busy.draw();
  }
  EXPECT_GT(busy.pictures.size(), 95U);
  EXPECT_LT(served.server.counts().octets - octets, busy.octets + 100'000);
  stalled.take();
  EXPECT_EQ(stalled.pictures.size(), 2U);
}

TEST(ViewServer, SendsTheNewestPictureToASlowTab) {
  Served served;
  Tab slow(served);
  slow.take();
  for (int i = 0; i < 90; ++i) served.tick();
  slow.take();
  EXPECT_LT(slow.time(), 0.2);
  slow.draw();
  served.tick();
  slow.take();
  EXPECT_GT(slow.time(), 3.0);
}

TEST(ViewServer, RefusesTabsBeyondItsLimit) {
  Served served;
  std::vector<std::unique_ptr<Tab>> tabs;
  for (std::size_t i = 0; i < ViewServer::kMostTabs; ++i)
    tabs.push_back(std::make_unique<Tab>(served, "?word=1f2e"));
  EXPECT_EQ(served.server.tabs(), ViewServer::kMostTabs);
  Tab one_more(served, "?word=1f2e");
  for (int i = 0; i < kMostRounds && one_more.take(); ++i) continue;
  ASSERT_EQ(one_more.texts.size(), 1U);
  EXPECT_EQ(one_more.texts[0]["type"], "bye");
  EXPECT_NE(one_more.texts[0]["text"].get<std::string>().find("64 tabs"), std::string::npos);
  EXPECT_TRUE(one_more.closed);
  tabs.pop_back();
  served.tick();
  Tab next(served);
  next.take();
  EXPECT_EQ(next.texts.at(0)["type"], "hello");
}

TEST(ViewServer, ClosesOnUnexpectedFrames) {
  Served served;
  const std::map<std::string, std::function<void(Tab&)>> frames{
      {"unmasked", [](Tab& tab) { tab.send(std::string("\x82\x01\x04", 3)); }},
      {"126 octets",
       [](Tab& tab) { tab.send(std::string("\x82\xFE\x00\x7E\x01\x02\x03\x04", 8)); }},
      {"in parts", [](Tab& tab) { tab.frame("\x04", 0x02); }},
      {"text", [](Tab& tab) { tab.frame("hello", 0x81); }},
      {"ping", [](Tab& tab) { tab.frame("", 0x89); }},
      {"malformed request", [](Tab& tab) { tab.frame("\x63"); }},
      {"cut request", [](Tab& tab) { tab.frame("\x01\x01"); }},
      {"close", [](Tab& tab) { tab.frame("", 0x88); }}};
  for (const auto& [name, send] : frames) {
    Tab tab(served);
    EXPECT_EQ(served.server.tabs(), 1U) << name;
    send(tab);
    EXPECT_TRUE(tab.hangs_up()) << name;
    EXPECT_EQ(served.server.tabs(), 0U) << name;
  }
}

constexpr const char* kDeflate = "permessage-deflate; client_max_window_bits";

TEST(ViewServer, CompressesForTabsThatOfferIt) {
  Served served;
  Tab plain(served), packed(served, "", 0, 1, kDeflate);
  EXPECT_EQ(plain.head.find("Extensions"), std::string::npos);
  EXPECT_NE(packed.head.find("Sec-WebSocket-Extensions: permessage-deflate"), std::string::npos);
  for (int i = 0; i < 90; ++i) {
    served.tick();
    for (Tab* tab : {&plain, &packed}) {
      ASSERT_TRUE(tab->take());
      tab->draw();
    }
  }
  EXPECT_EQ(packed.pictures.back(), plain.pictures.back());
  EXPECT_EQ(packed.texts.size(), plain.texts.size());
  EXPECT_LT(packed.octets, plain.octets * 3 / 4);
}

TEST(ViewServer, TakesCompressedFramesOnlyAsAgreed) {
  Served served;
  const std::string live("\x62\x01\x00", 3);  // request 4
  Tab plain(served), packed(served, "", 0, 1, kDeflate);
  plain.frame(live, 0xC2);
  EXPECT_TRUE(plain.hangs_up());
  packed.frame(live, 0xC2);
  packed.frame("\x04");
  EXPECT_TRUE(packed.take()) << "compressed or not";
  for (const std::string& bad : {std::string("\xff\xff", 2), std::string("\x4b\x84\x81\x01", 4)}) {
    Tab hostile(served, "", 0, 1, kDeflate);
    hostile.frame(bad, 0xC2);
    EXPECT_TRUE(hostile.hangs_up());
  }
  MessageCompression deflater(*agree_on_deflate(kDeflate));
  const std::string bomb = deflater.deflate(std::string(15'000, 'a'));
  Tab hostile(served, "", 0, 1, kDeflate);
  hostile.frame(bomb, 0xC2);
  EXPECT_TRUE(hostile.hangs_up()) << "15 kB";
  EXPECT_TRUE(packed.take());
}

TEST(ViewServer, TakesFramesThatComeInPieces) {
  Served served;
  Tab tab(served);
  const std::string frame("\x82\x81\x01\x02\x03\x04\x05", 7);  // kind 4
  for (const char octet : frame) tab.send(std::string(1, octet));
  EXPECT_TRUE(tab.take());
  EXPECT_EQ(served.server.tabs(), 1U);
}

TEST(ViewServer, SendsACloseFrameAtItsEnd) {
  auto served = std::make_unique<Served>();
  auto tab = std::make_unique<Tab>(*served);
  tab->take();
  const auto sent = served->server.counts().tabs;
  EXPECT_EQ(sent, 1U);
  tab.reset();
  served.reset();  // without any client left
}

TEST(ViewServer, NamesTheAddressThatATabOpens) {
  Served served;
  EXPECT_EQ(served.server.address(), "http://" + served.host() + "/#word=1f2e");
  EXPECT_TRUE(served.server.addresses_for_others().empty()) << "this host alone reaches it";
}

TEST(ViewServer, TakesTheNextPortUnlessOneIsGiven) {
  ViewStage stage{StageOptions{}};
  const ViewServer first(stage, {"127.0.0.1", std::nullopt, "w"});
  const ViewServer second(stage, {"127.0.0.1", std::nullopt, "w"});
  EXPECT_GT(second.port(), first.port());
  EXPECT_THROW(ViewServer(stage, {"127.0.0.1", first.port(), "w"}), std::runtime_error);
  EXPECT_THROW(ViewServer(stage, {"not an address", std::nullopt, "w"}), std::runtime_error);
}

}  // namespace
}  // namespace reckon::tools::view_server_test
