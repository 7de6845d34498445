// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Copies of one datagram over several interfaces.
#include "reckon/peer/network/copy_filter.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <span>
#include <string>
#include <string_view>

namespace reckon::peer {
namespace {

using namespace std::chrono_literals;
using std::chrono::nanoseconds;

constexpr unsigned kLo = 1, kEth0 = 2, kEth1 = 3;

class CopiesOfADatagram : public testing::Test {
 protected:
  bool is_copy(unsigned interface, std::string_view octets, nanoseconds now = 1s) {
    const auto bytes = std::as_bytes(std::span(octets));
    return filter_.is_copy({group_, sender_, bytes, now}, interface);
  }
  CopyFilter filter_;
  IpEndpoint group_ = IpEndpoint::v4(0xefc00100, 3000), sender_ = IpEndpoint::v4(0x0a090901, 4000);
};

TEST_F(CopiesOfADatagram, ComeOverOtherInterfaces) {
  EXPECT_FALSE(is_copy(kEth0, "a"));
  EXPECT_TRUE(is_copy(kEth1, "a"));
  EXPECT_TRUE(is_copy(kLo, "a"));
  EXPECT_FALSE(is_copy(kEth1, "b"));
}

TEST_F(CopiesOfADatagram, ComeOverInterfacesWithHighNumbersToo) {
  constexpr unsigned kVeth = 32 + kEth0, kBridge = 63 + kEth0;
  EXPECT_FALSE(is_copy(kEth0, "a"));
  EXPECT_TRUE(is_copy(kVeth, "a"));
  EXPECT_TRUE(is_copy(kBridge, "a"));
}

TEST_F(CopiesOfADatagram, AreNotEqualOnesOfTheSameInterface) {
  EXPECT_FALSE(is_copy(kEth0, "a"));
  EXPECT_FALSE(is_copy(kEth0, "a")) << "sent twice";
  EXPECT_TRUE(is_copy(kEth1, "a"));
  EXPECT_TRUE(is_copy(kEth1, "a"));
  EXPECT_FALSE(is_copy(kEth1, "a")) << "one more there than on the first interface";
  EXPECT_TRUE(is_copy(kEth0, "a"));
}

TEST_F(CopiesOfADatagram, HaveTheSameSenderAndDestination) {
  EXPECT_FALSE(is_copy(kEth0, "a"));
  sender_.port = 4001;
  EXPECT_FALSE(is_copy(kEth1, "a"));
  group_.port = 3001;
  EXPECT_FALSE(is_copy(kEth0, "a"));
}

TEST_F(CopiesOfADatagram, MayComeFromSeveralOwnAddresses) {
  EXPECT_FALSE(is_copy(kEth0, "a"));
  sender_ = IpEndpoint::v4(0x7f000001, 4000);
  EXPECT_FALSE(is_copy(kLo, "a")) << "another host";
  filter_.set_own_addresses({IpEndpoint::v4(0x0a090901, 0), IpEndpoint::v4(0x7f000001, 0)});
  EXPECT_FALSE(is_copy(kLo, "b"));
  sender_ = IpEndpoint::v4(0x0a090901, 4000);
  EXPECT_TRUE(is_copy(kEth0, "b"));
}

TEST_F(CopiesOfADatagram, ComeWithinHalfASecond) {
  EXPECT_FALSE(is_copy(kEth0, "a", 1s));
  EXPECT_TRUE(is_copy(kEth1, "a", 1s + CopyFilter::kWindow));
  EXPECT_FALSE(is_copy(kLo, "a", 1s + CopyFilter::kWindow + 1ns));
}

TEST_F(CopiesOfADatagram, AreRememberedUpToABound) {
  for (std::size_t i = 0; i < CopyFilter::kMost; ++i) {
    const std::string text = std::to_string(i);
    ASSERT_FALSE(is_copy(kEth0, text));
  }
  EXPECT_FALSE(is_copy(kEth1, "0")) << "the oldest is forgotten";
  EXPECT_TRUE(is_copy(kEth1, "100"));
}

}  // namespace
}  // namespace reckon::peer
