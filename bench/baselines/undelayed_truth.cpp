// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/baselines/undelayed_truth.hpp"

#include <cmath>

#include "reckon/bench/baselines/coupling_simulation.hpp"

namespace reckon::bench {
namespace {

constexpr double kLongestSubstep = 1e-4;  // [s]

}  // namespace

UndelayedTruth::UndelayedTruth(const CouplingRun& run)
    : run_(run),
      two_(run.counterpart == Counterpart::hand),
      substeps_(static_cast<int>(std::ceil(run.device.period / kLongestSubstep - 1e-9))),
      h_(run.device.period / substeps_) {
  bodies_[0].position = kCouplingStart;
}

double UndelayedTruth::force() const noexcept {
  return run_.environment.at(static_cast<double>(count_) * h_)
      .force(bodies_[0].position - bodies_[1].position);
}

void UndelayedTruth::move(Body& body, const OperatorModel& hand, double start,
                          double contact) const noexcept {
  haptics::HandTarget target;
  target.position.x() = start;
  if (hand.script) target = hand.script(static_cast<double>(count_) * h_);
  const double force = hand.stiffness * (target.position.x() - body.position) +
                       hand.damping * (target.velocity.x() - body.speed) + target.push.x() +
                       contact - run_.device.damping * body.speed;
  body.speed += h_ / run_.device.mass * force;
  body.position += h_ * body.speed;
}

void UndelayedTruth::step() noexcept {
  for (int i = 0; i < substeps_; ++i) {
    const double contact = force();
    move(bodies_[0], run_.hand, kCouplingStart, -contact);
    if (two_) move(bodies_[1], run_.other_hand, 0.0, contact);
    ++count_;
  }
}

}  // namespace reckon::bench
