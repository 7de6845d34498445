// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Whole peers whose hands touch one free body of 1 kg, in simulated time: two peers with a hand
// each over a network, or one peer with both hands.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "reckon/bench/studies/touch/touch_study.hpp"
#include "reckon/haptics/devices/simulated_device.hpp"

namespace reckon::bench {

/// Which peer simulates the body.
enum class OwnerRule : std::uint8_t {
  fixed,         ///< the first peer, for the whole run
  first_hand,    ///< the peer whose hand touches it; it requests the body at the touch
  before_touch,  ///< the same, but it requests the body before the touch: the rule of peers
};

struct OwnerRuleRow {
  OwnerRule rule;
  std::string_view name;
};
[[nodiscard]] std::span<const OwnerRuleRow> owner_rules();

/// A way of touching. The first peer owns the body at the start.
struct BodyTouch {
  std::string_view name, meaning;
  double seconds = 0;             ///< length of a run
  std::string_view objects = {};  ///< text of scene sections, in addition to hands and body
  double drag = 0;                ///< of the body [N s/m]
  double from = 0;                ///< x at the start, with `speed` [m]
  double speed = 0;               ///< at the start, along x [m/s]; 0: at rest
  haptics::HandTarget (*hand)(std::size_t hand, double time) = nullptr;  ///< frame S
};
[[nodiscard]] std::span<const BodyTouch> body_touches();

struct BodyTouchNetwork {
  double delay = 0;  ///< [s], one way, +-15 %
  double loss = 0;   ///< share of the datagrams
  std::uint64_t seed = 1;
};

struct BodyTouchRun {
  std::vector<Eigen::Vector3d> forces;  ///< [N], of both hands in each millisecond
  /// CPU time of a servo step of a peer while a hand feels a force, mean of the peers, with
  /// simulated devices.
  TouchCost cost;
};

/// @param peers 2, or 1 for the truth: both hands at one peer
[[nodiscard]] BodyTouchRun run_body_touch(const BodyTouch& touch, std::size_t peers,
                                          OwnerRule rule = OwnerRule::before_touch,
                                          const BodyTouchNetwork& network = {});

}  // namespace reckon::bench
