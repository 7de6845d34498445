// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/viewer/protocol/page_request.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <vector>

namespace reckon::tools {
namespace {

template <typename... Values>
std::vector<std::byte> message(std::uint8_t kind, const Values&... values) {
  std::vector<std::byte> out{std::byte{kind}};
  [[maybe_unused]] const auto add = [&out](const auto& value) {
    const std::size_t size = out.size();
    out.resize(size + sizeof value);
    std::memcpy(out.data() + size, &value, sizeof value);
  };
  (add(values), ...);
  return out;
}

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr std::uint8_t kOn = 1;

TEST(PageRequest, IsReadOfEachKind) {
  EXPECT_EQ(std::get<DrawnRequest>(*read_page_request(message(1, 77U))).number, 77U);
  EXPECT_EQ(std::get<SeekRequest>(*read_page_request(message(2, -1.5))).time, -1.5);
  EXPECT_EQ(std::get<SpeedRequest>(*read_page_request(message(3, 16.0F))).speed, 16.0F);
  EXPECT_TRUE(std::holds_alternative<LiveRequest>(*read_page_request(message(4))));
  EXPECT_EQ(std::get<StepRequest>(*read_page_request(message(5, std::int8_t{-1}))).seconds, -1);
  EXPECT_EQ(std::get<StepRequest>(*read_page_request(message(5, std::int8_t{2}))).updates, 1);
  const auto pointer = std::get<PointerRequest>(
      *read_page_request(message(6, std::uint16_t{1}, 1.F, 2.F, 3.F, kOn)));
  EXPECT_EQ(pointer.hand, 1);
  EXPECT_EQ(pointer.position.z(), 3.F);
  EXPECT_TRUE(pointer.held);
  EXPECT_FALSE(pointer.grabs);
  const auto grabbing = std::get<PointerRequest>(
      *read_page_request(message(6, std::uint16_t{1}, 1.F, 2.F, 3.F, std::uint8_t{2})));
  EXPECT_TRUE(grabbing.held && grabbing.grabs);
  const auto network =
      std::get<NetworkRequest>(*read_page_request(message(7, 300.F, 0.F, 0.5F, kOn)));
  EXPECT_EQ(network.delay_ms, 300.F);
  EXPECT_TRUE(network.outage);
  EXPECT_TRUE(std::holds_alternative<TakeHandRequest>(*read_page_request(message(8))));
  EXPECT_TRUE(std::holds_alternative<GiveHandRequest>(*read_page_request(message(9))));
  EXPECT_EQ(std::get<FollowRequest>(*read_page_request(message(10, std::uint16_t{5}))).slot, 5);
  EXPECT_TRUE(std::holds_alternative<GoAloneRequest>(*read_page_request(message(11))));
  EXPECT_TRUE(std::holds_alternative<WholeRequest>(*read_page_request(message(12))));
}

TEST(PageRequest, RefusesInvalidAndOutOfRangeNumbers) {
  const auto is_refused = [](const std::vector<std::byte>& octets) {
    return !read_page_request(octets).has_value();
  };
  EXPECT_TRUE(is_refused(message(2, std::numeric_limits<double>::infinity())));
  EXPECT_TRUE(is_refused(message(3, kNan)));
  EXPECT_TRUE(is_refused(message(3, 0.05F)));
  EXPECT_TRUE(is_refused(message(3, -1.F)));
  EXPECT_TRUE(is_refused(message(3, 17.F)));
  EXPECT_TRUE(is_refused(message(5, std::int8_t{0})));
  EXPECT_TRUE(is_refused(message(5, std::int8_t{100})));
  EXPECT_TRUE(is_refused(message(6, std::uint16_t{0}, kNan, 0.F, 0.F, kOn)));
  EXPECT_TRUE(is_refused(message(6, std::uint16_t{0}, 0.F, 1e30F, 0.F, kOn)));
  EXPECT_TRUE(is_refused(message(6, std::uint16_t{0}, 0.F, 0.F, 0.F, std::uint8_t{3})));
  EXPECT_TRUE(is_refused(message(7, -1.F, 0.F, 0.F, kOn)));
  EXPECT_TRUE(is_refused(message(7, 0.F, 301.F, 0.F, kOn)));
  EXPECT_TRUE(is_refused(message(7, 0.F, 0.F, kNan, kOn)));
}

TEST(PageRequest, RefusesEveryOtherLengthAndKind) {
  const auto pointer = message(6, std::uint16_t{1}, 1.F, 2.F, 3.F, kOn);
  for (std::size_t size = 0; size < pointer.size(); ++size)
    EXPECT_FALSE(read_page_request(std::span(pointer).first(size)).has_value()) << size;
  EXPECT_FALSE(read_page_request(message(4, kOn)).has_value());
  EXPECT_FALSE(read_page_request(message(0)).has_value());
  EXPECT_FALSE(read_page_request(message(13)).has_value());
}

TEST(PageRequest, PointerNetworkAndHandsChangeTheExercise) {
  EXPECT_TRUE(changes_exercise(PointerRequest{}));
  EXPECT_TRUE(changes_exercise(NetworkRequest{}));
  EXPECT_TRUE(changes_exercise(TakeHandRequest{}));
  EXPECT_TRUE(changes_exercise(GiveHandRequest{}));
  EXPECT_TRUE(changes_exercise(GoAloneRequest{}));
  EXPECT_FALSE(changes_exercise(SeekRequest{}));
  EXPECT_FALSE(changes_exercise(FollowRequest{}));
}

}  // namespace
}  // namespace reckon::tools
