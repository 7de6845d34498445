// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What a seed of the simulation of peers draws: who starts when under which number, what the line
// does to datagrams, and the faults, each of which can be left out without changing the others.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "reckon/aoim/groups/peer_id.hpp"
#include "reckon/tests/fuzz/search/datagram.hpp"
#include "reckon/tests/fuzz/search/dice.hpp"

namespace reckon::fuzz {

using std::chrono::nanoseconds;

inline constexpr std::size_t kMostPeers = 64;
inline constexpr std::size_t kNobody = ~std::size_t{0};

/// What befalls peers between the first start and the calm.
enum class FaultKind : std::uint8_t {
  kill,     ///< ends without a word, for good
  restart,  ///< ends without a word; a new process wants the same id at `until`
  depart,   ///< says good-bye; a new process wants the same id at `until`
  pause,    ///< the process is frozen; what the socket holds is read when it wakes
  split,    ///< the peers of `side` and the others do not hear each other
  one_way,  ///< the peers of `side` do not hear `peer`, which hears them
  clock_step,
  flood,            ///< a stranger announces hundreds of invented peers
  forged_farewell,  ///< a stranger says good-bye in the name of `peer`
  forged_restart,   ///< .. announces a new life of it
  forged_elder,     ///< .. that claims to have started in 1970
  forged_leap,      ///< .. sends a bare trailer of its life, 2^30 ahead
  forged_rename,    ///< .. announces its life under another number
};
inline constexpr std::size_t kFaultKinds = 13;

[[nodiscard]] constexpr bool is_forgery(FaultKind kind) noexcept {
  return kind >= FaultKind::flood;
}

struct Fault {
  FaultKind kind = FaultKind::kill;
  nanoseconds at{}, until{};
  std::size_t peer = 0;
  std::uint64_t side = 0;  ///< bit i: peer i
  nanoseconds step{};      ///< clock_step only
  nanoseconds interval{};  ///< of forged datagrams
};

/// One host with one process at a time.
struct Host {
  aoim::PeerId wanted;
  nanoseconds start{};
  std::size_t entities = 1;
  bool moves = false;
  bool keeps_port = false;  ///< a new process has the port of the one before
};

/// What happens at the end of the calm, when all is settled.
enum class Probe : std::uint8_t {
  newcomers,  ///< `probed` hosts more, at the same instant
  restart,    ///< host `probed` is killed before and begins a new life
};

struct Plan {
  std::uint64_t seed = 0;
  std::vector<Host> hosts;
  std::size_t at_first = 0;  ///< of the hosts; the others are newcomers of the probe
  bool wide = false;         ///< many cells and a radius of interest; else one group for all
  LossyLine line;
  std::vector<Fault> faults;
  nanoseconds faults_end{};
  std::size_t chatterer = kNobody;  ///< host that says something every 2 ms for a second
  nanoseconds chatter_at{};
  std::size_t jumper = kNobody;  ///< host whose entities jump over 110 m in the calm
  nanoseconds jump_at{};
  Probe probe = Probe::newcomers;
  std::size_t probed = 0;
};

/// Whether host `to` does not receive host `from` while the fault lasts.
[[nodiscard]] bool cuts(const Fault& fault, std::size_t from, std::size_t to) noexcept;

/// Whether a stranger speaks in the name of a peer.
[[nodiscard]] bool has_forgery(const Plan& plan) noexcept;

[[nodiscard]] Plan plan_of(std::uint64_t seed);
/// The same with a line that does no harm.
[[nodiscard]] Plan calmed(Plan plan);
/// "restart of peer 3, 2.104 s to 2.950 s"
[[nodiscard]] std::string text_of(const Fault& fault);
/// "5 peers, 3 numbers, loss 12 %, .."
[[nodiscard]] std::string text_of(const Plan& plan);

}  // namespace reckon::fuzz
