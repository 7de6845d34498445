// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Runs a scenario through servos and simulated devices, beside books of its own.
#pragma once

#include <string>

#include "reckon/tests/fuzz/touch/power.hpp"
#include "reckon/tests/fuzz/touch/scenario.hpp"

namespace reckon::fuzz {

/// Of the model of a device, beside what its servo states that its encoders may hide. Under a force
/// of 0.1 N or more.
struct ModelBooks {
  double made = -1e9;     ///< [J], most that it gave beyond what the hand put in
  double left = 1e9;      ///< least share of the most put in so far that was there still, from 1 mJ
  double claimed = -1e9;  ///< [J], most that the meter of its servo had above its books, from 1 mJ
};

/// What a run came to. Energies are those of the devices' own books, not of the servos' meters.
struct Outcome {
  double least_port = 0;    ///< [J], of work + damping + received - given + loan, any port
  double least_held = 1e9;  ///< [J], of it while a force of 0.1 N or more is held: to climb by
  double least_sum = 0;     ///< [J], of all ports and loans, where nobody lies
  double meter = 0;         ///< [J], most that a servo's meter has above the device's books
  double excess = -1e9;     ///< [N], greatest step of a force in growth or turning beyond the limit
  double rows = 0;          ///< largest |felt / right - 1| at the end, of hands in a row
  double wrong = 0;         ///< share of the right force by which one is off that held still
  double lacks = 0;         ///< share of it that is missing after an interruption
  std::string wrong_force;  ///< a sentence where that is more than may be
  bool told = false;        ///< a servo says that it shows less
  double unseen = -1e9;     ///< [J], most that the first hand got after 1.5 s beyond what surfaces
                            ///< did and 50 mW
  double pushed = 0;        ///< [s], in which a hand and the falling body push one another
  double haunted = 0;       ///< [s], longest for which a body is felt that has passed the hand
  double pinched = 0;       ///< greatest speed of the pinched cube over that of the paddle
  double heap_force = 0;    ///< [N], most that a far heap changes the first hand's force
  double heap_place = 0;    ///< [m], most that it changes the place of a body beside the hand
  ModelBooks model;
  Excess liar;            ///< of what the first hand got, beyond an honest twin of the liar
  double late_cost = 0;   ///< [J], most that a late sample took
  std::string violation;  ///< a sentence; empty where all promises were kept
};

/// @param seconds of simulated time
[[nodiscard]] Outcome try_out(const Scenario& scenario, double seconds);
/// The same, and once more with an honest twin in place of the liar: a firm grip leads a hand along
/// what the liar has shown, no faster than an arm, and its servo keeps its accounts. Fills `liar`.
[[nodiscard]] Outcome try_beside_twin(const Scenario& scenario, double seconds);

/// The same, and beside it once more without the far heap. Fills `heap_force` and `heap_place`.
[[nodiscard]] Outcome try_beside_heap(const Scenario& scenario, double seconds);

}  // namespace reckon::fuzz
