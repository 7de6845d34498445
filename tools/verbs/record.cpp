// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <string>

#include "reckon/pdu/bundle.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/clocks/clock.hpp"
#include "reckon/tools/captures/stamp_order.hpp"
#include "reckon/tools/command_line/command_line.hpp"
#include "reckon/tools/command_line/duration_text.hpp"
#include "reckon/tools/command_line/size_text.hpp"
#include "reckon/tools/command_line/status_line.hpp"
#include "reckon/tools/command_line/verb_rows.hpp"
#include "reckon/tools/datagrams/listening.hpp"
#include "reckon/tools/datagrams/sealed_datagrams.hpp"
#include "reckon/tools/datagrams/selection.hpp"
#include "reckon/tools/datagrams/source.hpp"
#include "reckon/tools/metrics/metrics_server.hpp"
#include "reckon/tools/metrics/source_metrics.hpp"
#include "reckon/tools/terminal/json_text.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::tools {
namespace {

using std::chrono::nanoseconds;

/// Longest wait for a quiet source, and for the disk once datagrams are in order (StampOrder).
constexpr nanoseconds kRecordPatience = std::chrono::milliseconds(100);

constexpr std::string_view kRecordSummary =
    "Writes live datagrams to a pcapng file, with times in nanoseconds.\n\n"
    "SOURCE is udp://GROUP[:PORT], a broadcast address (udp://10.9.9.255, udp://255.255.255.255),\n"
    "an address of this host, udp://0.0.0.0 for both, SCENE.toml (the groups of a scene) or\n"
    "iface:NAME (all UDP of an interface, needs CAP_NET_RAW).\n"
    "Default: 239.192.1.0:3000 and the 256 groups after it; needs no privileges. Every interface\n"
    "is received; a datagram that arrives on two of them is recorded once.\n"
    "Ctrl-C ends it. If it is killed or the disk is full, the file stays readable.\n"
    "A FILE that ends in .zst is compressed. Sealed datagrams stay sealed; a filter needs --key "
    "to\n"
    "read them.";
constexpr std::string_view kRecordExamples =
    "reckon record exercise.pcapng\n"
    "reckon record exercise.pcapng --for 10min --iface eth0\n"
    "reckon record day.pcapng udp://239.1.2.3:3000 --rotate-time 1h --rotate-size 1GB\n"
    "reckon record week.pcapng.zst --rotate-time 1h --rotate-total 100GB\n"
    "reckon record foes.pcapng.zst --where 'side == opposing'\n"
    "reckon record sealed.pcapng --key crane.key\n"
    "reckon record day.pcapng --rotate-time 1h --metrics 127.0.0.1:9464\n"
    "reckon record all.pcapng iface:eth0";

struct RecordOptions {
  SourceChoice source;
  peer::CaptureWriterOptions writer;
  std::string rotate_size;
  std::string rotate_total;
  std::optional<nanoseconds> duration;
  SelectionOptions selection;  ///< only its filter is used
  std::string key;             ///< file; empty: none
  std::string metrics;         ///< as typed; empty: none
  bool json = false;
};

/// One run of the verb.
class Recording {
 public:
  Recording(const RecordOptions& options, const Console& console)
      : options_(options),
        console_(console),
        selection_(options.selection),
        sealed_(options.key),
        source_(open_chosen_source(options.source)),
        metrics_(metrics_server(options.metrics)),
        writer_(create_recording(writer_options())),
        status_(console.err, begin_),
        silence_(options.source, begin_) {}

  /// Records until the end is requested. Throws EnvironmentError if the file is full. Reports the
  /// recorded datagrams in either case.
  void run();

 private:
  [[nodiscard]] peer::CaptureWriterOptions writer_options() const {
    peer::CaptureWriterOptions out = options_.writer;
    out.link_type = source_->link_type();
    const auto& listened = source_->report().interfaces;
    if (listened.size() == 1) out.interface = listened.front().name;
    return out;
  }
  [[nodiscard]] nanoseconds time_left(nanoseconds now) const {
    return options_.duration.has_value() ? *options_.duration - (now - begin_) : kRecordPatience;
  }
  void record();
  void take(const peer::SourceDatagram& datagram);
  void flush_when_due(nanoseconds now, bool quiet);
  void show_status(nanoseconds now);
  void show_metrics(nanoseconds now);
  void tell_end(nanoseconds elapsed, const std::string& problem) const;
  void summarise(nanoseconds elapsed) const;
  [[nodiscard]] std::string counts() const;
  void for_each_count(auto&& visit) const;
  void add_counts(JsonObject& line, std::string_view event, nanoseconds elapsed) const;

  const RecordOptions& options_;
  const Console& console_;
  CaptureSelection selection_;
  SealedDatagrams sealed_;
  std::unique_ptr<peer::DatagramSource> source_;
  std::unique_ptr<MetricsServer> metrics_;  ///< null: not requested
  std::unique_ptr<peer::CaptureWriter> writer_;
  StampOrder order_{[this](const peer::SourceDatagram& datagram) { writer_->write(datagram); }};
  peer::SteadyClock clock_;
  nanoseconds begin_{clock_.now()};
  StatusLine status_;
  SilenceWatch silence_;
  nanoseconds flushed_{begin_};
  std::uint64_t datagrams_ = 0;
  std::uint64_t pdus_ = 0;
  std::uint64_t octets_ = 0;
  std::uint64_t left_out_ = 0;  ///< datagrams that did not match
};

void Recording::run() {
  fmt::print(console_.err, "recording {} to {}; Ctrl-C ends\n",
             listening_text(options_.source, source_->report()), options_.writer.path);
  if (metrics_) fmt::print(console_.err, "{}\n", metrics_->sentence());
  try {
    record();
  } catch (const peer::CaptureWriteError& error) {
    status_.clear();
    tell_end(clock_.now() - begin_, error.what());
    throw EnvironmentError(error.what());
  }
  const nanoseconds elapsed = clock_.now() - begin_;
  tell_end(elapsed, source_->report().problem);
  summarise(elapsed);
}

void Recording::record() {
  peer::SourceDatagram datagram;
  while (!console_.stopped()) {
    const nanoseconds now = clock_.now();
    const nanoseconds left = time_left(now);
    if (left <= nanoseconds::zero()) break;
    const peer::SourceEvent event = source_->next(datagram, std::min(left, kRecordPatience));
    if (event == peer::SourceEvent::end) break;
    if (event == peer::SourceEvent::datagram) take(datagram);
    flush_when_due(now, event == peer::SourceEvent::nothing_yet);
  }
  order_.flush();
  status_.clear();
  const std::uint64_t lost = source_->report().dropped;
  writer_->finish(datagrams_ + left_out_ + lost, lost);
}

void Recording::take(const peer::SourceDatagram& datagram) {
  peer::SourceDatagram read = datagram;
  const bool is_read = sealed_.open(read);
  // Greetings and datagrams that cannot be opened belong to the exercise, unless a filter excludes
  // them.
  if (!options_.selection.where.empty() && !(is_read && selection_.takes(read))) {
    ++left_out_;
    return;
  }
  order_.add(datagram);
  ++datagrams_;
  octets_ += datagram.bytes.size();
  if (!is_read) return;
  for (const pdu::BundledPdu& pdu : pdu::BundleReader(read.bytes)) {
    if (pdu.error == pdu::DecodeError::none) ++pdus_;
  }
}

void Recording::flush_when_due(nanoseconds now, bool quiet) {
  if (quiet) order_.flush();
  if (quiet || now - flushed_ >= kRecordPatience) {
    writer_->flush();
    flushed_ = now;
  }
  if (status_.due(now)) show_status(now);
  if (metrics_ && metrics_->is_due(now)) show_metrics(now);
  if (!quiet || !means_groups(options_.source)) return;
  for (const std::string& sentence : silence_.look(source_->report(), now)) {
    status_.clear();
    fmt::print(console_.err, "{}\n", sentence);
  }
}

void Recording::show_status(nanoseconds now) {
  status_.show(fmt::format("{}: {}; {} lost before they reached this program",
                           duration_text(now - begin_), counts(), source_->report().dropped),
               now);
  if (!options_.json) return;
  std::string text;
  JsonObject line(text);
  add_counts(line, "status", now - begin_);
  line.end("\n");
  fmt::print(console_.out, "{}", text);
  std::fflush(console_.out);
}

void Recording::show_metrics(nanoseconds now) {
  OpenMetrics text;
  text.gauge("uptime_seconds", "time since the start", pdu::to_seconds(now - begin_));
  for_each_count([&](std::string_view name, std::string_view meaning, std::uint64_t value) {
    text.counter(fmt::format("recorded_{}", name), meaning, value);
  });
  add_source(text, source_->report());
  metrics_->show(text.end(), now);
}

std::string Recording::counts() const {
  return fmt::format("{} ({}, {})", counted(datagrams_, "datagram"), counted(pdus_, "PDU"),
                     size_text(octets_));
}

void Recording::for_each_count(auto&& visit) const {
  visit("datagrams", "datagrams recorded", datagrams_);
  visit("pdus", "readable PDUs in them", pdus_);
  visit("octets", "octets of UDP payload recorded", octets_);
  visit("left_out", "datagrams that did not match the filter", left_out_);
  visit("sealed_unread", "sealed datagrams that could not be opened", sealed_.unread());
  visit("lost", "datagrams lost before they reached the program", source_->report().dropped);
  const peer::RemovedFiles& removed = writer_->removed();
  visit("file_octets", "octets written to files", writer_->octets() + removed.octets);
  visit("files", "files begun", writer_->paths().size() + removed.files);
  visit("removed_files", "files removed for --rotate-total", removed.files);
  visit("removed_datagrams", "datagrams in these files", removed.datagrams);
}

void Recording::add_counts(JsonObject& line, std::string_view event, nanoseconds elapsed) const {
  line.text("event", event).decimals("seconds", pdu::to_seconds(elapsed), 3);
  for_each_count([&line](std::string_view name, std::string_view, std::uint64_t value) {
    line.value(name, value);
  });
}

void Recording::tell_end(nanoseconds elapsed, const std::string& problem) const {
  if (!options_.json) return;
  std::string text;
  JsonObject line(text);
  add_counts(line, "summary", elapsed);
  line.value("safe", writer_->datagrams())
      .array("paths", writer_->paths(), append_json_string)
      .text("problem", problem)
      .end("\n");
  fmt::print(console_.out, "{}", text);
}

void Recording::summarise(nanoseconds elapsed) const {
  const auto& paths = writer_->paths();
  const std::string files = paths.size() == 1 ? paths.front()
                                              : fmt::format("{} files, {} to {}", paths.size(),
                                                            paths.front(), paths.back());
  const std::uint64_t dropped = source_->report().dropped;
  fmt::print(console_.err,
             "recorded {} in {} to {} ({}); {} lost before they reached this program\n", counts(),
             duration_text(elapsed), files, size_text(writer_->octets()), dropped);
  if (left_out_ > 0)
    fmt::print(console_.err, "{} did not match and were omitted\n", counted(left_out_, "datagram"));
  if (const peer::RemovedFiles& removed = writer_->removed(); removed.files > 0)
    fmt::print(console_.err, "removed the oldest: {} with {} (--rotate-total {})\n",
               counted(removed.files, "file"), counted(removed.datagrams, "datagram"),
               options_.rotate_total);
  fmt::print(console_.err, "{}{}", heard_text(source_->report()), sealed_.summary());
  if (dropped > 0)
    fmt::print(console_.err,
               "to avoid loss, raise the receive buffer: sysctl -w net.core.rmem_max=33554432\n");
  const std::string& problem = source_->report().problem;
  if (!problem.empty()) fmt::print(console_.err, "{}\n", problem);
}

/// Octets; 0: not given.
std::uint64_t size_of(std::string_view flag, const std::string& text) {
  if (text.empty()) return 0;
  const auto size = parse_size(text);
  if (size.has_value()) return *size;
  throw UsageError(
      fmt::format("{} {}: not a size; write for example 500k, 100MB or 2GiB", flag, text));
}

void check(RecordOptions& options) {
  check_form(options.source.source);
  if (!means_groups(options.source) && !options.source.source.starts_with("iface:"))
    throw UsageError(fmt::format(
        "'{}' is not live; write udp://GROUP[:PORT] or iface:NAME, or `reckon cut {} OUT` for a "
        "part of a file",
        options.source.source, options.source.source));
  settle_compression(options.writer);
  peer::CaptureWriterOptions& writer = options.writer;
  writer.rotate_octets = size_of("--rotate-size", options.rotate_size);
  writer.rotate_total = size_of("--rotate-total", options.rotate_total);
  if (writer.rotate_total == 0) return;
  if (writer.rotate_octets == 0 && writer.rotate_after.count() == 0)
    throw UsageError("--rotate-total needs --rotate-time or --rotate-size");
  if (writer.rotate_total / 2 < writer.rotate_octets)
    throw UsageError(fmt::format("--rotate-total {}: must be at least twice --rotate-size {}",
                                 options.rotate_total, options.rotate_size));
}

int run_record(Arguments arguments, const Console& console) {
  RecordOptions options;
  CommandLine line("record", kRecordSummary, kRecordExamples);
  line.word("FILE", options.writer.path, true, "the pcapng file to write");
  line.word("SOURCE", options.source.source, false, "what to record, see above");
  line.option("--for", options.duration, "stop after this time, for example 10s");
  line.option("--iface", options.source.interface,
              "for groups: interface name, address or index (default: all, including lo)");
  line.offer("--iface", kInterfaces);
  line.option("--pool", options.source.pool,
              "groups to join after the base group (default: 256; 0 for udp://)");
  line.option("--rotate-size", options.rotate_size,
              "begin the next file, FILE_00002, at this size, for example 100MB");
  line.option("--rotate-time", options.writer.rotate_after,
              "begin the next file after this time, for example 1h");
  line.option("--rotate-total", options.rotate_total,
              "remove the oldest files of this recording if their total size would exceed this, "
              "for example 100GB");
  line.flag("--compress", options.writer.compress,
            "compress with zstd, as for a FILE that ends in .zst");
  options.selection.declare_filter(line);
  line.option("--key", options.key,
              "key file: filter and counts read sealed datagrams; groups are then one port above");
  add_metrics_flag(line, options.metrics);
  line.flag("--json", options.json, "counts every 5 s and at the end, one JSON object per line");
  line.flag("--force", options.writer.overwrite, "overwrite FILE");
  if (const auto status = line.parse(arguments, console)) return *status;
  options.source.sealed = !options.key.empty();
  check(options);
  (void)metrics_address(options.metrics);
  Recording recording(options, console);
  recording.run();
  return exit_status(ExitCode::good);
}

}  // namespace

namespace verb {

Verb record() { return verb_of(verb_row("record"), run_record); }

}  // namespace verb

}  // namespace reckon::tools
