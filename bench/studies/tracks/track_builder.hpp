// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Builds tracks from the samples of a file, in any order, with or without rates. Missing values are
// computed from earlier samples, never from later ones, because an owner does not have these
// either.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "reckon/bench/studies/tracks/track.hpp"

namespace reckon::bench {

/// A sample, and which of its rates are in the file.
struct ToldSample {
  deadreckon::MotionSample motion;
  bool has_velocity = false;
  bool has_orientation = false;
  bool has_rates = false;  ///< acceleration and angular velocity
};

/// Collects samples by entity. Bounded: throws UsageError above kMostSamples or kMostTracks.
class TrackBuilder {
 public:
  static constexpr std::size_t kMostSamples = 4'000'000;  // 0.6 GB, twice that for a capture
  static constexpr std::size_t kMostTracks = 1'000'000;
  /// Below this speed [m/s] an entity has no direction of its own and keeps its last one.
  static constexpr double kLeastSpeed = 1e-3;

  /// @param name of the entity; any text. All numbers of `sample` are finite.
  void add(std::string_view name, const ToldSample& sample);

  /// The tracks, in the order of their first samples: sorted by time, of equal times the last one.
  /// Missing rates are differences to the sample before: velocity from positions, acceleration from
  /// velocities, angular velocity from orientations; orientation (x forward) along the velocity
  /// while it moves. Ends the collection.
  [[nodiscard]] std::vector<Track> finish();

  /// Number of samples that arrived after a later one of their entity, and of samples dropped for
  /// another with the same time; valid after finish().
  [[nodiscard]] std::uint64_t disordered() const noexcept { return disordered_; }
  [[nodiscard]] std::uint64_t repeated() const noexcept { return repeated_; }

 private:
  struct Hash : std::hash<std::string_view> {
    using is_transparent = void;
  };
  using Told = std::vector<ToldSample>;

  void sort(Told& told);
  static Track track_of(std::string name, const Told& told);

  std::unordered_map<std::string, std::size_t, Hash, std::equal_to<>> places_;
  std::vector<std::string> names_;
  std::vector<Told> told_;
  std::size_t samples_ = 0;
  std::uint64_t disordered_ = 0, repeated_ = 0;
};

}  // namespace reckon::bench
