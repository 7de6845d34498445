// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/viewer/web/message_deflate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "reckon/tests/tools/support/message_inflate.hpp"

namespace reckon::tools {
namespace {

ClientFrame frame_of(std::string_view payload) {
  ClientFrame frame;
  frame.size = payload.size();
  std::ranges::transform(payload, frame.octets.begin(),
                         [](char octet) { return static_cast<std::byte>(octet); });
  return frame;
}

std::string text_of(const ClientFrame& frame) {
  return {reinterpret_cast<const char*>(frame.octets.data()), frame.size};
}

TEST(MessageDeflate, AcceptsOffersOfBrowsers) {
  const auto chromium = agree_on_deflate("permessage-deflate; client_max_window_bits");
  ASSERT_TRUE(chromium);
  EXPECT_EQ(chromium->answer, "permessage-deflate; client_no_context_takeover");
  EXPECT_TRUE(chromium->keeps_context);
  EXPECT_TRUE(agree_on_deflate("permessage-deflate"));
  EXPECT_TRUE(agree_on_deflate("x-webkit-deflate-frame, permessage-deflate"));
}

TEST(MessageDeflate, ObeysTheLimitsOfAnOffer) {
  const auto terms = agree_on_deflate(
      "permessage-deflate; server_no_context_takeover; server_max_window_bits=\"10\"");
  ASSERT_TRUE(terms);
  EXPECT_FALSE(terms->keeps_context);
  EXPECT_EQ(terms->window_bits, 10);
  EXPECT_EQ(terms->answer,
            "permessage-deflate; client_no_context_takeover; server_no_context_takeover; "
            "server_max_window_bits=10");
  const auto second = agree_on_deflate(
      "permessage-deflate; server_max_window_bits=8, permessage-deflate; "
      "server_max_window_bits=15");
  ASSERT_TRUE(second) << "8 bits are declined";
  EXPECT_EQ(second->window_bits, MessageCompression::kWindowBits);
}

TEST(MessageDeflate, DeclinesInvalidOffers) {
  for (const std::string_view offer :
       {"", "permessage-deflat", "permessage-deflate; server_max_window_bits",
        "permessage-deflate; server_max_window_bits=16", "permessage-deflate; unknown",
        "permessage-deflate; server_max_window_bits=010",
        "permessage-deflate; client_max_window_bits=7", "permessage-deflate;;",
        "permessage-deflate; server_no_context_takeover=1",
        "permessage-deflate; server_no_context_takeover; server_no_context_takeover",
        "permessage-deflate; client_max_window_bits; client_max_window_bits"})
    EXPECT_FALSE(agree_on_deflate(offer)) << offer;
}

TEST(MessageDeflate, MessagesComeBackAsTheyWere) {
  for (const char* offer : {"permessage-deflate", "permessage-deflate; server_no_context_takeover",
                            "permessage-deflate; server_max_window_bits=9"}) {
    MessageCompression deflater(*agree_on_deflate(offer));
    served::StreamInflater inflater;
    std::mt19937 random(1);
    for (const std::size_t size : {0U, 1U, 700U, 1024U, 70'000U, 700U, 3U}) {
      std::string message(size, 'a');
      for (char& octet : message) octet = static_cast<char>(random() % (size % 3 == 0 ? 256 : 4));
      EXPECT_EQ(inflater.inflate(deflater.deflate(message)), message) << offer << ' ' << size;
    }
  }
}

TEST(MessageDeflate, ContextShortensRepeatedMessages) {
  const std::string numbers = R"({"type":"numbers","time":12.345,"span":[0.000,60.000]})";
  MessageCompression with(*agree_on_deflate("permessage-deflate")),
      without(*agree_on_deflate("permessage-deflate; server_no_context_takeover"));
  const std::size_t first = with.deflate(numbers).size();
  EXPECT_EQ(without.deflate(numbers).size(), first);
  EXPECT_LT(with.deflate(numbers).size(), first / 3);
  EXPECT_EQ(without.deflate(numbers).size(), first);
}

TEST(MessageDeflate, LeavesPicturesAsTheyAre) {
  MessageCompression deflater(*agree_on_deflate("permessage-deflate"));
  const auto text = std::make_shared<const std::string>(std::string(100, 'a'));
  const auto is_compressed = [](const PackedMessage& message) {
    return (message.head.octets[0] & std::byte{0x40}) != std::byte{0};
  };
  EXPECT_TRUE(is_compressed(pack_message(WebSocketOpcode::text, text, &deflater)));
  const PackedMessage picture = pack_message(WebSocketOpcode::binary, text, &deflater);
  EXPECT_FALSE(is_compressed(picture));
  EXPECT_EQ(picture.payload, text);
  EXPECT_FALSE(is_compressed(pack_message(WebSocketOpcode::text, text, nullptr)));
}

TEST(MessageInflate, ReadsTheExamplesOfRfc7692) {
  MessageCompression inflater(*agree_on_deflate("permessage-deflate"));
  for (const std::string_view example :
       {std::string_view("\xf2\x48\xcd\xc9\xc9\x07\x00", 7),                   // 7.2.3.1
        std::string_view("\x00\x05\x00\xfa\xff\x48\x65\x6c\x6c\x6f\x00", 11),  // 7.2.3.3
        std::string_view("\xf3\x48\xcd\xc9\xc9\x07\x00\x00", 8),               // 7.2.3.4
        std::string_view("\xf2\x48\x05\x00\x00\x00\xff\xff\xca\xc9\xc9\x07\x00", 13)}) {
    ClientFrame frame = frame_of(example);
    EXPECT_TRUE(inflater.inflate(frame));
    EXPECT_EQ(text_of(frame), "Hello");
  }
}

TEST(MessageInflate, RefusesWhatInflatesBeyondItsLimit) {
  MessageCompression deflater(*agree_on_deflate("permessage-deflate"));
  MessageCompression inflater(*agree_on_deflate("permessage-deflate"));
  ClientFrame longest = frame_of(deflater.deflate(std::string(kLongestClientFrame, 'a')));
  EXPECT_TRUE(inflater.inflate(longest));
  EXPECT_EQ(text_of(longest), std::string(kLongestClientFrame, 'a'));
  for (const std::size_t size : {kLongestClientFrame + 1, std::size_t{15'000}}) {
    MessageCompression bomb(*agree_on_deflate("permessage-deflate"));
    const std::string packed = bomb.deflate(std::string(size, 'a'));
    ASSERT_LE(packed.size(), kLongestClientFrame);
    ClientFrame frame = frame_of(packed);
    EXPECT_FALSE(inflater.inflate(frame)) << size;
  }
}

TEST(MessageInflate, RefusesDamageAndEarlierContext) {
  MessageCompression inflater(*agree_on_deflate("permessage-deflate"));
  for (const std::string_view bad :
       {std::string_view("\xff\xff\xff", 3), std::string_view("\x07", 1),
        std::string_view("\xf3\x48\xcd\xc9\xc9\x07\x00\x00\x00", 9)}) {
    ClientFrame frame = frame_of(bad);
    EXPECT_FALSE(inflater.inflate(frame)) << bad.size();
  }
  ClientFrame hello = frame_of(std::string_view("\xf2\x48\xcd\xc9\xc9\x07\x00", 7));
  EXPECT_TRUE(inflater.inflate(hello));
  // 7.2.3.2: "Hello" by reference to the message before.
  ClientFrame again = frame_of(std::string_view("\xf2\x00\x11\x00\x00", 5));
  EXPECT_FALSE(inflater.inflate(again)) << "each message stands for itself";
}

}  // namespace
}  // namespace reckon::tools
