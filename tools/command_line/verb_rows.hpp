// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// THE list of verbs, in the order of help, and the program of each. `reckon` starts these programs,
// as git does with its own.
#pragma once

#include <algorithm>
#include <array>
#include <string_view>

#include "reckon/tools/command_line/console.hpp"

namespace reckon::tools {

inline constexpr std::string_view kPeerProgram = "reckon-peer";
inline constexpr std::string_view kInspectProgram = "reckon-inspect";
inline constexpr std::string_view kBenchProgram = "reckon-bench";

struct VerbRow {
  std::string_view name;
  std::string_view summary;  ///< one line
  std::string_view program;
};

inline constexpr std::array kVerbRows{
    VerbRow{"demo", "two peers on loopback whose hands touch; prints the costs", kPeerProgram},
    VerbRow{"peer", "one peer on a LAN", kPeerProgram},
    VerbRow{"inspect", "show every PDU of every datagram, from a capture or live", kInspectProgram},
    VerbRow{"view", "show the world in a browser page, live or from a capture", kPeerProgram},
    VerbRow{"record", "write live datagrams to a capture", kInspectProgram},
    VerbRow{"replay", "send a capture again, at its own speed or another", kInspectProgram},
    VerbRow{"info", "show what a capture contains", kInspectProgram},
    VerbRow{"cut", "write a part of a capture to a new file", kInspectProgram},
    VerbRow{"scene", "check or explain a scene file, or print a new one", kPeerProgram},
    VerbRow{"key", "create and show the key of a sealed exercise", kPeerProgram},
    VerbRow{"tune", "find the model and threshold for recorded motion", kBenchProgram},
    VerbRow{"devices", "list real devices and the problems that prevent their use", kPeerProgram},
    VerbRow{"doctor", "report problems of this host with remedies", kPeerProgram},
    VerbRow{"bench", "studies: cost of accuracy, latency of a touch, stability, scaling",
            kBenchProgram},
    VerbRow{"figures", "compute the figures of the thesis", kBenchProgram},
    VerbRow{"zwidth", "compute the stiffness and damping that a device can render", kBenchProgram},
};

/// The row of a verb. A name without a row does not compile.
consteval VerbRow verb_row(std::string_view name) {
  return *std::ranges::find(kVerbRows, name, &VerbRow::name);
}

/// The verb of a row in its own program.
inline Verb verb_of(const VerbRow& row, int (*run)(Arguments arguments, const Console& console)) {
  return {row.name, row.summary, run};
}

}  // namespace reckon::tools
