// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Whether a device may render a model: sampled by that device, the model must not need more damping
// than the device has. Passivity of a full model is no proof, although the thesis assumes it: 0.1 +
// 1/(s + 1) - 1.5/(s + 10) is positive real, but not with its fast mode at rest. So each reduced
// model is judged again for the device that receives it.
#pragma once

#include <optional>
#include <string>

#include "reckon/bench/linear_systems/state_space.hpp"

namespace reckon::bench {

struct RenderingDevice {
  double damping = 1.0;         ///< guaranteed [N s/m], > 0
  double sample_period = 1e-3;  ///< [s], > 0
};

struct Acceptance {
  /// Position [m] to force [N] against it, sampled, in the form for the device; empty: refused.
  std::optional<StateSpace> model;
  double required = 0.0;           ///< device damping that the original model needs [N s/m]
  double angular_frequency = 0.0;  ///< frequency of that need [rad/s]
  double added_damping = 0.0;      ///< added to the model [N s/m]
  std::string remark;              ///< the addition, or the reason for refusal; else empty
};

/// Samples the model, held over each period, and compares it with thesis (3.5),
///     b >= max over w of T/(2 (1 - cos wT)) Re{(1 - e^{-jwT}) H(e^{jwT})}.
/// A model that needs more is replaced by the nearest one that does not, if there is one. It gets
/// the least damper in parallel, B (x_k - x_{k-1})/T, which lowers the need by B cos wT at each
/// frequency. So a damper can compensate slow activity, but not the cost of sampling a stiff
/// spring.
/// @param position_to_force continuous, one input, one output, minimal
/// @throws std::invalid_argument from checked(), for a sampled or non-square system, or a device
/// with numbers that are not > 0
[[nodiscard]] Acceptance accepted(const StateSpace& position_to_force,
                                  const RenderingDevice& device);

/// A continuous model of impedance, speed to force, made positive real by the least direct damping.
struct PassiveImpedance {
  std::optional<StateSpace> model;  ///< empty: no damping makes it passive
  double added_damping = 0.0;       ///< [N s/m]
  std::string remark;               ///< the addition, or the reason for refusal; else empty
};
[[nodiscard]] PassiveImpedance nearest_passive(const StateSpace& speed_to_force);

}  // namespace reckon::bench
