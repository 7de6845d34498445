// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The random plan of a seed of the peer simulation: the start times and numbers of peers, the
// behaviour of the line, and the faults. Each fault can be omitted without changing the others.
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

/// Faults of peers between the first start and the calm.
enum class FaultKind : std::uint8_t {
  kill,     ///< ends without a leave announcement, for good
  restart,  ///< ends without a leave announcement; a new process requests the same id at `until`
  depart,   ///< ends with a leave announcement; a new process requests the same id at `until`
  pause,    ///< the process is frozen; then it reads its socket
  split,    ///< the peers of `side` and the others do not receive each other
  one_way,  ///< the peers of `side` do not receive `peer`, which receives them
  clock_step,
  flood,            ///< a stranger announces hundreds of forged peers
  forged_farewell,  ///< a stranger sends a leave announcement in the name of `peer`
  forged_restart,   ///< .. announces a new epoch of it
  forged_elder,     ///< .. announces an epoch that started in 1970
  forged_leap,      ///< .. sends a bare trailer of its epoch, 2^30 ahead
  forged_rename,    ///< .. announces its epoch under another number
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
  nanoseconds interval{};  ///< between forged datagrams
};

/// One host with one process at a time.
struct Host {
  aoim::PeerId wanted;
  nanoseconds start{};
  std::size_t entities = 1;
  bool moves = false;
  bool keeps_port = false;  ///< a new process has the port of the one before
};

/// The probe at the end of the calm, when all is settled.
enum class Probe : std::uint8_t {
  newcomers,  ///< `probed` more hosts, at the same instant
  restart,    ///< host `probed` is killed before and restarts
};

struct Plan {
  std::uint64_t seed = 0;
  std::vector<Host> hosts;
  std::size_t at_first = 0;  ///< number of first hosts; the others are newcomers of the probe
  bool wide = false;         ///< many cells and a radius of interest; else one group for all
  LossyLine line;
  std::vector<Fault> faults;
  nanoseconds faults_end{};
  std::size_t chatterer = kNobody;  ///< host that sends every 2 ms for a second
  nanoseconds chatter_at{};
  std::size_t jumper = kNobody;  ///< host whose entities jump over 110 m in the calm
  nanoseconds jump_at{};
  Probe probe = Probe::newcomers;
  std::size_t probed = 0;
};

/// Whether host `to` does not receive host `from` while the fault lasts.
[[nodiscard]] bool cuts(const Fault& fault, std::size_t from, std::size_t to) noexcept;

/// Whether a stranger sends in the name of a peer.
[[nodiscard]] bool has_forgery(const Plan& plan) noexcept;

[[nodiscard]] Plan plan_of(std::uint64_t seed);
/// The same plan with a harmless line.
[[nodiscard]] Plan calmed(Plan plan);
/// "restart of peer 3, 2.104 s to 2.950 s"
[[nodiscard]] std::string text_of(const Fault& fault);
/// "5 peers, 3 numbers, loss 12 %, .."
[[nodiscard]] std::string text_of(const Plan& plan);

}  // namespace reckon::fuzz
