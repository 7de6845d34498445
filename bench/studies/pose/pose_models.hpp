// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The list of dead-reckoning methods that studies compare: the model that the owner sends, and the
// viewer's prediction from its updates.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "reckon/bench/studies/pose/pose_study.hpp"

namespace reckon::bench {

struct PoseModel {
  std::string_view name;
  std::string_view meaning;
  std::optional<pdu::DeadReckoningAlgorithm> sent;  ///< empty: the owner's choice
  Prediction prediction = Prediction::as_sent;
};

/// The program's default is first: of two settings with equal results a study keeps the first.
inline constexpr std::array<PoseModel, 11> kPoseModels{{
    {"auto", "the owner's choice among fpw, rpw, rvw, rpb, rvb (the default)", std::nullopt},
    {"static", "held at the last position", pdu::DeadReckoningAlgorithm::static_},
    {"fpw", "velocity", pdu::DeadReckoningAlgorithm::fpw},
    {"rpw", "velocity, turning", pdu::DeadReckoningAlgorithm::rpw},
    {"rvw", "velocity and acceleration, turning", pdu::DeadReckoningAlgorithm::rvw},
    {"fvw", "velocity and acceleration", pdu::DeadReckoningAlgorithm::fvw},
    {"fpb", "velocity in body axes", pdu::DeadReckoningAlgorithm::fpb},
    {"rpb", "velocity in turning body axes", pdu::DeadReckoningAlgorithm::rpb},
    {"rvb", "velocity and acceleration in turning body axes", pdu::DeadReckoningAlgorithm::rvb},
    {"fvb", "velocity and acceleration in body axes", pdu::DeadReckoningAlgorithm::fvb},
    {"rvw+adaptive", "sent as rvw; the viewer chooses an order from the last updates",
     pdu::DeadReckoningAlgorithm::rvw, Prediction::adaptive},
}};

}  // namespace reckon::bench
