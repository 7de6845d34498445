// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Entities that move like recorded ones, and the Entity States that dead reckoning sends for them.
#pragma once

#include <Eigen/Geometry>
#include <chrono>
#include <cmath>
#include <fstream>
#include <map>
#include <numbers>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "reckon/deadreckon/motion/drm.hpp"
#include "reckon/deadreckon/motion/geocentric.hpp"
#include "reckon/deadreckon/wire_conversion.hpp"
#include "reckon/pdu/compression/state_numbers.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/pdu/timestamp.hpp"

namespace reckon::bench {

/// Positions and velocities of one entity; between two samples it follows the cubic through both.
struct Mover {
  std::vector<double> t;
  std::vector<Eigen::Vector2d> p, v;

  /// Position east and north [m], S, level, nose ahead.
  [[nodiscard]] deadreckon::KinematicState at(double time) const {
    std::size_t i = 0;
    while (i + 2 < t.size() && t[i + 1] <= time) ++i;
    const double h = t[i + 1] - t[i], s = std::clamp((time - t[i]) / h, 0.0, 1.0);
    const Eigen::Vector2d d = p[i + 1] - p[i], a = h * v[i], b = h * v[i + 1];
    const Eigen::Vector2d c3 = a + b - 2 * d, c2 = 3 * d - 2 * a - b;
    const Eigen::Vector2d place = p[i] + s * (a + s * (c2 + s * c3));
    const Eigen::Vector2d speed = (a + s * (2 * c2 + 3 * s * c3)) / h;
    const Eigen::Vector2d gain = (2 * c2 + 6 * s * c3) / (h * h);
    deadreckon::KinematicState state;
    state.algorithm = pdu::DeadReckoningAlgorithm::rvw;
    state.position = {place.x(), place.y(), 0.0};
    state.velocity = {speed.x(), speed.y(), 0.0};
    state.acceleration = {gain.x(), gain.y(), 0.0};
    if (speed.norm() < 0.1) return state;
    const Eigen::Vector2d nose = speed.normalized();
    Eigen::Matrix3d axes;
    axes << nose.x(), nose.y(), 0, nose.y(), -nose.x(), 0, 0, 0, -1;
    state.orientation = Eigen::Quaterniond(axes);
    const double turn = (speed.x() * gain.y() - speed.y() * gain.x()) / speed.squaredNorm();
    state.angular_velocity = {0.0, 0.0, -turn};
    return state;
  }
};

/// Rows "t,id,..." of a recording; `read` converts the other columns to position and velocity.
template <class Read>
std::vector<Mover> recorded(const std::string& file, std::size_t most, Read read) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  std::map<int, Mover> all;
  while (std::getline(in, line)) {
    std::ranges::replace(line, ',', ' ');
    std::istringstream row(line);
    double t = 0.0;
    int id = 0;
    Eigen::Vector2d p, v;
    if (!(row >> t >> id) || id >= static_cast<int>(4 * most) || !read(row, p, v)) continue;
    Mover& mover = all[id];
    if (!mover.t.empty() && t <= mover.t.back()) continue;
    mover.t.push_back(t);
    mover.p.push_back(p);
    mover.v.push_back(v);
  }
  std::vector<Mover> movers;
  for (auto& [id, mover] : all) {
    if (mover.t.size() >= 4 && movers.size() < most) movers.push_back(std::move(mover));
  }
  return movers;
}

inline Eigen::Vector2d along(double speed, double angle) {
  return {speed * std::cos(angle), speed * std::sin(angle)};
}

inline std::vector<Mover> cars(const std::string& folder, std::size_t most) {
  return recorded(folder + "/vehicles_town_sumo.csv", most, [](auto& row, auto& p, auto& v) {
    double heading = 0.0, speed = 0.0;
    const bool good = static_cast<bool>(row >> p.x() >> p.y() >> heading >> speed);
    v = along(speed, heading);
    return good;
  });
}

inline std::vector<Mover> pedestrians(const std::string& folder, std::size_t most) {
  return recorded(folder + "/pedestrians_ucy_students03.csv", most,
                  [](auto& row, auto& p, auto& v) {
                    return static_cast<bool>(row >> p.x() >> p.y() >> v.x() >> v.y());
                  });
}

/// Ships under way; each in a tangent plane of its own, because they are far from each other.
inline std::vector<Mover> ships(const std::string& folder, std::size_t most) {
  constexpr double kDegree = std::numbers::pi / 180, kEarth = 6371e3, kKnot = 1852.0 / 3600;
  return recorded(
      folder + "/vessels_ais_us_2022-01-03.csv", most, [=](auto& row, auto& p, auto& v) {
        double latitude = 0.0, longitude = 0.0, speed = 0.0, course = 0.0;
        if (!(row >> latitude >> longitude >> speed >> course) || speed < 1.0) return false;
        const double parallel = std::round(latitude);
        p.y() = kEarth * kDegree * (latitude - parallel);
        p.x() =
            kEarth * kDegree * std::cos(kDegree * parallel) * (longitude - std::round(longitude));
        v = along(kKnot * speed, (90 - course) * kDegree);
        return true;
      });
}

/// Vehicles that never move straight for `seconds`: three sinusoids each.
inline std::vector<Mover> made(std::size_t count, double seconds = 60.0) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<Mover> movers(count);
  for (Mover& mover : movers) {
    const Eigen::Vector2d drift = along(20 * unit(random), 7 * unit(random));
    std::array<std::array<double, 4>, 3> swings;
    for (auto& swing : swings) {
      swing = {2 + 20 * unit(random), 0.1 + 0.5 * unit(random), 7 * unit(random), 7 * unit(random)};
    }
    for (double t = 0.0; t < seconds; t += 0.5) {
      Eigen::Vector2d p = t * drift, v = drift;
      for (const auto& [size, rate, x, y] : swings) {
        p += size * Eigen::Vector2d(std::sin(rate * t + x), std::sin(rate * t + y));
        v += size * rate * Eigen::Vector2d(std::cos(rate * t + x), std::cos(rate * t + y));
      }
      mover.t.push_back(t);
      mover.p.push_back(p);
      mover.v.push_back(v);
    }
  }
  return movers;
}

/// One update as its owner sends it.
struct SentState {
  std::size_t entity = 0;
  double time = 0.0;  ///< [s]
  pdu::EntityState state;
};

inline const deadreckon::LocalFrame& town() {
  static const deadreckon::LocalFrame frame(0.85, 0.2, 100.0);
  return frame;
}

/// Checks ten times a second; sends if receivers are off by `threshold` [m] or 3 degrees, or after
/// 5 s; for at most `seconds` for each entity. In order of time. Motion is rounded to quanta, as in
/// a peer that compresses.
inline std::vector<SentState> sent_states(const std::vector<Mover>& movers, double threshold,
                                          double seconds = 120.0) {
  std::vector<SentState> sent;
  for (std::size_t i = 0; i < movers.size(); ++i) {
    const Mover& mover = movers[i];
    deadreckon::KinematicState model;
    double last = -1e9;
    const double end = std::min(mover.t.back(), mover.t.front() + seconds);
    for (double t = mover.t.front(); t < end; t += 0.1) {
      const deadreckon::KinematicState truth = mover.at(t);
      const deadreckon::Pose shown = deadreckon::extrapolate(model, t - last);
      const bool off = (shown.position - truth.position).norm() > threshold ||
                       shown.orientation.angularDistance(truth.orientation) > 0.0524;
      if (!off && t - last < 5.0) continue;
      SentState update{i, t, {}};
      update.state.entity_id = {7, 1, static_cast<std::uint16_t>(i + 1)};
      update.state.force_id = pdu::ForceId::friendly;
      update.state.entity_type = {
          pdu::EntityKind::platform, pdu::EntityDomain::land, 225, 1, 1, 3, 0};
      update.state.marking.set("RECKON " + std::to_string(i));
      if (deadreckon::to_wire(truth, town(), update.state) != deadreckon::ConversionError::none)
        continue;
      update.state.header.timestamp =
          pdu::to_dis_timestamp(std::chrono::duration_cast<std::chrono::nanoseconds>(
                                    std::chrono::duration<double>(1000.0 + t)),
                                true);
      pdu::quantise(update.state, {});
      (void)deadreckon::from_wire(update.state, town(), model);
      last = t;
      sent.push_back(update);
    }
  }
  std::ranges::stable_sort(sent, {}, &SentState::time);
  return sent;
}

}  // namespace reckon::bench
