// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Hands in contact among the many: whole peers in simulated time, what each sends while it touches
// and over the whole run, against a stream of every servo step, and how far off the force is.
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

/// One way of touching and of sending; rates are of one hand.
struct HandsRow {
  std::string_view scene;            ///< of contact_scenes()
  double threshold = 0;              ///< error of the force at which a hand sends [N]
  double contact_packets_per_s = 0;  ///< while the hands are pressed together; 0: no such part
  double packets_per_s = 0, octets_per_s = 0;  ///< over the whole run
  ForceError error;                            ///< in contact, against stiffness x overlap
};

/// Packets a second of a hand that sends each servo step.
inline constexpr double kRawPackets = 1000;

/// Errors of the force at which hands send [N], in turn.
inline constexpr std::array kHandThresholds{0.005, 0.015, 0.05, 0.1, 0.2, 0.4};
/// What the project asks of haptic entities: so many times fewer datagrams than a stream, while
/// hands are pressed together, and over a whole run.
inline constexpr double kFewerTouching = 25, kFewerWhole = 50;

/// Presses, strokes, taps, a visit and the shipped pair, scene by scene. @param network between the
/// hands  @param seed of it. Some 25 s of one core. @param go_on asked before each run; false ends
/// it: fewer rows
[[nodiscard]] std::vector<HandsRow> run_hands(const peer::ImpairmentLaw& network,
                                              std::uint64_t seed,
                                              const std::function<bool(double share)>& go_on = {});

[[nodiscard]] std::string hands_text(std::span<const HandsRow> rows);
/// A line of kind "hands" for each.
[[nodiscard]] std::string hands_json(std::span<const HandsRow> rows);

}  // namespace reckon::bench
