// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <filesystem>
#include <string>

#include "reckon/tools/captures/radio_audio.hpp"
#include "reckon/tools/command_line/command_line.hpp"
#include "reckon/tools/command_line/size_text.hpp"
#include "reckon/tools/command_line/verb_rows.hpp"
#include "reckon/tools/datagrams/selection.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::tools {
namespace {

constexpr std::string_view kCutSummary =
    "Writes a part of a capture as a new one.\n\n"
    "It copies whole datagrams, frame by frame and unchanged; it omits frames without UDP.\n"
    "Options of one kind are alternatives; a datagram must match each kind. A name that ends\n"
    "in .zst is compressed. With --audio it writes a 16-bit WAV file with the sound of one radio\n"
    "instead: its Signal PDUs in mu-law or linear PCM, placed by capture time.";
constexpr std::string_view kCutExamples =
    "reckon cut scenes/exercise.pcapng part.pcapng --from 1s --to 2s\n"
    "reckon cut scenes/exercise.pcapng one.pcapng --entity 1:2:1\n"
    "reckon cut scenes/exercise.pcapng touch.pcapng --group 239.192.1.7 --type attribute --type "
    "entity_state\n"
    "reckon cut scenes/exercise.pcapng foes.pcapng.zst --where 'side == opposing and domain == "
    "land'";

struct CutOptions {
  std::string in;
  peer::CaptureWriterOptions out;
  std::string audio;  ///< WAV file, instead of `out`; empty: none
  SelectionOptions selection;
};

void check_output(const CutOptions& options) {
  if (options.audio.empty() && options.out.path.empty())
    throw UsageError("OUT is missing: the pcapng file to write, or --audio FILE.wav");
  if (!options.audio.empty() && !options.out.path.empty())
    throw UsageError("--audio writes sound instead of a capture: remove OUT");
  const std::string& out = options.audio.empty() ? options.out.path : options.audio;
  std::error_code none;
  if (std::filesystem::equivalent(options.in, out, none))
    throw UsageError(
        fmt::format("{} would be overwritten while it is read; choose another name", out));
}

ExitCode tell(const CutOptions& options, const Console& console, std::uint64_t seen,
              const peer::CaptureWriter& writer, const peer::SourceReport& report) {
  fmt::print(console.err, "{} of {} written to {} ({})\n", writer.datagrams(),
             counted(seen, "datagram"), options.out.path, size_text(writer.octets()));
  const std::string damage = damage_text(report);
  if (!damage.empty()) fmt::print(console.err, "{}: {}\n", options.in, damage);
  if (writer.datagrams() == 0 && seen > 0)
    fmt::print(console.err, "no datagram was selected; `reckon info {}` shows the contents\n",
               options.in);
  return report.problem.empty() ? ExitCode::good : ExitCode::findings;
}

ExitCode cut(const CutOptions& options, const Console& console) {
  CaptureSelection selection(options.selection);
  const auto source = open_recording(options.in);
  peer::CaptureWriterOptions writer_options = options.out;
  writer_options.link_type = source->link_type();
  writer_options.interface = source->interface_name();
  const auto writer = create_recording(writer_options);
  std::uint64_t seen = 0;
  peer::SourceDatagram datagram;
  while (!console.stopped() && source->next(datagram, {}) == peer::SourceEvent::datagram) {
    ++seen;
    if (selection.takes(datagram)) writer->write(datagram);
  }
  writer->close();
  return tell(options, console, seen, *writer, source->report());
}

// A Signal PDU must match by itself: other PDUs in its datagram may belong to another radio.
ExitCode cut_audio(const CutOptions& options, const Console& console) {
  CaptureSelection selection(options.selection);
  const auto source = open_recording(options.in);
  DatagramInspector inspector(options.selection.lenient);
  RadioAudio audio(options.audio, options.out.overwrite);
  peer::SourceDatagram datagram;
  while (!console.stopped() && source->next(datagram, {}) == peer::SourceEvent::datagram) {
    if (!selection.takes(datagram)) continue;
    inspector.inspect(datagram, [&](const PduRow& row) {
      peer::SourceDatagram alone = datagram;
      alone.bytes = row.bytes;
      if (row.decoded && selection.takes(alone)) audio.take(row);
      return true;
    });
  }
  audio.finish();
  fmt::print(console.err, "{}", audio.summary());
  const std::string damage = damage_text(source->report());
  if (!damage.empty()) fmt::print(console.err, "{}: {}\n", options.in, damage);
  const bool whole = source->report().problem.empty();
  return whole && !audio.empty() ? ExitCode::good : ExitCode::findings;
}

int run_cut(Arguments arguments, const Console& console) {
  CutOptions options;
  CommandLine line("cut", kCutSummary, kCutExamples);
  line.word("IN", options.in, true, "pcap or pcapng file, also compressed; - is stdin");
  line.word("OUT", options.out.path, false, "the pcapng file to write");
  line.option("--audio", options.audio,
              "instead of OUT: write the sound of the one selected radio to this WAV file");
  line.option("--to", options.selection.to,
              "stop this long after the first datagram, for example 2min");
  options.selection.declare(line);
  line.flag("--force", options.out.overwrite, "overwrite OUT or the WAV file");
  if (const auto status = line.parse(arguments, console)) return *status;
  settle_compression(options.out);
  check_output(options);
  try {
    return exit_status(options.audio.empty() ? cut(options, console) : cut_audio(options, console));
  } catch (const peer::CaptureWriteError& error) {
    throw EnvironmentError(error.what());
  }
}

}  // namespace

namespace verb {

Verb cut() { return verb_of(verb_row("cut"), run_cut); }

}  // namespace verb

}  // namespace reckon::tools
