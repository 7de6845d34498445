// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What a seed of the simulation of leaders draws: hosts and where their entities are, what the line
// does, and the faults, each of which can be left out without changing the others.
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
  kill,     ///< ends without a word
  restart,  ///< ends without a word; a new process of the host starts at `until`
  depart,   ///< says good-bye
  pause,    ///< the process is frozen until `until`; what the socket holds is read when it wakes
  split,    ///< the hosts of `side` and the others do not hear each other until `until`
  clock_step,
  move,            ///< the host's entities jump to `place`
  leader_restart,  ///< restart of who leads the scene
  leader_depart,   ///< .. which says good-bye first
  leader_pause,    ///< pause of who leads the scene
  forged_claim,    ///< a stranger says in the host's name that it leads everything, since 1970
  forged_leave,    ///< .. that it leaves
  forged_map,      ///< .. a map of groups
  forged_states,   ///< .. a snapshot of a state that was never there
};
inline constexpr std::size_t kFaultKinds = 14;

[[nodiscard]] constexpr bool is_forgery(FaultKind kind) noexcept {
  return kind >= FaultKind::forged_claim;
}

/// Whether it befalls who leads the scene, whoever that is.
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
  std::size_t pool = 0;    ///< of the plan, for who forges its map
};

struct Host {
  nanoseconds start{}, clock{};  ///< clock: UTC less the true one
  aoim::Position place;
  std::size_t entities = 1;
};

struct Plan {
  std::uint64_t seed = 0;
  std::vector<Host> hosts;   ///< the last one is the newcomer of the calm
  std::size_t pool = 8;      ///< groups handed out
  bool hand_out = false;     ///< states go by them, not by the fixed tile
  bool beacons = false;      ///< each host carries one and follows that of the next
  bool loses_parts = false;  ///< who comes in the calm does not get half of the parts at first
  bool loses_maps = false;   ///< last ones of leaders, when the calm begins
  LossyLine line;
  std::vector<Fault> faults;  ///< by time
  nanoseconds calm{};         ///< from here on no loss, and no fault but forgeries
  nanoseconds kill{};         ///< a leader is killed in the calm
  nanoseconds newcomer{};     ///< the last host starts
  nanoseconds end{};
};

[[nodiscard]] Plan plan_of(std::uint64_t seed);
/// The same with a line that does no harm.
[[nodiscard]] Plan calmed(Plan plan);
[[nodiscard]] std::string text_of(const Fault& fault);
[[nodiscard]] std::string text_of(const Plan& plan);

}  // namespace reckon::fuzz::leaders
