// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/verbs/replay_options.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <string_view>

#include "reckon/tools/command_line/duration_text.hpp"

namespace reckon::tools {
namespace {

constexpr std::string_view kSummary =
    "Sends the datagrams of a capture again, at their recorded times.\n\n"
    "Programs of this host that joined their groups receive them; with --iface also the network\n"
    "of that interface, in IP fragments above its MTU. FILE is pcap or pcapng, also compressed.\n"
    "Sealed datagrams are sent unchanged, and members refuse them as replays; with --key they are\n"
    "sent plain, to the port below. At the end it prints the speed that it reached.\n"
    "Keys on a terminal: space pauses and resumes, left and right skip 10 s, + and - double and\n"
    "halve the speed, q quits.";
constexpr std::string_view kExamples =
    "reckon replay scenes/exercise.pcapng\n"
    "reckon replay scenes/exercise.pcapng --rate 4 --from 1s --to 2s\n"
    "reckon replay scenes/exercise.pcapng --to udp://239.1.2.3:3000 --iface eth0 --rewrite-time\n"
    "reckon replay scenes/exercise.pcapng --to udp://192.168.1.255:3000\n"
    "reckon replay scenes/exercise.pcapng --loop 0 --where 'entity.id == 1:2:*'\n"
    "reckon replay scenes/exercise.pcapng --map-exercise 1=7 --map-id 1:2:*=9:2:* --map-place "
    "34.05,-118.24";

/// Distinguishes a destination from a time, and finds the interface of a broadcast address.
void settle_destination(ReplayOptions& options) {
  for (const std::string& text : options.to) {
    const auto end = parse_duration(text);
    if ((end.has_value() && options.selection.to.has_value()) ||
        (!end.has_value() && options.destination.has_value()))
      throw UsageError(
          fmt::format("--to {}: the second {}; write one, and run `reckon replay` twice for two",
                      text, end.has_value() ? "end of the range" : "destination"));
    if (end.has_value())
      options.selection.to = end;
    else
      options.destination = parse_destination(text);
  }
  if (options.destination.has_value()) {
    const auto interface = broadcast_interface(*options.destination, local_networks());
    options.broadcast = interface.has_value();
    if (options.interface.empty()) options.interface = interface.value_or("");
  }
  if (options.interface.empty()) options.interface = "lo";
}

void check(const ReplayOptions& options) {
  if (!std::isfinite(options.rate) || options.rate < 0)
    throw UsageError(fmt::format(
        "--rate {}: write a number above 0 (2 is twice as fast), or 0 for as fast as possible",
        options.rate));
  // A missing file is reported when it is opened.
  std::error_code none;
  const bool is_pipe = options.file == "-" || (std::filesystem::exists(options.file, none) &&
                                               !can_be_read_again(options.file));
  if (is_pipe && options.loop != 1)
    throw UsageError(fmt::format("{} can be played only once; save it to a file for --loop",
                                 options.file == "-" ? "standard input" : options.file));
}

}  // namespace

bool can_be_read_again(const std::string& file) {
  std::error_code none;
  return file.starts_with("raw:") || std::filesystem::is_regular_file(file, none);
}

std::optional<int> parse_replay(Arguments arguments, const Console& console,
                                ReplayOptions& options) {
  CommandLine line("replay", kSummary, kExamples);
  line.word("FILE", options.file, true, "the capture; - is stdin");
  line.option(
      "--to", options.to,
      "send all to udp://ADDRESS:PORT, a group, a host or a broadcast address (default: the "
      "recorded destinations); or stop this long after the first datagram, for example 2min");
  line.option("--iface", options.interface,
              "interface to send on (default: lo, which reaches only this host; for a broadcast "
              "address, its interface); 'recorded': the interface named in the capture");
  line.offer("--iface", kInterfaces);
  line.option("--rate", options.rate, "speed: 2 is twice as fast, 0 as fast as possible");
  line.option("--loop", options.loop, "repeat this many times; 0: until Ctrl-C");
  options.selection.declare(line);
  line.option("--key", options.key, "key file: sends sealed datagrams plain, to the port below");
  line.flag("--rewrite-time", options.rewrite_time,
            "set the timestamps of PDUs to their send time");
  options.map.declare(line);
  line.flag("--json", options.json, "counts every 5 s and at the end, one JSON object per line");
  if (const auto status = line.parse(arguments, console)) return status;
  check(options);
  settle_destination(options);
  return std::nullopt;
}

}  // namespace reckon::tools
