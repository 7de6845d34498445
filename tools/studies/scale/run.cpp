// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/studies/scale/run.hpp"

#include <fmt/format.h>

#include <vector>

#include "reckon/tools/studies/scale/mechanisms.hpp"
#include "reckon/tools/studies/scale/text.hpp"
#include "reckon/tools/studies/scale/world.hpp"
#include "reckon/tools/studies/sweep/progress_bar.hpp"

namespace reckon::tools {
namespace {

/// Every mechanism in every exercise; fewer rows where it was stopped.
std::vector<ScaleRow> run_rows(const ScalePlan& plan, const Console& console) {
  std::vector<ScaleRow> rows;
  ProgressBar bar(console);
  const std::size_t all = plan.settings.size() * kMechanisms.size();
  for (const ScaleSetting& setting : plan.settings)
    for (std::size_t mechanism = 0; mechanism < kMechanisms.size(); ++mechanism) {
      const auto counts = run_world(setting, design_of(mechanism), [&](double share) {
        bar.show((static_cast<double>(rows.size()) + share) / static_cast<double>(all),
                 fmt::format("row {} of {}", rows.size() + 1, all));
        return !console.stopped();
      });
      if (console.stopped()) return rows;
      rows.push_back({setting, mechanism, counts});
    }
  return rows;
}

}  // namespace

int bench_scale(const ScaleWords& words, const std::string&, const Console& console) {
  const ScalePlan plan = read_scale_plan(words);
  const std::vector<ScaleRow> rows = run_rows(plan, console);
  fmt::print(console.out, "{}", words.json ? scale_json(rows) : scale_text(rows));
  return exit_status(ExitCode::good);
}

}  // namespace reckon::tools
