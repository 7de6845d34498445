// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/clocks/clock.hpp"
#include "reckon/tools/command_line/command_line.hpp"
#include "reckon/tools/command_line/output_file.hpp"
#include "reckon/tools/command_line/size_text.hpp"
#include "reckon/tools/command_line/verb_rows.hpp"
#include "reckon/tools/datagrams/listening.hpp"
#include "reckon/tools/datagrams/selection.hpp"
#include "reckon/tools/datagrams/source.hpp"
#include "reckon/tools/metrics/metrics_server.hpp"
#include "reckon/tools/metrics/source_metrics.hpp"
#include "reckon/tools/terminal/text_table.hpp"
#include "reckon/tools/viewer/page_files.hpp"
#include "reckon/tools/viewer/page_frame.hpp"
#include "reckon/tools/viewer/saved_run.hpp"
#include "reckon/tools/viewer/view_flags.hpp"
#include "reckon/tools/viewer/viewing.hpp"

namespace reckon::tools {
namespace {

using std::chrono::nanoseconds;

/// Limit of a capture in memory [octets].
constexpr std::size_t kCaptureRoom = std::size_t{1} << 30;

constexpr std::string_view kSummary =
    "Shows the world in a browser page, live or from a capture.\n\n"
    "SOURCE is as for `reckon inspect`: a capture, a scene, udp://ADDRESS[:PORT], iface:NAME;\n"
    "default: the default groups, live, on every interface. --save serves nothing: it writes the\n"
    "page and the last minute of a capture to one HTML file, which plays from disk.";

struct ViewOptions {
  SourceChoice source;
  std::string key;
  ViewFlags view;
  std::string metrics;
  std::optional<nanoseconds> duration;
  std::string save;
  bool overwrite = false;
  bool lenient = false;
};

std::optional<int> parse(Arguments arguments, const Console& console, ViewOptions& options) {
  CommandLine line("view", kSummary,
                   "reckon view scenes/exercise.pcapng --open\n"
                   "reckon view scenes/exercise.pcapng --save run.html\n"
                   "reckon view scenes/two_hands.toml --iface eth0\n"
                   "reckon view udp://239.192.1.0:3000 --port 9000\n"
                   "reckon view --listen 0.0.0.0 --for 1h");
  line.word("SOURCE", options.source.source, false, "source of the datagrams");
  add_view_flags(line, options.view);
  line.option("--for", options.duration,
              "stop after this time, for example 10s; with --save: length of the saved end of a "
              "capture (default: 1min), or time to receive from a live source");
  line.option("--save", options.save, "write one HTML file that plays, instead of serving a page");
  line.flag("--force", options.overwrite, "overwrite the file of --save");
  declare_lenient(line, options.lenient);
  line.option("--iface", options.source.interface,
              "for groups: interface name, address or index (default: all, including lo)");
  line.offer("--iface", kInterfaces);
  line.option("--key", options.key, "key file: reads sealed datagrams");
  line.option("--pool", options.source.pool,
              "groups to join after the base group (default: 256; 0 for udp://)");
  add_metrics_flag(line, options.metrics);
  return line.parse(arguments, console);
}

std::optional<peer::SceneFile> scene_of(const SourceChoice& choice) {
  if (!names_scene(choice.source)) return std::nullopt;
  try {
    return peer::load_scene_file(choice.source);
  } catch (const peer::SceneFileError& error) {
    throw UsageError(error.what());
  }
}

StageOptions stage_options(const ViewOptions& options) {
  StageOptions stage;
  stage.history.lenient = options.lenient;
  stage.source = options.source.source.empty() ? "the default groups" : options.source.source;
  stage.is_capture = !is_live(options.source);
  stage.kind = stage.is_capture ? "capture" : "live";
  stage.help = stage.is_capture
                   ? "This capture has no entities; reckon inspect shows its PDUs."
                   : "No entity received yet: start reckon demo, or a peer of this scene.";
  return stage;
}

void keep_all(StageOptions& stage) {
  stage.history.span.reset();
  stage.history.octets = kCaptureRoom;
}

void show_metrics(MetricsServer& server, Viewing& viewing, nanoseconds now, nanoseconds elapsed) {
  if (!server.is_due(now)) return;
  OpenMetrics text;
  text.gauge("uptime_seconds", "time since the start", pdu::to_seconds(elapsed));
  text.gauge("page_tabs_open", "open tabs", static_cast<double>(viewing.server().tabs()));
  viewing.server().counts().for_each(
      [&](std::string_view name, std::string_view meaning, std::uint64_t value) {
        text.counter(fmt::format("page_{}", name), meaning, value);
      });
  add_source(text, viewing.report());
  server.show(text.end(), now);
}

int serve(const ViewOptions& options, const Console& console) {
  const auto metrics = metrics_server(options.metrics);
  const std::optional<peer::SceneFile> scene = scene_of(options.source);
  const bool has_key = !options.key.empty() || (scene && !scene->network.key.empty());
  ViewingOptions viewing_options;
  viewing_options.server = server_options(options.view, has_key);
  viewing_options.key = options.key;
  StageOptions& stage = viewing_options.stage = stage_options(options);
  stage.scene = scene ? &*scene : nullptr;
  if (stage.is_capture) keep_all(stage);
  auto source = open_chosen_source(options.source);
  if (is_live(options.source))
    fmt::print(console.err, "listening to {}\n", listening_text(options.source, source->report()));
  Viewing viewing(viewing_options, std::move(source));
  tell_addresses(viewing.server(), has_key, console);
  const auto browser = open_browser(options.view, viewing.server().address());
  if (metrics) fmt::print(console.err, "{}\n", metrics->sentence());
  const peer::SteadyClock clock;
  const nanoseconds begin = clock.now();
  const nanoseconds end = options.duration.value_or(nanoseconds::max());
  SilenceWatch silence(options.source, begin);
  while (!console.stopped() && clock.now() - begin < end) {
    viewing.step();
    if (metrics) show_metrics(*metrics, viewing, clock.now(), clock.now() - begin);
    if (!means_groups(options.source)) continue;
    for (const std::string& sentence : silence.look(viewing.report(), clock.now()))
      fmt::print(console.err, "{}\n", sentence);
  }
  fmt::print(console.err, "{}", heard_text(viewing.report()));
  fmt::print(console.err, "{} looked, {} sent\n", counted(viewing.server().counts().tabs, "tab"),
             counted(viewing.server().counts().pictures, "picture"));
  const std::string& problem = viewing.report().problem;
  if (!problem.empty()) fmt::print(console.err, "{}\n", problem);
  return exit_status(problem.empty() ? ExitCode::good : ExitCode::findings);
}

// A saved file
// ------------------------------------------------------------------------------------------------

void check_save(const ViewOptions& options) {
  const ViewFlags& view = options.view;
  if (const std::string_view given = view.port ? "--port" : given_flag(view); !given.empty())
    throw UsageError(fmt::format("--save serves no page: remove {}", given));
  if (!options.metrics.empty())
    throw UsageError("--metrics: --save serves nothing; remove --metrics");
  if (is_live(options.source) && !options.duration)
    throw UsageError("--save: this source is live; add the time to receive, as in --for 1min");
  std::error_code none;
  if (std::filesystem::equivalent(options.source.source, options.save, none))
    throw UsageError(fmt::format("{} is the source and would be overwritten; choose another name",
                                 options.save));
  const bool is_there = std::filesystem::exists(options.save, none);
  if (is_there && !options.overwrite)
    throw UsageError(
        fmt::format("{} exists; choose another name, or --force to overwrite it", options.save));
  check_writable(options.save);
  if (!is_there) std::filesystem::remove(options.save, none);
}

void tell_saved(const SavedRun& run, std::size_t octets, const Console& console) {
  fmt::print(console.err, "{:.1f} s, {}, {}, {}\n", run.seconds,
             run.entities == 1 ? "1 entity" : fmt::format("{} entities", run.entities),
             counted(run.pictures, "picture"), size_text(octets));
  if (run.spacing > 1.01 * pdu::to_seconds(ViewServer::kTick))
    fmt::print(console.err,
               "pictures are up to {:.2f} s apart, because of the number of entities\n",
               run.spacing);
  if (run.left_out >= 0.05)
    fmt::print(console.err, "the {:.1f} s before are left out; --for sets the saved length\n",
               run.left_out);
}

int save(const ViewOptions& options, const Console& console) {
  check_save(options);
  const std::optional<peer::SceneFile> scene = scene_of(options.source);
  StageOptions stage_of_all = stage_options(options);
  stage_of_all.kind = "saved";
  stage_of_all.is_capture = true;  // all of it is received before it is shown
  // The path of the folder is private.
  if (!options.source.source.starts_with("udp://"))
    stage_of_all.source = std::filesystem::path(stage_of_all.source).filename();
  stage_of_all.scene = scene ? &*scene : nullptr;
  keep_all(stage_of_all);
  ViewStage stage(stage_of_all);
  SealedDatagrams sealed(options.key);
  const auto source = open_chosen_source(options.source);
  const peer::SteadyClock clock;
  const nanoseconds end =
      is_live(options.source) ? clock.now() + *options.duration : nanoseconds::max();
  const auto told =
      take_source(*source, sealed, stage, [&] { return console.stopped() || clock.now() >= end; });
  for (const std::string& sentence : told) fmt::print(console.err, "{}\n", sentence);
  const SavedRun run = save_run(stage, {.span = options.duration.value_or(SaveOptions::kMinute)});
  if (run.entities == 0) {
    fmt::print(console.err, "nothing is saved: it has no entity\n");
    return exit_status(ExitCode::findings);
  }
  const std::string file = filled_frame(find_page_file("/frame.html")->text, run.items);
  write_output(options.save, file, console);
  tell_saved(run, file.size(), console);
  return exit_status(told.empty() ? ExitCode::good : ExitCode::findings);
}

int run_view(Arguments arguments, const Console& console) {
  ViewOptions options;
  if (const auto status = parse(arguments, console, options)) return *status;
  options.source.sealed = !options.key.empty();
  if (!options.save.empty()) return save(options, console);
  if (options.overwrite) throw UsageError("--force needs --save");
  return serve(options, console);
}

}  // namespace

namespace verb {

Verb view() { return verb_of(verb_row("view"), run_view); }

}  // namespace verb

}  // namespace reckon::tools
