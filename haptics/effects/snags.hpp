// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Points that catch the tip until it is torn off, like rough wood or Velcro. A scene file sets them
// with `snags = {..}` of an object.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string_view>

#include "reckon/haptics/effects/effect_hooks.hpp"
#include "reckon/haptics/effects/effect_parameter.hpp"
#include "reckon/haptics/geometry/friction_cone.hpp"

namespace reckon::haptics {

/// Parameters of a surface.
struct Snagging {
  double density = 2e4;   ///< [1/m2]
  double force = 1.0;     ///< [N], which tears the tip off
  double reach = 5e-4;    ///< [m], radius within which a snag catches
  double friction = 0.1;  ///< coefficient between the snags
  double seed = 1.0;      ///< whole number; selects other positions
};

/// A bristle: the contact point sticks to a snag until the tangential force reaches `force`, then
/// slides on to the next one. It only holds the contact point back, so it never needs energy. The
/// positions follow from the seed and the object's axes: they are the same on all peers.
class Snags : public CountedEffect<Snags> {
 public:
  using Parameters = Snagging;
  static constexpr std::string_view kName = "snags";
  static constexpr std::string_view kKey = "snags";
  static constexpr std::string_view kCost = "one square root and eight hashes while it slides";
  static constexpr std::array<EffectParameter<Snagging>, 5> kParameters{{
      {"density", "1/m2", &Snagging::density, 1.0, 1e6, 2e4,
       "Snags per square metre; higher is rougher."},
      {"force", "N", &Snagging::force, 0.01, 20.0, 1.0,
       "Tangential force that releases the tip; higher catches more."},
      {"reach", "m", &Snagging::reach, 1e-5, 0.01, 5e-4,
       "Distance within which a snag catches; at 1 kHz a tip faster than 1000 times this may pass "
       "over it."},
      {"friction", "", &Snagging::friction, 0.0, 10.0, 0.1,
       "Tangential over normal force between the snags."},
      {"seed", "", &Snagging::seed, 0.0, 1e6, 1.0,
       "Whole number; selects the places of the snags."},
  }};

  /// @throws std::invalid_argument when a value is out of range, the seed is no whole number, or
  /// snags reach each other.
  explicit Snags(const Snagging& snagging)
      : snagging_(snagging),
        cell_(std::cbrt(2.0 * snagging.reach / snagging.density)),
        cone_(snagging.friction, snagging.friction) {
    check_parameters(kParameters, snagging);
    if (snagging.seed != std::floor(snagging.seed))
      throw std::invalid_argument("snags: seed must be a whole number");
    if (!(2.0 * snagging.reach < cell_))
      throw std::invalid_argument("snags: their reaches overlap; lower the reach or the density");
  }

  /// The snag that reaches this position, as a number that is unique nearby; 0: none.
  [[nodiscard]] std::uint64_t at(const Eigen::Vector3d& place) const noexcept {
    const Eigen::Vector3d first = (place / cell_).array() - 0.5;
    for (int corner = 0; corner < 8; ++corner) {
      const Eigen::Vector3d cell(std::floor(first.x()) + (corner & 1),
                                 std::floor(first.y()) + (corner >> 1 & 1),
                                 std::floor(first.z()) + (corner >> 2));
      std::uint64_t hash = mixed(static_cast<std::uint64_t>(snagging_.seed));
      for (const double one : cell)
        hash = mixed(hash ^ static_cast<std::uint64_t>(static_cast<std::int64_t>(one)));
      const std::uint64_t name = hash | 1U;
      Eigen::Vector3d snag;
      for (int axis = 0; axis < 3; ++axis) {
        hash = mixed(hash);
        snag[axis] = cell_ * (cell[axis] + static_cast<double>(hash >> 11) * 0x1p-53);
      }
      if ((snag - place).squaredNorm() < snagging_.reach * snagging_.reach) return name;
    }
    return 0;
  }

  /// Hook: the cone that holds the contact point.
  [[nodiscard]] FrictionCone& cone() noexcept { return cone_; }
  /// Hook: catches or releases the contact point.
  void follow(const SlidingPlace& here) noexcept {
    if (here.began || cone_.sliding()) caught_ = false;  // torn off, if it was caught
    if (!caught_) {
      const std::uint64_t snag = at(here.place);
      caught_ = snag != 0 && snag != last_;
      last_ = snag;
      if (caught_) cone_.set_sliding(false);
    }
    const double hold = caught_ && here.normal_force > 0.0 ? snagging_.force / here.normal_force
                                                           : snagging_.friction;
    cone_.adjust(std::max(hold, snagging_.friction), snagging_.friction);
  }

  [[nodiscard]] const Snagging& parameters() const noexcept { return snagging_; }

 private:
  // SplitMix64.
  static std::uint64_t mixed(std::uint64_t value) noexcept {
    value += 0x9E3779B97F4A7C15U;
    value = (value ^ (value >> 30)) * 0xBF58476D1CE4E5B9U;
    value = (value ^ (value >> 27)) * 0x94D049BB133111EBU;
    return value ^ (value >> 31);
  }

  Snagging snagging_;
  double cell_;  // [m], size of a grid cell, each with one snag
  FrictionCone cone_;
  std::uint64_t last_ = 0;  // snag below the tip in the last step
  bool caught_ = false;
};

}  // namespace reckon::haptics
