// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A coupling study in one process, or one side of it against the other over UDP; prints the hands'
// motion, sample by sample, in hexadecimal floating point.
//   coupled whole MODE server|hand
//   coupled first|second MODE server|hand OWN_ADDRESS:PORT OTHER_ADDRESS:PORT
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <exception>
#include <optional>
#include <string_view>

#include "reckon/bench/baselines/coupling_simulation.hpp"
#include "reckon/bench/coupling/udp_sample_link.hpp"

namespace {

using namespace reckon;
using bench::CouplingSide;

constexpr std::uint32_t kSamples = 3000;

bench::CouplingRun run_of(bench::CouplingMode mode, std::string_view counterpart) {
  bench::CouplingRun run;
  run.mode = mode;
  run.counterpart = counterpart == "hand" ? bench::Counterpart::hand : bench::Counterpart::server;
  run.environment = bench::Environment(bench::EnvironmentKind::linear, 400);
  run.network = peer::delayed_by(0.02, 0.5, 0.2);
  run.network.reorder = 0.1;
  run.network.reorder_delay = std::chrono::milliseconds(50);
  run.duration = kSamples * run.device.period;
  run.keep_trace = true;
  return run;
}

void print(int side, std::uint32_t number, double position, double force) {
  std::printf("%d %u %a %a\n", side, number, position, force);
}

void run_whole(const bench::CouplingRun& run) {
  const bench::CouplingOutcome outcome = simulate(run);
  for (int side = 0; side < 2; ++side) {
    std::uint32_t number = 0;
    for (const auto& sample : outcome.trace[static_cast<std::size_t>(side)])
      print(side, number++, sample.position, sample.force);
  }
}

void run_side(const bench::CouplingRun& run, CouplingSide side, const peer::IpEndpoint& own,
              const peer::IpEndpoint& other) {
  bench::UdpSampleLink link(own, {run.network, run.device.period, run.seed, side});
  link.connect(other);
  bench::CouplingPeer peer(run, side, link);
  for (std::uint32_t k = 0; k < kSamples; ++k) {
    peer.step();
    if (peer.has_hand()) print(static_cast<int>(side), k, peer.position(), peer.force());
  }
}

int usage() {
  std::fputs("coupled whole|first|second MODE server|hand [OWN:PORT OTHER:PORT]\n", stderr);
  return 2;
}

}  // namespace

int main(int count, char** words) {
  if (count != 4 && count != 6) return usage();
  const auto mode = bench::coupling_mode(words[2]);
  if (!mode) return usage();
  const bench::CouplingRun run = run_of(*mode, words[3]);
  try {
    if (count == 4) {
      run_whole(run);
      return 0;
    }
    const auto own = peer::IpEndpoint::parse(words[4]), other = peer::IpEndpoint::parse(words[5]);
    if (!own || !other) return usage();
    const bool first = std::strcmp(words[1], "first") == 0;
    run_side(run, first ? CouplingSide::first : CouplingSide::second, *own, *other);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "coupled: %s\n", error.what());
    return 1;
  }
  return 0;
}
