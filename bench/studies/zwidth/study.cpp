// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/zwidth/study.hpp"

#include "reckon/bench/studies/sweep/all_cores.hpp"
#include "reckon/bench/studies/zwidth/measured_border.hpp"

namespace reckon::bench {

std::vector<ZWidthRow> run_zwidth(const ZWidthDevice& device, std::span<const double> dampings,
                                  const ZWidthProgress& progress) {
  std::vector<ZWidthRow> rows(dampings.size());
  const bool whole = run_on_all_cores(
      rows.size(),
      [&](std::size_t i, const std::atomic<bool>& stop) {
        ZWidthRow& row = rows[i];
        row.damping = dampings[i];
        row.undelayed = undelayed_stiffness(device, row.damping);
        row.passive = passive_stiffness(device, row.damping);
        row.energy = energy_border(device, row.damping, [&] { return !stop; });
        row.unstable = stability_border(device, row.damping);
        row.shown = servo_stiffness(device, row.damping);
      },
      [&](std::size_t done) { return !progress || progress(done, rows.size()); });
  if (!whole) rows.clear();
  return rows;
}

}  // namespace reckon::bench
