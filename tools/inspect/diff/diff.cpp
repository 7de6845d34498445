// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/inspect/diff/diff.hpp"

#include <fmt/format.h>

#include "reckon/pdu/seconds.hpp"
#include "reckon/tools/command_line/command_line.hpp"
#include "reckon/tools/datagrams/selection.hpp"

namespace reckon::tools {
namespace {

using std::chrono::nanoseconds;

constexpr std::string_view kSummary =
    "Compares two captures: PDUs in only one, changed fields, order, times,\nand the differences "
    "of entity poses and contact forces.\n\nExit status: 0 the same PDUs in the same order, 1 "
    "different, 2 a file cannot be read.";
constexpr std::string_view kExamples =
    "reckon inspect diff before.pcapng after.pcapng\n"
    "reckon inspect diff recorded.pcapng replayed.pcapng --ignore-time --within 5ms\n"
    "reckon inspect diff recorded.pcapng twice_as_fast.pcapng\n"
    "reckon inspect diff a.pcapng b.pcapng --where 'type == entity_state' --json";

struct DiffOptions {
  std::string path_a;
  std::string path_b;
  std::string where;
  std::string align = "rate";
  bool lenient = false;
  bool ignore_time = false;
  bool json = false;
  bool csv = false;
  nanoseconds step = std::chrono::milliseconds(20);
  std::optional<nanoseconds> within;

  [[nodiscard]] Format format() const {
    if (json) return Format::json;
    return csv ? Format::csv : Format::text;
  }
};

std::optional<int> parse(Arguments arguments, const Console& console, DiffOptions& options) {
  CommandLine line("inspect diff", kSummary, kExamples);
  line.word("A", options.path_a, true, "a capture, pcap or pcapng");
  line.word("B", options.path_b, true, "another one");
  line.option("--where", options.where, "only PDUs of both that match; see reckon inspect --help");
  declare_lenient(line, options.lenient);
  line.flag("--ignore-time", options.ignore_time,
            "ignore times inside PDUs: header, trailer, presence");
  line.choice("--align", options.align, {"rate", "first", "none"},
              "rate: shift B's times by the difference at the first common PDU, and scale them if "
              "B was played at another rate; first: shift only; none: unchanged");
  line.option("--within", options.within,
              "arrivals farther apart than this count as different (default: none does)");
  line.option("--step", options.step, "time between the instants of poses and forces");
  line.flag("--json", options.json, "one JSON object per line");
  line.flag("--csv", options.csv, "one CSV table: what, key, a, b, difference");
  if (const auto status = line.parse(arguments, console)) return status;
  if (options.json && options.csv) throw UsageError("write either --csv or --json");
  if (options.step < std::chrono::microseconds(100))
    throw UsageError("--step is too small; write 100us or more");
  return std::nullopt;
}

}  // namespace

bool DiffFindings::is_same() const {
  const bool in_time =
      !tolerance.has_value() || difference.greatest_time() <= pdu::to_seconds(*tolerance);
  return difference.is_same() && in_time && problem_a.empty() && problem_b.empty();
}

int run_inspect_diff(Arguments arguments, const Console& console) {
  DiffOptions options;
  if (const auto status = parse(arguments, console, options)) return *status;
  const PduStreamOptions of_a{options.path_a, options.where, options.lenient, options.ignore_time};
  const PduStreamOptions of_b{options.path_b, options.where, options.lenient, options.ignore_time};
  const auto stopped = [&] { return console.stopped(); };
  const bool as_they_are = options.align == "none";
  std::optional<CaptureDifference> difference;
  const auto align = [&](PduStream& a, PduStream& b) {
    PduAlignment alignment(a, b, options.ignore_time);
    for (AlignedPdus step; !stopped() && alignment.next(step);) difference->add(step);
  };
  PduStream a(of_a);
  PduStream b(of_b);
  difference.emplace(as_they_are ? std::optional(nanoseconds::zero()) : std::nullopt);
  align(a, b);

  MotionDifference motion(difference->shift().value_or(nanoseconds::zero()), options.step);
  const auto other_rate = options.align == "rate" ? difference->other_rate() : std::nullopt;
  PduStream again_a(of_a);
  PduStream again_b(of_b);
  if (other_rate.has_value()) {
    // The rate is known only at the end.
    difference.emplace(std::nullopt, other_rate);
    align(again_a, again_b);
    PduStream last_a(of_a);
    PduStream last_b(of_b);
    PduAlignment alignment(last_a, last_b, options.ignore_time);
    motion.run_paired(alignment, *other_rate, stopped);
  } else {
    motion.run(again_a, again_b, stopped);
  }

  const DiffFindings findings{options.path_a,     options.path_b, a.report().problem,
                              b.report().problem, *difference,    motion,
                              options.step,       options.within};
  std::string out;
  append_diff(findings, options.format(), out);
  std::fwrite(out.data(), 1, out.size(), console.out);
  if (!findings.problem_a.empty()) fmt::print(console.err, "A: {}\n", findings.problem_a);
  if (!findings.problem_b.empty()) fmt::print(console.err, "B: {}\n", findings.problem_b);
  if (console.stopped()) {
    fmt::print(console.err, "ended before the end of the captures\n");
    return exit_status(ExitCode::findings);
  }
  return exit_status(findings.is_same() ? ExitCode::good : ExitCode::findings);
}

}  // namespace reckon::tools
