// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/exercise/twin_line.hpp"

#include "reckon/deadreckon/motion/drm.hpp"
#include "reckon/pdu/seconds.hpp"

namespace reckon::tools {
namespace {

deadreckon::KinematicState first_order(const haptics::HandMotion& motion) {
  deadreckon::KinematicState state;
  state.algorithm = pdu::DeadReckoningAlgorithm::fpw;
  state.position = motion.position;
  state.velocity = motion.velocity;
  return state;
}

}  // namespace

std::optional<TwinUpdate> TwinTeller::tell(const haptics::HandMotion& motion) {
  if (last_) {
    const auto age = motion.time - last_->time;
    const auto pose = deadreckon::extrapolate(last_->state, pdu::to_seconds(age));
    const bool near = (motion.position - pose.position).norm() <= threshold_;
    if (near && age < kLongestSilence) return std::nullopt;
  }
  return last_ = TwinUpdate{motion.time, first_order(motion)};
}

void TwinLine::send(const TwinUpdate& update, std::chrono::nanoseconds arrival) {
  if (under_way_.size() == kMost) under_way_.pop_front();
  under_way_.push_back({arrival, update});
}

bool TwinLine::receive(std::chrono::nanoseconds now) {
  bool is_new = false;
  for (const OnItsWay& one : under_way_) {
    if (one.arrival > now || (last_ && one.update.time <= last_->time)) continue;
    last_ = one.update;
    is_new = true;
  }
  std::erase_if(under_way_, [now](const OnItsWay& one) { return one.arrival <= now; });
  return is_new;
}

}  // namespace reckon::tools
