// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// When hands of this peer will touch a body.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <limits>
#include <span>

#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/peer/loops/touch_stage.hpp"

namespace reckon::peer {

/// Time until a hand touches the box of a body if both keep their velocities [s], or may touch it
/// if the hand turns aside; 0 inside; infinite if they miss each other. The box grows by the way of
/// the hand in kAside.
/// @param box in the axes of the body [m]
[[nodiscard]] double time_to_contact(const ApproachingHand& hand, const haptics::ObjectMotion& body,
                                     const Eigen::AlignedBox3d& box) noexcept;

/// Thread of the model loop; no allocation. O(bodies x hands).
class HandApproach {
 public:
  static constexpr double kAside = 0.05;  ///< [s]
  static constexpr double kSoon = 2.0;    ///< [s]; later contacts are not foreseen

  /// @param world may be null; then call nothing  @param touch has the hands; outlives this
  HandApproach(const haptics::BodyWorld* world, const TouchStage& touch) noexcept
      : world_(world), touch_(touch) {
    times_.fill(std::numeric_limits<double>::infinity());
  }

  /// Looks at the present hands. @param bodies of the world
  void look(std::span<const haptics::BodyState> bodies) noexcept;
  /// Time until a hand touches a body [s]; infinite: none does within kSoon.
  [[nodiscard]] double time_to(std::size_t body) const noexcept {
    return body < times_.size() ? times_[body] : std::numeric_limits<double>::infinity();
  }

 private:
  const haptics::BodyWorld* world_;
  const TouchStage& touch_;
  std::array<double, kMostSharedBodies> times_{};
};

}  // namespace reckon::peer
