// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Sums the load of the contacts at the probes of a tool on the port.
#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "reckon/haptics/contact/tool.hpp"
#include "reckon/haptics/passivity/energy_port.hpp"

namespace reckon::haptics {

/// For each probe: of_probe(), to which its contacts add, then add(). Finally finish().
template <int axes>
class LoadSum;

/// A point: its contacts add directly to the load.
template <>
class LoadSum<3> {
 public:
  explicit LoadSum(PortLoad& load) noexcept : load_(load) {}
  [[nodiscard]] PortLoad& of_probe() noexcept { return load_; }
  void add(const ToolOf<3>& /*tool*/, std::size_t /*probe*/) noexcept {}
  void finish(const ToolOf<3>& /*tool*/) noexcept {}

 private:
  PortLoad& load_;
};

/// Forces become wrenches, and slopes the curvatures of a rigid body.
template <>
class LoadSum<6> {
 public:
  explicit LoadSum(PortLoadOf<6>& load) noexcept : load_(load) {}
  [[nodiscard]] PortLoad& of_probe() noexcept { return one_ = PortLoad{}; }
  void add(const ToolOf<6>& tool, std::size_t probe) noexcept {
    load_.walls += tool.at_port(probe, one_.walls);
    load_.springs += tool.at_port(probe, one_.springs);
    load_.extra += tool.at_port(probe, one_.extra);
    if (!one_.shake.isZero(0.0)) load_.shake += tool.at_port(probe, one_.shake);
    load_.walls_stored += one_.walls_stored;
    load_.stored += one_.stored;
    walls_.add(tool.lever(probe), one_.walls_slope, one_.walls);
    springs_.add(tool.lever(probe), one_.springs_slope, one_.springs);
  }
  void finish(const ToolOf<6>& tool) noexcept {
    load_.walls_slope += walls_.slope(tool);
    load_.springs_slope += springs_.slope(tool);
  }

 private:
  struct Curvature {
    WrenchCurvature sum = WrenchCurvature::Zero();
    bool is_any = false;

    void add(const Eigen::Vector3d& lever, double slope, const Eigen::Vector3d& force) noexcept {
      if (!(slope > 0)) return;
      sum += curvature_of(lever, slope * Eigen::Matrix3d::Identity(), force);
      is_any = true;
    }
    [[nodiscard]] double slope(const ToolOf<6>& tool) const noexcept {
      return is_any ? tool.slope(sum) : 0.0;
    }
  };

  PortLoadOf<6>& load_;
  PortLoad one_;
  Curvature walls_, springs_;
};

}  // namespace reckon::haptics
