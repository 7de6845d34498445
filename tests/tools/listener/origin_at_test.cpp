// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/listener/origin_at.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace reckon::tools {
namespace {

using Eigen::Vector3d;

TEST(OriginAt, GivesTheFrameOnTheEllipsoid) {
  for (const double latitude : {-std::numbers::pi / 2, -1.2, 0.0, 0.8, 1.5, std::numbers::pi / 2}) {
    const deadreckon::LocalFrame truth(latitude, 0.3, 250);
    const deadreckon::LocalFrame found = local_frame_at(truth.origin());
    EXPECT_LT((found.origin() - truth.origin()).norm(), 1e-6) << latitude;
    EXPECT_LT((found.rotation().col(2) - truth.rotation().col(2)).norm(), 1e-9) << latitude;
  }
}

TEST(OriginAt, CutsTheHeight) {
  EXPECT_EQ(origin_at({0, 0, -3e8}).height, 1e8);
  EXPECT_NEAR(origin_at({0, 2e7, 0}).height, 2e7 - 6378137.0, 1e-6);
}

TEST(OriginAt, IsThePositionItselfNearTheEarthsCentre) {
  for (const Vector3d& position : {Vector3d(0, 0, 0), Vector3d(30, -40, 0), Vector3d(-9e5, 1, 0)})
    EXPECT_LT((local_frame_at(position).origin() - position).norm(), 1e-6) << position.transpose();
  EXPECT_LT((local_frame_at({30, 40, 7}).origin() - Vector3d(30, 40, 0)).norm(), 1e-6);
}

}  // namespace
}  // namespace reckon::tools
