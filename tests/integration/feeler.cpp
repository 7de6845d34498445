// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A peer with the simulated hands of a scene. Prints JSON lines:
//   feeler SCENE INTERFACE OPERATOR NAME SECONDS
// Fifty lines a second: time since the start [s], number of remote entities, greatest force of a
// remote entity on an own hand [N], force on the first own hand [N] with its servo time [s], number
// of owned bodies, and position of the first remote entity [m], if any. A line for each notice. At
// the end, the losses of the link and the last line of `reckon peer --json`.
#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <thread>

#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/joined_peer.hpp"
#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/tools/exercise/run_summary.hpp"
#include "reckon/tools/exercise/simulated_hand.hpp"

namespace {

using namespace reckon;
using namespace std::chrono_literals;

void tell(const peer::PeerView& view, double seconds) {
  double force = 0;
  for (std::size_t i = 0; i < view.count; ++i) force = std::max(force, view.rows[i].force_n);
  fmt::print("{{\"seconds\":{:.4f},\"entities\":{},\"force\":{:.4f}", seconds, view.entities,
             force);
  const Eigen::Vector3d& felt = view.servo().force;
  fmt::print(",\"felt\":[{:.4f},{:.4f},{:.4f}],\"felt_s\":{:.4f},\"bodies\":{}", felt.x(), felt.y(),
             felt.z(), pdu::to_seconds(view.servo().time - view.started), view.bodies);
  if (view.count > 0) {
    const Eigen::Vector3d& place = view.rows[0].position;
    fmt::print(",\"place\":[{:.5f},{:.5f},{:.5f}]", place.x(), place.y(), place.z());
  }
  fmt::print("}}\n");
}

int run(char** words) {
  const auto number = static_cast<std::uint32_t>(std::atoi(words[3]));
  const auto end = pdu::from_seconds(std::atof(words[5]));
  peer::FederateOptions options;
  options.scene = peer::load_scene_file(words[1]);
  options.interface = words[2];
  options.name = words[4];
  options.application = static_cast<std::uint16_t>(number);
  options.loops = peer::FederateLoops::threads;
  const tools::SimulatedHands hands = tools::make_simulated_hands(*options.scene, number);
  options.devices = hands.wired;
  peer::JoinedPeer joined(options);
  joined.run();
  while (joined.elapsed() < end) {
    std::this_thread::sleep_for(20ms);
    if (joined.peer().views().update())
      tell(joined.peer().views().read(), pdu::to_seconds(joined.elapsed()));
    for (auto& told = joined.peer().notices(); told.front() != nullptr; told.pop())
      fmt::print("{{\"notice\":\"{}\",\"seconds\":{:.3f}}}\n", told.front()->text.data(),
                 pdu::to_seconds(joined.elapsed()));
    std::fflush(stdout);
  }
  const tools::FinishedRun finished{joined.peer(), *joined.threads(),
                                    pdu::to_seconds(joined.elapsed())};
  joined.stop_loops();
  const peer::LinkStatistics link = joined.peer().link().statistics();
  fmt::print("{{\"kernel_drops\":{},\"received\":{}}}\n", link.kernel_drops, link.received);
  tools::print_run_json(stdout, finished);
  return 0;
}

}  // namespace

int main(int count, char** words) try {
  if (count == 6) return run(words);
  std::fputs("usage: feeler SCENE INTERFACE OPERATOR NAME SECONDS\n", stderr);
  return 2;
} catch (const std::exception& error) {
  fmt::print(stderr, "{}\n", error.what());
  return 1;
}
