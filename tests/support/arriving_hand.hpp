// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A hand that approaches its operator's sweep: a body that appears inside a hand gives no force.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "reckon/haptics/devices/simulated_device.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/scene/scene_file.hpp"

namespace reckon::test {

/// The sweep of an operator, after a second in which the hand comes from `away` [m] beside its
/// start.
inline haptics::HandScript arriving(const peer::OperatorConfig& sweep,
                                    const Eigen::Vector3d& away) {
  return [sweep, away](double time) {
    const double rate = 2.0 * std::numbers::pi / pdu::to_seconds(sweep.period);
    const double phase = rate * std::max(0.0, time - 1.0);
    const Eigen::Vector3d way = sweep.to - sweep.from;
    haptics::HandTarget target;
    target.position = sweep.from + 0.5 * (1.0 - std::cos(phase)) * way;
    target.velocity = 0.5 * rate * std::sin(phase) * way;
    if (time >= 1.0) return target;
    target.position += (1.0 - time) * away;
    target.velocity = -away;
    return target;
  };
}

}  // namespace reckon::test
