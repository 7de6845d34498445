// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/pdu/codec/enumerations.hpp"

#include <gtest/gtest.h>

namespace reckon::pdu {
namespace {

TEST(EnumerationNames, AreEmptyForValuesWithoutOne) {
  EXPECT_EQ(name(DeadReckoningAlgorithm::rvw), "DRM RVW");
  EXPECT_EQ(name(DeadReckoningAlgorithm{10}), "");
  EXPECT_EQ(name(ProtocolFamily::experimental), "Experimental");
  EXPECT_EQ(name(ProtocolFamily{128}), "");
  EXPECT_EQ(name(CollisionType{2}), "");
  EXPECT_EQ(name(EntityKind{255}), "");
  EXPECT_EQ(name(ForceId::opposing), "Opposing");
}

TEST(EnumerationNames, OfThisProjectEndWithTheLastValue) {
  EXPECT_EQ(name(ForceModelKind::modal), "Modal");
  EXPECT_EQ(name(ForceModelKind{6}), "");
  EXPECT_EQ(name(CellScheme::locales), "Locales");
  EXPECT_EQ(name(CellScheme{5}), "");
  EXPECT_EQ(name(CompressedForm::residual), "Residual");
  EXPECT_EQ(name(CompressedForm{4}), "");
  EXPECT_EQ(name(MembershipAction::join_near), "Join Near");
  EXPECT_EQ(name(MembershipAction{6}), "");
  EXPECT_EQ(name(AssuredKind::acknowledgement), "Acknowledgement");
  EXPECT_EQ(name(AssuredKind{4}), "");
}

}  // namespace
}  // namespace reckon::pdu
