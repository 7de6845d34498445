// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/compile.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "reckon/pdu/seconds.hpp"
#include "reckon/tools/command_line/command_line.hpp"
#include "reckon/tools/command_line/duration_text.hpp"
#include "reckon/tools/command_line/verb_rows.hpp"
#include "reckon/tools/exercise/body_report.hpp"
#include "reckon/tools/exercise/exercise.hpp"
#include "reckon/tools/exercise/hand_report.hpp"
#include "reckon/tools/exercise/live_display.hpp"
#include "reckon/tools/exercise/native_code.hpp"
#include "reckon/tools/exercise/run_summary.hpp"
#include "reckon/tools/exercise/scene_options.hpp"
#include "reckon/tools/exercise/simulated_slice.hpp"
#include "reckon/tools/exercise/stop_control.hpp"
#include "reckon/tools/terminal/report_text.hpp"
#include "reckon/tools/terminal/text_table.hpp"
#include "reckon/tools/verbs/demo_page.hpp"
#include "reckon/tools/verbs/demo_traces.hpp"
#include "reckon/tools/verbs/page_address.hpp"

namespace reckon::tools {
namespace {

using std::chrono::nanoseconds;

constexpr const char* kDefaultScene = "meeting.toml";
constexpr nanoseconds kLookEvery = std::chrono::milliseconds(100);
// What a peer without dead reckoning would send every servo step: one Entity State and one
// Attribute PDU with one force model, alone in a datagram.
constexpr double kRawOctets = 144 + 32 + 8 + 72;

struct DemoOptions {
  SceneOptions scene;
  DeviceChoice device;
  TraceFiles traces;
  std::optional<std::uint64_t> asked_peers;
  std::uint64_t peers = 2;  // what is run
  std::optional<nanoseconds> duration;
  bool json = false;
  bool simulated_time = false;
  bool no_transfer = false;
  std::string log;
  ViewSwitch view;
};

std::optional<int> parse(Arguments arguments, const Console& console, DemoOptions& options) {
  CommandLine line("demo",
                   "Two peers on loopback multicast whose hands touch; prints what it cost.",
                   "reckon demo\n"
                   "reckon demo --for 60s --json\n"
                   "reckon demo --impair 'delay=200ms jitter=100ms loss=20%' --for 30s\n"
                   "reckon demo --mesh bunny.ply --hand my_trace.csv\n"
                   "reckon demo --simulated-time --for 10min\n"
                   "reckon demo --view");
  line.word("SCENE", options.scene.scene, false,
            fmt::format("scene file; default: {} as installed", kDefaultScene));
  line.option("--peers", options.asked_peers,
              "how many peers, 1 to 64; 2, or the one of a scene with bodies");
  line.option("--for", options.duration, "end by itself after this time, e.g. 10s");
  add_scene_options(line, options.scene);
  add_device_flags(line, options.device);
  add_trace_options(line, options.traces);
  line.flag("--simulated-time", options.simulated_time,
            "no sockets and no waiting: simulated network, as fast as the machine goes");
  line.flag("--no-transfer", options.no_transfer,
            "give no energy on demand: shows that one hand then cannot push another");
  line.flag("--json", options.json, "one JSON object on the last line");
  add_view_switch(line, options.view);
  add_log_flag(line, options.log);
  return line.parse(arguments, console);
}

struct Cost {
  double seconds = 0;
  double remote_seen = -1;
  double packets = 0, octets = 0, raw_packets = 0, raw_octets = 0;
  ServoReport servo;
  peer::Spread pose, force, possible_force;
  double energy_min = 0, late_cost = 0;
};

Cost cost_of(const Exercise& exercise) {
  Cost cost;
  cost.seconds = pdu::to_seconds(exercise.elapsed());
  const nanoseconds seen = exercise.remote_seen();
  cost.remote_seen = seen < nanoseconds(0) ? -1.0 : pdu::to_seconds(seen);
  cost.packets = static_cast<double>(exercise.total("datagrams_out")) / cost.seconds;
  cost.octets = static_cast<double>(exercise.total("octets_out")) / cost.seconds;
  cost.raw_packets = exercise.raw_rate();
  cost.raw_octets = cost.raw_packets * kRawOctets;
  cost.servo = exercise.servo_report();
  cost.pose = exercise.measurement().pose_error();
  cost.force = exercise.measurement().force_error();
  cost.possible_force = exercise.measurement().possible_force_error();
  cost.energy_min = exercise.measurement().energy_min();
  cost.late_cost = exercise.measurement().late_cost();
  return cost;
}

std::vector<const peer::Counters*> counters_of(Exercise& exercise) {
  std::vector<const peer::Counters*> counters;
  for (std::size_t i = 0; i < exercise.size(); ++i)
    counters.push_back(&exercise.peer(i).counters());
  return counters;
}

Hands hands_of(const Exercise& exercise) {
  Hands hands;
  for (std::size_t i = 0; i < exercise.size(); ++i) add_hands(exercise.view(i), hands);
  return hands;
}

bool is_any_softened(const Hands& hands) {
  return std::any_of(hands.begin(), hands.end(), [](const peer::HandView* hand) {
    return hand->stiffness.softens_hand() || std::isfinite(hand->stiffness.straight_from());
  });
}

void print_force_error(std::FILE* out, const Cost& cost, const Exercise& exercise) {
  if (!(exercise.measurement().touching_hands() > 0)) {
    const bool touched = exercise.measurement().touching_entities() > 0;
    fmt::print(out, "    force             none: no hand touched another{}\n",
               touched ? "; what entities press is not compared" : "");
  } else if (is_any_softened(hands_of(exercise))) {
    spread_row(out, "force asked", cost.force, 1.0, "N   (between hands, in contact)");
    spread_row(out, "force possible", cost.possible_force, 1.0, "N   (what the devices can show)");
  } else {
    spread_row(out, "force", cost.force, 1.0, "N   (between hands, in contact)");
  }
}

void print_pose_error(std::FILE* out, const Cost& cost) {
  if (cost.pose.count > 0) {
    spread_row(out, "pose", cost.pose, 1e3, "mm");
  } else {
    fmt::print(out, "    pose              none: no peer showed anything of another\n");
  }
}

void print_touching(std::FILE* out, const DemoMeasurement& measured) {
  fmt::print(
      out, "  touching                   each other {:.1f} s, the object {:.1f} s{} (all peers)\n",
      measured.touching_hands(), measured.touching_scene(),
      measured.touching_entities() > 0
          ? fmt::format(", entities {:.1f} s", measured.touching_entities())
          : "");
}

/// What was sent against what peers without dead reckoning would send.
std::string against_raw(double raw, double now, std::size_t peers) {
  if (peers == 1) return "one peer: nobody to send to";
  if (!(raw > 0)) return "no hand whose steps could be streamed";
  return fmt::format("raw streaming {:.0f} /s   {:.0f} x fewer", raw, now > 0 ? raw / now : 0.0);
}

void print_json(std::FILE* out, const Cost& cost, Exercise& exercise) {
  const DemoMeasurement& measured = exercise.measurement();
  fmt::print(
      out,
      R"({{"remote_seen_s":{},"packets_per_s":{:.6g},"bytes_per_s":{:.6g},)"
      R"("raw_packets_per_s":{:.6g},"raw_bytes_per_s":{:.6g},"servo_late_us":{},)"
      R"("missed_steps":{},"loops":{},"unmeasured_steps":{},"pose_error_m":{},"force_error_n":{},"force_error_possible_n":{},)"
      R"("energy_min_j":{:.6g},"late_cost_j":{:.6g},"loan_j":{:.6g},)"
      R"("seconds":{:.6g},"hand_contact_s":{:.6g},"scene_contact_s":{:.6g},)"
      R"("entity_contact_s":{:.6g},)"
      R"("peak_force_n":{:.6g},"trips":{},"datagrams_lost":{},"send_checks":{},)"
      R"("updates_out":{},"own_octets":{},"hands":{}{}{}}})"
      "\n",
      cost.remote_seen < 0 ? "null" : fmt::format("{:.6g}", cost.remote_seen), cost.packets,
      cost.octets, cost.raw_packets, cost.raw_octets,
      spread_json(microseconds(cost.servo.lateness)), cost.servo.missed,
      loops_json(cost.servo.loops), exercise.unmeasured_steps(), errors_json(cost.pose),
      errors_json(cost.force), errors_json(cost.possible_force), cost.energy_min, cost.late_cost,
      measured.loan_most(), cost.seconds, measured.touching_hands(), measured.touching_scene(),
      measured.touching_entities(), measured.peak_force(), measured.trips(),
      exercise.total("datagrams_lost"), exercise.total("send_checks"),
      exercise.total("updates_out"), exercise.total("own_octets"), hands_json(hands_of(exercise)),
      bodies_json(exercise.peer(0).bodies()), walls_json(counters_of(exercise)));
}

void print_text(std::FILE* out, const Cost& cost, Exercise& exercise) {
  const DemoMeasurement& measured = exercise.measurement();
  fmt::print(out, "What {:.1f} s with {} cost\n", cost.seconds, counted(exercise.size(), "peer"));
  if (exercise.size() == 1) {
    fmt::print(out, "  first remote hand shown    none: one peer\n");
  } else if (cost.remote_seen >= 0) {
    fmt::print(out, "  first remote hand shown    {:.3f} s after start\n", cost.remote_seen);
  } else {
    fmt::print(out, "  first remote hand shown    never, by at least one peer\n");
  }
  const std::size_t peers = exercise.size();
  fmt::print(out, "  packets                    {:.1f} /s   {}\n", cost.packets,
             against_raw(cost.raw_packets, cost.packets, peers));
  fmt::print(out, "  octets                     {:.0f} /s   {}\n", cost.octets,
             against_raw(cost.raw_octets, cost.octets, peers));
  print_touching(out, measured);
  fmt::print(out, "  decisions                  {} taken, {} sent an update\n",
             exercise.total("send_checks"), exercise.total("updates_out"));
  spread_heading(out, "error");
  print_pose_error(out, cost);
  print_force_error(out, cost, exercise);
  if (cost.servo.steps > 0) {
    spread_row(
        out, "servo late", microseconds(cost.servo.lateness), 1.0,
        fmt::format("us  ({} periods missed, {} steps)", cost.servo.missed, cost.servo.steps));
    print_loops(out, cost.servo.loops);
    fmt::print(out, "  servo thread               {}\n", cost.servo.thread);
  }
  if (exercise.unmeasured_steps() > 0)
    fmt::print(
        out,
        "  not measured               {} servo steps: too many peers for this machine in real "
        "time; see --simulated-time\n",
        exercise.unmeasured_steps());
  fmt::print(out,
             "  energy                     never below {:.1e} J at any port or in sum; peak force "
             "{:.2f} N\n",
             cost.energy_min, measured.peak_force());
  if (measured.loan_most() > 0)
    fmt::print(out,
               "                             {:.1f} mJ lent to hands that met inside one another\n",
               1e3 * measured.loan_most());
  print_bodies(out, exercise.peer(0).bodies());
  print_hands(out, hands_of(exercise));
  print_walls(out, counters_of(exercise));
}

// Demos beside each other on one loopback are not to join each other. What is simulated hears
// nobody and stays as it is.
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
  tell();  // what was told at the start, even where a busy host had no time for a look
}

void check_flags(const DemoOptions& options) {
  const auto page = flags_of_switch(options.view);
  check_device_choice(options.device);
  if (!options.simulated_time) return;
  if (!options.device.device.empty())
    throw UsageError("--device: no person keeps up with --simulated-time; leave one of them out");
  if (page)
    throw UsageError(
        "--view: --simulated-time sends nothing that a page could show; leave one out");
  if (!options.duration) throw UsageError("--simulated-time needs an end: add --for 60s");
  if (options.scene.even_if_slow)
    throw UsageError("--even-if-slow: --simulated-time takes what time it takes; leave one out");
  if (!options.scene.iface.empty())
    throw UsageError("--iface: --simulated-time has no sockets; leave one of them out");
}

ExerciseOptions exercise_options(const DemoOptions& options) {
  ExerciseOptions made;
  made.peers = options.peers;
  made.iface = options.scene.iface.empty() ? "lo" : options.scene.iface;
  made.simulated_time = options.simulated_time;
  made.transfer = !options.no_transfer;
  made.even_if_slow = options.scene.even_if_slow;
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
             scene.network.exercise_named ? "" : ", drawn at random: the scene names none");
}

/// Of a scene with bodies, those that have a device.
std::uint64_t peers_of(const DemoOptions& options, const peer::SceneFile& scene) {
  const auto moves = [](const haptics::SceneObject& object) { return object.matter.mass > 0; };
  if (options.asked_peers || std::ranges::none_of(scene.scene.objects, moves))
    return options.asked_peers.value_or(2);
  std::uint64_t most = 1;
  for (const peer::DeviceConfig& device : scene.devices)
    most = std::max<std::uint64_t>(most, device.peer);
  return most;
}

int run(const DemoOptions& asked, const Console& console) {
  DemoOptions options = asked;
  check_flags(options);
  peer::SceneFile scene = load_scene(options.scene, kDefaultScene, options.asked_peers.value_or(2));
  if (!options.simulated_time) say_native_code(scene, console);
  options.peers = peers_of(options, scene);
  if (!scene.network.peers.empty())
    fmt::print(console.err, "the peers of a demo are of this host: the scene's {} are left out\n",
               counted(scene.network.peers.size(), "peer"));
  scene.network.peers.clear();
  choose_device(options.device, scene, 1, options.peers);
  scene.network.exercise = exercise_of(scene, options.simulated_time);
  const auto flags = flags_of_switch(options.view);
  const bool has_key = !scene.network.key.empty();
  if (flags) (void)server_options(*flags, has_key);  // refused before anything begins
  if (flags) let_pages_move_hands(scene, options.peers);
  StopControl stop;  // before the devices
  std::optional<Exercise> exercise;
  try {
    ExerciseOptions made = exercise_options(options);
    made.force_stop = &stop.stop();
    exercise.emplace(scene, made);
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  } catch (const UsageError&) {
    throw;
  } catch (const peer::StepTooDear& slow) {
    throw EnvironmentError(refusal_of(slow));
  } catch (const std::runtime_error& error) {
    throw EnvironmentError(error.what());
  }
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
    fmt::print(console.err, "running until Ctrl-C; --for 10s ends by itself\n");
  }
  if (flags) {
    exercise->run(SelfView::kLookEvery);  // till its hands have numbers
    page.emplace(*flags, scene, page_options(options, *exercise), *exercise, *twins);
    show_address(page->view(), has_key, display);
    browser = open_browser(*flags, page->view().address());
  } else if (!options.simulated_time) {
    display.put_in_head("with --view it is shown in a browser, where the mouse is a hand");
  }
  show_until_the_end(*exercise, scene, options, console, display, page ? &*page : nullptr, stop);
  display.close();
  page.reset();
  const Cost cost = cost_of(*exercise);
  exercise->stop();
  traces.close();
  if (options.json) {
    print_json(console.out, cost, *exercise);
  } else {
    print_text(console.out, cost, *exercise);
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
