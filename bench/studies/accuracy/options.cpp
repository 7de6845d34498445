// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/accuracy/options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "reckon/bench/studies/sweep/values.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/notation/units.hpp"

namespace reckon::bench {
namespace {

constexpr std::uint64_t kMostSeeds = 1000;
constexpr double kMostTouchDelay = 1;               // [s]
constexpr double kLeastRate = 20, kMostRate = 500;  // [Hz]

constexpr unsigned bit(AccuracyMode mode) { return static_cast<unsigned>(mode); }

constexpr unsigned kPoses = bit(AccuracyMode::poses), kForces = bit(AccuracyMode::forces),
                   kBoth = bit(AccuracyMode::poses_and_forces),
                   kAgainst = bit(AccuracyMode::against), kCircle = bit(AccuracyMode::circle),
                   kTrace = bit(AccuracyMode::trace), kTouch = bit(AccuracyMode::touch);
constexpr unsigned kTables = kPoses | kForces | kBoth;
constexpr unsigned kOfPoses = kPoses | kBoth | kAgainst | kTrace;

/// If two of them exclude each other, the first of trace, circle, against and touch; check_modes()
/// then rejects the other.
AccuracyMode mode_of(const BenchOptions& options) {
  if (!options.trace.empty()) return AccuracyMode::trace;
  if (options.circle) return AccuracyMode::circle;
  if (!options.against.empty()) return AccuracyMode::against;
  if (options.touch) return AccuracyMode::touch;
  if (options.force) return options.pose ? AccuracyMode::poses_and_forces : AccuracyMode::forces;
  return AccuracyMode::poses;
}

std::string refusal(AccuracyMode mode, std::string_view flag) {
  switch (mode) {
    case AccuracyMode::circle:
      return fmt::format(
          "--circle is a fixed case and allows only --models, --curves, --seed, --seeds and "
          "--json: remove {}",
          flag);
    case AccuracyMode::against:
      return fmt::format("--against searches for equal errors of poses: remove {}", flag);
    case AccuracyMode::trace:
      return fmt::format("--trace is one run of one pose: remove {}", flag);
    case AccuracyMode::touch:
      return fmt::format(
          "--touch has fixed cases and allows only --axis, --seed, --seeds, --delay, --loss, "
          "--json, --csv, --plot and --report: remove {}",
          flag);
    case AccuracyMode::forces:
      return fmt::format("--force: {} is for poses; add --pose, or remove it", flag);
    case AccuracyMode::poses_and_forces:
      if (flag == "--csv")
        return "--csv: poses and forces are two tables; write --pose or --force alone";
      return fmt::format("{} does not apply to --pose --force: remove it", flag);
    case AccuracyMode::poses:
      break;
  }
  if (flag == "--axis" || flag == "--plot")
    return fmt::format("{} is for error against time; add --touch", flag);
  if (flag == "--period") return "--period: with --trace FILE.csv only";
  return fmt::format("{} is for forces; add --force", flag);
}

/// Whether the shown pose jumps from prediction to prediction: on request, or by default for files.
bool snaps(const BenchOptions& options) {
  if (options.curves.empty()) return !options.files.empty();
  return std::ranges::all_of(options.curves, [](const auto& word) { return word == "snap"; });
}

/// Whether a random number is used: in a motion, in the network, or in the phases of a touch.
bool draws(AccuracyMode mode, const BenchOptions& options) {
  if (!options.jitter.empty() || !options.loss.empty()) return true;
  if (mode == AccuracyMode::circle || mode == AccuracyMode::touch) return true;
  return mode != AccuracyMode::forces && (options.files.empty() || !options.motions.empty());
}

/// Rejects flags that the study uses, but that exclude another flag.
void check_values(AccuracyMode mode, const BenchOptions& options,
                  std::span<const std::string> given) {
  const auto is_given = [&](std::string_view flag) { return std::ranges::count(given, flag) > 0; };
  if ((options.converge || options.converge_longest) && snaps(options))
    throw tools::UsageError(
        "--converge, --converge-longest: the curve snap does not converge; choose another, such as "
        "--curves cubic");
  if (options.front && !options.json && options.csv.empty())
    throw tools::UsageError("--front is for CSV and JSON; the table shows the front without --all");
  if (options.all && options.json)
    throw tools::UsageError("--all is for the table; --json has all settings without --front");
  const bool files_alone = !options.files.empty() && options.motions.empty();
  if (is_given("--for") && files_alone && mode != AccuracyMode::poses_and_forces)
    throw tools::UsageError("--for is the length of a motion, and FILE has its own: remove --for");
  if (is_given("--seed") && !draws(mode, options))
    throw tools::UsageError(
        "--seed: this run has no randomness; add --jitter or --loss, or remove --seed");
}

/// `read` applied to each part between commas.
template <typename Read>
auto each_part(std::span<const std::string> words, Read&& read) {
  std::vector<decltype(read(std::string_view()))> values;
  for (const std::string& word : words)
    for (const std::string_view part : parts_between_commas(word)) values.push_back(read(part));
  return values;
}

double quantity(std::string_view text, std::string_view unit, std::string_view flag) {
  const peer::Quantity quantity = peer::parse_quantity(text, unit);
  if (!quantity.good()) throw tools::UsageError(fmt::format("{}: {}", flag, quantity.error));
  return quantity.value;
}

double length_of(std::string_view text, std::string_view flag) {
  const double length = quantity(text, "m", flag);
  if (length > 0) return length;
  throw tools::UsageError(
      fmt::format("{}: '{}' is not above 0; write for example 50mm", flag, text));
}

double share_of(const std::string& text, double most, std::string_view flag) {
  if (text.empty()) return 0;
  const double share = quantity(text, "", flag);
  if (share >= 0 && share <= most) return share;
  throw tools::UsageError(fmt::format("{}: '{}' is not between 0 and {} %; write for example 10%",
                                      flag, text, 100 * most));
}

double heartbeat_of(const BenchOptions& options) {
  if (!options.heartbeat) return options.files.empty() ? 5.0 : kNoHeartbeat;
  if (options.heartbeat->count() > 0) return pdu::to_seconds(*options.heartbeat);
  throw tools::UsageError("--heartbeat: must be above 0, for example 5s");
}

/// All curves by default. The default for files is snap: they have a sample a second or a minute,
/// too few to resolve a curve, so that only the prediction is evaluated.
std::vector<deadreckon::ConvergenceCurve> curves_of(const BenchOptions& options) {
  if (options.curves.empty() && !options.files.empty()) return {deadreckon::ConvergenceCurve::snap};
  using Row = deadreckon::ConvergenceCurveRow;
  std::vector<deadreckon::ConvergenceCurve> curves;
  for (const Row& row :
       rows_named(options.curves, std::span<const Row>(deadreckon::kConvergenceCurves), "--curves"))
    curves.push_back(row.curve);
  return curves;
}

std::uint64_t seeds_of(const BenchOptions& options) {
  const std::uint64_t seeds = options.seeds.value_or(1);
  if (seeds >= 1 && seeds <= kMostSeeds) return seeds;
  throw tools::UsageError(fmt::format("--seeds: {} is not from 1 to {}", seeds, kMostSeeds));
}

template <typename Rows>
std::string names_of(const Rows& rows) {
  std::string names;
  for (const auto& row : rows) names += fmt::format("{}{}", names.empty() ? "" : ", ", row.name);
  return names;
}

}  // namespace

std::vector<Flag> BenchOptions::flags() {
  const auto known = [](std::string_view help, const auto& rows) {
    return fmt::format("{}{}", help, names_of(rows));
  };
  return {
      {"--pose", &pose, kOfPoses | kCircle, "the study of poses (the default)"},
      {"--force", &force, kForces | kBoth,
       "hands in contact, their traffic and forces: complete peers in simulated time; --pose adds "
       "poses"},
      {"--contact", &contacts, kForces | kBoth,
       known("with --force: ways of touching, or all (the default): ", contact_scenes())},
      {"--send-at", &sendings, kForces | kBoth,
       "with --force: forces and fixed rates at which hands send "
       "(10mN,15mN,20mN,30mN,50mN,100mN,200mN,50Hz)"},
      {"--touch", &touch, kTouch, "force error against nanoseconds per servo step, axis by axis"},
      {"--axis", &axes, kTouch, known("with --touch: axes (default: all): ", touch_axes()),
       names_of(touch_axes())},
      {"--plot", &plot, kTouch, "with --touch: write the picture to this SVG file"},
      {"--motion", &motions, kOfPoses, known("motions, or all (the default): ", bench::motions()),
       names_of(bench::motions())},
      {"--models", &models, kOfPoses | kCircle, known("models (default: all): ", kPoseModels),
       names_of(kPoseModels)},
      {"--thresholds", &thresholds, kPoses | kBoth | kTrace,
       "thresholds of position, such as 50mm,1m (default: six that suit the motion)"},
      {"--curves", &curves, kOfPoses | kCircle,
       known("convergence curves (default: all, for files snap): ", deadreckon::kConvergenceCurves),
       names_of(deadreckon::kConvergenceCurves)},
      {"--angle", &angle, kOfPoses,
       "threshold of orientation, or none (3deg; none for files without orientations)"},
      {"--heartbeat", &heartbeat, kOfPoses,
       "longest time between two updates (5s; for files unbounded)"},
      {"--first-heartbeat", &first_heartbeat, kOfPoses,
       "against loss: time after a change until it is repeated; each repetition waits twice as "
       "long (none)"},
      {"--converge", &converge, kOfPoses, "duration of convergence (100ms)"},
      {"--converge-longest", &converge_longest, kOfPoses,
       "longest convergence, for large errors; equal to --converge: the same for all errors (1s)"},
      {"--seeds", &seeds, kPoses | kBoth | kAgainst | kCircle | kTouch,
       "number of runs, with seeds from --seed on; results are medians (1; with --circle 20)"},
      {"--against", &against, kAgainst,
       "MODEL:LENGTH; number of updates that --models (auto) need for the same p99 error"},
      {"--circle", &circle, kCircle,
       "fixed case of a steady turn over a poor link; status 1 if the default exceeds the limit"},
      {"--all", &all, kPoses | kBoth, "also show dominated settings in the table"},
      {"--front", &front, kPoses | kBoth, "omit dominated settings in CSV and JSON"},
      {"--trace", &trace, kTrace,
       "write each sample of one run to this file; needs one motion or FILE, one model, one curve, "
       "and one threshold or --period"},
      {"--period", &period, kTrace, "with --trace: send at this period instead of by a threshold"},
  };
}

AccuracyMode BenchOptions::checked_mode(std::span<const std::string> given) {
  const AccuracyMode mode = mode_of(*this);
  std::vector<Flag> rows = flags();
  const auto only_for = [&](std::string_view name, unsigned modes) {
    rows.emplace_back(name, &pose, modes, "");
  };
  only_for("FILE", kOfPoses);
  only_for("--json", kTables | kAgainst | kCircle | kTouch);
  only_for("--for", kTables | kAgainst | kTrace);
  only_for("--jitter", kOfPoses | kForces);
  for (const char* name : {"--delay", "--loss"}) only_for(name, kOfPoses | kForces | kTouch);
  only_for("--csv", kPoses | kForces | kTouch);
  only_for("--report", kTables | kTouch);
  check_modes(rows, bit(mode), given, [&](std::string_view flag) { return refusal(mode, flag); });
  check_values(mode, *this, given);
  return mode;
}

std::vector<PoseModel> read_models(std::span<const std::string> words) {
  return rows_named(words, std::span<const PoseModel>(kPoseModels), "--models");
}

std::vector<double> read_thresholds(std::span<const std::string> words) {
  return each_part(words, [](std::string_view part) { return length_of(part, "--thresholds"); });
}

std::vector<Motion> read_motions(std::span<const std::string> words) {
  return rows_named(words, motions(), "--motion");
}

std::vector<ContactScene> read_contacts(std::span<const std::string> words) {
  return rows_named(words, contact_scenes(), "--contact");
}

std::vector<ContactSending> read_sendings(std::span<const std::string> words) {
  if (words.empty()) return {kContactSendings.begin(), kContactSendings.end()};
  return each_part(words, [](std::string_view part) {
    const bool rate = part.ends_with("Hz");
    const double value = quantity(part, rate ? "Hz" : "N", "--send-at");
    if (rate ? !(value >= kLeastRate && value <= kMostRate) : !(value > 0))
      throw tools::UsageError(
          fmt::format("--send-at: '{}' is neither a force above 0 nor a rate from {} to {} Hz; "
                      "write for example 15mN,50Hz",
                      part, kLeastRate, kMostRate));
    return rate ? ContactSending{0, value} : ContactSending{value, 0};
  });
}

Baseline read_baseline(const std::string& text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos)
    throw tools::UsageError(fmt::format(
        "--against: '{}' has no threshold; write MODEL:LENGTH, for example rvw:1m", text));
  return {row_named(text.substr(0, colon), std::span<const PoseModel>(kPoseModels), "--against"),
          length_of(std::string_view(text).substr(colon + 1), "--against")};
}

TouchConditions read_touch_conditions(const BenchOptions& options) {
  TouchConditions conditions{options.first_seed(), seeds_of(options)};
  if (options.delay) conditions.delay = pdu::to_seconds(*options.delay);
  if (conditions.delay && !(*conditions.delay > 0 && *conditions.delay <= kMostTouchDelay))
    throw tools::UsageError("--delay: must be above 0 and at most 1s with --touch");
  conditions.loss = share_of(options.loss, 0.99, "--loss");
  return conditions;
}

AccuracyGrid read_conditions(const BenchOptions& options) {
  AccuracyGrid grid;
  grid.models = read_models(options.models);
  grid.curves = curves_of(options);
  if (options.angle == "none")
    grid.angle = kAnyAngle;
  else if (!options.angle.empty())
    grid.angle = quantity(options.angle, "rad", "--angle");
  if (!(grid.angle > 0))
    throw tools::UsageError("--angle: must be above 0; write for example 3deg, or none");
  grid.heartbeat = heartbeat_of(options);
  if (options.first_heartbeat) grid.first_heartbeat = pdu::to_seconds(*options.first_heartbeat);
  if (options.converge) grid.convergence.duration = pdu::to_seconds(*options.converge);
  if (options.converge_longest)
    grid.convergence.longest = pdu::to_seconds(*options.converge_longest);
  const double jitter = share_of(options.jitter, 1, "--jitter");
  grid.network.law = peer::delayed_by(options.delay ? pdu::to_seconds(*options.delay) : 0, jitter,
                                      share_of(options.loss, 0.99, "--loss"));
  grid.network.seed = options.first_seed();
  grid.seeds = seeds_of(options);
  if (jitter > 0 && grid.network.law.delay.count() == 0)
    throw tools::UsageError(
        "--jitter is a share of --delay, which is 0; write --delay 80ms --jitter 40%");
  return grid;
}

}  // namespace reckon::bench
