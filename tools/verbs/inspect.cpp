// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include "reckon/peer/clocks/clock.hpp"
#include "reckon/tools/command_line/command_line.hpp"
#include "reckon/tools/command_line/verb_rows.hpp"
#include "reckon/tools/datagrams/filter.hpp"
#include "reckon/tools/datagrams/filter_fields.hpp"
#include "reckon/tools/datagrams/listening.hpp"
#include "reckon/tools/datagrams/pdu_row.hpp"
#include "reckon/tools/datagrams/sealed_datagrams.hpp"
#include "reckon/tools/datagrams/selection.hpp"
#include "reckon/tools/datagrams/source.hpp"
#include "reckon/tools/datagrams/time_range.hpp"
#include "reckon/tools/inspect/check/check_view.hpp"
#include "reckon/tools/inspect/diff/diff.hpp"
#include "reckon/tools/inspect/output/options.hpp"
#include "reckon/tools/inspect/view_list.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::tools {
namespace {

using std::chrono::nanoseconds;

/// Longest wait for a live source, so that Ctrl-C and --for take effect.
constexpr nanoseconds kInspectPatience = std::chrono::milliseconds(100);
/// Text is written in pieces of about this size [octets], and as soon as a live source is quiet.
constexpr std::size_t kWriteSize = std::size_t{1} << 16;

constexpr std::string_view kInspectSummary =
    "Shows every PDU of every datagram, from a capture or live.\n\n"
    "SOURCE is one of\n"
    "  FILE                pcap or pcapng, plain or compressed (zstd, gzip, bzip2, xz, lz4)\n"
    "  -                   the same on stdin\n"
    "  raw:FILE            one bare datagram\n"
    "  udp://GROUP[:PORT]  a live group, such as udp://239.192.1.0:3000 or udp://[ff15::1]\n"
    "  udp://ADDRESS       live broadcast (10.9.9.255, 255.255.255.255) or unicast (an address of\n"
    "                      this host); 0.0.0.0: both, on every address\n"
    "  SCENE.toml          the live groups of a scene\n"
    "  iface:NAME          all UDP of an interface (needs CAP_NET_RAW)\n"
    "Default: 239.192.1.0:3000 and the 256 groups after it, live. Live groups are received on\n"
    "every interface; a datagram that arrives on two of them is counted once.\n"
    "SOURCE and VIEW may be in either order.";
constexpr std::string_view kInspectExamples =
    "reckon inspect scenes/exercise.pcapng\n"
    "reckon inspect --for 10s --json | jq -c 'select(.status != \"ok\")'\n"
    "reckon inspect udp://239.192.1.0:3000 --iface eth0 --tree --count 1\n"
    "reckon inspect scenes/exercise.pcapng check || echo findings\n"
    "reckon inspect scenes/exercise.pcapng stats --by entity --csv\n"
    "reckon inspect scenes/exercise.pcapng --where 'id == 1:*:* and kind == platform and not side "
    "== "
    "friendly'\n"
    "reckon inspect scenes/exercise.pcapng --where 'entity.id == 1:1:*' --from 1s --to 2s\n"
    "reckon inspect bundles --iface eth0 --for 10s\n"
    "reckon inspect scenes/exercise.pcapng haptics --svg forces.svg\n"
    "reckon inspect raw:datagram.bin --full\n"
    "reckon inspect sealed.pcapng --key crane.key\n"
    "reckon inspect diff before.pcapng after.pcapng\n"
    "tcpdump -w - udp port 3000 | reckon inspect -";

/// Collects text and writes it in large pieces.
class Output {
 public:
  explicit Output(std::FILE* file) : file_(file) {}

  [[nodiscard]] std::string& text() { return text_; }
  void write_if_large() {
    if (text_.size() >= kWriteSize) write();
  }
  /// Throws if writing fails, as on a full disk. A closed pipe is no error; ferror() reports it.
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

std::optional<Filter> filter_of(const InspectOptions& options) {
  if (options.where.empty()) return std::nullopt;
  return Filter(options.where);
}

/// One run of the verb: reads datagrams, passes them to the view, keeps the counts.
class Inspection {
 public:
  Inspection(const InspectOptions& options, const Console& console)
      : options_(options),
        console_(console),
        filter_(filter_of(options)),
        range_(options.from, options.to),
        sealed_(options.key),
        source_(open_chosen_source(options.source)),
        silence_(options.source, clock_.now()),
        output_(console.out),
        inspector_(options.lenient),
        view_(inspect_view_kind(options.view).make(options, console)) {}

  void run() {
    if (is_live(options_.source))
      fmt::print(console_.err, "listening to {}; Ctrl-C ends\n",
                 listening_text(options_.source, source_->report()));
    std::string& out = output_.text();
    view_->begin(out);
    output_.write();
    read();
    view_->finish(shown_, out);
    output_.write();
  }

  void summarise() const;
  [[nodiscard]] ExitCode verdict() const;

 private:
  [[nodiscard]] nanoseconds time_left(nanoseconds begin) const {
    return options_.duration.has_value() ? *options_.duration - (clock_.now() - begin)
                                         : nanoseconds::max();
  }
  void read();
  void tell_silence();
  [[nodiscard]] bool is_in_range(nanoseconds time);
  void show(const peer::SourceDatagram& datagram);
  /// Shows one PDU; false after the last requested one.
  bool show(const peer::SourceDatagram& datagram, const PduRow& row);
  void end_datagram(const peer::SourceDatagram& datagram, bool is_shown);

  const InspectOptions& options_;
  const Console& console_;
  std::optional<Filter> filter_;
  TimeRange range_;
  SealedDatagrams sealed_;
  std::unique_ptr<peer::DatagramSource> source_;
  peer::SteadyClock clock_;
  SilenceWatch silence_;
  Output output_;
  DatagramInspector inspector_;
  std::unique_ptr<View> view_;
  InspectTally shown_;                // PDUs that passed the filter
  std::optional<nanoseconds> start_;  // of the first datagram
  bool full_ = false;
};

void Inspection::read() {
  const nanoseconds begin = clock_.now();
  std::string& out = output_.text();
  peer::SourceDatagram datagram;
  while (!full_ && !console_.stopped()) {
    const nanoseconds left = time_left(begin);
    if (left <= nanoseconds::zero()) break;
    const bool nothing_to_write = out.empty();
    const peer::SourceEvent event = source_->next(
        datagram, nothing_to_write ? std::min(left, kInspectPatience) : nanoseconds::zero());
    if (event == peer::SourceEvent::end) break;
    if (event == peer::SourceEvent::datagram && sealed_.open(datagram) &&
        is_in_range(datagram.time))
      show(datagram);
    if (source_->is_live()) view_->tick(clock_.utc_now(), source_->report(), out);
    if (event == peer::SourceEvent::nothing_yet) {
      output_.write();
      tell_silence();
    }
    full_ = full_ || view_->has_ended();
  }
}

bool Inspection::is_in_range(nanoseconds time) {
  if (!start_.has_value()) {
    start_ = time;
    range_.begin_at(time);
    inspector_.start_at(time);
  }
  // A capture that is still being written has no end of its own.
  full_ = full_ || (options_.source.follow && range_.is_past(time));
  return range_.has(time);
}

void Inspection::tell_silence() {
  if (!means_groups(options_.source)) return;
  for (const std::string& sentence : silence_.look(source_->report(), clock_.now())) {
    if (!view_->show_notice(sentence)) fmt::print(console_.err, "{}\n", sentence);
  }
}

void Inspection::show(const peer::SourceDatagram& datagram) {
  view_->expect(datagram);
  const std::uint64_t before = shown_.all_pdus();
  full_ = !inspector_.inspect(datagram, [&](const PduRow& row) { return show(datagram, row); });
  end_datagram(datagram, shown_.all_pdus() > before);
  // A capture on stdin may be growing, and its source does not report when it is quiet.
  if (options_.source.source == "-")
    output_.write();
  else
    output_.write_if_large();
}

void Inspection::end_datagram(const peer::SourceDatagram& datagram, bool is_shown) {
  std::string& out = output_.text();
  if (!is_shown) return view_->skip();
  ++shown_.datagrams;
  view_->datagram(datagram, *start_, out);
}

bool Inspection::show(const peer::SourceDatagram& datagram, const PduRow& row) {
  std::string& out = output_.text();
  view_->look(row);
  if (filter_.has_value() && !filter_->matches(row, datagram)) return true;
  ++shown_.pdus[static_cast<std::size_t>(row.status)];
  if (row.rule == kForeignRule) ++shown_.foreign;
  view_->pdu(datagram, row, *start_, out);
  return !options_.count.has_value() || shown_.all_pdus() < *options_.count;
}

/// ": 5 good, 1 error, 0 notes".
std::string quality(const InspectTally& tally) {
  std::string text = fmt::format(": {} good, {}", tally.of(PduStatus::ok),
                                 counted(tally.of(PduStatus::error), "error"));
  if (tally.of(PduStatus::warning) > 0)
    text += fmt::format(", {}", counted(tally.of(PduStatus::warning), "warning"));
  return text + fmt::format(", {}", counted(tally.of(PduStatus::note) - tally.foreign, "note"));
}

void Inspection::summarise() const {
  const InspectTally& tally = shown_;
  const InspectTally& all = inspector_.tally();
  const peer::SourceReport& report = source_->report();
  std::string line = fmt::format("{} in {}", counted(tally.all_pdus() - tally.foreign, "PDU"),
                                 counted(tally.datagrams - tally.foreign, "datagram"));
  if (!view_->found_faults().has_value()) line += quality(tally);
  if (filter_.has_value()) line += fmt::format("; {} looked at", counted(all.all_pdus(), "PDU"));
  if (all.foreign > 0)
    line += fmt::format("; {} of other protocols", counted(all.foreign, "datagram"));
  const peer::FragmentCounts& fragments = report.fragments;
  if (fragments.whole > 0)
    line += fmt::format("; {} reassembled from IP fragments", counted(fragments.whole, "datagram"));
  if (all.fragments > 0)
    line += fmt::format("; {} with missing or overlapping IP fragments",
                        counted(all.fragments, "datagram"));
  if (fragments.waiting > 0)
    line += fmt::format("; {} still waited for IP fragments at the end",
                        counted(fragments.waiting, "datagram"));
  if (report.cut > 0) line += fmt::format("; {} cut by the capture", counted(report.cut, "frame"));
  if (report.skipped > 0) line += fmt::format("; {} without UDP", counted(report.skipped, "frame"));
  if (report.malformed > 0)
    line += fmt::format("; {} with a broken IP or UDP header", counted(report.malformed, "frame"));
  if (is_live(options_.source) || report.dropped > 0)
    line += fmt::format("; {} lost before they reached this program", report.dropped);
  fmt::print(console_.err, "{}\n{}{}", line, heard_text(report), sealed_.summary());
  if (!report.problem.empty()) fmt::print(console_.err, "{}\n", report.problem);
}

ExitCode Inspection::verdict() const {
  if (console_.stopped()) return ExitCode::good;
  const InspectTally& tally = shown_;
  const peer::SourceReport& report = source_->report();
  const bool damaged = tally.of(PduStatus::error) > 0 || tally.of(PduStatus::warning) > 0 ||
                       report.fragments.lost + report.fragments.overlapping > 0 ||
                       report.malformed > 0 || report.cut > 0 || !report.problem.empty() ||
                       sealed_.unread() > 0;
  return damaged || view_->found_faults().value_or(false) ? ExitCode::findings : ExitCode::good;
}

/// A table that is updated on a terminal; otherwise a format for pipes.
std::string_view default_view(const InspectOptions& options, const Console& console) {
  const bool shown = isatty(fileno(console.out)) == 1 && !options.json && !options.csv;
  const bool tail = options.full || options.tree || options.count.has_value();
  return is_live(options.source) && shown && !tail ? "top" : "tail";
}

void check_combination(InspectOptions& options, const Console& console) {
  sort_inspect_words(options);
  if (options.view.empty()) options.view = default_view(options, console);
  const InspectViewKind& kind = inspect_view_kind(options.view);
  const bool tail = kind.name == "tail";
  if (options.full && options.tree)
    throw UsageError("--tree and --full both list every field; remove one of them");
  if ((options.full || options.tree) && !tail)
    throw UsageError("--full and --tree need the view tail: remove the other view");
  if (options.csv && (options.json || options.full))
    throw UsageError("--csv and --json are alternatives: remove one of them");
  if (options.csv && !kind.takes_csv && !options.rules)
    throw UsageError(fmt::format(
        "{} has no --csv, because its rows differ; write --json, or a view with --csv: {}",
        kind.name, views_with_csv()));
  if (!options.by.empty() && options.view != "stats")
    throw UsageError("--by needs the view stats: write reckon inspect SOURCE stats --by " +
                     options.by);
  if ((!options.svg.empty() || options.step.has_value()) && options.view != "haptics")
    throw UsageError("--svg and --step need the view haptics: write reckon inspect SOURCE haptics");
  if ((!options.from.empty() || !options.to.empty()) && is_live(options.source))
    throw UsageError(
        "--from and --to select a part of a recording; write --for with a live source");
  options.json = options.json || options.full;
}

int print(std::string text, const Console& console) {
  Output output(console.out);
  output.text() = std::move(text);
  output.write();
  return exit_status(ExitCode::good);
}

std::string rules_text(const InspectOptions& options) {
  std::string text;
  append_check_rules(options.format(), text);
  return text;
}

int run_inspect(Arguments arguments, const Console& console) {
  if (!arguments.empty() && arguments.front() == "diff")
    return run_inspect_diff(arguments.subspan(1), console);
  InspectOptions options;
  const std::string summary =
      fmt::format("{}\n\nFields of --where (==, !=, <, <=, >, >=; and, or, not, parentheses):\n{}",
                  kInspectSummary, filter_fields_text());
  CommandLine line("inspect", summary, kInspectExamples);
  line.word("SOURCE", options.source.source, false, "source of the datagrams, see above");
  std::string views, meanings;
  for (const InspectViewKind& kind : inspect_views()) {
    views.append(kind.name).append(" ");
    meanings += fmt::format("{}{}: {}", meanings.empty() ? "" : "; ", kind.name, kind.meaning);
  }
  line.word("VIEW", options.view, false, meanings);
  line.offer("VIEW", views);
  line.flag("--tree", options.tree, "every field of every PDU, one per line");
  line.flag("--json", options.json, "one JSON object per line");
  line.flag("--full", options.full, "--json with every field, under the key \"fields\"");
  line.flag("--csv", options.csv, views_with_csv() + ": one table with a header row");
  line.choice("--by", options.by, {"type", "sender", "group", "entity"},
              "stats: only this table, with all rows");
  line.flag("--follow", options.source.follow,
            "wait for new data at the end of a capture file; top: write the table each second");
  line.option("--where", options.where,
              "only PDUs that match, for example 'entity.id == 1:*:* and kind == platform'");
  std::string fields;
  for (const FilterField& field : filter_fields()) fields.append(field.name).append(" ");
  line.offer("--where", fields);
  line.option("--fields", options.fields, "list the fields of this PDU type for --where, and exit");
  line.offer("--fields", types_with_fields());
  line.option("--from", options.from,
              "recordings: start here: 90s after the first datagram, 14:03:20 (UTC) or "
              "2026-11-26T14:03:20Z");
  line.option("--to", options.to, "recordings: stop before this, in the same format");
  line.option("--svg", options.svg, "haptics: draw the forces into this file");
  line.option("--step", options.step, "haptics: time between two samples (default: 10ms)");
  declare_lenient(line, options.lenient);
  line.flag("--rules", options.rules, "list the rules of check with remedies, and exit");
  line.option("--for", options.duration, "stop after this time, for example 10s");
  line.option("--count", options.count, "stop after this many PDUs");
  line.option("--iface", options.source.interface,
              "for groups: interface name, address or index (default: all, including lo)");
  line.offer("--iface", kInterfaces);
  line.option("--key", options.key,
              "key file: reads sealed datagrams; groups are then one port above");
  line.option("--pool", options.source.pool,
              "groups to join after the base group (default: 256; 0 for udp://)");
  if (const auto status = line.parse(arguments, console)) return *status;
  check_combination(options, console);
  if (options.rules) return print(rules_text(options), console);
  if (!options.fields.empty()) return print(table_fields_text(options.fields), console);
  options.source.sealed = !options.key.empty();

  Inspection inspection(options, console);
  inspection.run();
  inspection.summarise();
  return exit_status(inspection.verdict());
}

}  // namespace

namespace verb {

Verb inspect() { return verb_of(verb_row("inspect"), run_inspect); }

}  // namespace verb

}  // namespace reckon::tools
