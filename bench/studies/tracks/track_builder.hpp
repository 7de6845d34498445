// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Tracks from samples as a file tells them: in any order, with or without rates. What is not told
// follows from the samples before, never from later ones: an owner has no future either.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "reckon/bench/studies/tracks/track.hpp"

namespace reckon::bench {

/// A sample, and which of its rates the file told.
struct ToldSample {
  deadreckon::MotionSample motion;
  bool has_velocity = false;
  bool has_orientation = false;
  bool has_rates = false;  ///< acceleration and angular velocity
};

/// Collects samples by entity. Bounded: throws UsageError past kMostSamples or kMostTracks.
class TrackBuilder {
 public:
  static constexpr std::size_t kMostSamples = 4'000'000;  // 0.6 GB, a capture twice that
  static constexpr std::size_t kMostTracks = 1'000'000;
  /// Slower than this [m/s] an entity has no direction of its own: it keeps the one it had.
  static constexpr double kLeastSpeed = 1e-3;

  /// @param name of the entity; any text. All numbers of `sample` are finite.
  void add(std::string_view name, const ToldSample& sample);

  /// The tracks, in the order of their first samples: sorted by time, of equal times the last one,
  /// rates filled in by differences to the sample before:
  /// velocity from positions, acceleration from velocities, angular velocity from orientations,
  /// orientation (x forward) along the velocity where it moves. Ends the collection.
  [[nodiscard]] std::vector<Track> finish();

  /// Samples that came later than a younger one of their entity, and those dropped for another of
  /// the same time; after finish().
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
