// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Whether a device may render a model: sampled by that device, it must not need more damping than
// the device has. A model that is passive where it was made says nothing about it (the thesis takes
// that for granted; 0.1 + 1/(s + 1) - 1.5/(s + 10) is positive real, with its fast mode at rest it
// is not), so each reduced model is judged again for the device that receives it.
#pragma once

#include <optional>
#include <string>

#include "reckon/haptics/analysis/state_space.hpp"

namespace reckon::haptics {

struct RenderingDevice {
  double damping = 1.0;         ///< that one is sure of [N s/m], > 0
  double sample_period = 1e-3;  ///< [s], > 0
};

struct Acceptance {
  /// Position [m] to force [N] against it, sampled, as the device is to render it; empty: refused.
  std::optional<StateSpace> model;
  double required = 0.0;           ///< device damping that the model needs as it came [N s/m]
  double angular_frequency = 0.0;  ///< where it needs that [rad/s]
  double added_damping = 0.0;      ///< that was given to it [N s/m]
  std::string remark;              ///< what was added, or why it is refused; else empty
};

/// Samples the model, held over each period, and holds it against thesis (3.5),
///     b >= max over w of T/(2 (1 - cos wT)) Re{(1 - e^{-jwT}) H(e^{jwT})}.
/// One that needs more becomes the nearest that does not, where there is one: with the least damper
/// beside it, B (x_k - x_{k-1})/T, which takes B cos wT off the need at each frequency, so slow
/// activity can be paid for and the cost of sampling a stiff spring cannot.
/// @param position_to_force continuous, one input, one output, minimal
/// @throws std::invalid_argument as checked(), for a sampled or non-square system, or a device
/// whose numbers are not > 0
[[nodiscard]] Acceptance accepted(const StateSpace& position_to_force,
                                  const RenderingDevice& device);

/// A continuous model of impedance, speed to force, made positive real by the least direct damping.
struct PassiveImpedance {
  std::optional<StateSpace> model;  ///< empty: no damping makes it passive
  double added_damping = 0.0;       ///< [N s/m]
  std::string remark;               ///< what was added, or why it is refused; else empty
};
[[nodiscard]] PassiveImpedance nearest_passive(const StateSpace& speed_to_force);

}  // namespace reckon::haptics
