// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/scale/measured_text.hpp"

#include <fmt/format.h>

#include "reckon/bench/studies/pose/study_text.hpp"
#include "reckon/tools/terminal/json_text.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::bench {
namespace {

double a_second(const MeasuredPeer& run, std::uint64_t sum) {
  return static_cast<double>(sum) / run.seconds;
}

double update_cost(const MeasuredPeer& run) {
  return run.updates > 0 ? run.cpu / static_cast<double>(run.updates) : 0;
}

template <typename Of>
double slope(const MeasuredReport& report, Of&& of) {
  std::vector<double> x, y;
  for (const MeasuredPeer& run : report.runs) {
    x.push_back(static_cast<double>(run.entities));
    y.push_back(of(run));
  }
  return log_slope(x, y);
}

}  // namespace

PeerCosts MeasuredReport::costs() const {
  return fit_costs(std::span(runs).first(std::max<std::size_t>(1, runs.size() - 1)));
}

double MeasuredReport::prediction_error() const {
  return costs().of(runs.back()) / runs.back().cpu - 1;
}

double MeasuredReport::datagram_slope() const {
  return slope(*this, [](const MeasuredPeer& run) { return a_second(run, run.datagrams); });
}

double MeasuredReport::cpu_slope() const {
  return slope(*this, [](const MeasuredPeer& run) { return run.cpu / run.seconds; });
}

std::string measured_text(const MeasuredReport& report) {
  constexpr auto kRight = tools::TextTable::Align::right;
  tools::TextTable table({{"ENTITIES", kRight},
                          {"PEERS", kRight},
                          {"GROUPS", kRight},
                          {"PACKETS/s", kRight},
                          {"B/s", kRight},
                          {"UPDATES/s", kRight},
                          {"KNOWN", kRight},
                          {"CPU", kRight},
                          {"AN UPDATE", kRight}});
  for (const MeasuredPeer& run : report.runs)
    table.add({fmt::format("{}", run.entities), fmt::format("{}", run.peers),
               fmt::format("{}", run.groups), number_text(a_second(run, run.datagrams)),
               number_text(a_second(run, run.octets)), number_text(a_second(run, run.updates)),
               fmt::format("{}", run.known),
               fmt::format("{} %", number_text(100 * run.cpu / run.seconds)),
               fmt::format("{} us", number_text(1e6 * update_cost(run)))});
  const PeerCosts costs = report.costs();
  std::string out = fmt::format(
      "one whole peer that listens among light ones, its loops alone (no kernel)\n{}\n"
      "fitted: {} us a datagram, {} us an update, {} us a second an entity known, {} us a second "
      "idle; off by {} % (rms)\n",
      table.text(), number_text(1e6 * costs.datagram), number_text(1e6 * costs.update),
      number_text(1e6 * costs.entity), number_text(1e6 * costs.idle),
      number_text(100 * costs.spread));
  if (report.runs.size() > 1)
    out += fmt::format(
        "the largest world, which the fit has not seen: CPU predicted {:+.0f} % off\n"
        "log-log slope over entities: {:.2f} of packets/s, {:.2f} of CPU\n",
        100 * report.prediction_error(), report.datagram_slope(), report.cpu_slope());
  return out;
}

std::string measured_json(const MeasuredReport& report) {
  std::string out;
  for (const MeasuredPeer& run : report.runs) {
    tools::JsonObject(out)
        .text("kind", "measured")
        .value("peers", run.peers)
        .value("entities", run.entities)
        .value("seconds", run.seconds)
        .value("groups", run.groups)
        .value("heard_packets_per_s", a_second(run, run.datagrams))
        .value("heard_bytes_per_s", a_second(run, run.octets))
        .value("heard_updates_per_s", a_second(run, run.updates))
        .value("known", run.known)
        .value("cpu_share", run.cpu / run.seconds)
        .value("update_cpu_s", update_cost(run))
        .end("\n");
  }
  const PeerCosts costs = report.costs();
  tools::JsonObject(out)
      .text("kind", "costs")
      .value("datagram_s", costs.datagram)
      .value("update_s", costs.update)
      .value("entity_share", costs.entity)
      .value("idle_share", costs.idle)
      .value("spread", costs.spread)
      .value("prediction_error", report.prediction_error())
      .value("packets_slope", report.datagram_slope())
      .value("cpu_slope", report.cpu_slope())
      .end("\n");
  return out;
}

}  // namespace reckon::bench
