// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Runs whole peers that touch in simulated time and records every servo step; and their twins, the
// same devices and operators without a network between them.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <vector>

#include "reckon/haptics/devices/simulated_device.hpp"
#include "reckon/peer/scene/scene_file.hpp"

namespace reckon::bench {

/// Positions and forces of hands in every servo step of one millisecond.
struct ContactRecord {
  std::size_t hands = 0;
  std::vector<Eigen::Vector3d> positions;  ///< [m], of devices, S: step x hands + hand
  std::vector<Eigen::Vector3d> forces;     ///< [N] on a hand from another, as felt, S: (step x
                                           ///< hands + hand) x hands + other

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
  double packets_per_s = 0, octets_per_s = 0;  ///< of all peers, including headers of UDP and IPv4
  double for_force_per_s = 0;                  ///< updates sent because of the force error
  std::vector<double> packets;  ///< of all peers, from the start to each whole tenth of a second
  double servo_step_ns = 0;     ///< median of one peer, including its simulated device
};

/// Runs `peers` of the scene for `seconds`. @param scripts move the hands instead of the scene's
/// operators; empty: the operators move them. Deterministic except for servo_step_ns. About 50 ms
/// for a second of two peers. @param recorded number of hands in the record, from the first; 0:
/// all.
/// @param go_on called ten times a simulated second; false ends the run, and the result is not
///     valid.
/// @throws as Exercise does.
[[nodiscard]] ContactRun run_contact(const peer::SceneFile& scene, std::size_t peers,
                                     const std::vector<haptics::HandScript>& scripts,
                                     double seconds, std::size_t recorded = 0,
                                     const std::function<bool(double share)>& go_on = {});

/// The devices of these peers under the same hands. Each feels the springs [N/m] of all others at
/// their positions of that instant: no network, no prediction, no port.
[[nodiscard]] ContactRecord run_twins(const peer::SceneFile& scene, double stiffness,
                                      const std::vector<haptics::HandScript>& scripts,
                                      double seconds);

/// Greatest stiffness of a remote hand that the device of a peer of this scene can show [N/m].
[[nodiscard]] double stiffest_hand(const peer::SceneFile& scene);

}  // namespace reckon::bench
