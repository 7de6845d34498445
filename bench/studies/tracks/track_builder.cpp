// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/tracks/track_builder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "reckon/deadreckon/motion/rotation.hpp"
#include "reckon/tools/command_line/console.hpp"

namespace reckon::bench {
namespace {

using deadreckon::MotionSample;
using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector3d;

/// Orientation with body x along v and body y level.
Quaterniond along(const Vector3d& v) {
  const double yaw = std::atan2(v.y(), v.x());
  const double climb = std::atan2(v.z(), std::hypot(v.x(), v.y()));
  return AngleAxisd(yaw, Vector3d::UnitZ()) * AngleAxisd(-climb, Vector3d::UnitY());
}

/// Computes values that the file does not contain. `before` is null for the first sample.
void complete(ToldSample& sample, const MotionSample* before) {
  MotionSample& now = sample.motion;
  const double dt = before != nullptr ? now.time - before->time : 1;
  if (!sample.has_velocity && before != nullptr)
    now.velocity = (now.position - before->position) / dt;
  if (!sample.has_orientation) {
    if (now.velocity.norm() >= TrackBuilder::kLeastSpeed)
      now.orientation = along(now.velocity);
    else if (before != nullptr)
      now.orientation = before->orientation;
  }
  if (sample.has_rates || before == nullptr) return;
  now.acceleration = (now.velocity - before->velocity) / dt;
  now.angular_velocity =
      deadreckon::logarithm(before->orientation.conjugate() * now.orientation) / dt;
}

// A difference over almost no time may overflow.
bool make_finite(MotionSample& sample) {
  if (!sample.position.allFinite() || !std::isfinite(sample.time)) return false;
  if (!sample.velocity.allFinite()) sample.velocity.setZero();
  if (!sample.acceleration.allFinite()) sample.acceleration.setZero();
  if (!sample.angular_velocity.allFinite()) sample.angular_velocity.setZero();
  if (!sample.orientation.coeffs().allFinite()) sample.orientation.setIdentity();
  return true;
}

}  // namespace

void TrackBuilder::add(std::string_view name, const ToldSample& sample) {
  if (++samples_ > kMostSamples)
    throw tools::UsageError(
        fmt::format("more than {} samples; cut the file into parts", kMostSamples));
  auto found = places_.find(name);
  if (found == places_.end()) {
    if (told_.size() == kMostTracks)
      throw tools::UsageError(
          fmt::format("more than {} entities; is the column id right?", kMostTracks));
    found = places_.emplace(std::string(name), told_.size()).first;
    names_.emplace_back(name);
    told_.emplace_back();
  }
  told_[found->second].push_back(sample);
}

void TrackBuilder::sort(Told& told) {
  const auto earlier = [](const ToldSample& a, const ToldSample& b) {
    return a.motion.time < b.motion.time;
  };
  for (std::size_t i = 1; i < told.size(); ++i) disordered_ += earlier(told[i], told[i - 1]);
  std::stable_sort(told.begin(), told.end(), earlier);
  // Of samples with equal times the last one is kept.
  std::size_t kept = 0;
  for (std::size_t i = 0; i < told.size(); ++i) {
    const bool is_last = i + 1 == told.size() || earlier(told[i], told[i + 1]);
    if (is_last) told[kept++] = told[i];
  }
  repeated_ += told.size() - kept;
  told.resize(kept);
}

Track TrackBuilder::track_of(std::string name, const Told& told) {
  Track track;
  track.name = std::move(name);
  track.samples.reserve(told.size());
  for (ToldSample sample : told) {
    complete(sample, track.samples.empty() ? nullptr : &track.samples.back());
    if (make_finite(sample.motion)) track.samples.push_back(sample.motion);
  }
  return track;
}

std::vector<Track> TrackBuilder::finish() {
  std::vector<Track> tracks;
  tracks.reserve(told_.size());
  for (std::size_t i = 0; i < told_.size(); ++i) {
    sort(told_[i]);
    tracks.push_back(track_of(std::move(names_[i]), told_[i]));
    Told().swap(told_[i]);
  }
  told_.clear();
  places_.clear();
  return tracks;
}

}  // namespace reckon::bench
