// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The random plan of a seed of the leader simulation: hosts and the positions of their entities,
// the behaviour of the line, and the faults. Each fault can be omitted without changing the others.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "reckon/aoim/cells/position.hpp"
#include "reckon/tests/fuzz/search/datagram.hpp"

namespace reckon::fuzz::leaders {

using std::chrono::nanoseconds;

inline constexpr std::size_t kMostHosts = 12;

enum class FaultKind : std::uint8_t {
  kill,     ///< ends without a leave announcement
  restart,  ///< ends without a leave announcement; a new process of the host starts at `until`
  depart,   ///< ends with a leave announcement
  pause,    ///< the process is frozen until `until`; then it reads its socket
  split,    ///< the hosts of `side` and the others do not receive each other until `until`
  clock_step,
  move,            ///< the host's entities jump to `place`
  leader_restart,  ///< restart of the scene leader
  leader_depart,   ///< departure of the scene leader
  leader_pause,    ///< pause of the scene leader
  forged_claim,    ///< a stranger claims in the host's name to lead everything since 1970
  forged_leave,    ///< .. sends a leave announcement
  forged_map,      ///< .. sends a map of groups
  forged_states,   ///< .. sends a snapshot of a state that never existed
};
inline constexpr std::size_t kFaultKinds = 14;

[[nodiscard]] constexpr bool is_forgery(FaultKind kind) noexcept {
  return kind >= FaultKind::forged_claim;
}

/// Whether the fault concerns the current scene leader.
[[nodiscard]] constexpr bool is_of_leader(FaultKind kind) noexcept {
  return kind >= FaultKind::leader_restart && kind <= FaultKind::leader_pause;
}

struct Fault {
  FaultKind kind = FaultKind::kill;
  nanoseconds at{}, until{};
  std::size_t host = 0;
  std::uint64_t side = 0;  ///< bit i: host i
  nanoseconds step{};      ///< clock_step only
  aoim::Position place;    ///< move only
  std::size_t pool = 0;    ///< of the plan, for a forged map
};

struct Host {
  nanoseconds start{}, clock{};  ///< clock: offset from true UTC
  aoim::Position place;
  std::size_t entities = 1;
};

struct Plan {
  std::uint64_t seed = 0;
  std::vector<Host> hosts;   ///< the last one is the newcomer of the calm
  std::size_t pool = 8;      ///< groups handed out
  bool hand_out = false;     ///< states use these groups instead of the fixed tile
  bool beacons = false;      ///< each host carries a beacon and follows that of the next host
  bool loses_parts = false;  ///< the newcomer of the calm loses half of the snapshot parts at first
  bool loses_maps = false;   ///< the last maps of leaders are lost when the calm begins
  LossyLine line;
  std::vector<Fault> faults;  ///< by time
  nanoseconds calm{};         ///< from here on no loss, and no fault but forgeries
  nanoseconds kill{};         ///< when a leader is killed in the calm
  nanoseconds newcomer{};     ///< when the last host starts
  nanoseconds end{};
};

[[nodiscard]] Plan plan_of(std::uint64_t seed);
/// The same plan with a harmless line.
[[nodiscard]] Plan calmed(Plan plan);
[[nodiscard]] std::string text_of(const Fault& fault);
[[nodiscard]] std::string text_of(const Plan& plan);

}  // namespace reckon::fuzz::leaders
