// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/datagram_gate.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace reckon::peer {
namespace {

std::vector<std::byte> bytes_of(std::initializer_list<int> values) {
  std::vector<std::byte> result;
  for (const int value : values) result.push_back(static_cast<std::byte>(value));
  return result;
}

TEST(DatagramGate, RefusesDatagramsOutsideTheExercise) {
  const auto header = [](int version, int exercise, int length) {
    return bytes_of({version, exercise, 1, 1, 0, 0, 0, 0, length >> 8, length & 255, 0, 0});
  };
  EXPECT_EQ(refuse_at_gate(header(7, 1, 12), 1), Refusal::none);
  EXPECT_EQ(refuse_at_gate(header(6, 1, 144), 1), Refusal::none);
  for (const int version : {0, 1, 8, 0xE7, 255})
    EXPECT_EQ(refuse_at_gate(header(version, 1, 12), 1), Refusal::version) << version;
  std::vector<std::byte> sealed(kEnvelope, std::byte{0});
  sealed[0] = std::byte{0xE7};
  sealed[1] = std::byte{0x11};
  EXPECT_EQ(refuse_at_gate(sealed, 1), Refusal::sealed);
  EXPECT_EQ(refuse_at_gate(header(7, 2, 12), 1), Refusal::exercise);
  EXPECT_EQ(refuse_at_gate(header(7, 1, 11), 1), Refusal::length);
  EXPECT_EQ(refuse_at_gate({}, 1), Refusal::length);
  const std::vector<std::byte> whole = header(7, 1, 12);
  for (std::size_t size = 1; size < 12; ++size)
    EXPECT_EQ(refuse_at_gate(std::span(whole).first(size), 1), Refusal::length);
}

// The decoder counts truncated datagrams, under the name of its rule.
TEST(DatagramGate, LeavesTruncatedDatagramsToTheDecoder) {
  EXPECT_EQ(refuse_at_gate(bytes_of({7, 1, 1, 1, 0, 0, 0, 0, 0, 144, 0, 0}), 1), Refusal::none);
}

}  // namespace
}  // namespace reckon::peer
