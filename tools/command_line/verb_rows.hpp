// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// THE list of verbs, in the order of help, and the program of each. `reckon` starts these programs,
// as git does with its own. A verb is a file in verbs/, or a study, that defines its function, and
// a declaration and a row here.
#pragma once

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include "reckon/tools/command_line/console.hpp"

namespace reckon::tools {

inline constexpr std::string_view kPeerProgram = "reckon-peer";
inline constexpr std::string_view kInspectProgram = "reckon-inspect";
inline constexpr std::string_view kBenchProgram = "reckon-bench";

namespace verb {

Verb demo();
Verb peer();
Verb inspect();
Verb view();
Verb record();
Verb replay();
Verb info();
Verb cut();
Verb scene();
Verb key();
Verb tune();
Verb devices();
Verb doctor();
Verb bench();
Verb figures();
Verb zwidth();

}  // namespace verb

struct VerbRow {
  std::string_view name;
  std::string_view summary;  ///< one line
  std::string_view program;
  Verb (*make)() = nullptr;  ///< in its own program; null in others, which do not link it
};

/// The rows as a program has them.
template <const std::string_view& kOwn>
consteval auto verb_rows() {
  const auto row = [](std::string_view name, std::string_view summary, std::string_view program,
                      Verb (*make)()) {
    return VerbRow{name, summary, program, program == kOwn ? make : nullptr};
  };
  return std::array{
      row("demo", "two peers on loopback whose hands touch; prints the costs", kPeerProgram,
          verb::demo),
      row("peer", "one peer on a LAN", kPeerProgram, verb::peer),
      row("inspect", "show every PDU of every datagram, from a capture or live", kInspectProgram,
          verb::inspect),
      row("view", "show the world in a browser page, live or from a capture", kPeerProgram,
          verb::view),
      row("record", "write live datagrams to a capture", kInspectProgram, verb::record),
      row("replay", "send a capture again, at its own speed or another", kInspectProgram,
          verb::replay),
      row("info", "show what a capture contains", kInspectProgram, verb::info),
      row("cut", "write a part of a capture to a new file", kInspectProgram, verb::cut),
      row("scene", "check or explain a scene file, or print a new one", kPeerProgram, verb::scene),
      row("key", "create and show the key of a sealed exercise", kPeerProgram, verb::key),
      row("tune", "find the model and threshold for recorded motion", kBenchProgram, verb::tune),
      row("devices", "list real devices and the problems that prevent their use", kPeerProgram,
          verb::devices),
      row("doctor", "report problems of this host with remedies", kPeerProgram, verb::doctor),
      row("bench", "studies: cost of accuracy, latency of a touch, stability, scaling",
          kBenchProgram, verb::bench),
      row("figures", "compute the figures of the thesis", kBenchProgram, verb::figures),
      row("zwidth", "compute the stiffness and damping that a device can render", kBenchProgram,
          verb::zwidth),
  };
}

inline constexpr std::string_view kFrontProgram = "reckon";
inline constexpr std::array kVerbRows = verb_rows<kFrontProgram>();

/// The verbs of a program, in the order of the rows.
template <const std::string_view& kOwn>
std::vector<Verb> own_verbs() {
  static constexpr std::array kRows = verb_rows<kOwn>();
  std::vector<Verb> verbs;
  for (const VerbRow& row : kRows)
    if (row.make != nullptr) verbs.push_back(row.make());
  return verbs;
}

/// The row of a verb. A name without a row does not compile.
consteval VerbRow verb_row(std::string_view name) {
  return *std::ranges::find(kVerbRows, name, &VerbRow::name);
}

/// The verb of a row in its own program.
inline Verb verb_of(const VerbRow& row, int (*run)(Arguments arguments, const Console& console)) {
  return {row.name, row.summary, run};
}

}  // namespace reckon::tools
