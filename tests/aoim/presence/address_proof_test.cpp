// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The proof of a sender's address by the MAC of its announcement.
#include "reckon/aoim/presence/address_proof.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "reckon/tests/aoim/support/segment.hpp"

namespace reckon::aoim {
namespace {

using namespace test;

constexpr ProofFunctions kProofs{scrambled, scrambled_with};
const SourceAddress kGenuine = source(2), kRelayed = source(66);

// Announcements of one sender, in order, with their send times.
class AddressMac : public testing::Test {
 protected:
  pdu::Presence said(nanoseconds at, const SourceAddress& from = kGenuine) {
    pdu::Presence one = presence_of(2, 22);
    chain_.sign(one, from, at);
    return one;
  }
  bool note(const pdu::Presence& heard, nanoseconds at, const SourceAddress& from) {
    return proof_.note(heard, at, from, from == kGenuine, scrambled_with);
  }

  LifeChain chain_{kProofs, {9}};
  AddressProof proof_;
};

TEST_F(AddressMac, ProvesTheAddressItNames) {
  const SourceAddress moved = source(3);
  note(said(seconds(0)), milliseconds(3), kGenuine);
  EXPECT_TRUE(note(said(milliseconds(300), moved), milliseconds(303), moved));
  EXPECT_FALSE(proof_.disclose(said(milliseconds(900)), kGenuine, kProofs).proven);
  const Disclosure found = proof_.disclose(said(milliseconds(1100)), kGenuine, kProofs);
  EXPECT_EQ(found.proven, moved);
  EXPECT_EQ(found.refuted.port, 0);
  EXPECT_TRUE(proof_.is_proved());
}

TEST_F(AddressMac, RefutesARelayAndAlteredContent) {
  for (const bool is_altered : {false, true}) {
    SCOPED_TRACE(is_altered);
    AddressProof proof;
    LifeChain chain(kProofs, {9});
    pdu::Presence one = presence_of(2, 22), next = one;
    chain.sign(one, kGenuine, seconds(5));
    chain.sign(next, kGenuine, seconds(6));
    if (is_altered) one.simulation.application = 3;
    const SourceAddress from = is_altered ? kGenuine : kRelayed;
    proof.note(one, seconds(5), from, false, scrambled_with);
    const Disclosure found = proof.disclose(next, source(4), kProofs);
    EXPECT_FALSE(found.proven);
    EXPECT_EQ(found.refuted, from);
    EXPECT_FALSE(proof.is_proved());
  }
}

// Anyone with the key can make a MAC for any address.
TEST_F(AddressMac, ProvesNothingOnceItsKeyMayBeRevealed) {
  for (const int late_ms : {-30'000, -150, -50, 0, 30'000}) {
    SCOPED_TRACE(late_ms);
    AddressProof proof;
    LifeChain genuine(kProofs, {9}), forging(kProofs, {9});
    pdu::Presence one = presence_of(2, 22), forged = one, next = one;
    for (int s = 0; s < 100; ++s) {
      genuine.sign(one, kGenuine, seconds(s));
      forging.sign(forged, kRelayed, seconds(s));
      (void)proof.disclose(one, kGenuine, kProofs);
      if (s < 70) proof.note(one, seconds(s), kGenuine, true, scrambled_with);
      if (s == 99)
        proof.note(forged, seconds(100) + milliseconds(late_ms), kRelayed, false, scrambled_with);
    }
    genuine.sign(next, kGenuine, seconds(100));
    EXPECT_EQ(proof.disclose(next, kGenuine, kProofs).proven.has_value(), late_ms <= -150);
  }
}

TEST_F(AddressMac, IsAcceptedAgainAfterTheSenderWasSuspended) {
  nanoseconds slept{0};
  std::vector<bool> in_time;
  for (int s = 0; s < 60; ++s) {
    if (s == 20) slept = seconds(9);  // longer than the slot counter covers
    const auto now = seconds(s) + slept;
    const pdu::Presence one = said(now);
    (void)proof_.disclose(one, kGenuine, kProofs);
    note(one, now, kGenuine);
    pdu::Presence copy = one;
    copy.slot_time += 1;
    in_time.push_back(note(copy, now + milliseconds(1), kRelayed));
  }
  EXPECT_TRUE(in_time[19]);
  EXPECT_FALSE(in_time[22]);
  EXPECT_TRUE(in_time[40]);
}

TEST_F(AddressMac, EachOfManyAddressesHasAChance) {
  int proven = 0;
  for (int s = 0; s < 200; ++s) {
    const pdu::Presence one = said(seconds(s), source(3));
    if (proof_.disclose(one, kGenuine, kProofs).proven) ++proven;
    for (std::uint8_t i = 0; i < 20; ++i)
      note(one, seconds(s) + milliseconds(i),
           source(static_cast<std::uint8_t>(i == 13 ? 3 : 80 + i)));
  }
  EXPECT_GT(proven, 10);
}

}  // namespace
}  // namespace reckon::aoim
