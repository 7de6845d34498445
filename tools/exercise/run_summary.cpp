// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/exercise/run_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>

#include "reckon/pdu/seconds.hpp"
#include "reckon/tools/emissions/emission_text.hpp"
#include "reckon/tools/exercise/body_report.hpp"
#include "reckon/tools/exercise/exercise.hpp"
#include "reckon/tools/exercise/hand_report.hpp"
#include "reckon/tools/exercise/leaders_report.hpp"
#include "reckon/tools/terminal/json_text.hpp"
#include "reckon/tools/terminal/report_text.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::tools {
namespace {

using std::chrono::nanoseconds;

/// A limit that a peer can reach, by the counter that reports it.
struct Wall {
  std::string_view counter;
  std::string_view sentence;
};
constexpr std::array<Wall, 7> kWalls{{
    {"models_refused", "{} force models were refused: their values are impossible"},
    {"hands_unfelt", "{} bodies near a hand were not felt: a servo has room for 32"},
    {"hands_unpressed", "{} hands near bodies did not press them: a peer has room for 8"},
    {"table_full", "{} updates of entities that had no room in the table"},
    {"write_overflow", "{} datagrams dropped, because the ring to the network was full"},
    {"stale_datagrams", "{} datagrams dropped, because they waited for more than 1 s"},
    {"read_waits", "{} times the ring from the network was full; datagrams waited in the kernel"},
}};

std::uint64_t most(std::span<const peer::Counters* const> peers, std::string_view counter) {
  std::uint64_t most = 0;
  for (const peer::Counters* counters : peers) {
    const peer::Counter* found = counters->find(counter);
    most = std::max(most, found == nullptr ? 0 : found->value());
  }
  return most;
}

// Over all hands: the least energy, and the number of force cuts.
struct Ports {
  double energy_min = 0;
  double late_cost = 0;
  double loan_most = 0;
  std::uint64_t trips = 0;
};

Ports ports_of(const peer::PeerView& view) {
  Ports ports;
  for (const peer::HandView& hand : view.own_hands()) {
    ports.energy_min = std::min(ports.energy_min, hand.servo.port_energy_min);
    ports.late_cost = std::max(ports.late_cost, hand.servo.late_cost);
    ports.loan_most = std::max(ports.loan_most, hand.servo.loan_most);
    ports.trips += hand.servo.trips;
  }
  return ports;
}

Hands hands_of(const peer::PeerView& view) {
  Hands hands;
  add_hands(view, hands);
  return hands;
}

std::uint64_t counter(const peer::Peer& peer, std::string_view name) {
  const peer::Counter* found = peer.counters().find(name);
  return found == nullptr ? 0 : found->value();
}

std::string emissions_json(const peer::Peer& peer, const peer::PeerView& view) {
  std::string text;
  for (const peer::Emission& emission : peer.model().emissions().rows()) {
    text += text.empty() ? '[' : ',';
    append_emission_json(text, emission, view.started, view.time);
  }
  return text.empty() ? "[]" : text + ']';
}

void print_emissions(std::FILE* out, const peer::EmissionTable& table) {
  if (table.rows().empty()) return;
  fmt::print(out, "  emissions                  {} of remote entities, {} of them active\n",
             counted(table.rows().size(), "system"),
             std::ranges::count_if(table.rows(), &peer::Emission::emits));
}

// "32 datagrams: 30 of length field 0, 2 of another exercise"; empty if none was refused.
std::string refused_text(const peer::Peer& peer) {
  constexpr std::pair<std::string_view, std::string_view> kReasons[]{
      {"refused_no_length_in", "of length field 0"},
      {"refused_exercise_in", "of another exercise"},
      {"refused_version_in", "of another version"},
      {"refused_length_in", "without a PDU header"}};
  std::string text;
  std::uint64_t sum = 0;
  for (const auto& [name, reason] : kReasons) {
    const std::uint64_t count = counter(peer, name);
    if (count == 0) continue;
    text += fmt::format("{}{} {}", sum == 0 ? "" : ", ", count, reason);
    sum += count;
  }
  return sum == 0 ? text : fmt::format("{}: {}", counted(sum, "datagram"), text);
}

}  // namespace

void print_run_json(std::FILE* out, const FinishedRun& run) {
  peer::Peer& peer = run.peer;
  const double seconds = run.seconds;
  const peer::PeerView& view = peer.views().read();
  const peer::DutyCycle& duty = run.threads.servo_duty();
  const nanoseconds seen = view.first_remote;
  fmt::print(
      out,
      R"({{"id":"{}:{}:{}","seconds":{:.6g},"remote_seen_s":{},"entities":{},"peers":{},)"
      R"("packets_per_s":{:.6g},"bytes_per_s":{:.6g},"packets_in_per_s":{:.6g},)"
      R"("servo_steps":{},"servo_late_us":{},"missed_steps":{},"loops":{},)"
      R"("pose_jump_m":{},"force_jump_n":{},)"
      R"("energy_min_j":{:.6g},"late_cost_j":{:.6g},"loan_j":{:.6g},"trips":{},"hands":{})",
      view.own.site, view.own.application, view.own.entity, seconds,
      seen < nanoseconds(0) ? "null" : fmt::format("{:.6g}", pdu::to_seconds(seen)), view.entities,
      view.peers, static_cast<double>(counter(peer, "datagrams_out")) / seconds,
      static_cast<double>(counter(peer, "octets_out")) / seconds,
      static_cast<double>(counter(peer, "datagrams_in")) / seconds, duty.steps(),
      spread_json(microseconds(peer::percentiles(duty.lateness()))), duty.missed(),
      loops_json(loops_of(run.threads)), spread_json(peer.model().remote().pose_jumps().spread()),
      spread_json(peer.model().remote().force_jumps().spread()), ports_of(view).energy_min,
      ports_of(view).late_cost, ports_of(view).loan_most, ports_of(view).trips,
      hands_json(hands_of(view)));
  peer.counters().for_each([&](const peer::CounterReading& counter) {
    fmt::print(out, R"(,"{}":{})", counter.name, counter.value);
  });
  std::string link;
  JsonObject object(link);
  peer.link().statistics().for_each([&](std::string_view name, std::string_view,
                                        std::uint64_t value) { object.value(name, value); });
  object.end();
  fmt::print(out, "{},\"emissions\":{},\"link\":{}}}\n", leaders_json(view.leaders),
             emissions_json(peer, view), link);
}

void print_run_text(std::FILE* out, const FinishedRun& run) {
  peer::Peer& peer = run.peer;
  const double seconds = run.seconds;
  const peer::PeerView& view = peer.views().read();
  const peer::DutyCycle& duty = run.threads.servo_duty();
  const std::string refused = refused_text(peer);
  fmt::print(out, "What {:.1f} s as {}:{}:{} cost\n", seconds, view.own.site, view.own.application,
             view.own.entity);
  if (view.first_remote >= nanoseconds(0)) {
    fmt::print(out, "  first remote entity shown  {:.3f} s after start\n",
               pdu::to_seconds(view.first_remote));
  } else {
    fmt::print(out, "  first remote entity shown  never{}\n",
               refused.empty() ? "; is another peer on this interface?" : "");
  }
  if (!refused.empty()) fmt::print(out, "  refused                    {}\n", refused);
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
             fmt::format("us  ({} periods missed, {} steps)", duty.missed(), duty.steps()));
  print_loops(out, loops_of(run.threads));
  fmt::print(out, "  servo thread               {}\n", servo_text(run.threads));
  fmt::print(out, "  energy                     never below {:.1e} J\n", ports_of(view).energy_min);
  if (ports_of(view).loan_most > 0)
    fmt::print(out,
               "                             {:.1f} mJ lent to hands that met inside one another\n",
               1e3 * ports_of(view).loan_most);
  if (view.owned > view.hand_count) {
    fmt::print(out, "  without a device           {} entities, which gave {:.3g} J to hands\n",
               view.owned - view.hand_count, view.power_given);
  }
  if (view.leaders.on) {
    fmt::print(out, "  leaders                    {}\n", leaders_text(std::array{&view}));
  }
  if (view.body_owner_count > 0)
    fmt::print(out, "  bodies                     {}\n", owners_text(view, true));
  print_emissions(out, peer.model().emissions());
  print_hands(out, hands_of(view));
  const peer::Counters* counters = &peer.counters();
  print_walls(out, std::span(&counters, 1));
}

void print_walls(std::FILE* out, std::span<const peer::Counters* const> peers) {
  for (const Wall& wall : kWalls) {
    const std::uint64_t count = most(peers, wall.counter);
    if (count == 0) continue;
    fmt::print(out, "  {:<26} {}\n", "wall", fmt::format(fmt::runtime(wall.sentence), count));
  }
}

std::string walls_json(std::span<const peer::Counters* const> peers) {
  std::string text;
  for (const Wall& wall : kWalls) {
    const std::uint64_t count = most(peers, wall.counter);
    if (count > 0) text += fmt::format(R"(,"{}":{})", wall.counter, count);
  }
  return text;
}

}  // namespace reckon::tools
