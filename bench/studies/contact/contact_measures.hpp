// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Compares the recorded forces of hands in contact with the forces that they should have felt.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "reckon/bench/studies/contact/contact_run.hpp"

namespace reckon::bench {

/// People do not notice differences below this share of a force (Weber), or below the least force
/// that they feel.
inline constexpr double kWeberShare = 0.1;
inline constexpr double kLeastFelt = 0.05;  ///< [N]

/// Size of an error [N].
struct ForceError {
  double p50 = 0, p99 = 0, max = 0, rms = 0;
  double noticed = 0;       ///< share of the time in which a person may notice it
  std::size_t samples = 0;  ///< in contact, felt or true; 0: they did not touch
  double share = 0;         ///< RMS divided by the RMS of the wanted force; 0 if that is 0
};

/// Size of errors relative to the wanted forces, both [N] and of equal length; empty: no samples.
[[nodiscard]] ForceError error_size(std::vector<double> errors, std::span<const double> wanted);

/// Response of a hand's force to strokes, relative to the true force.
struct Response {
  double gain = 0;
  double phase = 0;  ///< [rad], below 0: the force lags
};

/// Parameters of the true force.
struct ContactTruth {
  double stiffness = 0;  ///< [N/m], of each hand towards the others
  double reach = 0;      ///< [m], sum of two radii
};

/// Felt force against stiffness x overlap at the same instant, along the line between the hands,
/// while either is not zero; all pairs, in both directions.
[[nodiscard]] ForceError error_at_instant(const ContactRecord& record, const ContactTruth& truth);

/// RMS difference between the felt force and the twin's force at the same time, while either is not
/// zero [N].
[[nodiscard]] double error_of_twin(const ContactRecord& record, const ContactRecord& twin);

/// Greatest force from one other hand within a second of the twin's first touch, divided by the
/// twin's greatest force there; no value if the twin does not touch.
[[nodiscard]] std::optional<double> first_peak(const ContactRecord& record,
                                               const ContactRecord& twin);

/// Response of the first two hands, each to the other, at this frequency [Hz] over steps [from,
/// to), which should be whole periods; no value if the record or the true force has no component at
/// it.
[[nodiscard]] std::optional<std::array<Response, 2>> stroke_response(const ContactRecord& record,
                                                                     const ContactTruth& truth,
                                                                     double frequency,
                                                                     std::size_t from,
                                                                     std::size_t to);

/// Longest time that a force of kLeastFelt or more was felt after the hands had separated [s].
[[nodiscard]] double linger(const ContactRecord& record, const ContactTruth& truth);

}  // namespace reckon::bench
