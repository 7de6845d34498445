// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Entities of ours that the peer moves along recorded tracks, or that rest at their places in the
// scene.
#pragma once

#include <algorithm>
#include <chrono>
#include <vector>

#include "reckon/peer/settings/entity_config.hpp"
#include "reckon/peer/tracks/entity_track.hpp"
#include "reckon/peer/world/entity_description.hpp"

namespace reckon::peer {

/// The description of an entity of the scene by its owner.
[[nodiscard]] inline EntityDescription description_of(const EntityConfig& config) {
  EntityDescription description;
  description.marking = config.marking;
  description.type = config.type;
  description.force_id = config.force_id;
  description.appearance = config.appearance;
  description.capabilities = config.capabilities;
  description.dead_reckoning = config.dead_reckoning;
  description.model = config.model;
  description.power = config.power;
  description.beacon = config.beacon;
  return description;
}

/// The true motion of a track at an instant.
[[nodiscard]] inline EntityTruth truth_of(const deadreckon::KinematicState& motion,
                                          std::chrono::nanoseconds now) noexcept {
  EntityTruth truth;
  truth.time = now;
  truth.position = motion.position;
  truth.orientation = motion.orientation;
  truth.velocity = motion.velocity;
  truth.acceleration = motion.acceleration;
  truth.angular_velocity = motion.angular_velocity;
  return truth;
}

/// Updates their positions: of felt entities every 2 ms, of all others at 60 Hz, not all in the
/// same pass. One thread; allocates only in add().
class TrackedEntities {
 public:
  static constexpr std::chrono::nanoseconds kFelt = std::chrono::milliseconds(2);
  static constexpr std::chrono::nanoseconds kSeen{16'666'667};

  void add(EntityNumber number, const EntityTrack& track, bool felt) {
    tracks_.push_back({number, track, felt ? kFelt : kSeen, {}});
  }

  /// Calls move(number, truth) for each that is due. The tracks begin at the first call.
  void advance(std::chrono::nanoseconds now, auto&& move) {
    if (now < next_) return;
    if (begun_ < std::chrono::nanoseconds(0)) begin(now);
    next_ = std::chrono::nanoseconds::max();
    for (Tracked& tracked : tracks_) {
      if (now >= tracked.due) {
        move(tracked.number,
             truth_of(tracked.track.at(1e-9 * static_cast<double>((now - begun_).count())), now));
        tracked.due = tracked.track.moves() ? next_of(tracked, now) : kNever;
      }
      next_ = std::min(next_, tracked.due);
    }
  }

  /// The first call of advance(), with which the tracks begin; negative before it.
  [[nodiscard]] std::chrono::nanoseconds begun() const noexcept { return begun_; }

  /// When advance() has something to do; max if it has nothing.
  [[nodiscard]] std::chrono::nanoseconds next_due() const noexcept {
    return tracks_.empty() ? kNever : next_;
  }

 private:
  static constexpr std::chrono::nanoseconds kNever = std::chrono::nanoseconds::max();
  struct Tracked {
    EntityNumber number;
    EntityTrack track;
    std::chrono::nanoseconds period, due;
  };
  void begin(std::chrono::nanoseconds now) noexcept {
    begun_ = now;
    for (Tracked& tracked : tracks_) tracked.due = now;
  }
  [[nodiscard]] std::chrono::nanoseconds next_of(const Tracked& tracked,
                                                 std::chrono::nanoseconds now) const noexcept {
    // The first truth of all entities is sent at once. After that, each has a different time within
    // the period.
    constexpr int kPlaces = 16;
    if (now > begun_) return now + tracked.period;
    return now + tracked.period + (tracked.number % kPlaces) * tracked.period / kPlaces;
  }

  std::vector<Tracked> tracks_;
  std::chrono::nanoseconds begun_{-1};
  std::chrono::nanoseconds next_{0};
};

}  // namespace reckon::peer
