// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/accuracy/options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/scene/nearest_word.hpp"
#include "reckon/peer/scene/units.hpp"
#include "reckon/tools/command_line/console.hpp"

namespace reckon::bench {
namespace {

constexpr std::uint64_t kMostSeeds = 1000;
constexpr double kLeastRate = 20, kMostRate = 500;  // [Hz]

/// The parts between commas of all words, without blanks about them.
std::vector<std::string> parts_of(std::span<const std::string> words) {
  std::vector<std::string> parts;
  for (std::string_view word : words) {
    for (;;) {
      const std::size_t comma = word.find(',');
      std::string_view part = word.substr(0, comma);
      while (part.starts_with(' ')) part.remove_prefix(1);
      while (part.ends_with(' ')) part.remove_suffix(1);
      parts.emplace_back(part);
      if (comma == word.npos) break;
      word.remove_prefix(comma + 1);
    }
  }
  return parts;
}

template <typename Row>
const Row& row_named(std::string_view name, std::span<const Row> rows, std::string_view flag) {
  std::vector<std::string_view> names;
  for (const Row& row : rows) {
    if (row.name == name) return row;
    names.push_back(row.name);
  }
  const std::string_view nearest = peer::nearest_word(name, names);
  throw tools::UsageError(
      fmt::format("{}: there is no '{}'{}; known: {}", flag, name,
                  nearest.empty() ? "" : fmt::format(" (did you mean '{}'?)", nearest),
                  fmt::join(names, ", ")));
}

template <typename Row>
std::vector<Row> rows_named(std::span<const std::string> words, std::span<const Row> rows,
                            std::string_view flag) {
  std::vector<Row> chosen;
  for (const std::string& name : parts_of(words)) {
    if (name == "all")
      chosen.insert(chosen.end(), rows.begin(), rows.end());
    else
      chosen.push_back(row_named(name, rows, flag));
  }
  return chosen;
}

double quantity(std::string_view text, std::string_view unit, std::string_view flag) {
  const peer::Quantity quantity = peer::parse_quantity(text, unit);
  if (!quantity.good()) throw tools::UsageError(fmt::format("{}: {}", flag, quantity.error));
  return quantity.value;
}

double length_of(std::string_view text, std::string_view flag) {
  const double length = quantity(text, "m", flag);
  if (length > 0) return length;
  throw tools::UsageError(fmt::format("{}: '{}' is not above 0; write it as in 50mm", flag, text));
}

double share_of(const std::string& text, double most, std::string_view flag) {
  if (text.empty()) return 0;
  const double share = quantity(text, "", flag);
  if (share >= 0 && share <= most) return share;
  throw tools::UsageError(fmt::format("{}: '{}' is not between 0 and {} %; write it as in 10%",
                                      flag, text, 100 * most));
}

double heartbeat_of(const BenchOptions& options) {
  if (!options.heartbeat) return options.files.empty() ? 5.0 : kNoHeartbeat;
  if (options.heartbeat->count() > 0) return pdu::to_seconds(*options.heartbeat);
  throw tools::UsageError("--heartbeat: has to be above 0; write it as in 5s");
}

}  // namespace

std::vector<PoseModel> read_models(std::span<const std::string> words) {
  return rows_named(words, std::span<const PoseModel>(kPoseModels), "--models");
}

std::vector<deadreckon::ConvergenceCurve> read_curves(std::span<const std::string> words) {
  using Row = deadreckon::ConvergenceCurveRow;
  std::vector<deadreckon::ConvergenceCurve> curves;
  for (const Row& row :
       rows_named(words, std::span<const Row>(deadreckon::kConvergenceCurves), "--curves"))
    curves.push_back(row.curve);
  return curves;
}

std::vector<double> read_thresholds(std::span<const std::string> words) {
  std::vector<double> thresholds;
  for (const std::string& part : parts_of(words))
    thresholds.push_back(length_of(part, "--thresholds"));
  return thresholds;
}

std::vector<Motion> read_motions(std::span<const std::string> words) {
  return rows_named(words, motions(), "--motion");
}

std::vector<ContactScene> read_contacts(std::span<const std::string> words) {
  return rows_named(words, contact_scenes(), "--contact");
}

std::vector<ContactSending> read_sendings(std::span<const std::string> words) {
  std::vector<ContactSending> sendings;
  for (const std::string& part : parts_of(words)) {
    const bool rate = part.ends_with("Hz");
    const double value = quantity(part, rate ? "Hz" : "N", "--send-at");
    if (rate ? !(value >= kLeastRate && value <= kMostRate) : !(value > 0))
      throw tools::UsageError(fmt::format(
          "--send-at: '{}' is no force above 0 and no rate from {} to {} Hz; write it as in "
          "15mN,50Hz",
          part, kLeastRate, kMostRate));
    sendings.push_back(rate ? ContactSending{0, value} : ContactSending{value, 0});
  }
  return sendings;
}

Baseline read_baseline(const std::string& text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos)
    throw tools::UsageError(
        fmt::format("--against: '{}' names no threshold; write MODEL:LENGTH as in rvw:1m", text));
  return {row_named(text.substr(0, colon), std::span<const PoseModel>(kPoseModels), "--against"),
          length_of(std::string_view(text).substr(colon + 1), "--against")};
}

AccuracyGrid read_conditions(const BenchOptions& options) {
  AccuracyGrid grid;
  if (options.angle == "none")
    grid.angle = kAnyAngle;
  else if (!options.angle.empty())
    grid.angle = quantity(options.angle, "rad", "--angle");
  if (!(grid.angle > 0)) throw tools::UsageError("--angle: has to be above 0; write 3deg, or none");
  grid.heartbeat = heartbeat_of(options);
  if (options.first_heartbeat) grid.first_heartbeat = pdu::to_seconds(*options.first_heartbeat);
  if (options.converge) grid.convergence.duration = pdu::to_seconds(*options.converge);
  if (options.converge_longest)
    grid.convergence.longest = pdu::to_seconds(*options.converge_longest);
  const double jitter = share_of(options.jitter, 1, "--jitter");
  grid.network.law = peer::delayed_by(options.delay ? pdu::to_seconds(*options.delay) : 0, jitter,
                                      share_of(options.loss, 0.99, "--loss"));
  grid.network.seed = options.seed;
  grid.seeds = options.seeds.value_or(1);
  if (grid.seeds < 1 || grid.seeds > kMostSeeds)
    throw tools::UsageError(fmt::format("--seeds: {} is not from 1 to {}", grid.seeds, kMostSeeds));
  if (jitter > 0 && grid.network.law.delay.count() == 0)
    throw tools::UsageError(
        "--jitter is a share of --delay, which is 0; write --delay 80ms --jitter 40%");
  return grid;
}

}  // namespace reckon::bench
