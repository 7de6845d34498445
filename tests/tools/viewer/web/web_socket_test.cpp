// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/viewer/web/web_socket.hpp"

#include <gtest/gtest.h>

#include <initializer_list>
#include <string>
#include <vector>

namespace reckon::tools {
namespace {

std::vector<std::byte> octets(std::initializer_list<unsigned> values) {
  std::vector<std::byte> out;
  for (const unsigned value : values) out.push_back(static_cast<std::byte>(value));
  return out;
}

TEST(WebSocket, AnswersTheExampleKeyOfRfc6455) {
  EXPECT_EQ(web_socket_accept("dGhlIHNhbXBsZSBub25jZQ=="), "s3pPLMBiTxaQ9kYGzzhZRbK+xOo=");
}

TEST(WebSocket, KnowsAKeyByItsForm) {
  EXPECT_TRUE(is_web_socket_key("dGhlIHNhbXBsZSBub25jZQ=="));
  EXPECT_FALSE(is_web_socket_key("dGhlIHNhbXBsZSBub25jZQ="));
  EXPECT_FALSE(is_web_socket_key("dGhlIHNhbXBsZSBub25jZ!=="));
  EXPECT_FALSE(is_web_socket_key("dGhlIHNhbXBsZSBub25jZQAA"));
  EXPECT_FALSE(is_web_socket_key(""));
}

TEST(WebSocket, WritesPayloadLengthsInTheShortestForm) {
  const auto head = [](std::size_t size) {
    const FrameHead made = frame_head(WebSocketOpcode::binary, size);
    return std::vector<std::byte>(made.bytes().begin(), made.bytes().end());
  };
  EXPECT_EQ(head(0), octets({0x82, 0}));
  EXPECT_EQ(head(125), octets({0x82, 125}));
  EXPECT_EQ(head(126), octets({0x82, 126, 0, 126}));
  EXPECT_EQ(head(65535), octets({0x82, 126, 255, 255}));
  EXPECT_EQ(head(65536), octets({0x82, 127, 0, 0, 0, 0, 0, 1, 0, 0}));
}

TEST(WebSocket, UnmasksAShortBinaryFrame) {
  const auto frame = octets({0x82, 0x83, 1, 2, 4, 8, 0x10, 0x22, 0x44, 99});
  ClientFrame read;
  ASSERT_EQ(read_client_frame(frame, false, read), FrameVerdict::good);
  EXPECT_EQ(std::vector(read.payload().begin(), read.payload().end()), octets({0x11, 0x20, 0x40}));
  EXPECT_EQ(read.length, 9U);
  for (std::size_t size = 0; size < 9; ++size)
    EXPECT_EQ(read_client_frame(std::span(frame).first(size), false, read),
              FrameVerdict::incomplete);
}

TEST(WebSocket, RefusesUnmaskedLongPartialAndOtherFrames) {
  ClientFrame read;
  EXPECT_EQ(read_client_frame(octets({0x82, 0x01, 7}), false, read), FrameVerdict::bad);
  EXPECT_EQ(read_client_frame(octets({0x82, 0xFE, 0, 126}), false, read), FrameVerdict::bad);
  EXPECT_EQ(read_client_frame(octets({0x02, 0x81}), false, read),
            FrameVerdict::bad);  // first of several
  EXPECT_EQ(read_client_frame(octets({0x80, 0x81}), false, read),
            FrameVerdict::bad);  // the last of them
  EXPECT_EQ(read_client_frame(octets({0xC2, 0x81}), false, read), FrameVerdict::bad);  // compressed
  EXPECT_EQ(read_client_frame(octets({0x81, 0x81}), false, read), FrameVerdict::bad);  // text
  EXPECT_EQ(read_client_frame(octets({0x89, 0x80}), false, read), FrameVerdict::bad);  // ping
  EXPECT_EQ(read_client_frame(octets({0x88, 0x80}), false, read), FrameVerdict::closing);
}

}  // namespace
}  // namespace reckon::tools
