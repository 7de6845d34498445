// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A flat surface, as passed to contacts.
#pragma once

#include "reckon/haptics/passivity/contact_spring.hpp"

namespace reckon::test {

/// A plane at x = `height` [m], felt beyond it, of stiffness `k` [N/m] up to `slope_limit` [N/m].
inline haptics::ContactParameters plane(double k, double height, double slope_limit) {
  haptics::ContactParameters theta;
  theta.kind = pdu::ForceModelKind::plane;
  theta.normal = -Eigen::Vector3d::UnitX();
  theta.point = Eigen::Vector3d(height, 0, 0);
  theta.k1 = k;
  theta.gain = 1;
  theta.slope_limit = slope_limit;
  return theta;
}

}  // namespace reckon::test
