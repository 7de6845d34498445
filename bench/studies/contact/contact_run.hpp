// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Whole peers touch in simulated time and every servo step is kept; and their twins, the same
// devices and operators without a network between them.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <vector>

#include "reckon/haptics/devices/simulated_device.hpp"
#include "reckon/peer/scene/scene_file.hpp"

namespace reckon::bench {

/// What hands did and felt in every servo step, a millisecond each.
struct ContactRecord {
  std::size_t hands = 0;
  std::vector<Eigen::Vector3d> positions;  ///< [m], of devices, S: step x hands + hand
  std::vector<Eigen::Vector3d> forces;     ///< [N] on a hand from another, as felt, S:
                                           ///< (step x hands + hand) x hands + other

  [[nodiscard]] std::size_t steps() const noexcept {
    return hands > 0 ? positions.size() / hands : 0;
  }
  [[nodiscard]] const Eigen::Vector3d& position(std::size_t step, std::size_t hand) const noexcept {
    return positions[step * hands + hand];
  }
  [[nodiscard]] const Eigen::Vector3d& force(std::size_t step, std::size_t hand,
                                             std::size_t other) const noexcept {
    return forces[(step * hands + hand) * hands + other];
  }
};

/// A run of peers with one hand each.
struct ContactRun {
  ContactRecord record;
  double seconds = 0;
  double packets_per_s = 0, octets_per_s = 0;  ///< of all peers; headers of UDP and IPv4 too
  double for_force_per_s = 0;                  ///< updates that the error of the force asked for
  std::vector<double> packets;  ///< of all peers, from the begin until each whole tenth of a second
  double servo_step_ns = 0;     ///< median of one peer, its simulated device too
};

/// Runs `peers` of the scene for so long [s]. @param scripts move the hands in the place of the
/// scene's operators; none: those do. The same every time but for servo_step_ns. 50 ms or so for
/// a second of two peers. @param recorded so many of the first hands are in the record; 0: all.
/// @param go_on asked ten times a simulated second; false ends the run, of which nothing is good.
/// @throws what Exercise throws.
[[nodiscard]] ContactRun run_contact(const peer::SceneFile& scene, std::size_t peers,
                                     const std::vector<haptics::HandScript>& scripts,
                                     double seconds, std::size_t recorded = 0,
                                     const std::function<bool(double share)>& go_on = {});

/// The devices of these peers under the same hands, where each feels the springs [N/m] of all
/// others where they are at that instant: no network, no prediction, no port.
[[nodiscard]] ContactRecord run_twins(const peer::SceneFile& scene, double stiffness,
                                      const std::vector<haptics::HandScript>& scripts,
                                      double seconds);

/// Stiffest remote hand that the device of a peer of this scene shows [N/m].
[[nodiscard]] double stiffest_hand(const peer::SceneFile& scene);

}  // namespace reckon::bench
