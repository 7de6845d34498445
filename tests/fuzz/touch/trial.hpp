// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Runs a scenario through servos and simulated devices, with an independent energy ledger.
#pragma once

#include <string>

#include "reckon/tests/fuzz/touch/power.hpp"
#include "reckon/tests/fuzz/touch/scenario.hpp"

namespace reckon::fuzz {

/// Books of a device model, beyond the energy that its encoders may hide as the servo states. Under
/// a force of 0.1 N or more.
struct ModelBooks {
  double made = -1e9;     ///< [J], greatest energy given beyond the hand's input
  double left = 1e9;      ///< least remaining share of the greatest input so far, from 1 mJ
  double claimed = -1e9;  ///< [J], greatest excess of the servo's meter over its ledger, from 1 mJ
};

/// The result of a run. Energies are from the devices' own ledgers, not from the servos' meters.
struct Outcome {
  double least_port = 0;    ///< [J], of work + damping + received - given + loan, any port
  double least_held = 1e9;  ///< [J], of it under a held force of 0.1 N or more: for the climb
  double least_sum = 0;     ///< [J], of all ports and loans, without a liar
  double meter = 0;         ///< [J], greatest excess of a servo's meter over the device's ledger
  double excess = -1e9;     ///< [N], greatest growth or turn of a force beyond the limit
  double rows = 0;          ///< greatest |felt / right - 1| at the end, of hands in a row
  double wrong = 0;         ///< relative error of the force of a resting hand
  double lacks = 0;         ///< share of it that is missing after an interruption
  std::string wrong_force;  ///< a sentence if that exceeds the tolerance
  bool told = false;        ///< a servo reports a reduced force
  double unseen = -1e9;     ///< [J], of the first hand after 1.5 s beyond surfaces' input and 50 mW
  double pushed = 0;        ///< [s], in which a hand and the falling body push each other
  double haunted = 0;       ///< [s], longest contact with a body that has passed the hand
  double pinched = 0;       ///< greatest speed of the pinched cube relative to the paddle
  double heap_force = 0;    ///< [N], greatest change of the first hand's force by a distant heap
  double heap_place = 0;  ///< [m], the same of a body's position, while the budget of work suffices
  ModelBooks model;
  Excess liar;            ///< energy of the first hand beyond that from an honest twin of the liar
  double late_cost = 0;   ///< [J], greatest energy that a late sample took
  std::string violation;  ///< a sentence; empty if all promises were kept
};

/// @param seconds of simulated time
[[nodiscard]] Outcome try_out(const Scenario& scenario, double seconds);
/// The same, and once more with an honest twin in place of the liar: a firm grip leads a hand along
/// the motion that the liar has shown, no faster than an arm, and its servo keeps its accounts.
/// Fills `liar`.
[[nodiscard]] Outcome try_beside_twin(const Scenario& scenario, double seconds);

/// The same, and once more without the distant heap. Fills `heap_force` and `heap_place`.
[[nodiscard]] Outcome try_beside_heap(const Scenario& scenario, double seconds);

}  // namespace reckon::fuzz
