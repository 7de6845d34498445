// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Properties of every PDU type of the list. The suite is instantiated over a share of the list in
// each every_pdu_N_test.cpp, so that they compile in parallel.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>
#include <random>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "reckon/pdu/pdu_types.hpp"
#include "reckon/pdu/print.hpp"
#include "reckon/pdu/type_names.hpp"
#include "reckon/tests/pdu/support/guarded_buffer.hpp"
#include "reckon/tests/pdu/support/random_pdu.hpp"
#include "reckon/tests/support/allocation_guard.hpp"
#include "reckon/tests/support/wire_samples.hpp"

namespace reckon::pdu {
namespace {

using test::GuardedBuffer;
using test::RandomFields;

inline constexpr std::size_t kShares = 6;

template <std::size_t share, typename... T, std::size_t... i>
auto share_of(TypeList<T...>, std::index_sequence<i...>) {
  using All = std::tuple<std::type_identity<T>...>;
  return testing::Types<typename std::tuple_element_t<share + kShares * i, All>::type...>{};
}
constexpr std::size_t share_size(std::size_t share) {
  return (PduTypes::kSize - share + kShares - 1) / kShares;
}
/// Every kShares-th type of the list, from `share` on.
template <std::size_t share>
using Share = decltype(share_of<share>(PduTypes{}, std::make_index_sequence<share_size(share)>{}));

/// Visitor: does the PDU take all octets up to its end?
class RestCheck {
 public:
  template <typename T>
  void operator()(std::string_view, const T&) {}
  template <typename View, typename R>
  void count(std::string_view, const View&, R) {}
  template <typename View, typename R>
  void records(std::string_view, const View&, R) {}
  template <typename View>
  void walked(std::string_view, const View&) {
    // Such views have no count of their own, only the constant 0.
    if constexpr (!std::is_member_object_pointer_v<decltype(&View::count)>) keeps_ = true;
  }
  [[nodiscard]] bool keeps() const { return keeps_; }

 private:
  bool keeps_ = false;
};
template <typename T>
bool keeps_rest() {
  // With the visitor of a reader: views may be shown as the records that they hold.
  RestCheck check;
  fields(check, *std::make_unique<T>());
  return check.keeps();
}

inline PduType type_found_by_visit(std::span<const std::byte> octets) {
  PduHeader header;
  auto found = PduType::other;
  if (decode_header(octets, header) != DecodeError::none) return found;
  static_cast<void>(visit(octets, header,
                          [&](const auto& pdu) { found = std::decay_t<decltype(pdu)>::kPduType; }));
  return found;
}

class PduNames {
 public:
  template <typename T>
  static std::string GetName(int) {
    return std::string(snake_name(T::kPduType));
  }
};

template <typename T>
class EveryPdu : public testing::Test {
 protected:
  static std::vector<std::byte> sample() { return test::sample_octets(snake_name(T::kPduType)); }
  static std::string json(const T& pdu) {
    std::string text;
    TextSink sink(text);
    print_json(pdu, sink);
    return text;
  }
};
TYPED_TEST_SUITE_P(EveryPdu);

std::vector<std::byte> encoded(const auto& pdu) {
  std::vector<std::byte> octets(wire_size(pdu));
  EXPECT_EQ(encode(pdu, octets), octets.size());
  return octets;
}

TYPED_TEST_P(EveryPdu, DecodesTheGoldenSampleToItsValues) {
  const auto octets = this->sample();
  TypeParam pdu;
  ASSERT_EQ(decode(octets, pdu), DecodeError::none);
  EXPECT_EQ(nlohmann::json::parse(this->json(pdu)),
            test::sample_values(snake_name(TypeParam::kPduType)));
}

TYPED_TEST_P(EveryPdu, EncodesTheGoldenSampleToTheSameOctets) {
  const auto octets = this->sample();
  TypeParam pdu;
  ASSERT_EQ(decode(octets, pdu), DecodeError::none);
  EXPECT_EQ(encoded(pdu), octets);
}

TYPED_TEST_P(EveryPdu, RoundTripsWithAllFields) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    RandomFields random(seed);
    TypeParam pdu;
    fields(random, pdu);
    const auto octets = encoded(pdu);
    TypeParam back;
    ASSERT_EQ(decode(octets, back), DecodeError::none) << "seed " << seed;

    pdu.header.pdu_type = TypeParam::kPduType;
    pdu.header.protocol_family = TypeParam::kProtocolFamily;
    pdu.header.length = static_cast<std::uint16_t>(octets.size());
    EXPECT_EQ(this->json(back), this->json(pdu)) << "seed " << seed;
    EXPECT_EQ(encoded(back), octets) << "seed " << seed;
  }
}

TYPED_TEST_P(EveryPdu, RejectsEveryTruncationWithoutReadingBeyondIt) {
  const auto octets = this->sample();
  GuardedBuffer buffer;
  for (std::size_t size = 0; size < octets.size(); ++size) {
    TypeParam pdu;
    EXPECT_EQ(decode(buffer.hold(std::span(octets).first(size)), pdu), DecodeError::truncated)
        << size << " octets";
  }
}

TYPED_TEST_P(EveryPdu, RejectsEveryLengthFieldBelowTheFixedPart) {
  const auto octets = this->sample();
  GuardedBuffer buffer;
  for (std::uint16_t length = 0; length < kFixedSize<TypeParam>; ++length) {
    auto lying = buffer.hold(std::span(octets).first(std::max<std::size_t>(length, kHeaderSize)));
    store_big_endian(lying.data() + 8, length);
    TypeParam pdu;
    EXPECT_EQ(decode(lying, pdu), DecodeError::length) << length;
  }
}

TYPED_TEST_P(EveryPdu, NeverReadsBeyondACutLengthField) {
  const auto octets = this->sample();
  GuardedBuffer buffer;
  for (auto length = static_cast<std::uint16_t>(kFixedSize<TypeParam>); length < octets.size();
       ++length) {
    auto lying = buffer.hold(std::span(octets).first(length));
    store_big_endian(lying.data() + 8, length);
    TypeParam pdu;
    // Only the padding of the last record may be missing, or the end of a part that is kept as
    // octets.
    const bool accepted = decode(lying, pdu) == DecodeError::none;
    EXPECT_TRUE(!accepted || length + 8U > octets.size() || keeps_rest<TypeParam>()) << length;
  }
}

TYPED_TEST_P(EveryPdu, RoundTripsAcceptedDamageWithoutOverrun) {
  const auto octets = this->sample();
  GuardedBuffer buffer;
  std::mt19937_64 random(7);
  std::size_t accepted = 0;
  for (int i = 0; i < 20000; ++i) {
    auto damaged = buffer.hold(octets);
    for (std::uint64_t n = 1 + random() % 4; n > 0; --n)
      damaged[random() % damaged.size()] =
          static_cast<std::byte>(random() % 4 == 0 ? 255 : random());
    TypeParam pdu;
    if (decode(damaged, pdu) != DecodeError::none) continue;
    ++accepted;
    const auto back = encoded(pdu);
    ASSERT_LE(back.size(), damaged.size());
    // The encoder sets the family and the length; all other octets are unchanged.
    EXPECT_TRUE(std::equal(back.begin(), back.begin() + 3, damaged.begin()));
    EXPECT_TRUE(std::equal(back.begin() + 4, back.begin() + 8, damaged.begin() + 4));
    EXPECT_TRUE(std::equal(back.begin() + 10, back.end(), damaged.begin() + 10));
  }
  EXPECT_GT(accepted, 1000U);
}

TYPED_TEST_P(EveryPdu, LeavesADefaultPduAfterAnError) {
  auto octets = this->sample();
  octets[0] = std::byte{99};
  RandomFields random(1);
  TypeParam pdu;
  fields(random, pdu);
  ASSERT_EQ(decode(octets, pdu), DecodeError::version);
  EXPECT_EQ(this->json(pdu), this->json(TypeParam{}));
}

TYPED_TEST_P(EveryPdu, RefusesOctetsOfAnotherType) {
  auto octets = this->sample();
  octets[2] = std::byte{200};
  TypeParam pdu;
  EXPECT_EQ(decode(octets, pdu), DecodeError::pdu_type);
}

TYPED_TEST_P(EveryPdu, SkipsOctetsAddedByALaterRevision) {
  auto octets = this->sample();
  const auto whole = octets;
  octets.resize(octets.size() + 24, std::byte{0xEE});
  store_big_endian(octets.data() + 8, static_cast<std::uint16_t>(octets.size()));
  TypeParam pdu;
  if (keeps_rest<TypeParam>()) {
    // Octets that cannot be distinguished from the PDU's own are kept, or refused if they form no
    // record.
    if (decode(octets, pdu) != DecodeError::none) return;
    EXPECT_EQ(encoded(pdu), octets);
    return;
  }
  ASSERT_EQ(decode(octets, pdu), DecodeError::none);
  EXPECT_EQ(encoded(pdu), whole);
}

TYPED_TEST_P(EveryPdu, WritesNothingWhenItDoesNotFit) {
  const auto octets = this->sample();
  TypeParam pdu;
  ASSERT_EQ(decode(octets, pdu), DecodeError::none);
  std::vector<std::byte> out(octets.size() - 1, std::byte{0xAA});
  EXPECT_EQ(encode(pdu, out), 0U);
  EXPECT_EQ(out, std::vector<std::byte>(octets.size() - 1, std::byte{0xAA}));
}

TYPED_TEST_P(EveryPdu, AllocatesNothingWhileDecodingAndEncoding) {
  const auto octets = this->sample();
  std::array<std::byte, 512> out;
  const test::AllocationGuard guard;
  TypeParam pdu;
  const DecodeError error = decode(octets, pdu);
  const std::size_t written = encode(pdu, out);
  const std::size_t allocations = guard.count();
  EXPECT_EQ(error, DecodeError::none);
  EXPECT_EQ(written, octets.size());
  EXPECT_EQ(allocations, 0U);
}

TYPED_TEST_P(EveryPdu, IsFoundByTheTypeInItsHeader) {
  const auto octets = this->sample();
  EXPECT_EQ(type_found_by_visit(octets), TypeParam::kPduType);
}

REGISTER_TYPED_TEST_SUITE_P(EveryPdu, DecodesTheGoldenSampleToItsValues,
                            EncodesTheGoldenSampleToTheSameOctets, RoundTripsWithAllFields,
                            RejectsEveryTruncationWithoutReadingBeyondIt,
                            RejectsEveryLengthFieldBelowTheFixedPart,
                            NeverReadsBeyondACutLengthField, RoundTripsAcceptedDamageWithoutOverrun,
                            LeavesADefaultPduAfterAnError, RefusesOctetsOfAnotherType,
                            SkipsOctetsAddedByALaterRevision, WritesNothingWhenItDoesNotFit,
                            AllocatesNothingWhileDecodingAndEncoding, IsFoundByTheTypeInItsHeader);

}  // namespace
}  // namespace reckon::pdu
