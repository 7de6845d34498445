// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What `reckon bench accuracy` was asked for, read from its words.
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
#include "reckon/bench/studies/tracks/motions.hpp"

namespace reckon::bench {

/// The studies, each a bit of the table of flags.
enum class AccuracyMode : std::uint8_t {
  poses = 1,
  forces = 2,
  poses_and_forces = 4,
  against = 8,
  circle = 16,
  trace = 32,
  touch = 64,
};

/// The words as typed. Lists: several in one word with commas between, or the flag repeated.
struct BenchOptions : SharedWords {
  std::vector<std::string> motions, thresholds, models, curves;
  bool pose = false;  ///< what is studied; poses where neither is said
  bool force = false;
  std::vector<std::string> contacts, sendings;  ///< of the study of forces
  bool touch = false;                           ///< error of a force against time in the servo
  std::vector<std::string> axes;                ///< of that
  bool circle = false;                          ///< the fixed case of circle_study.hpp
  std::string against;                          ///< "rvw:1m"
  std::string angle;  ///< empty: 3deg, none for files without orientations
  std::optional<std::chrono::nanoseconds> heartbeat, first_heartbeat, converge, converge_longest,
      period;
  std::optional<std::uint64_t> seeds;
  std::string trace;  ///< file to write
  bool front = false, all = false;

  [[nodiscard]] std::vector<Flag> flags();
  /// The study that was asked for. @param given as CommandLine::given(). @throws UsageError with
  /// the first flag that it does not look at, and the remedy.
  [[nodiscard]] AccuracyMode checked_mode(std::span<const std::string> given);
};

/// A model and its threshold, as in "rvw:1m".
struct Baseline {
  PoseModel model;
  double threshold = 0;  ///< [m]
};

// Each throws UsageError with the word, what is known and what may have been meant.

/// Without words all.
[[nodiscard]] std::vector<PoseModel> read_models(std::span<const std::string> words);
[[nodiscard]] std::vector<double> read_thresholds(std::span<const std::string> words);
/// "all" is every motion.
[[nodiscard]] std::vector<Motion> read_motions(std::span<const std::string> words);
/// "all" is every scene of hands in contact.
[[nodiscard]] std::vector<ContactScene> read_contacts(std::span<const std::string> words);
/// Forces above 0, as in 15mN, and rates of 20 to 500 Hz: hands in contact send every 60 ms anyway,
/// and at most every 2 ms. Without words kContactSendings.
[[nodiscard]] std::vector<ContactSending> read_sendings(std::span<const std::string> words);
[[nodiscard]] Baseline read_baseline(const std::string& text);

/// Everything but thresholds, checked; heartbeat as given, else 5 s, or none
/// for files.
[[nodiscard]] AccuracyGrid read_conditions(const BenchOptions& options);

}  // namespace reckon::bench
