// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/touch/touch_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <string_view>

#include "reckon/bench/studies/accuracy/query_cost.hpp"
#include "reckon/bench/studies/touch/touch_report.hpp"
#include "reckon/bench/studies/tune/options.hpp"
#include "reckon/peer/scene/nearest_word.hpp"
#include "reckon/tools/command_line/output_file.hpp"
#include "reckon/tools/command_line/status_line.hpp"

namespace reckon::bench {
namespace {

const TouchAxis& axis_named(std::string_view name) {
  const auto axes = touch_axes();
  const auto found = std::ranges::find(axes, name, &TouchAxis::name);
  if (found != axes.end()) return *found;
  std::vector<std::string_view> names;
  for (const TouchAxis& axis : axes) names.push_back(axis.name);
  for (const LeftOutAxis& axis : left_out_axes())
    if (axis.name == name)
      throw tools::UsageError(fmt::format("--axis: {} is left out: {}", axis.name, axis.why));
  const std::string_view nearest = peer::nearest_word(name, names);
  throw tools::UsageError(
      fmt::format("--axis: there is no '{}'{}; known: {}", name,
                  nearest.empty() ? "" : fmt::format(" (did you mean '{}'?)", nearest),
                  fmt::join(names, ", ")));
}

/// Each once, in the order of the list.
std::vector<const TouchAxis*> axes_of(const TouchOptions& options) {
  std::vector<const TouchAxis*> asked, axes;
  for (const std::string& word : options.axes)
    for (const std::string& name : list_of(word)) asked.push_back(&axis_named(name));
  for (const TouchAxis& axis : touch_axes())
    if (asked.empty() || std::ranges::count(asked, &axis) > 0) axes.push_back(&axis);
  return axes;
}

}  // namespace

int bench_touch(const TouchOptions& options, const std::string& command,
                const tools::Console& console) {
  const auto axes = axes_of(options);
  for (const std::string& path : {options.csv, options.report, options.plot})
    tools::check_writable(path);
  const auto now = [] { return std::chrono::steady_clock::now().time_since_epoch(); };
  tools::StatusLine line(console.err, now());
  TouchReport report{command, processor_name(), options.seed, {}};
  for (const TouchAxis* axis : axes) {
    if (console.stopped()) break;
    line.show(fmt::format("{}: {} of {} axes", axis->name, report.results.size(), axes.size()),
              now());
    report.results.push_back(
        run_touch_axis(*axis, options.seed, true, [&] { return !console.stopped(); }));
  }
  line.clear();
  if (console.stopped())
    fmt::print(console.err, "stopped after {} of {} axes; the last one may lack settings\n",
               report.results.size(), axes.size());
  fmt::print(console.out, "{}", options.json ? touch_json(report) : touch_text(report));
  tools::write_output(options.csv, touch_csv(report), console);
  tools::write_output(options.plot, touch_svg(report.results), console);
  tools::write_output(options.report, touch_page(report), console);
  return tools::exit_status(tools::ExitCode::good);
}

}  // namespace reckon::bench
