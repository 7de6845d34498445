// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>

#include "reckon/tools/command_line/command_line.hpp"
#include "reckon/tools/command_line/size_text.hpp"
#include "reckon/tools/datagrams/selection.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::tools {
namespace {

constexpr std::string_view kSummary =
    "Writes a part of a capture as a new one.\n\n"
    "Whole datagrams are taken, frame for frame and octet for octet; frames without UDP are left\n"
    "out. Words of one kind widen the choice, words of different kinds narrow it. A name that "
    "ends\n"
    "in .zst is compressed.";
constexpr std::string_view kExamples =
    "reckon cut day.pcapng part.pcapng --from 90s --to 2min\n"
    "reckon cut day.pcapng one.pcapng --entity 1:2:3\n"
    "reckon cut day.pcapng touch.pcapng --group 239.192.1.7 --type attribute --type entity_state\n"
    "reckon cut day.pcapng foes.pcapng.zst --where 'side == opposing and domain == land'";

struct CutOptions {
  std::string in;
  peer::CaptureWriterOptions out;
  SelectionOptions selection;
};

void refuse_same_file(const CutOptions& options) {
  std::error_code none;
  if (std::filesystem::equivalent(options.in, options.out.path, none))
    throw UsageError(fmt::format("{} would be overwritten while it is read; choose another name",
                                 options.out.path));
}

ExitCode tell(const CutOptions& options, const Console& console, std::uint64_t seen,
              const peer::CaptureWriter& writer, const peer::SourceReport& report) {
  fmt::print(console.err, "{} of {} written to {} ({})\n", writer.datagrams(),
             counted(seen, "datagram"), options.out.path, size_text(writer.octets()));
  const std::string damage = damage_text(report);
  if (!damage.empty()) fmt::print(console.err, "{}: {}\n", options.in, damage);
  if (writer.datagrams() == 0 && seen > 0)
    fmt::print(console.err, "nothing was chosen; `reckon info {}` shows what there is\n",
               options.in);
  return report.problem.empty() ? ExitCode::good : ExitCode::findings;
}

ExitCode cut(const CutOptions& options, const Console& console) {
  CaptureSelection selection(options.selection);
  const auto source = open_recording(options.in);
  peer::CaptureWriterOptions writer_options = options.out;
  writer_options.link_type = source->link_type();
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

int run_cut(Arguments arguments, const Console& console) {
  CutOptions options;
  CommandLine line("cut", kSummary, kExamples);
  line.word("IN", options.in, true, "pcap or pcapng file, also compressed; - is stdin");
  line.word("OUT", options.out.path, true, "the pcapng file to write");
  line.option("--to", options.selection.to,
              "stop this long after the first datagram, for example 2min");
  options.selection.declare(line);
  line.flag("--force", options.out.overwrite, "overwrite OUT");
  if (const auto status = line.parse(arguments, console)) return *status;
  settle_compression(options.out);
  refuse_same_file(options);
  try {
    return exit_status(cut(options, console));
  } catch (const peer::CaptureWriteError& error) {
    throw EnvironmentError(error.what());
  }
}

}  // namespace

namespace verb {

Verb cut() { return {"cut", "write a part of a capture to a new file", run_cut}; }

}  // namespace verb

}  // namespace reckon::tools
