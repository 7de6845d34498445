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

}  // namespace
}  // namespace reckon::pdu
