// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// THE list of mechanisms that reduce traffic, in the order in which the study adds them. A new
// mechanism is a member of ScaleDesign and a row here.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

namespace reckon::bench {

/// Which mechanisms peers use.
struct ScaleDesign {
  bool dead_reckoning = false;  ///< else each entity is sent at each tick
  bool bundling = false;        ///< else one Entity State a datagram
  bool areas = false;           ///< a group for each cell; else all receive everything
  /// Rate and threshold depend on the nearest receiver. Updates that only near receivers need are
  /// sent to groups of their own. Else all updates are alike.
  bool channels = false;
  bool compression = false;  ///< see scale_compression(); else whole Entity States
};

struct Mechanism {
  std::string_view name;
  std::string_view short_name;  ///< for a narrow table
  std::string_view meaning;
  void (*add)(ScaleDesign&);  ///< to the mechanisms of the rows before it
};

inline constexpr std::array kMechanisms{
    Mechanism{"every tick", "every tick",
              "each entity is sent at each tick, to all, one a datagram", [](ScaleDesign&) {}},
    Mechanism{
        "+ dead reckoning", "+ dead reckoning",
        "sent when the error of the peers' prediction reaches the threshold, and at the heartbeat",
        [](ScaleDesign& design) { design.dead_reckoning = true; }},
    Mechanism{"+ bundling", "+ bundling", "entities of one peer share datagrams",
              [](ScaleDesign& design) { design.bundling = true; }},
    Mechanism{"+ areas of interest", "+ areas",
              "a multicast group for each cell, joined within the radius",
              [](ScaleDesign& design) { design.areas = true; }},
    Mechanism{"+ channels", "+ channels",
              "at most 30 updates a second if a receiver is within 50 m, 10 and 4 times as coarse "
              "within 200 m, else 1 and 16 times; each row within the radius except the last uses "
              "its own group of each cell, if 1,000 groups suffice; otherwise all receive what the "
              "nearest receiver needs",
              [](ScaleDesign& design) { design.channels = true; }},
    Mechanism{"+ compression", "+ compression",
              "the part of a state that receivers cannot predict, or with groups for near rows its "
              "difference from the last key, in one PDU a bundle",
              [](ScaleDesign& design) { design.compression = true; }},
};

/// The mechanisms of the rows up to and including `row`.
[[nodiscard]] constexpr ScaleDesign design_of(std::size_t row) {
  ScaleDesign design;
  for (const Mechanism& mechanism : std::span(kMechanisms).first(row + 1)) mechanism.add(design);
  return design;
}

}  // namespace reckon::bench
