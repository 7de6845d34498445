// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/accuracy/circle_study.hpp"

#include <algorithm>

#include "reckon/bench/studies/tracks/motions.hpp"

namespace reckon::bench {

std::vector<CircleRow> run_circle_study(std::span<const PoseModel> models,
                                        std::span<const deadreckon::ConvergenceCurve> curves,
                                        const CircleCase& circle) {
  const auto motion = std::find_if(motions().begin(), motions().end(),
                                   [](const Motion& row) { return row.name == "circle"; });
  const std::vector<Track> tracks{motion->generate(circle.seconds, circle.network.seed)};
  std::vector<CircleRow> rows;
  for (const PoseModel& model : models) {
    for (const auto curve : curves) {
      PoseSetting setting;
      setting.model = model.sent;
      setting.prediction = model.prediction;
      setting.period = circle.period;
      setting.convergence.curve = curve;
      rows.push_back({model, curve, run_seeds(tracks, setting, circle.network, circle.seeds)});
    }
  }
  return rows;
}

}  // namespace reckon::bench
