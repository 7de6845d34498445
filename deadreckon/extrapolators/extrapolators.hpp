// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// THE list of the extrapolators that use a history of updates. A new one is a header and a row
// here; tests, benches and the adaptive choice use the list.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "reckon/deadreckon/extrapolators/multi_step.hpp"
#include "reckon/deadreckon/extrapolators/position_history.hpp"

namespace reckon::deadreckon {

/// Highest rate that an extrapolator needs from a sender.
enum class SentRates : std::uint8_t { position, velocity, acceleration };

struct Extrapolator {
  std::string_view name;
  int order;            ///< Exact for motions that are polynomials in time of this degree...
  std::size_t updates;  ///< ...with at least this number of updates.
  SentRates needs;      ///< Highest rate that the update must have.
  Pose (*predict)(const MotionHistory&, double tau, const StepLimits&) noexcept;
};

inline constexpr std::array<Extrapolator, 7> kExtrapolators{{
    {"hold", 0, 1, SentRates::position, hold},
    {"one_step_1", 1, 1, SentRates::velocity, first_order_one_step},
    {"two_step_1", 1, 2, SentRates::position, first_order_two_step},
    {"one_step_2", 2, 1, SentRates::acceleration, second_order_one_step},
    {"two_step_2", 2, 2, SentRates::velocity, second_order_two_step},
    {"two_step_3", 3, 2, SentRates::acceleration, third_order_two_step},
    {"position_history", 2, 3, SentRates::position, position_history},
}};

}  // namespace reckon::deadreckon
