// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <thread>

#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/joined_peer.hpp"
#include "reckon/tools/command_line/command_line.hpp"
#include "reckon/tools/exercise/exercise.hpp"
#include "reckon/tools/exercise/live_table.hpp"
#include "reckon/tools/exercise/scene_options.hpp"
#include "reckon/tools/exercise/simulated_hand.hpp"
#include "reckon/tools/terminal/json_text.hpp"
#include "reckon/tools/terminal/report_text.hpp"

namespace reckon::tools {
namespace {

using std::chrono::nanoseconds;

constexpr nanoseconds kRefresh = std::chrono::milliseconds(100);

struct PeerVerbOptions {
  SceneOptions scene;
  std::string name = "HAND";
  std::uint64_t operator_number = 1;
  std::optional<nanoseconds> duration;
  bool json = false;
  bool events = false;
};

/// Letters of an entity marking on the wire.
constexpr std::size_t kLongestMarking = 11;

std::optional<int> parse(Arguments arguments, const Console& console, PeerVerbOptions& options) {
  CommandLine line("peer",
                   "One peer on a LAN: its entities, and simulated hands as the scene says.",
                   "reckon peer scenes/two_hands.toml --iface eth0\n"
                   "reckon peer scenes/two_hands.toml --iface eth0 --operator 2 --name BOB\n"
                   "reckon peer scenes/two_hands.toml --for 60s --json");
  line.word("SCENE", options.scene.scene, true, "scene file; all peers need the same");
  add_scene_options(line, options.scene);
  line.option("--name", options.name, "marking of the hand, at most 11 characters");
  line.option("--operator", options.operator_number,
              "which peer of the scene this is, from 1: its devices, entities and operator");
  line.option("--for", options.duration, "end by itself after this time, e.g. 10s");
  line.flag("--json", options.json, "one JSON object on the last line");
  line.flag("--events", options.events, "a JSON line for each remote entity that appears or goes");
  return line.parse(arguments, console);
}

// The peer that `options` ask for, with its simulated hands, and what there is to be told of its
// link.
class RunningPeer {
 public:
  RunningPeer(const peer::SceneFile& scene, const PeerVerbOptions& options, const Console& console)
      : hands_(make_simulated_hands(scene, static_cast<std::uint32_t>(options.operator_number))),
        joined_(federate_options(scene, options, hands_)) {
    for (const std::string& sentence : joined_.link_report()) {
      fmt::print(console.err, "{}\n", sentence);
    }
    joined_.run();
  }

  void stop() { joined_.resign(); }
  [[nodiscard]] nanoseconds elapsed() const { return joined_.elapsed(); }
  [[nodiscard]] peer::Peer& peer() { return joined_.peer(); }
  [[nodiscard]] const peer::PeerThreads& threads() const { return *joined_.threads(); }

 private:
  static peer::FederateOptions federate_options(const peer::SceneFile& scene,
                                                const PeerVerbOptions& options,
                                                const SimulatedHands& hands) {
    peer::FederateOptions own;
    own.name = options.name;
    own.scene = scene;
    own.loops = peer::FederateLoops::threads;
    own.scene_peer = static_cast<std::uint32_t>(options.operator_number);
    own.devices = hands.wired;
    return own;
  }

  SimulatedHands hands_;
  peer::JoinedPeer joined_;
};

// One line for each remote entity that was not there, or is no longer.
class EntityEvents {
 public:
  void report(const peer::PeerView& view, double elapsed, std::FILE* out) {
    const auto has = [](const peer::PeerView& in, const pdu::EntityId& id) {
      return std::any_of(in.rows.begin(), in.rows.begin() + static_cast<std::ptrdiff_t>(in.count),
                         [&](const peer::EntityView& row) { return row.id == id; });
    };
    const auto tell = [&](const char* event, const peer::EntityView& row) {
      std::string marking;
      append_json_string(marking, row.marking.data());
      fmt::print(out,
                 R"({{"event":"{}","id":"{}:{}:{}","marking":{},"seconds":{:.3f},"updates":{}}})"
                 "\n",
                 event, row.id.site, row.id.application, row.id.entity, marking, elapsed,
                 row.updates);
      std::fflush(out);
    };
    for (std::size_t i = 0; i < view.count; ++i) {
      if (!has(last_, view.rows[i].id)) tell("appeared", view.rows[i]);
    }
    for (std::size_t i = 0; i < last_.count; ++i) {
      if (!has(view, last_.rows[i].id)) tell("gone", last_.rows[i]);
    }
    last_ = view;
  }

 private:
  peer::PeerView last_;
};

// Of all hands: the least energy, and the cuts of the force.
struct Ports {
  double energy_min = 0;
  std::uint64_t trips = 0;
};

Ports ports_of(const peer::PeerView& view) {
  Ports ports;
  for (const peer::HandView& hand : view.own_hands()) {
    ports.energy_min = std::min(ports.energy_min, hand.servo.port_energy_min);
    ports.trips += hand.servo.trips;
  }
  return ports;
}

std::uint64_t counter(const peer::Peer& peer, std::string_view name) {
  const peer::Counter* found = peer.counters().find(name);
  return found == nullptr ? 0 : found->value();
}

void print_json(std::FILE* out, RunningPeer& running, double seconds) {
  peer::Peer& peer = running.peer();
  const peer::PeerView& view = peer.views().read();
  const peer::DutyCycle& duty = running.threads().servo_duty();
  const nanoseconds seen = view.first_remote;
  fmt::print(
      out,
      R"({{"id":"{}:{}:{}","seconds":{:.6g},"remote_seen_s":{},"entities":{},"peers":{},)"
      R"("packets_per_s":{:.6g},"bytes_per_s":{:.6g},"packets_in_per_s":{:.6g},)"
      R"("servo_steps":{},"servo_late_us":{},"missed_steps":{},"pose_jump_m":{},"force_jump_n":{},)"
      R"("energy_min_j":{:.6g},"trips":{})",
      view.own.site, view.own.application, view.own.entity, seconds,
      seen < nanoseconds(0) ? "null" : fmt::format("{:.6g}", pdu::to_seconds(seen)), view.entities,
      view.peers, static_cast<double>(counter(peer, "datagrams_out")) / seconds,
      static_cast<double>(counter(peer, "octets_out")) / seconds,
      static_cast<double>(counter(peer, "datagrams_in")) / seconds, duty.steps(),
      spread_json(microseconds(peer::percentiles(duty.lateness()))), duty.missed(),
      spread_json(peer.model().remote().pose_jumps().spread()),
      spread_json(peer.model().remote().force_jumps().spread()), ports_of(view).energy_min,
      ports_of(view).trips);
  peer.counters().for_each([&](std::string_view name, std::string_view, std::uint64_t value) {
    fmt::print(out, R"(,"{}":{})", name, value);
  });
  fmt::print(out, "}}\n");
}

void print_text(std::FILE* out, RunningPeer& running, double seconds) {
  peer::Peer& peer = running.peer();
  const peer::PeerView& view = peer.views().read();
  const peer::DutyCycle& duty = running.threads().servo_duty();
  fmt::print(out, "What {:.1f} s as {}:{}:{} cost\n", seconds, view.own.site, view.own.application,
             view.own.entity);
  if (view.first_remote >= nanoseconds(0)) {
    fmt::print(out, "  first remote entity shown  {:.3f} s after start\n",
               pdu::to_seconds(view.first_remote));
  } else {
    fmt::print(out, "  first remote entity shown  never; is another peer on this interface?\n");
  }
  fmt::print(out, "  sent                       {:.1f} packets/s, {:.0f} octets/s\n",
             static_cast<double>(counter(peer, "datagrams_out")) / seconds,
             static_cast<double>(counter(peer, "octets_out")) / seconds);
  fmt::print(out, "  decisions                  {} taken, {} sent an update\n",
             counter(peer, "send_checks"), counter(peer, "updates_out"));
  fmt::print(out, "  received                   {:.1f} packets/s, {} lost\n",
             static_cast<double>(counter(peer, "datagrams_in")) / seconds,
             counter(peer, "datagrams_lost"));
  spread_heading(out, "error");
  spread_row(out, "pose jump", peer.model().remote().pose_jumps().spread(), 1e3,
             "mm  (update against prediction)");
  spread_row(out, "force jump", peer.model().remote().force_jumps().spread(), 1.0, "N");
  spread_row(out, "servo late", microseconds(peer::percentiles(duty.lateness())), 1.0,
             fmt::format("us  ({} of {} steps missed)", duty.missed(), duty.steps()));
  fmt::print(out, "  servo thread               {}\n", servo_text(running.threads()));
  fmt::print(out, "  energy                     never below {:.1e} J\n", ports_of(view).energy_min);
  if (view.owned > view.hand_count) {
    fmt::print(out, "  without a device           {} entities, which put {:.3g} J into hands\n",
               view.owned - view.hand_count, view.power_given);
  }
}

int run(const PeerVerbOptions& options, const Console& console) {
  const peer::SceneFile scene =
      load_scene(options.scene, options.scene.scene, options.operator_number);
  std::optional<RunningPeer> running;
  try {
    running.emplace(scene, options, console);
  } catch (const std::runtime_error& error) {
    throw EnvironmentError(error.what());
  }

  TableScreen screen(console);
  EntityEvents events;
  const nanoseconds end = options.duration.value_or(nanoseconds::max());
  while (!console.stopped() && running->elapsed() < end) {
    std::this_thread::sleep_for(std::min(kRefresh, end - running->elapsed()));
    running->peer().views().update();
    const peer::PeerView& view = running->peer().views().read();
    const double elapsed = pdu::to_seconds(running->elapsed());
    if (options.events) events.report(view, elapsed, console.out);
    while (const peer::Notice* notice = running->peer().notices().front()) {
      if (!screen.active()) fmt::print(console.err, "{}\n", notice->text.data());
      running->peer().notices().pop();
    }
    if (options.json || options.events) continue;
    const TablePeer table{&view, &running->peer().counters()};
    screen.show(live_table(std::span(&table, 1), scene, elapsed));
  }
  const double seconds = pdu::to_seconds(running->elapsed());
  running->stop();
  if (options.json) {
    print_json(console.out, *running, seconds);
  } else if (!options.events) {
    print_text(console.out, *running, seconds);
  }
  return exit_status(ExitCode::good);
}

int run_peer(Arguments arguments, const Console& console) {
  PeerVerbOptions options;
  if (const auto status = parse(arguments, console, options)) return *status;
  if (options.operator_number == 0) throw UsageError("--operator counts from 1");
  if (options.name.size() > kLongestMarking)
    throw UsageError(fmt::format("--name: '{}' has {} letters; a marking holds {} at most",
                                 options.name, options.name.size(), kLongestMarking));
  return run(options, console);
}

}  // namespace

namespace verb {

Verb peer() { return {"peer", "one peer on a LAN", run_peer}; }

}  // namespace verb

}  // namespace reckon::tools
