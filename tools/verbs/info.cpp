// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <string>

#include "reckon/tools/captures/summary.hpp"
#include "reckon/tools/command_line/command_line.hpp"
#include "reckon/tools/command_line/verb_rows.hpp"
#include "reckon/tools/datagrams/selection.hpp"

namespace reckon::tools {
namespace {

constexpr std::string_view kInfoSummary =
    "Summarises a capture: times, datagrams, PDUs by type, senders, groups, entities, damage.\n\n"
    "FILE is pcap or pcapng, also compressed; - is stdin. Exit status 1 if it is damaged.";
constexpr std::string_view kInfoExamples =
    "reckon info scenes/exercise.pcapng\n"
    "reckon info scenes/exercise.pcapng --json | jq '.types[]'";

ExitCode verdict(const CaptureSummary& summary, const peer::SourceReport& report) {
  const InspectTally& tally = summary.tally();
  const bool damaged = tally.of(PduStatus::error) > 0 || tally.of(PduStatus::warning) > 0 ||
                       report.fragments.lost + report.fragments.overlapping > 0 ||
                       report.malformed > 0 || report.cut > 0 || !report.problem.empty();
  return damaged ? ExitCode::findings : ExitCode::good;
}

int run_info(Arguments arguments, const Console& console) {
  std::string file;
  bool json = false, lenient = false;
  CommandLine line("info", kInfoSummary, kInfoExamples);
  line.word("FILE", file, true, "the capture");
  line.flag("--json", json, "one JSON object on one line");
  declare_lenient(line, lenient);
  if (const auto status = line.parse(arguments, console)) return *status;

  const auto source = open_recording(file);
  CaptureSummary summary(lenient);
  peer::SourceDatagram datagram;
  while (!console.stopped() && source->next(datagram, {}) == peer::SourceEvent::datagram)
    summary.add(datagram);
  const peer::SourceReport& report = source->report();
  const std::string text =
      json ? summary_json(file, summary, report) : summary_text(file, summary, report);
  fmt::print(console.out, "{}", text);
  if (console.stopped()) {
    fmt::print(console.err, "stopped early: only the beginning of {} was read\n", file);
    return exit_status(ExitCode::good);
  }
  return exit_status(verdict(summary, report));
}

}  // namespace

namespace verb {

Verb info() { return verb_of(verb_row("info"), run_info); }

}  // namespace verb

}  // namespace reckon::tools
