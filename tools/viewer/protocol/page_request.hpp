// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Requests from a page to the server, one short binary message each. Accepts any octets.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <variant>

namespace reckon::tools {

/// Picture `number` is drawn: another one may be sent.
struct DrawnRequest {
  std::uint32_t number = 0;
};
/// Shows another instant and pauses there.
struct SeekRequest {
  double time = 0;  ///< [s], finite
};
struct SpeedRequest {
  static constexpr float kLeast = 0.1F, kMost = 16;
  float speed = 1;  ///< 0: pause; else kLeast .. kMost
};
struct LiveRequest {};
struct StepRequest {
  int seconds = 0;  ///< -1 or 1; 0: one update
  int updates = 0;  ///< -1 or 1
};
/// Target position of a hand.
struct PointerRequest {
  static constexpr float kFarthest = 1e4F;  ///< [m] from the origin, each way
  std::uint16_t hand = 0;
  Eigen::Vector3f position = Eigen::Vector3f::Zero();  ///< [m]
  bool held = false;
  bool grabs = false;  ///< grabs the touched body
};
/// Network impairment from now on.
struct NetworkRequest {
  static constexpr float kMostDelay = 300, kMostJitter = 300;  ///< [ms]
  float delay_ms = 0, jitter_ms = 0;
  float loss = 0;  ///< share, 0 .. 1
  bool outage = false;
};
struct TakeHandRequest {};
struct GiveHandRequest {};
/// Lets the bodies go on without the peers that are missing.
struct GoAloneRequest {};
/// The page cannot use its last picture: sends a whole one.
struct WholeRequest {};
/// Selects the entity whose cells are lit.
struct FollowRequest {
  std::uint16_t slot = 0xFFFF;  ///< 0xFFFF: none
};

using PageRequest = std::variant<DrawnRequest, SeekRequest, SpeedRequest, LiveRequest, StepRequest,
                                 PointerRequest, NetworkRequest, TakeHandRequest, GiveHandRequest,
                                 FollowRequest, GoAloneRequest, WholeRequest>;

/// The request in a message; none if it is no request, has another length, or a number in it is not
/// finite or out of its range.
[[nodiscard]] std::optional<PageRequest> read_page_request(
    std::span<const std::byte> message) noexcept;

/// Whether it changes the exercise: such a request needs the access word.
[[nodiscard]] bool changes_exercise(const PageRequest& request) noexcept;

}  // namespace reckon::tools
