// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/accuracy/modes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "reckon/tools/command_line/console.hpp"

namespace reckon::bench {
namespace {

constexpr unsigned bit(AccuracyMode mode) { return static_cast<unsigned>(mode); }

constexpr unsigned kPoses = bit(AccuracyMode::poses), kForces = bit(AccuracyMode::forces),
                   kBoth = bit(AccuracyMode::poses_and_forces),
                   kAgainst = bit(AccuracyMode::against), kCircle = bit(AccuracyMode::circle),
                   kTrace = bit(AccuracyMode::trace), kTouch = bit(AccuracyMode::touch);
constexpr unsigned kTables = kPoses | kForces | kBoth;
constexpr unsigned kOfPoses = kPoses | kBoth | kAgainst | kTrace;

struct FlagUse {
  std::string_view flag;
  unsigned modes;  ///< that look at it
};

/// THE list: a flag that is not here is looked at by all.
constexpr std::array kUses{
    FlagUse{"FILE", kOfPoses},
    FlagUse{"--json", kTables | kAgainst | kCircle | kTouch},
    FlagUse{"--for", kTables | kAgainst | kTrace},
    FlagUse{"--pose", kOfPoses | kCircle},
    FlagUse{"--force", kForces | kBoth},
    FlagUse{"--contact", kForces | kBoth},
    FlagUse{"--send-at", kForces | kBoth},
    FlagUse{"--motion", kOfPoses},
    FlagUse{"--models", kOfPoses | kCircle},
    FlagUse{"--thresholds", kPoses | kBoth | kTrace},
    FlagUse{"--curves", kOfPoses | kCircle},
    FlagUse{"--angle", kOfPoses},
    FlagUse{"--heartbeat", kOfPoses},
    FlagUse{"--first-heartbeat", kOfPoses},
    FlagUse{"--converge", kOfPoses},
    FlagUse{"--converge-longest", kOfPoses},
    FlagUse{"--delay", kOfPoses | kForces},
    FlagUse{"--jitter", kOfPoses | kForces},
    FlagUse{"--loss", kOfPoses | kForces},
    FlagUse{"--seeds", kPoses | kBoth | kAgainst | kCircle},
    FlagUse{"--against", kAgainst},
    FlagUse{"--circle", kCircle},
    FlagUse{"--touch", kTouch},
    FlagUse{"--axis", kTouch},
    FlagUse{"--plot", kTouch},
    FlagUse{"--all", kPoses | kBoth},
    FlagUse{"--front", kPoses | kBoth},
    FlagUse{"--csv", kPoses | kForces | kTouch},
    FlagUse{"--trace", kTrace},
    FlagUse{"--period", kTrace},
    FlagUse{"--report", kTables | kTouch},
};

std::string refusal(AccuracyMode mode, std::string_view flag) {
  switch (mode) {
    case AccuracyMode::circle:
      return fmt::format(
          "--circle is a fixed case: beside it only --models, --curves, --seed, --seeds and "
          "--json; "
          "leave {} out",
          flag);
    case AccuracyMode::against:
      return fmt::format("--against looks for equal errors of poses: leave {} out", flag);
    case AccuracyMode::trace:
      return fmt::format("--trace is one run of one pose: leave {} out", flag);
    case AccuracyMode::touch:
      return fmt::format(
          "--touch has cases of its own: beside it only --axis, --seed, --json, --csv, --plot and "
          "--report; leave {} out",
          flag);
    case AccuracyMode::forces:
      return fmt::format("--force: {} is for poses; give --pose too, or leave it out", flag);
    case AccuracyMode::poses_and_forces:
      if (flag == "--csv")
        return "--csv: poses and forces are two tables; give --pose or --force alone";
      return fmt::format("{} does not go with --pose --force; leave it out", flag);
    case AccuracyMode::poses:
      break;
  }
  if (flag == "--axis" || flag == "--plot")
    return fmt::format("{} is for error against time; give --touch too", flag);
  if (flag == "--period") return "--period: with --trace FILE.csv only";
  return fmt::format("{} is for forces; give --force too", flag);
}

/// Whether what is shown jumps from prediction to prediction: asked for, or as files are looked at.
bool snaps(const BenchOptions& options) {
  if (options.curves.empty()) return !options.files.empty();
  return std::ranges::all_of(options.curves, [](const auto& word) { return word == "snap"; });
}

/// Whether chance takes part: in a motion, in the network, in the phases of a touch.
bool draws(AccuracyMode mode, const BenchOptions& options) {
  if (!options.jitter.empty() || !options.loss.empty()) return true;
  if (mode == AccuracyMode::circle || mode == AccuracyMode::touch) return true;
  return mode != AccuracyMode::forces && (options.files.empty() || !options.motions.empty());
}

/// Flags that the study takes, but not beside some other.
void check_values(AccuracyMode mode, const BenchOptions& options,
                  std::span<const std::string> given) {
  const auto is_given = [&](std::string_view flag) { return std::ranges::count(given, flag) > 0; };
  if ((options.converge || options.converge_longest) && snaps(options))
    throw tools::UsageError(
        "--converge, --converge-longest: the curve snap does not converge; name another by "
        "--curves, as in cubic");
  if (options.front && !options.json && options.csv.empty())
    throw tools::UsageError(
        "--front is for CSV and JSON; the table shows the front unless --all is given");
  if (options.all && options.json)
    throw tools::UsageError(
        "--all is for the table; --json has all settings unless --front is given");
  const bool files_alone = !options.files.empty() && options.motions.empty();
  if (is_given("--for") && files_alone && mode != AccuracyMode::poses_and_forces)
    throw tools::UsageError("--for is the length of a motion, FILE has its own: leave --for out");
  if (is_given("--seed") && !draws(mode, options))
    throw tools::UsageError(
        "--seed: nothing is drawn here; give --jitter or --loss, or leave --seed out");
}

}  // namespace

AccuracyMode mode_of(const BenchOptions& options) {
  if (!options.trace.empty()) return AccuracyMode::trace;
  if (options.circle) return AccuracyMode::circle;
  if (!options.against.empty()) return AccuracyMode::against;
  if (options.touch) return AccuracyMode::touch;
  if (options.force) return options.pose ? AccuracyMode::poses_and_forces : AccuracyMode::forces;
  return AccuracyMode::poses;
}

void check_flags(AccuracyMode mode, std::span<const std::string> given,
                 const BenchOptions& options) {
  for (const std::string& flag : given) {
    const auto* use = std::ranges::find(kUses, std::string_view(flag), &FlagUse::flag);
    if (use != kUses.end() && (use->modes & bit(mode)) == 0)
      throw tools::UsageError(refusal(mode, flag));
  }
  check_values(mode, options, given);
}

}  // namespace reckon::bench
