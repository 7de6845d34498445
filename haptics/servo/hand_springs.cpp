// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/servo/hand_springs.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cstddef>

#include "reckon/haptics/contact/load_sum.hpp"

namespace reckon::haptics {
namespace {

double greatest_eigenvalue(const Eigen::Matrix3d& symmetric) {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(symmetric, Eigen::EigenvaluesOnly);
  return (1.0 + 1e-9) * solver.eigenvalues()(2);
}

}  // namespace

template <int axes>
void HandSprings<axes>::load(std::span<RemoteContact* const> hands, const PortMeans& means,
                             const ToolOf<axes>& tool, const StepContext& step, ServoTally& tally,
                             Load& sum) noexcept {
  guests_.make_room(hands, means.spare, means.level, step.dt);
  LoadSum<axes> all(sum);
  PortLoad& one = all.of_probe();
  Eigen::Matrix3d slopes = Eigen::Matrix3d::Zero();
  Eigen::Vector3d of_guests = Eigen::Vector3d::Zero();
  std::size_t touched = 0;
  for (const RemoteContact* remote : hands) {
    if (!remote->touching()) continue;
    const ContactSpring& spring = remote->spring();
    if (remote->is_guest()) of_guests += spring.force();
    const double share = guests_.share_of(*remote);
    one.springs += share * spring.force();
    one.stored += share * spring.stored();
    one.extra += share * remote->damper(step);
    one.springs_slope = std::max(one.springs_slope, share * spring.greatest_slope());
    slopes += share * spring.slope();
    ++touched;
  }
  tally.guests.note_force(guests_.share(), of_guests, step.dt);
  if (touched > 0) tally.hands += step.dt;
  if (touched > 1) one.springs_slope = greatest_eigenvalue(slopes);
  all.add(tool, 0);
  all.finish(tool);
}

template <int axes>
void HandSprings<axes>::soften(double most, const ToolOf<axes>& tool, const StepContext& step,
                               ServoTally& tally, Load& sum) noexcept {
  const bool beyond = sum.springs_slope > std::max(0.0, most);  // without springs there is no slope
  const double goal = beyond ? std::max(0.0, most) / sum.springs_slope : 1.0;
  const double most_change = step.dt / RemoteContact::kRamp;
  crowd_share_ += std::clamp(goal - crowd_share_, -most_change, most_change);
  tally.crowd.note_force(crowd_share_, tool.force(sum.springs), step.dt);
  sum.springs *= crowd_share_;
  sum.stored *= crowd_share_;
  sum.springs_slope *= crowd_share_;
}

template class HandSprings<3>;
template class HandSprings<6>;

}  // namespace reckon::haptics
