// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Choice of the model order: the least order whose force is within a threshold in newtons of the
// full model's, for the motions to be felt. Each order is evaluated in turn, without a rule of
// thumb. The result has an error bound, or a reason if no order suffices.
//
//   const auto choice = choose_order(BodyReduction(body), {3e-3, 30.0}, 900.0, 0.05);
//   if (!choice.model) std::cerr << choice.refusal << '\n';
#pragma once

#include <optional>
#include <string>

#include "reckon/bench/reduction/balanced_reduction.hpp"
#include "reckon/bench/reduction/congruence_reduction.hpp"

namespace reckon::bench {

/// Motions for judging models: sinusoids of any frequency up to a band limit.
struct InputRange {
  double amplitude = 3e-3;  ///< of each input, in its unit: [m] for a probe; > 0
  double band_hz = 30.0;    ///< highest frequency; hands move below 10 Hz, feel to some 300 Hz
};

/// The chosen model, and the error of its force against the full model's.
template <typename Model>
struct OrderChoice {
  std::optional<Model> model;  ///< empty: refused
  int order = 0;               ///< of the model; if refused, of the nearest one
  double error = 0.0;          ///< [N], largest over the band at the amplitude
  double error_hz = 0.0;       ///< frequency of the error
  double bound = 0.0;          ///< [N], over all frequencies, beyond the band too
  std::string refusal;         ///< fault, number and remedy; empty if chosen
};

/// Least number of modes, judged with a contact spring between each probe and its point. The error
/// is that of the forces of all points together (Frobenius norm of the difference). One or two
/// elastic modes of a basis other than Basis::modes are skipped if one of them has a damping ratio
/// below 0.15: they give the dent under a point a mass that it does not have, and the contact
/// rings.
/// @param stiffness of the contact [N/m], > 0  @param threshold [N], > 0
/// @throws std::invalid_argument for a number that is not > 0. Cost: the body's modes, then its
/// responses at hundreds of frequencies: 1 ms for 36 coordinates, 25 ms for 196. If dampers couple
/// the modes, each frequency needs a factor (PressedBody): 0.4 s for 196.
[[nodiscard]] OrderChoice<ModalForceModel> choose_order(const BodyReduction& reduction,
                                                        const InputRange& range, double stiffness,
                                                        double threshold);

/// Least order; inputs in [m], outputs in [N]. The bound is twice the sum of the Hankel values left
/// out. @throws std::invalid_argument for a number that is not > 0
[[nodiscard]] OrderChoice<StateSpace> choose_order(const BalancedReduction& reduction,
                                                   const InputRange& range, double threshold);

}  // namespace reckon::bench
