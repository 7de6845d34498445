// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Measures servo steps of a scene whose bodies all move, with hands among them.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>

#include "reckon/peer/scene/scene_file.hpp"

namespace reckon::peer {

/// CPU of the steps of all servos of a peer in one period [s].
struct BodyCosts {
  std::size_t bodies = 0;  ///< awake in the median period
  double median = 0.0, p99 = 0.0;
  double p99_until_force = 0.0;     ///< until the last force is written
  std::size_t steps = 0, late = 0;  ///< periods, and those whose steps took longer than a period
};

/// How long to measure.
struct BodyRuns {
  int runs = 3;          ///< > 0: more give a steadier result
  double longest = 0.5;  ///< [s] of CPU, of a run
  double pace = 1.0;     ///< see haptics::BodyWorld::set_pace()
};

/// Runs the scene's own bodies, all awake, while hands sweep through the largest island. Each run
/// has the same steps, 700 at most; the result has the least time of each step. Set-up code.
/// @param hands number of hands, > 0
/// @return nothing for a scene without bodies
[[nodiscard]] std::optional<BodyCosts> measure_bodies(const SceneFile& scene, std::size_t hands,
                                                      std::chrono::nanoseconds period,
                                                      const BodyRuns& runs = {});

/// Time of this host for a second of counted work of bodies, over that of the reference host [1];
/// see haptics::BodyWorld::set_pace(). The least of three runs of 27 boxes; some 20 ms.
[[nodiscard]] double measure_body_pace();

}  // namespace reckon::peer
