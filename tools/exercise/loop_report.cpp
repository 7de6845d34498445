// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/exercise/loop_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <iterator>

#include "reckon/tools/terminal/report_text.hpp"

namespace reckon::tools {

peer::Percentiles worst(const peer::Percentiles& a, const peer::Percentiles& b) {
  return {std::max(a.p50, b.p50), std::max(a.p99, b.p99), std::max(a.p999, b.p999),
          std::max(a.max, b.max)};
}

void LoopReports::add(const LoopReports& other) {
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i].took = worst(all[i].took, other.all[i].took);
    all[i].passes += other.all[i].passes;
    all[i].overruns += other.all[i].overruns;
  }
}

LoopReports loops_of(const peer::PeerThreads& threads) {
  LoopReports reports;
  const std::array<const peer::PassTimes*, 3> times{&threads.read_times(), &threads.model_times(),
                                                    &threads.write_times()};
  for (std::size_t i = 0; i < times.size(); ++i) {
    reports.all[i].took = peer::percentiles(times[i]->times());
    reports.all[i].passes = times[i]->times().count();
    reports.all[i].overruns = times[i]->overruns();
  }
  return reports;
}

void print_loops(std::FILE* out, const LoopReports& loops) {
  for (std::size_t i = 0; i < loops.all.size(); ++i) {
    const LoopReport& loop = loops.all[i];
    if (loop.passes == 0) continue;
    const std::string name = fmt::format("{} loop", LoopReports::kNames[i]);
    spread_row(out, name.c_str(), microseconds(loop.took), 1.0,
               fmt::format("us  ({} of {} passes took longer than a servo period)", loop.overruns,
                           loop.passes));
  }
}

std::string loops_json(const LoopReports& loops) {
  std::string out;
  for (std::size_t i = 0; i < loops.all.size(); ++i) {
    const LoopReport& loop = loops.all[i];
    fmt::format_to(std::back_inserter(out), R"({}"{}":{{"passes":{},"us":{},"overruns":{}}})",
                   out.empty() ? "{" : ",", LoopReports::kNames[i], loop.passes,
                   spread_json(microseconds(loop.took)), loop.overruns);
  }
  return out + "}";
}

}  // namespace reckon::tools
