// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// How remote entities are shown.
#pragma once

#include <cstdint>

#include "reckon/deadreckon/motion/convergence.hpp"

namespace reckon::peer {

/// Basis of the shown pose of a remote entity.
enum class Prediction : std::uint8_t {
  as_sent,  ///< the model of its last update
  adaptive  ///< the extrapolator that predicted its last updates best
};

/// How remote entities are shown. The servo always uses the model as sent.
struct ConvergenceConfig {
  deadreckon::ConvergenceSettings settings;
  Prediction prediction = Prediction::as_sent;
};

}  // namespace reckon::peer
