// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What one seed does to the owners: the line between the peers, hands that touch objects, and
// faults.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace reckon::fuzz::owners {

using Nanoseconds = std::chrono::nanoseconds;

inline constexpr Nanoseconds kWarmUp = std::chrono::seconds(4);   // all vote
inline constexpr Nanoseconds kHealed = std::chrono::seconds(24);  // no fault any more
inline constexpr Nanoseconds kEnd = std::chrono::seconds(36);

struct Line {
  double loss = 0.0, doubled = 0.0;
  double late = 0.0;  ///< share of datagrams that take up to 4 s
  Nanoseconds least{}, most{};

  friend bool operator==(const Line&, const Line&) = default;
};

enum class FaultKind : std::uint8_t {
  crash,
  restart,
  pause,
  partition,
  one_way,  ///< from `peer` to `other`
  leave,
  deaf,    ///< nothing arrives at the peer
  choke,   ///< only rounds pass between the peer and others, as through a path with a small MTU
  mute,    ///< nothing arrives from the peer
  bridge,  ///< a partition with `peer` on both sides
};
inline constexpr std::size_t kFaultKinds = 10;

struct Fault {
  FaultKind kind = FaultKind::crash;
  Nanoseconds at{}, until{};
  std::size_t peer = 0, other = 0;  ///< other: of a one-way cut
  std::uint32_t side = 0;           ///< peers of one side of a partition
};

/// A hand of a peer is at an object.
struct Touch {
  Nanoseconds from{}, to{};
  std::size_t peer = 0, object = 0;
};

struct Plan {
  std::uint64_t seed = 0;
  std::size_t peers = 2, objects = 1;
  std::size_t island = 1;          ///< the first objects change owner together
  std::vector<std::size_t> hosts;  ///< of each peer
  bool moves = false;              ///< objects are always in motion
  bool is_contested = false;       ///< two peers ask within 100 ms
  bool leaves_only = false;        ///< no other fault
  Nanoseconds step{};              ///< between two steps of a peer
  Line line;
  std::vector<Touch> touches;
  std::vector<Fault> faults;
};

[[nodiscard]] Plan plan_of(std::uint64_t seed);
[[nodiscard]] Plan calmed(Plan plan);
[[nodiscard]] std::string text_of(const Plan& plan);
[[nodiscard]] std::string text_of(const Fault& fault);

}  // namespace reckon::fuzz::owners
