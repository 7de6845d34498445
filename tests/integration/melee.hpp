// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Federates in a field whose scene thins updates by distance, each with an entity that moves along
// a path. The shown entities are compared with the limits of their tiers.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/tests/integration/federates.hpp"

namespace reckon::test {

/// Position at a time [s], in S [m].
using Path = std::function<Eigen::Vector3d(double)>;

/// Slowly through the field with a superimposed swing, as people move in a melee: the velocity
/// predicts the position for a third of a second.
inline Path wander(std::mt19937& random, double side) {
  std::uniform_real_distribution<double> share(0.0, 1.0);
  const auto swing = [&] {
    const double reach = 3.0 + 7.0 * share(random), speed = 3.0 + 4.0 * share(random);
    const double phase = 2 * std::numbers::pi * share(random), middle = side * share(random);
    return [=](double t) {
      return middle + 50.0 * std::sin(0.04 * t + phase) + reach * std::sin(speed / reach * t);
    };
  };
  const auto x = swing(), y = swing();
  return [=](double t) { return Eigen::Vector3d(x(t), y(t), 0.0); };
}
/// `count` such paths in a square.
inline std::vector<Path> crowd(std::size_t count, double side, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<Path> paths;
  for (std::size_t i = 0; i < count; ++i) paths.push_back(wander(random, side));
  return paths;
}
/// A weave about a line: any update at any instant leads away from it.
inline Path weave(double reach, double speed) {
  return [=](double t) { return Eigen::Vector3d(speed * t, reach * std::sin(3.0 * t), 0.0); };
}
/// Straight on, with an occasional bump to one side: too small for the distant tiers' thresholds,
/// while updates to the near tiers during a bump lead away.
inline Path bump(double reach, double speed) {
  return [=](double t) {
    const double phase = std::min(std::fmod(t, 3.0), 1.0),
                 wave = std::sin(std::numbers::pi * phase);
    return Eigen::Vector3d(speed * t, reach * wave * wave, 0.0);
  };
}
/// Straight on, with sidesteps of some seconds, which the distant tiers need not know.
inline Path sidestep(double reach, double speed) {
  return [=](double t) {
    const double at = std::fmod(t, 10.0), share = std::clamp(at < 5.0 ? at : 6.0 - at, 0.0, 1.0);
    return Eigen::Vector3d(speed * t, reach * share * share * (3.0 - 2.0 * share), 0.0);
  };
}
inline Path stand(const Eigen::Vector3d& place) {
  return [=](double) { return place; };
}

/// Errors of the shown entities of others.
struct Looks {
  std::size_t all = 0, missing = 0, beyond = 0, near_beyond = 0;
  double worst = 0.0;       ///< error relative to the limit of its tier
  double near_worst = 0.0;  ///< error [m] in the nearest row
};

class Melee {
 public:
  static constexpr double kThreshold = 0.2;  ///< [m]
  static constexpr double kSenses = 200.0, kEnd = 40.0, kMiddle = 100.0;
  static constexpr std::chrono::milliseconds kStep{20};
  /// An entity received from outside the radius is shown shortly after it enters, even at 100 m/s.
  static constexpr double kEntering = 30.0;  // [m]
  /// Additional error of an update that is 5 ms under way, decided once in 20 ms and sent at most
  /// thirty times a second [m], for the sharpest turns here.
  static constexpr double kSlack = 0.15;

  static peer::SceneFile scene(bool own_groups) {
    constexpr double kForever = std::numeric_limits<double>::infinity();
    peer::SceneFile scene = *peer::dis_exercise(1, 0.82, 0.145);
    scene.network.interop = false;
    scene.aoim.cell = 50.0;
    scene.aoim.radius = kSenses;
    const aoim::Channel rows[] = {{kEnd, aoim::Body::full, 30.0, 30.0, 144.0, false, 1.0},
                                  {kMiddle, aoim::Body::approximate, 10.0, 10.0, 144.0, false, 4.0},
                                  {kForever, aoim::Body::rigid, 10.0, 10.0, 144.0, false, 10.0}};
    scene.aoim.tiers = peer::distance_tiers(rows, own_groups);
    scene.hash = peer::scene_hash(scene);
    return scene;
  }

  explicit Melee(const peer::SceneFile& scene, std::vector<Path> paths, std::uint64_t seed = 1,
                 double loss = 0.0, std::chrono::nanoseconds jitter = {})
      : paths_(std::move(paths)),
        federates_(paths_.size(), Federates::delayed(std::chrono::milliseconds(5), loss, jitter),
                   seed) {
    for (const Path& path : paths_) join(scene, path);
  }

  void run(std::chrono::nanoseconds span) {
    const auto drive = [&] {
      for (std::size_t i = 0; i < paths_.size(); ++i)
        federates_[i].update_attributes(things_[i], truth_of(paths_[i]));
    };
    const auto all_look = [&] {
      if (looks_) look();
    };
    federates_.run(span, kStep, drive, all_look);
  }
  /// From now on the shown entities are checked in each step.
  void begin() {
    looks_ = true;
    seen_ = {};
    before_ = {heard("datagrams_in"), heard("octets_in"), heard("updates_out")};
  }
  [[nodiscard]] const Looks& seen() const { return seen_; }
  [[nodiscard]] std::uint64_t datagrams() { return heard("datagrams_in") - before_[0]; }
  [[nodiscard]] std::uint64_t octets() { return heard("octets_in") - before_[1]; }
  [[nodiscard]] std::uint64_t updates() { return heard("updates_out") - before_[2]; }
  std::uint64_t count(std::size_t i, const char* counter) { return federates_.count(i, counter); }
  std::uint64_t heard(const char* counter) {
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < paths_.size(); ++i) sum += count(i, counter);
    return sum;
  }
  void set_path(std::size_t i, Path path) { paths_[i] = std::move(path); }
  [[nodiscard]] double time() const { return federates_.time(); }
  /// Sets the azimuth of one federate's entity; returns its error as another shows it [rad], large
  /// if unknown.
  void turn(std::size_t i, double azimuth, double rate) {
    parts_[i].set({kTurret, 0, deadreckon::PartMetric::azimuth, 0, azimuth, rate});
    federates_[i].update_parts(things_[i], parts_[i]);
  }
  [[nodiscard]] double shown_azimuth(std::size_t watcher, std::size_t other) {
    const peer::ShownParts shown = federates_[watcher].peer().model().remote().parts(
        federates_.id_of(other), federates_.now());
    return shown.empty() ? 1e9 : shown[0].value;
  }
  /// Error of another's entity at `watcher` [m].
  [[nodiscard]] double error(std::size_t watcher, std::size_t other) {
    const peer::RemoteEntity* row = row_of(watcher, other);
    if (row == nullptr) return 1e9;
    return (row->predicted(federates_.now()).position - paths_[other](time())).norm();
  }

 private:
  [[nodiscard]] peer::EntityTruth truth_of(const Path& path) const {
    constexpr double kAside = 1e-3;
    const double t = time();
    const Eigen::Vector3d before = path(t - kAside), at = path(t), after = path(t + kAside);
    peer::EntityTruth truth;
    truth.time = federates_.now();
    truth.position = at;
    truth.velocity = (after - before) / (2 * kAside);
    truth.acceleration = (after - 2 * at + before) / (kAside * kAside);
    return truth;
  }
  void join(const peer::SceneFile& scene, const Path& path) {
    peer::EntityDescription thing;
    thing.type = {pdu::EntityKind::platform, pdu::EntityDomain::land, 225, 7, 1, 0, 0};
    thing.dead_reckoning.algorithm = pdu::DeadReckoningAlgorithm::fpw;
    thing.dead_reckoning.thresholds.position = kThreshold;
    things_.push_back(federates_.join(scene).register_object(thing, truth_of(path)));
  }
  [[nodiscard]] const peer::RemoteEntity* row_of(std::size_t watcher, std::size_t other) {
    return federates_[watcher].peer().model().remote().find(federates_.id_of(other));
  }
  void look() {
    for (std::size_t a = 0; a < paths_.size(); ++a) {
      for (std::size_t b = 0; b < paths_.size(); ++b) {
        const double away = (paths_[a](time()) - paths_[b](time())).norm();
        if (a != b && away < kSenses - kEntering) look_at(a, b, away);
      }
    }
  }
  void look_at(std::size_t watcher, std::size_t other, double away) {
    ++seen_.all;
    if (row_of(watcher, other) == nullptr) {
      ++seen_.missing;
      return;
    }
    const double coarser = away <= kEnd ? 1.0 : away <= kMiddle ? 4.0 : 10.0;
    const double off = error(watcher, other), share = off / (coarser * kThreshold + kSlack);
    seen_.beyond += share > 1.0;
    seen_.near_beyond += share > 1.0 && away <= kEnd;
    seen_.worst = std::max(seen_.worst, share);
    if (away <= kEnd) seen_.near_worst = std::max(seen_.near_worst, off);
  }

  static constexpr std::uint32_t kTurret = 128;  // SISO UID 59
  std::vector<Path> paths_;
  Federates federates_;
  std::vector<peer::ObjectHandle> things_;
  bool looks_ = false;
  Looks seen_;
  std::map<std::size_t, deadreckon::PartState> parts_;
  std::array<std::uint64_t, 3> before_{};
};

}  // namespace reckon::test
