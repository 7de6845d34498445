// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Options of `reckon bench accuracy`, read from its flags.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "reckon/bench/studies/accuracy/study.hpp"
#include "reckon/bench/studies/contact/contact_study.hpp"
#include "reckon/bench/studies/frame/study.hpp"
#include "reckon/bench/studies/touch/touch_study.hpp"
#include "reckon/bench/studies/tracks/motions.hpp"

namespace reckon::bench {

/// The studies; each is a bit in the table of flags.
enum class AccuracyMode : std::uint8_t {
  poses = 1,
  forces = 2,
  poses_and_forces = 4,
  against = 8,
  circle = 16,
  trace = 32,
  touch = 64,
};

/// The words as typed. Lists: several values in one word, separated by commas, or the flag
/// repeated.
struct BenchOptions : SharedWords {
  std::vector<std::string> motions, thresholds, models, curves;
  bool pose = false;  ///< subject of the study; poses if neither is set
  bool force = false;
  std::vector<std::string> contacts, sendings;  ///< of the study of forces
  bool touch = false;                           ///< error of a force against time in the servo
  std::vector<std::string> axes;                ///< of the study of touch
  bool circle = false;                          ///< the fixed case of circle_study.hpp
  std::string against;                          ///< "rvw:1m"
  std::string angle;  ///< empty: 3deg; none for files without orientations
  std::optional<std::chrono::nanoseconds> heartbeat, first_heartbeat, converge, converge_longest,
      period;
  std::optional<std::uint64_t> seeds;
  std::string trace;  ///< file to write
  bool front = false, all = false;

  [[nodiscard]] std::vector<Flag> flags();
  /// The requested study. @param given as CommandLine::given(). @throws UsageError with the first
  /// flag that it does not use, and the remedy.
  [[nodiscard]] AccuracyMode checked_mode(std::span<const std::string> given);
};

/// A model and its threshold, as in "rvw:1m".
struct Baseline {
  PoseModel model;
  double threshold = 0;  ///< [m]
};

// Each throws UsageError with the word, the known names and the nearest one.

/// All models if `words` is empty.
[[nodiscard]] std::vector<PoseModel> read_models(std::span<const std::string> words);
[[nodiscard]] std::vector<double> read_thresholds(std::span<const std::string> words);
/// "all" selects every motion.
[[nodiscard]] std::vector<Motion> read_motions(std::span<const std::string> words);
/// "all" selects every scene of hands in contact.
[[nodiscard]] std::vector<ContactScene> read_contacts(std::span<const std::string> words);
/// Forces above 0, for example 15mN, and rates of 20 to 500 Hz: hands in contact send at least
/// every 60 ms, and at most every 2 ms. kContactSendings if `words` is empty.
[[nodiscard]] std::vector<ContactSending> read_sendings(std::span<const std::string> words);
[[nodiscard]] Baseline read_baseline(const std::string& text);

/// Seeds, delay and loss of the study of touch, checked.
[[nodiscard]] TouchConditions read_touch_conditions(const BenchOptions& options);

/// All settings except thresholds, checked. The default heartbeat is 5 s, and none for files.
[[nodiscard]] AccuracyGrid read_conditions(const BenchOptions& options);

}  // namespace reckon::bench
