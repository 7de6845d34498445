// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/joined_peer.hpp"
#include "reckon/peer/scene/beacon_names.hpp"
#include "reckon/peer/scene/belongings.hpp"
#include "reckon/tools/command_line/command_line.hpp"
#include "reckon/tools/command_line/verb_rows.hpp"
#include "reckon/tools/exercise/balance_report.hpp"
#include "reckon/tools/exercise/entity_events.hpp"
#include "reckon/tools/exercise/hand_report.hpp"
#include "reckon/tools/exercise/live_display.hpp"
#include "reckon/tools/exercise/native_code.hpp"
#include "reckon/tools/exercise/real_devices.hpp"
#include "reckon/tools/exercise/run_summary.hpp"
#include "reckon/tools/exercise/scene_options.hpp"
#include "reckon/tools/exercise/simulated_hand.hpp"
#include "reckon/tools/exercise/stop_control.hpp"
#include "reckon/tools/metrics/metrics_server.hpp"
#include "reckon/tools/metrics/peer_metrics.hpp"
#include "reckon/tools/terminal/json_text.hpp"
#include "reckon/tools/terminal/text_table.hpp"
#include "reckon/tools/verbs/demo_page.hpp"
#include "reckon/tools/verbs/page_address.hpp"
#include "reckon/tools/verbs/peer_page.hpp"

namespace reckon::tools {
namespace {

using std::chrono::nanoseconds;

constexpr nanoseconds kLookEvery = std::chrono::milliseconds(100);

struct PeerVerbOptions {
  SceneOptions scene;
  DeviceChoice device;
  std::string name;
  std::optional<std::uint64_t> operator_number;
  std::optional<std::uint64_t> application;
  std::optional<nanoseconds> duration;
  bool json = false;
  bool events = false;
  bool felt = false;
  std::optional<nanoseconds> balance;
  std::string to;
  std::string follow;
  ViewSwitch view;
  std::string metrics, log;
};

/// Letters of an entity marking on the wire.
constexpr std::size_t kLongestMarking = 11;

/// The first part of this host's name as a marking, so that others know whose hand it is. A letter
/// is left for the number of a second hand.
std::string marking_of_host() {
  std::array<char, 256> host{};
  static_cast<void>(::gethostname(host.data(), host.size() - 1));
  std::string name(host.data());
  name.resize(std::min({name.find('.'), name.size(), kLongestMarking - 1}));
  const auto is_printable = [](char letter) { return letter > ' ' && letter <= '~'; };
  return name.empty() || !std::all_of(name.begin(), name.end(), is_printable) ? "HAND" : name;
}
/// Numbers above address all applications.
constexpr std::uint64_t kMostApplications = 65534;

std::optional<int> parse(Arguments arguments, const Console& console, PeerVerbOptions& options) {
  CommandLine line("peer",
                   "One peer on a LAN: its entities, and simulated hands as the scene says.",
                   "reckon peer scenes/two_hands.toml --iface eth0\n"
                   "reckon peer scenes/two_hands.toml --iface eth0 --operator 2 --name BOB\n"
                   "reckon peer scenes/two_hands.toml --for 60s --json\n"
                   "reckon peer scenes/two_hands.toml --iface eth0 --view\n"
                   "reckon peer scenes/two_hands.toml --iface eth0 --metrics 127.0.0.1:9464");
  line.word("SCENE", options.scene.scene, true, "scene file; all peers need the same");
  add_scene_options(line, options.scene);
  add_device_flags(line, options.device);
  line.option("--name", options.name,
              "marking of the hand, at most 11 characters; default: the name of this host");
  line.option("--operator", options.operator_number,
              "which peer of the scene this is, from 1: its devices, entities and operator; "
              "default: the first that no other peer is");
  line.option(
      "--application", options.application,
      "second number of the entity IDs, 1 to 65534, in a scene with 'interop'; default: the "
      "first that no program of this host has");
  line.option("--for", options.duration, "end by itself after this time, e.g. 10s");
  line.option("--to", options.to,
              "where there is no multicast: to whom each datagram goes, e.g. "
              "10.0.0.7,host-b:3001; all peers the same list; goes before the scene's 'peers'");
  line.option("--follow", options.follow,
              "beacons whose cells are listened to, e.g. gate,ferry; instead of the scene's "
              "'follow'");
  line.flag("--json", options.json, "one JSON object on the last line");
  line.flag("--events", options.events,
            "a JSON line for each remote entity that appears or goes, and for each notice");
  line.flag("--felt", options.felt,
            "a JSON line ten times a second: what each hand feels of others");
  line.option("--balance", options.balance,
              "a JSON line so often, e.g. 10s, and at the end: what became of each datagram, by "
              "sender and group; with --operator, unless the scene has one peer");
  add_view_switch(line, options.view);
  add_metrics_flag(line, options.metrics);
  add_log_flag(line, options.log);
  return line.parse(arguments, console);
}

// Whether it asks who is there which peer of the scene it is.
bool asks_for_number(const peer::SceneFile& scene, const PeerVerbOptions& options) {
  return !options.operator_number && peer::peers_of(scene) > 1 && !scene.network.interop;
}

// The peer that `options` ask for, with its simulated hands, and what there is to report of its
// link.
class RunningPeer {
 public:
  RunningPeer(const peer::SceneFile& scene, const PeerVerbOptions& options, const Console& console,
              EntityEvents& events, peer::DatagramTap* tap)
      : real_(plugins_of(options.device)),
        joined_(federate_options(scene, options, hands_, real_, tap, stop_.stop()),
                options.events ? &events : nullptr) {
    if (joined_.options().deal) {
      fmt::print(console.err, "this is peer {} of the scene: no other is; --operator chooses\n",
                 joined_.options().scene_peer);
    }
    for (const std::string& sentence : joined_.link_report()) {
      fmt::print(console.err, "{}\n", sentence);
    }
    joined_.run();
  }

  void stop() { joined_.resign(); }
  [[nodiscard]] nanoseconds elapsed() const { return joined_.elapsed(); }
  [[nodiscard]] nanoseconds now() const { return joined_.clock().now(); }
  [[nodiscard]] peer::Peer& peer() { return joined_.peer(); }
  [[nodiscard]] std::vector<peer::Notice> sealing_notices() {
    return joined_.take_sealing_notices();
  }
  [[nodiscard]] const peer::PeerThreads& threads() const { return *joined_.threads(); }
  /// Of its devices, and of the software stop.
  [[nodiscard]] std::vector<std::string> device_notices() {
    std::vector<std::string> all = real_.take_notices();
    for (std::string& sentence : hands_.take_notices()) all.push_back(std::move(sentence));
    for (std::string& sentence : stop_.take_notices()) all.push_back(std::move(sentence));
    return all;
  }
  void press_stop_key() { stop_.press_key(now()); }
  /// Its hands that a page may move.
  [[nodiscard]] const std::vector<PointerHand>& pointers() const { return hands_.pointers; }

 private:
  static peer::FederateOptions federate_options(const peer::SceneFile& scene,
                                                const PeerVerbOptions& options,
                                                SimulatedHands& hands, RealDevices& real,
                                                peer::DatagramTap* tap, haptics::ForceStop& stop) {
    peer::FederateOptions own;
    own.tap = tap;
    own.force_stop = &stop;
    own.name = options.name;
    own.scene = scene;
    own.loops = peer::FederateLoops::threads;
    own.even_if_slow = options.scene.even_if_slow;
    if (options.application) own.application = static_cast<std::uint16_t>(*options.application);
    const bool lends = flags_of_switch(options.view).has_value();
    const auto make_hands = [&scene, &options, &hands, &real, lends](std::uint32_t number) {
      peer::SceneFile held = scene;
      choose_device(options.device, held, number, peer::kMostPeers);
      if (lends) let_pages_move_hands(held, number);
      hands = make_simulated_hands(held, number);
      real.plug_in(held, number, hands.wired);
      return hands.wired;
    };
    if (asks_for_number(scene, options)) {
      own.deal = make_hands;
    } else {
      own.scene_peer = static_cast<std::uint32_t>(options.operator_number.value_or(1));
      own.devices = make_hands(own.scene_peer);
    }
    return own;
  }

  StopControl stop_;      // before the devices
  SimulatedHands hands_;  // before the peer, which makes them while it joins
  RealDevices real_;      // as well
  peer::JoinedPeer joined_;
};

// At once, for whoever reads them from a pipe.
void print_line(std::FILE* out, const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), out);
  std::fflush(out);
}

void print_notice(std::FILE* out, peer::NoticeKind kind, peer::Severity severity,
                  std::string_view text, double seconds) {
  std::string line;
  JsonObject(line)
      .text("event", "notice")
      .decimals("seconds", seconds, 3)
      .text("text", text)
      .text("notice", peer::facts_of(kind).id)
      .text("severity", peer::name_of(severity))
      .end("\n");
  print_line(out, line);
}

/// What became of each datagram, reported so often.
class BalanceLines {
 public:
  BalanceLines(nanoseconds every, std::FILE* out) : every_(every), next_(every), out_(out) {}

  [[nodiscard]] peer::DatagramTap& tap() { return tap_; }
  void look(const RunningPeer& running) {
    balance_.look();
    if (running.elapsed() < next_) return;
    next_ += every_;
    tell(running, false);
  }
  /// The last line: nothing happens any more.
  void end(const RunningPeer& running) {
    balance_.look();
    tell(running, true);
  }

 private:
  void tell(const RunningPeer& running, bool end) {
    const double seconds = pdu::to_seconds(running.elapsed());
    print_line(out_, balance_line(balance_.report(running.now(), end), seconds, end));
  }

  nanoseconds every_, next_;
  std::FILE* out_;
  peer::DatagramTap tap_;
  peer::DatagramBalance balance_{tap_};
};

// What there is to tell since the last look.
void tell_notices(RunningPeer& running, const Console& console, bool as_events,
                  LiveDisplay& display, PeerPage* page) {
  const pdu::SimulationAddress own = running.peer().views().read().own.simulation();
  const auto tell = [&](const peer::Notice& notice) {
    display.add({own, notice});
    if (page != nullptr) page->note(notice);
    if (as_events)
      print_notice(console.out, notice.kind, notice.severity, notice.text.data(),
                   pdu::to_seconds(running.elapsed()));
  };
  while (const peer::Notice* notice = running.peer().notices().front()) {
    tell(*notice);
    running.peer().notices().pop();
  }
  for (const peer::Notice& notice : running.sealing_notices()) tell(notice);
  for (std::string& sentence : running.device_notices()) {
    constexpr auto kDevice = peer::NoticeKind::device;
    if (as_events)
      print_notice(console.out, kDevice, peer::facts_of(kDevice).severity, sentence,
                   pdu::to_seconds(running.elapsed()));
    display.add_of_devices({std::move(sentence)});
  }
}

std::vector<peer::NamedPeer> read_list(const std::string& list) {
  if (list.empty()) return {};
  try {
    return peer::parse_peers(list);
  } catch (const std::invalid_argument& error) {
    throw UsageError(fmt::format("--to: {}", error.what()));
  }
}

// What this peer follows is its own matter: the scene's hash stays.
void follow_beacons(peer::SceneFile& scene, const PeerVerbOptions& options) {
  if (options.follow.empty()) return;
  if (!scene.aoim.hand_out)
    throw UsageError(
        "--follow: beacons are found in the map of groups that are handed out; set 'leaders' and "
        "'hand_out' in the scene's [aoim]");
  scene.aoim.follow = options.follow;
}

// Where the flag names somebody, that goes before what the scene says.
void send_to(const std::vector<peer::NamedPeer>& list, peer::NetworkConfig& network,
             const Console& console) {
  if (list.empty()) return;
  if (!network.peers.empty())
    fmt::print(console.err, "--to: the scene's {} are left out\n",
               counted(network.peers.size(), "peer"));
  network.peers = list;
}

void check_balance(const peer::SceneFile& scene, const PeerVerbOptions& options) {
  if (options.balance && asks_for_number(scene, options))
    throw UsageError(
        "--balance: which peer of the scene this is would be asked for by datagrams without "
        "numbers, of which no balance can be kept; say which it is, as in --operator 1");
}

void check_application(const peer::SceneFile& scene, const PeerVerbOptions& options) {
  if (!options.application) return;
  if (!scene.network.interop)
    throw UsageError(
        "--application: peers of this scene agree on their IDs; it is for a scene with 'interop'");
  if (*options.application < 1 || *options.application > kMostApplications)
    throw UsageError(fmt::format("--application: {} is none of an ID: they are 1 to {}",
                                 *options.application, kMostApplications));
}

/// @param lines whether the output has lines of its own, which a summary would end
void print_run(const PeerVerbOptions& options, bool lines, const FinishedRun& finished,
               const Console& console) {
  if (options.json) {
    print_run_json(console.out, finished);
  } else if (!lines) {
    print_run_text(console.out, finished);
  }
}

std::unique_ptr<RunningPeer> joined_peer(const peer::SceneFile& scene,
                                         const PeerVerbOptions& options, const Console& console,
                                         EntityEvents& events, peer::DatagramTap* tap) {
  try {
    return std::make_unique<RunningPeer>(scene, options, console, events, tap);
  } catch (const UsageError&) {
    throw;
  } catch (const peer::StepTooDear& slow) {
    throw EnvironmentError(refusal_of(slow));
  } catch (const std::runtime_error& error) {
    throw EnvironmentError(error.what());
  }
}

int run(const PeerVerbOptions& options, const Console& console) {
  const std::vector<peer::NamedPeer> list = read_list(options.to);
  peer::SceneFile scene = load_scene(options.scene, options.scene.scene,
                                     options.operator_number.value_or(peer::kMostPeers));
  say_native_code(scene, console);
  check_balance(scene, options);
  check_application(scene, options);
  const auto flags = flags_of_switch(options.view);
  const bool has_key = !scene.network.key.empty();
  if (flags) (void)server_options(*flags, has_key);  // refused before it joins
  send_to(list, scene.network, console);
  follow_beacons(scene, options);
  EntityEvents events;  // outlives the peer
  std::optional<BalanceLines> balance;
  if (options.balance) balance.emplace(*options.balance, console.out);
  // Before the peer: it does not join where its metrics cannot be asked for.
  const auto metrics = metrics_server(options.metrics);
  const std::unique_ptr<RunningPeer> running =
      joined_peer(scene, options, console, events, balance ? &balance->tap() : nullptr);

  const bool lines = options.events || options.felt || options.balance;
  LiveDisplay display(console, !options.json && !lines, 1, options.log);
  if (metrics) display.add({metrics->sentence()});
  std::optional<PeerPage> page;
  std::unique_ptr<BrowserRedirect> browser;
  const nanoseconds end = options.duration.value_or(nanoseconds::max());
  nanoseconds next_felt{0};
  bool shown = false;  // a picture has come: it has the hands
  nanoseconds look_every = display.is_drawn() ? LiveDisplay::kKeysEvery : kLookEvery;
  if (flags) look_every = SelfView::kLookEvery;
  while (!console.stopped() && !display.quit() && running->elapsed() < end) {
    std::this_thread::sleep_for(std::min(look_every, end - running->elapsed()));
    shown |= running->peer().views().update();
    const peer::PeerView& view = running->peer().views().read();
    const double elapsed = pdu::to_seconds(running->elapsed());
    if (flags && shown && !page) {
      const PeerPageOptions named{options.scene.scene, options.scene.iface};
      page.emplace(*flags, scene, named, view, running->pointers());
      page->add_receiver(running->peer());
      show_address(page->view(), has_key, display);
      browser = open_browser(*flags, page->view().address());
    }
    if (page) page->show(view);
    if (metrics && metrics->is_due(running->now()))
      metrics->show(peer_metrics(running->peer(), running->threads(), view, elapsed),
                    running->now());
    if (options.events) events.report(elapsed, console.out);
    if (balance) balance->look(*running);
    if (options.felt && running->elapsed() >= next_felt) {
      print_line(console.out, felt_lines(view, elapsed));
      next_felt += kLookEvery;
    }
    if (display.take_stop_key()) running->press_stop_key();
    tell_notices(*running, console, options.events, display, page ? &*page : nullptr);
    const TablePeer table{&view, &running->peer().counters()};
    display.show(std::span(&table, 1), scene, running->elapsed());
  }
  const FinishedRun finished{running->peer(), running->threads(),
                             pdu::to_seconds(running->elapsed())};
  page.reset();
  running->stop();
  if (balance) balance->end(*running);
  tell_notices(*running, console, options.events, display, nullptr);
  if (options.events) events.report_rest(finished.peer.model(), finished.seconds, console.out);
  display.close();
  print_run(options, lines, finished, console);
  return exit_status(ExitCode::good);
}

void check_beacons(const std::string& list) {
  try {
    static_cast<void>(peer::beacon_names(list));
  } catch (const std::invalid_argument& error) {
    throw UsageError(fmt::format("--follow: {}", error.what()));
  }
}

int run_peer(Arguments arguments, const Console& console) {
  PeerVerbOptions options;
  if (const auto status = parse(arguments, console, options)) return *status;
  if (options.operator_number && *options.operator_number == 0)
    throw UsageError("--operator counts from 1");
  if (options.name.size() > kLongestMarking)
    throw UsageError(fmt::format("--name: '{}' has {} letters; a marking holds {} at most",
                                 options.name, options.name.size(), kLongestMarking));
  if (options.name.empty()) options.name = marking_of_host();
  check_beacons(options.follow);
  check_device_choice(options.device);
  (void)flags_of_switch(options.view);
  (void)metrics_address(options.metrics);
  if (options.balance && *options.balance < kLookEvery)
    throw UsageError("--balance: a line every 100ms is the most that is printed");
  return run(options, console);
}

}  // namespace

namespace verb {

Verb peer() { return verb_of(verb_row("peer"), run_peer); }

}  // namespace verb

}  // namespace reckon::tools
