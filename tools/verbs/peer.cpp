// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/joined_peer.hpp"
#include "reckon/peer/notation/beacon_names.hpp"
#include "reckon/peer/scene/belongings.hpp"
#include "reckon/tools/command_line/command_line.hpp"
#include "reckon/tools/command_line/verb_rows.hpp"
#include "reckon/tools/exercise/entity_events.hpp"
#include "reckon/tools/exercise/hand_report.hpp"
#include "reckon/tools/exercise/live_display.hpp"
#include "reckon/tools/exercise/native_code.hpp"
#include "reckon/tools/exercise/run_summary.hpp"
#include "reckon/tools/exercise/scene_options.hpp"
#include "reckon/tools/metrics/metrics_server.hpp"
#include "reckon/tools/metrics/peer_metrics.hpp"
#include "reckon/tools/terminal/text_table.hpp"
#include "reckon/tools/verbs/page_address.hpp"
#include "reckon/tools/verbs/peer_lines.hpp"
#include "reckon/tools/verbs/peer_page.hpp"
#include "reckon/tools/verbs/running_peer.hpp"

namespace reckon::tools {
namespace {

using std::chrono::nanoseconds;

constexpr nanoseconds kPeerLookEvery = std::chrono::milliseconds(100);

/// Letters of an entity marking on the wire.
constexpr std::size_t kLongestMarking = 11;

/// The first part of this host's name as a marking, so that others can identify the hand. One
/// letter is reserved for the number of a second hand.
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
  CommandLine line(
      "peer", "One peer on a LAN: its entities and simulated hands, as the scene defines them.",
      "reckon peer scenes/two_hands.toml --iface eth0\n"
      "reckon peer scenes/two_hands.toml --iface eth0 --operator 2 --name BOB\n"
      "reckon peer --join --iface eth0\n"
      "reckon peer scenes/two_hands.toml --for 60s --json\n"
      "reckon peer scenes/two_hands.toml --iface eth0 --view\n"
      "reckon peer scenes/two_hands.toml --iface eth0 --metrics 127.0.0.1:9464");
  line.word("SCENE", options.scene.scene, false,
            "scene file, the same for all peers; not with --join");
  line.flag("--join", options.join.group,
            "get the scene from the peers that play it, instead of SCENE; with a value: their base "
            "group, e.g. --join=239.192.5.0:3000");
  line.option("--exercise", options.join.exercise,
              "with --join: number of the exercise, 1 to 255; default: any; with a key: 1");
  add_scene_options(line, options.scene);
  add_device_flags(line, options.device);
  line.option("--name", options.name,
              "marking of the hand, at most 11 characters; default: the name of this host");
  line.option("--operator", options.operator_number,
              "number of this peer in the scene, from 1: selects its devices, entities and "
              "operator; default: the first free one");
  line.option("--application", options.application,
              "application number of the entity IDs, 1 to 65534, in a scene with 'interop'; "
              "default: the first that no program of this host uses");
  line.option("--for", options.duration, "stop after this time, e.g. 10s");
  line.option("--to", options.to,
              "without multicast: hosts that receive each datagram, e.g. 10.0.0.7,host-b:3001; the "
              "same list for all peers; overrides the scene's 'peers'");
  line.option(
      "--follow", options.follow,
      "beacons whose cells this peer joins, e.g. gate,ferry; overrides the scene's 'follow'");
  line.flag("--json", options.json, "one JSON object on the last line");
  line.flag("--events", options.events,
            "a JSON line for each remote entity that appears or disappears, and for each notice");
  line.flag("--felt", options.felt,
            "a JSON line ten times a second: what each hand feels from others");
  line.option(
      "--balance", options.balance,
      "a JSON line at this interval, e.g. 10s, and at the end: counts of received, lost and "
      "refused datagrams by sender and group; needs --operator, unless the scene has one peer");
  add_view_switch(line, options.view);
  add_metrics_flag(line, options.metrics);
  add_log_flag(line, options.log);
  return line.parse(arguments, console);
}

// Reports notices since the last call.
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

// Followed beacons concern only this peer: the scene's hash stays the same.
void follow_beacons(peer::SceneFile& scene, const PeerVerbOptions& options) {
  if (options.follow.empty()) return;
  if (!scene.aoim.hand_out)
    throw UsageError(
        "--follow needs the map of handed-out groups: set 'leaders' and 'hand_out' in the scene's "
        "[aoim]");
  scene.aoim.follow = options.follow;
}

// Peers named by the flag replace the scene's list.
void send_to(const std::vector<peer::NamedPeer>& list, peer::NetworkConfig& network,
             const Console& console) {
  if (list.empty()) return;
  if (!network.peers.empty())
    fmt::print(console.err, "--to: the scene's {} are ignored\n",
               counted(network.peers.size(), "peer"));
  network.peers = list;
}

void check_balance(const peer::SceneFile& scene, const PeerVerbOptions& options) {
  if (options.balance && asks_for_number(scene, options))
    throw UsageError(
        "--balance needs the number of this peer, because the search for a free one uses datagrams "
        "without numbers: add for example --operator 1");
}

void check_application(const peer::SceneFile& scene, const PeerVerbOptions& options) {
  if (!options.application) return;
  if (!scene.network.interop)
    throw UsageError(
        "--application needs a scene with 'interop': peers of this scene choose their IDs "
        "themselves");
  if (*options.application < 1 || *options.application > kMostApplications)
    throw UsageError(fmt::format("--application: {} is out of range: write 1 to {}",
                                 *options.application, kMostApplications));
}

// A scene of one peer has no number for others: any may be written.
void check_operator(const peer::SceneFile& scene, const PeerVerbOptions& options) {
  const std::uint32_t most = peer::peers_of(scene);
  if (options.operator_number.value_or(1) <= most || most == 1 || scene.network.interop) return;
  throw UsageError(fmt::format(
      "--operator {}: the peers of this scene have the numbers 1 to {}: write one of them, or "
      "leave --operator out to join beside them",
      *options.operator_number, most));
}

/// @param lines whether the output is a stream of lines, without a summary
void print_run(const PeerVerbOptions& options, bool lines, const FinishedRun& finished,
               const Console& console) {
  if (options.json) {
    print_run_json(console.out, finished);
  } else if (!lines) {
    print_run_text(console.out, finished);
  }
}

peer::SceneFile checked_scene(const PeerVerbOptions& options, const Console& console) {
  peer::SceneFile scene = load_scene(options.scene, options.scene.scene,
                                     options.operator_number.value_or(peer::kMostPeers));
  say_native_code(scene, console);
  check_balance(scene, options);
  check_application(scene, options);
  check_operator(scene, options);
  if (const auto flags = flags_of_switch(options.view))
    (void)server_options(*flags, !scene.network.key.empty());  // reports bad options before it
                                                               // joins
  return scene;
}

/// Opens the page at the first view, which contains the hands.
class PageWhenSeen {
 public:
  PageWhenSeen(const PeerVerbOptions& options, const peer::SceneFile& scene)
      : options_(options), scene_(scene), flags_(flags_of_switch(options.view)) {}

  [[nodiscard]] bool is_wanted() const { return flags_.has_value(); }
  /// Null until it is open.
  [[nodiscard]] PeerPage* page() { return page_ ? &*page_ : nullptr; }
  void show(RunningPeer& running, const peer::PeerView& view, LiveDisplay& display) {
    if (!flags_) return;
    if (!page_) {
      const PeerPageOptions named{options_.scene.scene, options_.scene.iface};
      page_.emplace(*flags_, scene_, named, running.peer(), view, running.pointers());
      show_address(page_->view(), !scene_.network.key.empty(), display);
      browser_ = open_browser(*flags_, page_->view().address());
    }
    page_->show(view);
  }
  void close() { page_.reset(); }

 private:
  const PeerVerbOptions& options_;
  const peer::SceneFile& scene_;
  std::optional<ViewFlags> flags_;
  std::optional<PeerPage> page_;
  std::unique_ptr<BrowserRedirect> browser_;
};

int run(const PeerVerbOptions& options, const Console& console) {
  const std::vector<peer::NamedPeer> list = read_list(options.to);
  peer::SceneFile scene = checked_scene(options, console);
  send_to(list, scene.network, console);
  follow_beacons(scene, options);
  EntityEvents events(scene.network.entities);  // outlives the peer
  std::optional<BalanceLines> balance;
  if (options.balance) balance.emplace(*options.balance, console.out);
  // Before the peer: it does not join if the metrics port cannot be used.
  const auto metrics = metrics_server(options.metrics);
  const std::unique_ptr<RunningPeer> running =
      joined_peer(scene, options, console, events, balance ? &balance->tap() : nullptr);

  const bool lines = options.events || options.felt || options.balance;
  LiveDisplay display(console, !options.json && !lines, 1, options.log);
  if (metrics) display.add({metrics->sentence()});
  if (display.is_drawn()) display.add(running->link_warnings());
  PageWhenSeen page(options, scene);
  const nanoseconds end = options.duration.value_or(nanoseconds::max());
  nanoseconds next_felt{0};
  bool shown = false;  // a view has been published
  nanoseconds look_every = display.is_drawn() ? LiveDisplay::kKeysEvery : kPeerLookEvery;
  if (page.is_wanted()) look_every = SelfView::kLookEvery;
  while (!console.stopped() && !display.quit() && running->elapsed() < end) {
    std::this_thread::sleep_for(std::min(look_every, end - running->elapsed()));
    shown |= running->peer().views().update();
    const peer::PeerView& view = running->peer().views().read();
    const double elapsed = pdu::to_seconds(running->elapsed());
    if (shown) page.show(*running, view, display);
    if (metrics && metrics->is_due(running->now()))
      metrics->show(peer_metrics(running->peer(), running->threads(), view, elapsed),
                    running->now());
    if (options.events) events.report(elapsed, console.out);
    if (balance) balance->look(*running);
    if (options.felt && running->elapsed() >= next_felt) {
      print_line(console.out, felt_lines(view, elapsed));
      next_felt += kPeerLookEvery;
    }
    if (display.take_stop_key()) running->press_stop_key();
    tell_notices(*running, console, options.events, display, page.page());
    const TablePeer table{&view, &running->peer().counters()};
    display.show(std::span(&table, 1), scene, running->elapsed());
  }
  const FinishedRun finished{running->peer(), running->threads(),
                             pdu::to_seconds(running->elapsed())};
  page.close();
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

void check_join(const PeerVerbOptions& options) {
  const JoinPlace& join = options.join;
  if (join.group.empty() == options.scene.scene.empty())
    throw UsageError(join.group.empty()
                         ? "SCENE is required: write reckon peer SCENE, or --join to get the scene "
                           "from the peers that play it"
                         : "--join gets the scene from other peers: leave SCENE out");
  if (!join.group.empty() && !options.to.empty())
    throw UsageError("--join needs multicast: give SCENE with --to");
  if (join.exercise && join.group.empty())
    throw UsageError("--exercise is only for --join: a scene file has [network] exercise");
  if (join.exercise && (*join.exercise < 1 || *join.exercise > 255))
    throw UsageError(fmt::format("--exercise: {} is out of range: write 1 to 255", *join.exercise));
}

int run_peer(Arguments arguments, const Console& console) {
  PeerVerbOptions options;
  if (const auto status = parse(arguments, console, options)) return *status;
  if (options.operator_number && *options.operator_number == 0)
    throw UsageError("--operator: write 1 or more");
  if (options.name.size() > kLongestMarking)
    throw UsageError(fmt::format("--name: '{}' has {} characters; write at most {}", options.name,
                                 options.name.size(), kLongestMarking));
  if (options.name.empty()) options.name = marking_of_host();
  check_beacons(options.follow);
  check_device_choice(options.device);
  (void)flags_of_switch(options.view);
  (void)metrics_address(options.metrics);
  if (options.balance && *options.balance < kPeerLookEvery)
    throw UsageError("--balance: write at least 100ms");
  check_join(options);
  if (!options.join.group.empty()) join_scene(options.join, options.scene, console);
  return run(options, console);
}

}  // namespace

namespace verb {

Verb peer() { return verb_of(verb_row("peer"), run_peer); }

}  // namespace verb

}  // namespace reckon::tools
