// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/clocks/clock.hpp"
#include "reckon/tools/command_line/command_line.hpp"
#include "reckon/tools/datagrams/source.hpp"
#include "reckon/tools/terminal/text_table.hpp"
#include "reckon/tools/viewer/view_flags.hpp"
#include "reckon/tools/viewer/viewing.hpp"

namespace reckon::tools {
namespace {

using std::chrono::nanoseconds;

/// Of a capture, in memory [octets].
constexpr std::size_t kCaptureRoom = std::size_t{1} << 30;

constexpr std::string_view kSummary =
    "Shows the world in a browser page, live or from a capture.\n\n"
    "SOURCE is what `reckon inspect` takes: a capture, a scene, udp://GROUP[:PORT], iface:NAME;\n"
    "without one the default groups, live.";

struct ViewOptions {
  SourceChoice source;
  std::string key;
  ViewFlags view;
  std::optional<nanoseconds> duration;
};

std::optional<int> parse(Arguments arguments, const Console& console, ViewOptions& options) {
  CommandLine line("view", kSummary,
                   "reckon view exercise.pcapng --open\n"
                   "reckon view scenes/two_hands.toml --iface eth0\n"
                   "reckon view udp://239.192.1.0:3000 --port 9000\n"
                   "reckon view --listen 0.0.0.0 --for 1h");
  line.word("SOURCE", options.source.source, false, "where the datagrams come from");
  add_view_flags(line, options.view);
  line.option("--for", options.duration, "end by itself after this time, as in 10s");
  line.option("--iface", options.source.interface,
              "for groups: interface name, address or index (default: chosen by score)");
  line.option("--key", options.key, "key file: reads what is sealed");
  line.option("--pool", options.source.pool,
              "groups to join behind the base group (default: 256; 0 for udp://)");
  return line.parse(arguments, console);
}

std::optional<peer::SceneFile> scene_of(const SourceChoice& choice) {
  if (!choice.source.ends_with(".toml")) return std::nullopt;
  try {
    return peer::load_scene_file(choice.source);
  } catch (const peer::SceneFileError& error) {
    throw UsageError(error.what());
  }
}

int run(ViewOptions& options, const Console& console) {
  options.source.sealed = !options.key.empty();
  const std::optional<peer::SceneFile> scene = scene_of(options.source);
  ViewingOptions viewing_options;
  viewing_options.server = server_options(options.view);
  viewing_options.key = options.key;
  StageOptions& stage = viewing_options.stage;
  stage.source = options.source.source.empty() ? "the default groups" : options.source.source;
  stage.is_capture = !is_live(options.source);
  stage.kind = stage.is_capture ? "capture" : "live";
  stage.help = stage.is_capture
                   ? "This capture holds no entities; reckon inspect shows its PDUs."
                   : "Nobody is heard yet: start reckon demo, or a peer of this scene.";
  stage.scene = scene ? &*scene : nullptr;
  if (stage.is_capture) {
    stage.history.span.reset();
    stage.history.octets = kCaptureRoom;
  }
  Viewing viewing(viewing_options, open_chosen_source(options.source));
  tell_addresses(viewing.server(), options.view, console);
  const peer::SteadyClock clock;
  const nanoseconds begin = clock.now();
  const nanoseconds end = options.duration.value_or(nanoseconds::max());
  while (!console.stopped() && clock.now() - begin < end) viewing.step();
  fmt::print(console.err, "{} looked, {} sent\n", counted(viewing.server().counts().tabs, "tab"),
             counted(viewing.server().counts().pictures, "picture"));
  const std::string& problem = viewing.report().problem;
  if (!problem.empty()) fmt::print(console.err, "{}\n", problem);
  return exit_status(problem.empty() ? ExitCode::good : ExitCode::findings);
}

int run_view(Arguments arguments, const Console& console) {
  ViewOptions options;
  if (const auto status = parse(arguments, console, options)) return *status;
  return run(options, console);
}

}  // namespace

namespace verb {

Verb view() {
  return {"view", "show the world in a browser page, live or from a capture", run_view};
}

}  // namespace verb

}  // namespace reckon::tools
