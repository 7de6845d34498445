// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Dead reckoning of articulated parts: turrets, guns, flaps, gear. An Entity State has a few
// numbers and their rates for each part. Peers extrapolate them, the owner compares, and the shown
// values converge, as for the pose.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "reckon/deadreckon/motion/convergence.hpp"

namespace reckon::deadreckon {

/// Moving quantity of a part: SISO UID 58. The metric of its rate is one more.
enum class PartMetric : std::uint8_t {
  position = 1,    ///< Share of the part's travel, 0 to 1.
  extension = 3,   ///< [m]
  x = 5,           ///< [m]
  y = 7,           ///< [m]
  z = 9,           ///< [m]
  azimuth = 11,    ///< [rad]
  elevation = 13,  ///< [rad]
  rotation = 15    ///< [rad]
};

/// Angles are kept in (-pi, pi] and compared the shorter way round.
[[nodiscard]] constexpr bool is_angle(PartMetric metric) noexcept {
  return metric >= PartMetric::azimuth;
}

/// One number of one part, with its rate, from an update.
struct PartParameter {
  std::uint32_t part = 0;         ///< Class of the part, SISO UID 59, without the metric.
  std::uint16_t attached_to = 0;  ///< 0 = the entity itself, else a part.
  PartMetric metric = PartMetric::azimuth;
  std::uint8_t change = 0;  ///< Change indicator on the wire: number of changes; 1 follows 255.
  double value = 0;         ///< Unit according to the metric.
  double rate = 0;          ///< In this unit a second.
};

/// Whether part and metric are the same; each pair occurs once.
[[nodiscard]] constexpr bool same_place(const PartParameter& a, const PartParameter& b) noexcept {
  return a.part == b.part && a.metric == b.metric;
}

/// The articulated parts in one update. Fixed capacity, no allocation.
class PartState {
 public:
  static constexpr std::size_t kCapacity = 32;

  /// Adds a parameter or replaces the one of its part and metric. Angles are wrapped. `change`
  /// advances if the value, rate or attachment differs. Returns false, without a change, for
  /// numbers that are not finite and without room.
  bool set(const PartParameter& parameter) noexcept;
  /// Removes a parameter, if it is there.
  void remove(std::uint32_t part, PartMetric metric) noexcept;
  void clear() noexcept { size_ = 0; }

  [[nodiscard]] std::span<const PartParameter> parameters() const noexcept {
    return {parameters_.data(), size_};
  }
  /// Null if there is none.
  [[nodiscard]] const PartParameter* find(std::uint32_t part, PartMetric metric) const noexcept;

 private:
  friend struct PartReader;
  [[nodiscard]] PartParameter* slot(const PartParameter& like) noexcept;

  std::array<PartParameter, kCapacity> parameters_;
  std::size_t size_ = 0;
};

/// Counts for the records of one update.
struct PartReading {
  std::size_t taken = 0;       ///< Accepted values and rates.
  std::size_t not_finite = 0;  ///< NaN or infinity.
  std::size_t unknown = 0;     ///< Metric that is not in the list.
  std::size_t no_value = 0;    ///< Rate without a value.
  std::size_t no_room = 0;     ///< Beyond PartState::kCapacity.
};

/// Reads the parts in the variable parameter records of an Entity State into `out`, which is
/// replaced. Records other than articulated parts are skipped, invalid ones left out and counted.
/// Of two records for the same part and metric the last is used, and a value without a rate has the
/// rate zero. `records`: 16 octets each, a remainder is ignored. Any octets; no allocation.
PartReading from_wire(std::span<const std::byte> records, PartState& out) noexcept;

/// Octets that to_wire writes: one record for each value and one for each rate.
[[nodiscard]] std::size_t wire_size(const PartState& state) noexcept;

/// Writes the records, values rounded to float32: read them back for the values that peers have. A
/// zero rate is written too, for receivers that would keep an old one. Returns the octets, 0 if
/// `out` is too small.
[[nodiscard]] std::size_t to_wire(const PartState& state, std::span<std::byte> out) noexcept;

/// A parameter at one time.
struct PartMotion {
  double value = 0;
  double rate = 0;
};

/// Default time [s] for which the rates of an update are used: the time-out of an entity with a
/// heartbeat of 5 s.
inline constexpr double kLongestPartMotion = 12.0;

/// The parameter `tau` seconds after its update: value + rate tau, for `longest` seconds at most,
/// after which it holds. Angles wrapped. NaN tau counts as 0. About 10 ns.
[[nodiscard]] PartMotion predict(const PartParameter& parameter, double tau,
                                 double longest = kLongestPartMotion) noexcept;

/// a - b; for angles the shorter way, in (-pi, pi].
[[nodiscard]] double difference(PartMetric metric, double a, double b) noexcept;

/// Errors of parts above which an update is sent.
struct PartThresholds {
  /// [rad], default 3 degrees, as for the orientation of an entity.
  double angle = 0.05235987755982989;
  /// [m], default 0.1: 3 degrees at the end of a part of 2 m.
  double length = 0.1;
  /// For the metric `position`, a share of the part's travel; default 0.05.
  double share = 0.05;
};

/// Whether the prediction of peers from `sent`, `since` seconds old, differs from `truth`: the
/// error of a part is above its threshold, or a part was added, removed or attached elsewhere.
/// `sent` is the state that peers decoded, `longest` the time for which they use rates.
[[nodiscard]] bool should_send(const PartState& truth, const PartState& sent, double since,
                               const PartThresholds& thresholds = {},
                               double longest = kLongestPartMotion) noexcept;

/// The shown parts of one remote entity: the prediction, plus an error that decays by the curve of
/// the convergence. With the cubic, value and rate are continuous at an update. Large errors get
/// more time, as for a pose: lengths by gentle_speed, angles by gentle_turn. The acceleration of an
/// earlier error is not carried over, so that the quintic suits only updates at longer intervals
/// than its duration. Times are seconds of one steady clock of the caller. Not synchronised, no
/// allocation.
class PartConvergence {
 public:
  explicit PartConvergence(const ConvergenceSettings& settings = {},
                           double longest = kLongestPartMotion) noexcept
      : settings_(settings), longest_(longest) {}

  /// The update of the time `time` replaces the one before at `now`. New or reattached parts, and
  /// lengths with an error above the teleport distance, are at once shown as received. Parts that
  /// are not in the update are removed.
  void update(const PartState& state, double time, double now) noexcept {
    update(state, time, now, longest_);
  }
  /// The same; rates are used for `longest` seconds from this update on.
  void update(const PartState& state, double time, double now, double longest) noexcept;

  /// The newest update.
  [[nodiscard]] const PartState& state() const noexcept { return state_; }
  /// Parameter `i` of state().parameters() as shown at `now`; `i` < its size.
  [[nodiscard]] PartMotion shown(std::size_t i, double now) const noexcept;

 private:
  struct Error {
    PartMotion off;       // shown minus predicted at the update
    double duration = 0;  // [s]
  };
  [[nodiscard]] Error error_for(const PartParameter& next, double time, double now,
                                double longest) const noexcept;
  [[nodiscard]] double gentle_duration(PartMetric metric, double off) const noexcept;

  ConvergenceSettings settings_;
  double longest_;
  PartState state_;
  double time_ = 0;   // of the newest update
  double start_ = 0;  // when it was stored
  std::array<Error, PartState::kCapacity> errors_{};
};

}  // namespace reckon::deadreckon
