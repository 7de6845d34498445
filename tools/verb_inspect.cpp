// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/verb_inspect.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <system_error>

#include "src/clock.hpp"
#include "tools/command_line.hpp"
#include "tools/inspect_json.hpp"
#include "tools/inspect_pdu.hpp"
#include "tools/inspect_source.hpp"
#include "tools/inspect_text.hpp"
#include "tools/text_table.hpp"

namespace reckon::tools {
namespace {

using std::chrono::nanoseconds;

/// A live source is asked again after so long, so that Ctrl-C and --for are heeded.
constexpr nanoseconds kPatience = std::chrono::milliseconds(100);
/// Text is written in pieces of about this size [octets], and as soon as a live source is quiet.
constexpr std::size_t kWriteSize = std::size_t{1} << 16;

constexpr std::string_view kSummary =
    "Shows every PDU of every datagram, from a capture or live.\n\n"
    "SOURCE is one of\n"
    "  FILE                pcap or pcapng\n"
    "  -                   the same on stdin\n"
    "  raw:FILE            one bare datagram\n"
    "  udp://GROUP[:PORT]  a live group, as udp://239.192.1.0:3000 or udp://[ff15::1]\n"
    "  iface:NAME          all UDP of an interface (needs CAP_NET_RAW)\n"
    "Without one: 239.192.1.0:3000 and the 256 groups behind it, live.";
constexpr std::string_view kExamples =
    "reckon inspect capture.pcapng\n"
    "reckon inspect --for 10s --json | jq -c 'select(.status != \"ok\")'\n"
    "reckon inspect udp://239.192.1.0:3000 --iface eth0 --tree --count 1\n"
    "reckon inspect raw:datagram.bin --full\n"
    "tcpdump -w - udp port 3000 | reckon inspect -";

struct InspectOptions {
  SourceChoice source;
  std::string view;
  bool json = false;
  bool full = false;
  bool tree = false;
  std::optional<nanoseconds> duration;
  std::optional<std::uint64_t> count;
};

/// Collects text and writes it in large pieces.
class Output {
 public:
  explicit Output(std::FILE* file) : file_(file) {}

  [[nodiscard]] std::string& text() { return text_; }
  void write_if_large() {
    if (text_.size() >= kWriteSize) write();
  }
  /// Throws where the file takes no more; a reader that went away is no fault and shows in
  /// ferror().
  void write() {
    errno = 0;
    const std::size_t written = std::fwrite(text_.data(), 1, text_.size(), file_);
    if ((written < text_.size() || std::fflush(file_) != 0) && errno != EPIPE)
      throw std::system_error(errno, std::generic_category(), "writing the output");
    text_.clear();
  }

 private:
  std::FILE* file_;
  std::string text_;
};

/// One run of the verb: reads datagrams, shows their PDUs, keeps the counts.
class Inspection {
 public:
  Inspection(const InspectOptions& options, const Console& console)
      : options_(options),
        console_(console),
        source_(open_chosen_source(options.source)),
        output_(console.out) {}

  void run() {
    if (!options_.json && !options_.tree) append_tail_titles(output_.text());
    output_.write();
    const nanoseconds begin = clock_.now();
    peer::SourceDatagram datagram;
    while (!full_ && !console_.stopped()) {
      const nanoseconds left = time_left(begin);
      if (left <= nanoseconds::zero()) break;
      const bool nothing_to_write = output_.text().empty();
      const peer::SourceEvent event = source_->next(
          datagram, nothing_to_write ? std::min(left, kPatience) : nanoseconds::zero());
      if (event == peer::SourceEvent::end) break;
      if (event == peer::SourceEvent::datagram) show(datagram);
      if (event == peer::SourceEvent::nothing_yet) output_.write();
    }
    output_.write();
  }

  void summarise() const;
  [[nodiscard]] ExitCode verdict() const;

 private:
  [[nodiscard]] nanoseconds time_left(nanoseconds begin) const {
    return options_.duration.has_value() ? *options_.duration - (clock_.now() - begin)
                                         : nanoseconds::max();
  }
  void show(const peer::SourceDatagram& datagram) {
    if (inspector_.tally().datagrams == 0) start_ = datagram.time;
    full_ = !inspector_.inspect(datagram, [this](const PduRow& row) { return show(row); });
    // A capture on stdin may still be growing, and its source cannot say when it is quiet.
    if (options_.source.source == "-")
      output_.write();
    else
      output_.write_if_large();
  }
  /// Shows one PDU; false where it was the last one asked for.
  bool show(const PduRow& row) {
    if (options_.json)
      append_json_line(output_.text(), row, options_.full);
    else if (options_.tree)
      append_tree(output_.text(), row, console_.colour);
    else
      append_tail_line(output_.text(), row, start_, console_.colour);
    return !options_.count.has_value() || inspector_.tally().all_pdus() < *options_.count;
  }

  const InspectOptions& options_;
  const Console& console_;
  std::unique_ptr<peer::DatagramSource> source_;
  Output output_;
  peer::SteadyClock clock_;
  DatagramInspector inspector_;
  nanoseconds start_{};
  bool full_ = false;
};

void Inspection::summarise() const {
  const InspectTally& tally = inspector_.tally();
  const peer::SourceReport& report = source_->report();
  std::string line = fmt::format("{} in {}: {} good, {}", counted(tally.all_pdus(), "PDU"),
                                 counted(tally.datagrams, "datagram"), tally.of(PduStatus::ok),
                                 counted(tally.of(PduStatus::error), "error"));
  if (tally.of(PduStatus::warning) > 0)
    line += fmt::format(", {}", counted(tally.of(PduStatus::warning), "warning"));
  line += fmt::format(", {}", counted(tally.of(PduStatus::note), "note"));
  if (tally.fragments > 0) line += fmt::format("; {}", counted(tally.fragments, "IP fragment"));
  if (report.cut > 0) line += fmt::format("; {} cut by the capture", counted(report.cut, "frame"));
  if (report.skipped > 0) line += fmt::format("; {} without UDP", counted(report.skipped, "frame"));
  if (report.malformed > 0)
    line += fmt::format("; {} with a broken IP or UDP header", counted(report.malformed, "frame"));
  if (source_->is_live() || report.dropped > 0)
    line += fmt::format("; {} lost before they reached us", report.dropped);
  fmt::print(console_.err, "{}\n", line);
  if (!report.problem.empty()) fmt::print(console_.err, "{}\n", report.problem);
}

ExitCode Inspection::verdict() const {
  if (console_.stopped()) return ExitCode::good;
  const InspectTally& tally = inspector_.tally();
  const peer::SourceReport& report = source_->report();
  const bool damaged = tally.of(PduStatus::error) > 0 || tally.of(PduStatus::warning) > 0 ||
                       report.malformed > 0 || report.cut > 0 || !report.problem.empty();
  return damaged ? ExitCode::findings : ExitCode::good;
}

void tell_source(const InspectOptions& options, const Console& console) {
  if (!means_groups(options.source)) return;
  const auto groups = groups_of(options.source);
  fmt::print(console.err, "listening to {}", groups.front().text());
  if (groups.size() > 1) fmt::print(console.err, " and {} groups behind it", groups.size() - 1);
  fmt::print(console.err, "; Ctrl-C ends\n");
}

}  // namespace

int run_inspect(Arguments arguments, const Console& console) {
  InspectOptions options;
  CommandLine line("inspect", kSummary, kExamples);
  line.word("SOURCE", options.source.source, false, "where the datagrams come from, see above");
  line.choice("VIEW", options.view, {"tail"}, "tail: one line a PDU (the default)");
  line.flag("--tree", options.tree, "every field of every PDU, one a line");
  line.flag("--json", options.json, "one JSON object a PDU and line");
  line.flag("--full", options.full, "--json with every field, under the key \"fields\"");
  line.option("--for", options.duration, "end by itself after this time, as in 10s");
  line.option("--count", options.count, "end after this many PDUs");
  line.option("--iface", options.source.interface,
              "for groups: interface name, address or index (default: chosen by score)");
  line.option("--pool", options.source.pool,
              "groups to join behind the base group (default: 256; 0 for udp://)");
  if (const auto status = line.parse(arguments, console)) return *status;
  if (options.full && options.tree)
    throw UsageError("--tree shows every field as it is; take --full or --tree");
  options.json = options.json || options.full;

  Inspection inspection(options, console);
  tell_source(options, console);
  inspection.run();
  inspection.summarise();
  return exit_status(inspection.verdict());
}

}  // namespace reckon::tools
