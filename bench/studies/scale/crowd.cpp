// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/scale/crowd.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>

#include "reckon/pdu/random/split_mix.hpp"
#include "reckon/tools/command_line/console.hpp"

namespace reckon::bench {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kStraight = 1e-9;  // [rad] in a step; below: no turn
constexpr double kMiddle = 0x1p30;  // of the block numbers
constexpr double kBlock = 100;      // [m], side of a neighbourhood
constexpr double kRestShare = 0.5, kVehicleShare = 0.3;

std::uint8_t gait_named(std::string_view name) {
  for (std::size_t i = 0; i < kGaits.size(); ++i)
    if (kGaits[i].name == name) return static_cast<std::uint8_t>(i);
  std::string known;
  for (const Gait& gait : kGaits) known += fmt::format("{}, ", gait.name);
  throw tools::UsageError(
      fmt::format("--movement: there is no '{}'; known: {}{}", name, known, kMixedGait));
}

std::uint8_t mixed_gait(double draw) {
  if (draw < kRestShare) return gait_named("rest");
  return gait_named(draw < kRestShare + kVehicleShare ? "vehicles" : "walkers");
}

/// Morton code: interleaves the bits of x and y. Neighbours in the plane get similar numbers.
std::uint64_t interleaved(std::uint32_t x, std::uint32_t y) {
  const auto spread = [](std::uint64_t v) {
    v = (v | v << 16) & 0x0000FFFF0000FFFFULL;
    v = (v | v << 8) & 0x00FF00FF00FF00FFULL;
    v = (v | v << 4) & 0x0F0F0F0F0F0F0F0FULL;
    v = (v | v << 2) & 0x3333333333333333ULL;
    return (v | v << 1) & 0x5555555555555555ULL;
  };
  return spread(x) | spread(y) << 1;
}

/// Indices 0 .. size - 1, sorted by neighbourhood.
std::vector<std::uint32_t> by_neighbourhood(std::span<const aoim::Position> places) {
  const auto block = [](double v) {
    return static_cast<std::uint32_t>(std::clamp(v / kBlock + kMiddle, 0.0, 2.0 * kMiddle));
  };
  std::vector<std::uint64_t> keys;
  for (const aoim::Position& place : places)
    keys.push_back(interleaved(block(place.x), block(place.y)));
  std::vector<std::uint32_t> order(places.size());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) {
    return keys[a] != keys[b] ? keys[a] < keys[b] : a < b;
  });
  return order;
}

/// Bounding box of all samples of all tracks.
Eigen::AlignedBox3d bounds_of(std::span<const Track> tracks) {
  Eigen::AlignedBox3d bounds;
  for (const Track& track : tracks)
    for (const deadreckon::MotionSample& sample : track.samples) bounds.extend(sample.position);
  return bounds;
}

std::shared_ptr<const peer::TrackCurve> curve_of(const Track& track) {
  peer::TrackSamples samples;
  for (const deadreckon::MotionSample& sample : track.samples) {
    samples.times.push_back(sample.time);
    samples.positions.push_back(sample.position);
  }
  return std::make_shared<const peer::TrackCurve>(std::move(samples), false);
}

}  // namespace

Crowd::Crowd(const CrowdPlan& plan) : seed_(plan.seed) {
  if (plan.tracks.empty())
    place_walkers(plan);
  else
    place_tracks(plan);
}

double Crowd::draw(std::size_t entity) noexcept {
  return pdu::unit_of(
      pdu::split_mix(seed_ ^ pdu::split_mix(entity << 32 | walkers_[entity].draws++)));
}

void Crowd::place_walkers(const CrowdPlan& plan) {
  side_ = 1000 * std::sqrt(static_cast<double>(plan.entities) / plan.density);
  std::vector<aoim::Position> places(plan.entities);
  for (std::size_t i = 0; i < places.size(); ++i)
    places[i] = {side_ * (pdu::unit_of(pdu::split_mix(seed_ + 2 * i)) - 0.5),
                 side_ * (pdu::unit_of(pdu::split_mix(seed_ + 2 * i + 1)) - 0.5), 0};
  for (const std::uint32_t i : by_neighbourhood(places)) places_.push_back(places[i]);

  walkers_.resize(places_.size());
  for (std::size_t i = 0; i < walkers_.size(); ++i) {
    Walker& walker = walkers_[i];
    walker.gait = plan.movement == kMixedGait ? mixed_gait(draw(i)) : gait_named(plan.movement);
    const Gait& gait = kGaits[walker.gait];
    walker.heading = 2 * kPi * draw(i);
    walker.speed = gait.top_speed * (0.5 + 0.5 * draw(i));
    begin_leg(i, 0);
  }
}

void Crowd::place_tracks(const CrowdPlan& plan) {
  const Eigen::AlignedBox3d bounds = bounds_of(plan.tracks);
  const Eigen::Vector3d extent = bounds.sizes();
  const std::size_t copies = (plan.entities + plan.tracks.size() - 1) / plan.tracks.size();
  const auto columns = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(copies))));
  side_ = static_cast<double>(columns) * std::max(extent.x(), extent.y());

  std::vector<std::shared_ptr<const peer::TrackCurve>> curves;
  for (const Track& track : plan.tracks) curves.push_back(curve_of(track));
  std::vector<peer::EntityTrack> tracks;
  std::vector<aoim::Position> places;
  for (std::size_t i = 0; i < plan.entities; ++i) {
    const std::size_t copy = i / plan.tracks.size();
    const Eigen::Vector3d offset(
        static_cast<double>(copy % columns) * extent.x() - bounds.min().x() - 0.5 * side_,
        static_cast<double>(copy / columns) * extent.y() - bounds.min().y() - 0.5 * side_, 0);
    tracks.emplace_back(curves[i % curves.size()], offset);
    const Eigen::Vector3d at = tracks.back().at(0).position;
    places.push_back({at.x(), at.y(), at.z()});
  }
  for (const std::uint32_t i : by_neighbourhood(places)) {
    places_.push_back(places[i]);
    tracks_.push_back(std::move(tracks[i]));
  }
  recorded_.resize(tracks_.size());
  advance(0);
}

void Crowd::advance(double time) {
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    recorded_[i] = tracks_[i].at(time);
    const Eigen::Vector3d& at = recorded_[i].position;
    places_[i] = {at.x(), at.y(), at.z()};
  }
  for (std::size_t i = 0; i < walkers_.size(); ++i)
    if (moves(i)) advance_walker(i, time);
  time_ = time;
}

void Crowd::advance_walker(std::size_t entity, double time) {
  Walker& walker = walkers_[entity];
  for (double now = time_; now < time;) {
    const double until = std::min(time, walker.leg_end);
    const double span = until - now, angle = walker.turn * span;
    aoim::Position& place = places_[entity];
    const double way = walker.speed * span + 0.5 * walker.acceleration * span * span;
    if (std::abs(angle) < kStraight) {
      place.x += way * std::cos(walker.heading);
      place.y += way * std::sin(walker.heading);
    } else {
      const double radius = walker.speed / walker.turn;
      place.x += radius * (std::sin(walker.heading + angle) - std::sin(walker.heading));
      place.y -= radius * (std::cos(walker.heading + angle) - std::cos(walker.heading));
      walker.heading += angle;
    }
    walker.speed = std::max(0.0, walker.speed + walker.acceleration * span);
    reflect(entity);
    now = until;
    if (now >= walker.leg_end) begin_leg(entity, now);
  }
}

void Crowd::reflect(std::size_t entity) {
  Walker& walker = walkers_[entity];
  const auto fold = [&](double& v, double mirrored) {
    const double edge = 0.5 * side_;
    if (std::abs(v) <= edge) return;
    v = std::clamp((v < 0 ? -side_ : side_) - v, -edge, edge);
    walker.heading = mirrored;
    walker.turn = -walker.turn;
  };
  fold(places_[entity].x, kPi - walker.heading);
  fold(places_[entity].y, -walker.heading);
}

void Crowd::begin_leg(std::size_t entity, double time) {
  Walker& walker = walkers_[entity];
  const Gait& gait = kGaits[walker.gait];
  const double length = std::max(0.2, -gait.leg * std::log1p(-draw(entity)));
  walker.leg_end = time + length;
  walker.turn = walker.acceleration = 0;
  if (draw(entity) < gait.bend_share) {
    walker.turn = draw(entity) < 0.5 ? gait.turn_rate : -gait.turn_rate;
    return;
  }
  walker.heading += gait.heading_change * (2 * draw(entity) - 1);
  const double wanted = gait.top_speed * draw(entity);
  if (gait.acceleration == 0) return;
  // The leg ends when the speed is reached.
  walker.acceleration = wanted > walker.speed ? gait.acceleration : -gait.acceleration;
  walker.leg_end =
      time + std::min(length, std::abs(wanted - walker.speed) / gait.acceleration + 1e-3);
}

deadreckon::MotionSample Crowd::motion(std::size_t entity) noexcept {
  deadreckon::MotionSample sample;
  if (!tracks_.empty()) {
    sample = deadreckon::motion_sample(recorded_[entity], time_);
    const deadreckon::KinematicState& state = recorded_[entity];
    sample.velocity = state.velocity;
    sample.acceleration = state.acceleration;
    return sample;
  }
  const Walker& walker = walkers_[entity];
  const aoim::Position& place = places_[entity];
  const Eigen::Vector3d ahead(std::cos(walker.heading), std::sin(walker.heading), 0);
  sample.time = time_;
  sample.position = {place.x, place.y, place.z};
  // Body axes: x forward, z down.
  sample.orientation = Eigen::AngleAxisd(walker.heading, Eigen::Vector3d::UnitZ()) *
                       Eigen::AngleAxisd(kPi, Eigen::Vector3d::UnitX());
  sample.velocity = walker.speed * ahead;
  sample.acceleration = walker.acceleration * ahead +
                        walker.speed * walker.turn * Eigen::Vector3d(-ahead.y(), ahead.x(), 0);
  sample.angular_velocity = {0, 0, -walker.turn};
  return sample;
}

double Crowd::speed(std::size_t entity) const noexcept {
  return tracks_.empty() ? walkers_[entity].speed : recorded_[entity].velocity.norm();
}

bool Crowd::moves(std::size_t entity) const noexcept {
  return tracks_.empty() ? kGaits[walkers_[entity].gait].top_speed > 0 : tracks_[entity].moves();
}

}  // namespace reckon::bench
