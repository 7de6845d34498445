// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Thesis Fig 3.1: a sampled and held spring produces energy.
#pragma once

#include "reckon/bench/studies/figures/figure.hpp"

namespace reckon::bench {

/// A spring pressed and released at constant speed, its force held over each sample.
struct SampledSpring {
  double stiffness = 2000.0;     ///< [N/m]
  double speed = 0.1;            ///< [m/s] > 0, both ways
  double depth = 0.005;          ///< [m], a whole number of samples deep
  double sample_period = 0.001;  ///< [s] > 0
};

/// Energy that the user gets back in excess of the energy put in: the sum of held force x
/// displacement, both ways [J].
[[nodiscard]] double energy_made(const SampledSpring& spring);

/// Fig 3.1 at 10 ms and at 1 ms.
[[nodiscard]] Figure figure_sampled_spring();

}  // namespace reckon::bench
