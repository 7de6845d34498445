// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "reckon/tools/command_line/command_line.hpp"
#include "reckon/tools/command_line/verb_rows.hpp"
#include "reckon/tools/exercise/exercise.hpp"
#include "reckon/tools/exercise/live_display.hpp"
#include "reckon/tools/exercise/native_code.hpp"
#include "reckon/tools/exercise/scene_options.hpp"
#include "reckon/tools/exercise/simulated_slice.hpp"
#include "reckon/tools/exercise/stop_control.hpp"
#include "reckon/tools/terminal/text_table.hpp"
#include "reckon/tools/verbs/demo_page.hpp"
#include "reckon/tools/verbs/demo_report.hpp"
#include "reckon/tools/verbs/demo_traces.hpp"
#include "reckon/tools/verbs/page_address.hpp"

namespace reckon::tools {
namespace {

using std::chrono::nanoseconds;

constexpr const char* kDefaultScene = "meeting.toml";
constexpr nanoseconds kLookEvery = std::chrono::milliseconds(100);
struct DemoOptions {
  SceneOptions scene;
  DeviceChoice device;
  TraceFiles traces;
  std::optional<std::uint64_t> asked_peers;
  std::uint64_t peers = 2;  // number of peers to run
  std::optional<nanoseconds> duration;
  bool json = false;
  bool simulated_time = false;
  bool no_transfer = false;
  std::string log;
  ViewSwitch view;
};

std::optional<int> parse(Arguments arguments, const Console& console, DemoOptions& options) {
  CommandLine line("demo", "Two peers on loopback multicast whose hands touch; prints the costs.",
                   "reckon demo\n"
                   "reckon demo --for 60s --json\n"
                   "reckon demo --impair 'delay=200ms jitter=100ms loss=20%' --for 30s\n"
                   "reckon demo --mesh scenes/touchstone.obj --hand scenes/hand_trace.csv\n"
                   "reckon demo --simulated-time --for 10min\n"
                   "reckon demo --view");
  line.word("SCENE", options.scene.scene, false,
            fmt::format("scene file; default: {} as installed", kDefaultScene));
  line.option("--peers", options.asked_peers,
              "number of peers, 1 to 64; default: as many as own a device or an entity of the "
              "scene, at least 2, or 1 with bodies");
  line.option("--for", options.duration, "stop after this time, e.g. 10s");
  add_scene_options(line, options.scene);
  add_device_flags(line, options.device);
  add_trace_options(line, options.traces);
  line.flag("--simulated-time", options.simulated_time,
            "simulated network without sockets, as fast as possible");
  line.flag("--no-transfer", options.no_transfer,
            "transfer no energy on demand: one hand then cannot push another");
  line.flag("--json", options.json, "one JSON object on the last line");
  add_view_switch(line, options.view);
  add_log_flag(line, options.log);
  return line.parse(arguments, console);
}

// Concurrent demos on one loopback interface must not join each other. A simulated network is
// isolated and keeps its exercise.
std::uint8_t exercise_of(const peer::SceneFile& scene, bool simulated) {
  if (scene.network.exercise_named || simulated) return scene.network.exercise;
  std::random_device random;
  return static_cast<std::uint8_t>(std::uniform_int_distribution<int>(1, 254)(random));
}

void show_until_the_end(Exercise& exercise, const peer::SceneFile& scene,
                        const DemoOptions& options, const Console& console, LiveDisplay& display,
                        DemoPage* page, StopControl& stop) {
  const nanoseconds end = options.duration.value_or(nanoseconds::max());
  nanoseconds slice = options.simulated_time ? kSimulatedSlice : kLookEvery;
  if (display.is_drawn() && !options.simulated_time) slice = LiveDisplay::kKeysEvery;
  if (page != nullptr) slice = SelfView::kLookEvery;
  std::vector<TablePeer> peers(exercise.size());
  const auto tell = [&] {
    for (const ReceivedNotice& heard : exercise.take_notices()) {
      display.add(heard);
      if (page != nullptr) page->note(heard);
    }
    display.add_of_devices(exercise.device_notices());
    display.add_of_devices(stop.take_notices());
  };
  while (!console.stopped() && !display.quit() && exercise.elapsed() < end) {
    exercise.run(std::min(slice, end - exercise.elapsed()));
    if (display.take_stop_key()) stop.press_key(exercise.clock().now());
    tell();
    if (page != nullptr) page->show(exercise);
    for (std::size_t i = 0; i < peers.size(); ++i)
      peers[i] = {&exercise.view(i), &exercise.peer(i).counters()};
    display.show(peers, scene, exercise.elapsed());
  }
  tell();  // notices of the start, even if a busy host never entered the loop
}

void check_flags(const DemoOptions& options) {
  const auto page = flags_of_switch(options.view);
  check_device_choice(options.device);
  if (!options.simulated_time) return;
  if (!options.device.device.empty())
    throw UsageError("--device: a person cannot follow --simulated-time; remove one of them");
  if (page)
    throw UsageError("--view: --simulated-time sends no datagrams for a page; remove one of them");
  if (!options.duration) throw UsageError("--simulated-time needs an end: add --for 60s");
  if (options.scene.even_if_slow)
    throw UsageError("--even-if-slow has no effect with --simulated-time; remove one of them");
  if (!options.scene.iface.empty())
    throw UsageError("--iface: --simulated-time has no sockets; remove one of them");
}

ExerciseOptions exercise_options(const DemoOptions& options) {
  ExerciseOptions made;
  made.peers = options.peers;
  made.iface = options.scene.iface.empty() ? "lo" : options.scene.iface;
  made.simulated_time = options.simulated_time;
  made.transfer = !options.no_transfer;
  made.even_if_slow = options.scene.even_if_slow;
  made.body_pace = pace_of(options.scene);
  made.plugins = plugins_of(options.device);
  made.trace_bodies = !options.traces.bodies.empty();
  made.trace_loops = !options.traces.loop.empty();
  made.impairment_changes = made.trace_contacts = flags_of_switch(options.view).has_value();
  return made;
}

DemoPageOptions page_options(const DemoOptions& options, const Exercise& exercise) {
  DemoPageOptions page;
  page.source = options.scene.scene.empty() ? kDefaultScene : options.scene.scene;
  page.iface = options.scene.iface.empty() ? "lo" : options.scene.iface;
  page.raw_bit_per_s = 8 * kRawOctets * exercise.raw_rate();
  return page;
}

void say_where(const DemoOptions& options, const peer::SceneFile& scene, const Console& console) {
  if (options.simulated_time) return;
  fmt::print(console.err, "DIS exercise {}{}\n", scene.network.exercise,
             scene.network.exercise_named ? "" : ", chosen at random, because the scene has none");
}

/// As many as own a device or an entity, but at least 2, or 1 in a scene with bodies.
std::uint64_t peers_of(const DemoOptions& options, const peer::SceneFile& scene) {
  if (options.asked_peers) return *options.asked_peers;
  const auto moves = [](const haptics::SceneObject& object) { return object.matter.mass > 0; };
  std::uint64_t most = std::ranges::any_of(scene.scene.objects, moves) ? 1 : 2;
  for (const peer::DeviceConfig& device : scene.devices)
    most = std::max<std::uint64_t>(most, device.peer);
  for (const peer::EntityConfig& entity : scene.entities)
    most = std::max<std::uint64_t>(most, entity.peer);
  return most;
}

std::unique_ptr<Exercise> started_exercise(const peer::SceneFile& scene, const DemoOptions& options,
                                           haptics::ForceStop& stop) {
  try {
    ExerciseOptions made = exercise_options(options);
    made.force_stop = &stop;
    return std::make_unique<Exercise>(scene, made);
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  } catch (const UsageError&) {
    throw;
  } catch (const peer::StepTooDear& slow) {
    throw EnvironmentError(refusal_of(slow));
  } catch (const std::runtime_error& error) {
    throw EnvironmentError(error.what());
  }
}

int run(const DemoOptions& asked, const Console& console) {
  DemoOptions options = asked;
  check_flags(options);
  peer::SceneFile scene = load_scene(options.scene, kDefaultScene, options.asked_peers.value_or(2));
  if (!options.simulated_time) say_native_code(scene, console);
  options.peers = peers_of(options, scene);
  if (!scene.network.peers.empty())
    fmt::print(console.err, "all peers of a demo run on this host: the scene's {} are ignored\n",
               counted(scene.network.peers.size(), "peer"));
  scene.network.peers.clear();
  choose_device(options.device, scene, 1, options.peers);
  scene.network.exercise = exercise_of(scene, options.simulated_time);
  const auto flags = flags_of_switch(options.view);
  const bool has_key = !scene.network.key.empty();
  if (flags) (void)server_options(*flags, has_key);  // reports bad options before anything starts
  if (flags) let_pages_move_hands(scene, options.peers);
  StopControl stop;  // before the devices
  const std::unique_ptr<Exercise> exercise = started_exercise(scene, options, stop.stop());
  DemoTraces traces(options.traces, scene, *exercise);
  std::optional<HandTwins> twins;
  if (flags) twins.emplace(scene, *exercise);
  std::optional<DemoPage> page;
  std::unique_ptr<BrowserRedirect> browser;
  if (traces.takes_steps() || flags) {
    exercise->on_step(
        [&](std::size_t peer, std::size_t device, const haptics::ServoSnapshot& step) {
          traces.take(peer, device, step);
          if (twins) twins->take(peer, device, step);
          if (page) page->take(peer, device, step);
        });
  }

  say_where(options, scene, console);
  LiveDisplay display(console, !options.json, options.peers, options.log);
  if (!display.is_drawn() && !options.json && !options.duration) {
    fmt::print(console.err, "running until Ctrl-C; add --for 10s to end by itself\n");
  }
  if (flags) {
    exercise->run(SelfView::kLookEvery);  // until its hands have IDs
    page.emplace(*flags, scene, page_options(options, *exercise), *exercise, *twins);
    show_address(page->view(), has_key, display);
    browser = open_browser(*flags, page->view().address());
  } else if (!options.simulated_time) {
    display.put_in_head("add --view to see it in a browser, where the mouse moves a hand");
  }
  show_until_the_end(*exercise, scene, options, console, display, page ? &*page : nullptr, stop);
  display.close();
  page.reset();
  const DemoCost cost = cost_of(*exercise);
  exercise->stop();
  traces.close();
  if (options.json) {
    print_demo_json(console.out, cost, *exercise);
  } else {
    print_demo_text(console.out, cost, *exercise);
  }
  return exit_status(ExitCode::good);
}

int run_demo(Arguments arguments, const Console& console) {
  DemoOptions options;
  if (const auto status = parse(arguments, console, options)) return *status;
  return run(options, console);
}

}  // namespace

namespace verb {

Verb demo() { return verb_of(verb_row("demo"), run_demo); }

}  // namespace verb

}  // namespace reckon::tools
