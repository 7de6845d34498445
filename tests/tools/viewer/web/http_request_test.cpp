// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/viewer/web/http_request.hpp"

#include <gtest/gtest.h>

#include <string>

namespace reckon::tools {
namespace {

const std::string kRequest =
    "GET /stream?word=1f2e HTTP/1.1\r\nhost: 127.0.0.1:8642\r\nORIGIN:  http://127.0.0.1:8642 \r\n"
    "Upgrade: websocket\r\nConnection: keep-alive, Upgrade\r\nSec-WebSocket-Key: abc\r\n"
    "Sec-WebSocket-Version: 13\r\nUser-Agent: x\r\n\r\n";

TEST(HttpRequest, ReadsTheHeadOfABrowser) {
  HttpRequest request;
  const std::string octets = kRequest + "behind";
  ASSERT_EQ(read_request(octets, request), RequestVerdict::good);
  EXPECT_EQ(request.method, "GET");
  EXPECT_EQ(request.path, "/stream");
  EXPECT_EQ(request.query, "word=1f2e");
  EXPECT_EQ(request.host, "127.0.0.1:8642");
  EXPECT_EQ(request.origin, "http://127.0.0.1:8642");
  EXPECT_EQ(request.upgrade, "websocket");
  EXPECT_EQ(request.connection, "keep-alive, Upgrade");
  EXPECT_EQ(request.key, "abc");
  EXPECT_EQ(request.version, "13");
  EXPECT_EQ(request.length, kRequest.size());
}

TEST(HttpRequest, WaitsForMoreWhereverItIsCut) {
  HttpRequest request;
  for (std::size_t size = 0; size < kRequest.size(); ++size)
    EXPECT_EQ(read_request(kRequest.substr(0, size), request), RequestVerdict::incomplete) << size;
}

TEST(HttpRequest, RefusesDuplicateFieldsAndInvalidLines) {
  HttpRequest request;
  for (const std::string line : {"Host: a\r\nHost: b", "Origin: a\r\norigin: a", "no colon",
                                 ": no name", "a b: c", "Ho st: a"})
    EXPECT_EQ(read_request("GET / HTTP/1.1\r\n" + line + "\r\n\r\n", request), RequestVerdict::bad)
        << line;
  for (const std::string line : {"GET / HTTP/1.0", "GET  HTTP/1.1", "GET http://evil/ HTTP/1.1",
                                 "/", "GET / HTTP/1.1 ", "GET /\x01 HTTP/1.1", ""})
    EXPECT_EQ(read_request(line + "\r\n\r\n", request), RequestVerdict::bad) << line;
}

TEST(HttpRequest, GivesUpOnAHeadWithoutAnEnd) {
  HttpRequest request;
  const std::string head = "GET / HTTP/1.1\r\nCookie: ";
  EXPECT_EQ(read_request(head + std::string(20'000, 'x'), request), RequestVerdict::too_long);
  EXPECT_EQ(read_request(head + std::string(kLongestHead - 1 - head.size(), 'x'), request),
            RequestVerdict::incomplete);
}

TEST(HttpRequest, FindsListWordsInAnyCase) {
  EXPECT_TRUE(lists_word("keep-alive, Upgrade", "upgrade"));
  EXPECT_FALSE(lists_word("keep-alive, Upgraded", "upgrade"));
  EXPECT_FALSE(lists_word("", "upgrade"));
}

TEST(HttpRequest, FindsTheValueOfAQueryName) {
  EXPECT_EQ(value_in_query("a=1&word=1f2e&b", "word"), "1f2e");
  EXPECT_EQ(value_in_query("aword=1", "word"), "");
  EXPECT_EQ(value_in_query("word", "word"), "");
}

}  // namespace
}  // namespace reckon::tools
