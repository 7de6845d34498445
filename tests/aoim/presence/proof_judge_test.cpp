// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/presence/proof_judge.hpp"

#include <gtest/gtest.h>

#include "reckon/tests/aoim/support/samples.hpp"

namespace reckon::aoim {
namespace {

using test::presence_of;

// The first announcement of the slot with this link.
pdu::Presence announced(std::uint32_t number, std::uint8_t secret) {
  LifeChain chain({test::scrambled, nullptr}, {secret});
  pdu::Presence said = presence_of(2, 22);
  for (std::uint32_t i = 0; i <= number; i += kSlotLinks)
    chain.sign(said, {}, i / kSlotLinks * kSlot);
  return said;
}

TEST(ProofJudge, WrongProofsDoNotBlockTheOwnersProof) {
  const auto now = std::chrono::seconds(100);
  const LifeTip tip(announced(0, 1), std::chrono::seconds(0));
  const pdu::Presence far = announced(1600, 1), near = announced(48, 1),
                      forged = announced(1600, 2);
  ProofJudge proofs(test::scrambled);
  EXPECT_EQ(proofs.judge(tip, far, now, false), Opening::newer);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(proofs.judge(tip, forged, now, false), Opening::wrong);
  EXPECT_EQ(proofs.judge(tip, far, now, false), Opening::wrong) << "tired of those from elsewhere";
  EXPECT_EQ(proofs.judge(tip, near, now, false), Opening::newer);
  EXPECT_EQ(proofs.judge(tip, far, now, true), Opening::newer);
  EXPECT_EQ(proofs.judge(tip, far, now + std::chrono::seconds(1), false), Opening::newer);
}

TEST(ProofJudge, ProvesNothingWithoutAFunction) {
  ProofJudge proofs(nullptr);
  const LifeTip tip(announced(0, 1), std::chrono::seconds(0));
  EXPECT_EQ(proofs.judge(tip, announced(1, 1), std::chrono::seconds(1), false), Opening::none);
}

}  // namespace
}  // namespace reckon::aoim
