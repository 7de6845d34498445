// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// How small a model may be: the least order whose force is within a threshold in newtons of the
// full model's, for the motions that are to be felt. Chosen by what each order does, one after the
// other, not by a rule of thumb; a bound comes beside it, and a reason where no order will do.
//
//   const auto choice = choose_order(BodyReduction(body), {3e-3, 30.0}, 900.0, 0.05);
//   if (!choice.model) std::cerr << choice.refusal << '\n';
#pragma once

#include <optional>
#include <string>

#include "reckon/haptics/reduction/balanced_reduction.hpp"
#include "reckon/haptics/reduction/congruence_reduction.hpp"

namespace reckon::haptics {

/// Motions by which models are judged: sinusoids of any frequency up to a band.
struct InputRange {
  double amplitude = 3e-3;  ///< of each input, in its unit: [m] for a probe; > 0
  double band_hz = 30.0;    ///< highest frequency; hands move below 10 Hz, feel up to some 300 Hz
};

/// The model chosen, and how far its force is off the full model's.
template <typename Model>
struct OrderChoice {
  std::optional<Model> model;  ///< empty: refused
  int order = 0;               ///< of the model; if refused, of the nearest one
  double error = 0.0;          ///< [N], largest over the band at the amplitude
  double error_hz = 0.0;       ///< where
  double bound = 0.0;          ///< [N], over all frequencies, beyond the band too
  std::string refusal;         ///< what, the number, the remedy; empty if chosen
};

/// Least number of modes, judged through a contact spring between each probe and its point; the
/// error is that of the forces of all points together (Frobenius norm of the difference). One and
/// two elastic modes of a basis other than Basis::modes are passed over where one of them has a
/// damping ratio below 0.15: they give the dent under a point a mass that it does not have, and the
/// contact rings.
/// @param stiffness of the contact [N/m], > 0  @param threshold [N], > 0
/// @throws std::invalid_argument for a number that is not > 0. Cost: the body's modes, then its
/// responses at hundreds of frequencies: 1 ms for 36 coordinates, 25 ms for 196; where dampers
/// couple the modes, by a factor at each frequency (PressedBody), 0.4 s for 196.
[[nodiscard]] OrderChoice<ModalForceModel> choose_order(const BodyReduction& reduction,
                                                        const InputRange& range, double stiffness,
                                                        double threshold);

/// Least order; inputs in [m], outputs in [N]. The bound is twice the Hankel values left out.
/// @throws std::invalid_argument for a number that is not > 0
[[nodiscard]] OrderChoice<StateSpace> choose_order(const BalancedReduction& reduction,
                                                   const InputRange& range, double threshold);

}  // namespace reckon::haptics
