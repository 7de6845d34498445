// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What a record of hands in contact says of the forces that they felt, beside those that they
// should have felt.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "reckon/bench/studies/contact/contact_run.hpp"

namespace reckon::bench {

/// Differences of a force below this share are not told apart by people (Weber), nor those below
/// the least that they feel.
inline constexpr double kWeberShare = 0.1;
inline constexpr double kLeastFelt = 0.05;  ///< [N]

/// Sizes of an error [N].
struct ForceError {
  double p50 = 0, p99 = 0, max = 0, rms = 0;
  double noticed = 0;       ///< share of the time in which a person may notice it
  std::size_t samples = 0;  ///< in contact, felt or true; none: they did not touch
};

/// Sizes of errors beside the forces that were wanted, both [N] and of one length; none: no
/// samples.
[[nodiscard]] ForceError error_size(std::vector<double> errors, std::span<const double> wanted);

/// Of a hand's force while it is stroked: against the truth.
struct Response {
  double gain = 0;
  double phase = 0;  ///< [rad], below 0: it comes late
};

/// What is asked of the measures.
struct ContactTruth {
  double stiffness = 0;  ///< [N/m], of each hand to the others
  double reach = 0;      ///< [m], sum of two radii
};

/// Felt force against stiffness x overlap at that same instant, along the line between the hands,
/// while either is not zero; all pairs, both ways.
[[nodiscard]] ForceError error_at_instant(const ContactRecord& record, const ContactTruth& truth);

/// RMS of the felt force against what the twin feels at the same time, while either feels any [N].
[[nodiscard]] double error_of_twin(const ContactRecord& record, const ContactRecord& twin);

/// Largest force from one other within a second of the twin's first touch, over the twin's there;
/// nothing where the twin does not touch.
[[nodiscard]] std::optional<double> first_peak(const ContactRecord& record,
                                               const ContactRecord& twin);

/// Of the first two hands, each from the other, at this frequency [Hz] over steps [from, to), which
/// should be whole periods; nothing where the record or the truth has no such part.
[[nodiscard]] std::optional<std::array<Response, 2>> stroke_response(const ContactRecord& record,
                                                                     const ContactTruth& truth,
                                                                     double frequency,
                                                                     std::size_t from,
                                                                     std::size_t to);

/// Longest time that a force of kLeastFelt or more was felt after the hands had parted [s].
[[nodiscard]] double linger(const ContactRecord& record, const ContactTruth& truth);

}  // namespace reckon::bench
