// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/contact/tool.hpp"

#include <algorithm>

namespace reckon::haptics {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Wrench of_axes(const AxisDamping& damping) {
  Wrench each;
  each << Vector3d::Constant(damping.translation), Vector3d::Constant(damping.rotation);
  return each;
}

WrenchCurvature of_a_unit_spring(const Vector3d& lever) noexcept {
  return curvature_of(lever, Matrix3d::Identity(), Vector3d::Zero());
}

}  // namespace

ToolOf<6>::ToolOf(const AxisDamping& damping, std::span<const Vector3d> probes)
    : axes_(of_axes(damping)), translation_(damping.translation), rotation_(damping.rotation) {
  size_ = std::clamp<std::size_t>(probes.size(), 1, kMostProbes);
  probes_.fill(Vector3d::Zero());
  std::copy_n(probes.begin(), std::min(probes.size(), kMostProbes), probes_.begin());
  WrenchCurvature all = WrenchCurvature::Zero();
  for (std::size_t i = 0; i < size_; ++i) {
    all += of_a_unit_spring(probes_[i]);
    longest_ = std::max(longest_, probes_[i].norm());
  }
  // All rotational axes have the same damping, so a rotation of the tool changes neither.
  tool_damping_ = 1.0 / axes_.slope(all);
  probe_damping_ = 1.0 / axes_.slope(of_a_unit_spring(probes_[0]));
  place_probes();
}

void ToolOf<6>::place_probes() noexcept {
  const Matrix3d axes = pose_.orientation.toRotationMatrix();
  for (std::size_t i = 0; i < size_; ++i) levers_[i] = axes * probes_[i];
}

void ToolOf<6>::reset(const HandlePose& pose) noexcept {
  pose_ = pose;
  step_.setZero();
  place_probes();
}

void ToolOf<6>::move(const HandlePose& pose) noexcept {
  const Eigen::AngleAxisd turn(pose.orientation * pose_.orientation.conjugate());
  step_ << pose.position - pose_.position, turn.angle() * turn.axis();
  pose_ = pose;
  place_probes();
}

ToolState ToolOf<6>::state(const Force& written) const noexcept {
  ToolState out;
  out.turns = true;
  out.handle = pose_.position;
  out.orientation = pose_.orientation;
  out.turn_rate = turn_;
  out.torque = wrench(written).tail<3>();
  out.count = size_;
  for (std::size_t i = 0; i < size_; ++i) out.probes[i] = place(i);
  return out;
}

}  // namespace reckon::haptics
