// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "reckon/deadreckon/force/force_predictor.hpp"
#include "reckon/deadreckon/motion/convergence.hpp"
#include "reckon/deadreckon/motion/drm.hpp"
#include "reckon/deadreckon/sending/update_policy.hpp"
#include "reckon/deadreckon/wire_conversion.hpp"
#include "reckon/tests/deadreckon/support/oracle.hpp"
#include "reckon/tests/support/allocation_guard.hpp"

namespace reckon::deadreckon {
namespace {

TEST(Allocation, ConversionToForceAllocatesNothing) {
  test::Random random(1);
  const LocalFrame frame(0.8, 0.2, 100);
  const KinematicState truth = random.state(pdu::DeadReckoningAlgorithm::rvb, 1);
  ForceModel model;
  model.kind = pdu::ForceModelKind::sphere;
  model.k1 = 100;
  model.radius = 0.1;
  model.validity = 12;
  pdu::EntityState pdu;
  pdu::HapticRecord record;
  KinematicState state;
  UpdatePolicy policy({}, 5);
  PoseConvergence convergence;
  ForcePredictor predictor;
  double sink = 0;

  const reckon::test::AllocationGuard guard;
  for (int i = 0; i < 100; ++i) {
    const double now = 0.01 * i;
    if (to_wire(truth, frame, pdu) != ConversionError::none) sink += 1;
    if (from_wire(pdu, frame, state) != ConversionError::none) sink += 1;
    if (to_wire(model, record) != ConversionError::none) sink += 1;
    if (from_wire(record, model) != ConversionError::none) sink += 1;
    predictor.update(model, state, now);
    const Pose pose = extrapolate(state, 0.1);
    convergence.restart(pose, extrapolate(state, 0.2), now);
    sink += convergence.shown(pose, now + 0.05).position.x();
    const ProbeState probe = {pose.position, pose.velocity, 0.01};
    const double off = predictor.error(model, pose, {&probe, 1}, now);
    if (policy.decide(pose, now, off) != SendReason::none) policy.sent(state, now);
  }
  EXPECT_EQ(guard.count(), 0u);
  EXPECT_TRUE(std::isfinite(sink));
}

}  // namespace
}  // namespace reckon::deadreckon
