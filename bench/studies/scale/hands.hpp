// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Two hands in contact: whole peers in simulated time. Measures the rates of each hand in contact
// and over the whole run, against a stream of every servo step, and the force error.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/bench/studies/contact/contact_measures.hpp"
#include "reckon/peer/network/impairment.hpp"

namespace reckon::bench {

/// One scene at one threshold; rates are per hand.
struct HandsRow {
  std::string_view scene;            ///< of contact_scenes()
  double threshold = 0;              ///< force error at which a hand sends [N]
  double contact_packets_per_s = 0;  ///< while the hands are pressed together; 0: never are
  double packets_per_s = 0, octets_per_s = 0;  ///< over the whole run
  ForceError error;                            ///< in contact, against stiffness x overlap
};

/// Packets a second of a hand that sends at each servo step.
inline constexpr double kRawPackets = 1000;

/// Force errors at which hands send [N], ascending.
inline constexpr std::array kHandThresholds{0.005, 0.015, 0.05, 0.1, 0.2, 0.4};
/// Requirement for haptic entities: so many times fewer datagrams than a stream, while hands are
/// pressed together and over a whole run.
inline constexpr double kFewerTouching = 25, kFewerWhole = 50;

/// Runs presses, strokes, taps, a visit and the shipped pair, scene by scene; some 25 s on a core.
/// @param network between the hands  @param seed of the network  @param go_on called before each
/// run; false ends the study with fewer rows
[[nodiscard]] std::vector<HandsRow> run_hands(const peer::ImpairmentLaw& network,
                                              std::uint64_t seed,
                                              const std::function<bool(double share)>& go_on = {});

[[nodiscard]] std::string hands_text(std::span<const HandsRow> rows);
/// A line of kind "hands" for each.
[[nodiscard]] std::string hands_json(std::span<const HandsRow> rows);

}  // namespace reckon::bench
