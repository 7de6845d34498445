// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/scale/options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "reckon/bench/studies/scale/many_hands.hpp"
#include "reckon/bench/studies/scale/prediction.hpp"
#include "reckon/bench/studies/sweep/values.hpp"
#include "reckon/bench/studies/tracks/track_file.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/scene/scene_words.hpp"
#include "reckon/tools/command_line/console.hpp"

namespace reckon::bench {
namespace {

constexpr double kMostPeers = 65'534, kMostEntities = 1e7;
constexpr std::uint64_t kMostPort = 65'535;
constexpr std::uint64_t kMostDrawn = 100;
constexpr double kShortest = 1, kLongest = 3600;  // [s]

std::vector<std::size_t> counts_of(const std::string& text, double most, std::string_view flag) {
  std::vector<std::size_t> counts;
  for (const double value : read_values(text, {"", 1, most, false}, flag)) {
    if (value != std::floor(value))
      throw tools::UsageError(fmt::format("{}: {} is not a whole number", flag, value));
    counts.push_back(static_cast<std::size_t>(value));
  }
  return counts;
}

std::vector<std::size_t> entities_of(const ScaleWords& words, std::size_t peers) {
  if (words.entities.empty()) return {kEntitiesAPeer * peers};
  return counts_of(words.entities, kMostEntities, "--entities");
}

double single(const std::string& text, const ValueRule& rule, std::string_view flag) {
  const auto values = read_values(text, rule, flag);
  if (values.size() == 1) return values.front();
  throw tools::UsageError(fmt::format("{}: '{}' is more than one value; write one", flag, text));
}

double share_of(const std::string& text, std::string_view flag) {
  return text.empty() ? 0 : single(text, {"", 0, 0.99, false}, flag);
}

std::size_t read_pool(const std::string& text) {
  const double groups = single(text, {"", 1, aoim::kMaximumPool, false}, "--pool");
  const auto pool = static_cast<std::size_t>(groups);
  if (static_cast<double>(pool) != groups || !aoim::is_pool(pool))
    throw tools::UsageError(fmt::format("--pool: {} groups are not possible; write 1, or 4 to {}",
                                        text, aoim::kMaximumPool));
  return pool;
}

aoim::CellScheme read_scheme(const std::string& text) {
  const auto scheme = peer::value_of<aoim::CellScheme>(text);
  if (scheme && *scheme != aoim::CellScheme::locales) return *scheme;
  throw tools::UsageError(
      fmt::format("--scheme: '{}' is not one of square, hexagonal and quadtree", text));
}

/// Finds the interval of `length` [s] that most tracks cover. Returns these tracks cut to it; time
/// 0 is its begin.
std::vector<Track> cut_out(const std::vector<Track>& tracks, double length) {
  double begin = 0;
  std::size_t best = 0;
  const auto lasts = [&](const Track& track, double from) {
    return track.samples.front().time <= from && track.samples.back().time >= from + length;
  };
  for (const Track& start : tracks) {
    const double from = start.samples.front().time;
    const auto count = static_cast<std::size_t>(
        std::ranges::count_if(tracks, [&](const Track& track) { return lasts(track, from); }));
    if (count > best) {
      best = count;
      begin = from;
    }
  }
  std::vector<Track> cut;
  for (const Track& track : tracks) {
    if (!lasts(track, begin)) continue;
    cut.push_back({track.name, {}});
    for (std::size_t i = 0; i < track.samples.size(); ++i) {
      const bool ends_before = i + 1 < track.samples.size() && track.samples[i + 1].time <= begin;
      if (ends_before) continue;
      cut.back().samples.push_back(track.samples[i]);
      cut.back().samples.back().time -= begin;
      if (track.samples[i].time >= begin + length) break;
    }
  }
  return cut;
}

std::vector<Track> read_tracks(const ScaleWords& words, double length) {
  if (words.file.empty()) return {};
  if (!words.movement.empty())
    throw tools::UsageError("--movement: FILE has its own; remove one of them");
  if (!words.density.empty())
    throw tools::UsageError("--density: FILE has its own; remove one of them");
  std::vector<Track> tracks = cut_out(read_track_file(words.file).tracks, length);
  if (tracks.empty())
    throw tools::UsageError(
        fmt::format("{}: no track lasts {:g} s; shorten --for", words.file, length));
  return tracks;
}

/// Measured simulated time [s].
double length_of(const ScaleWords& words) {
  const double seconds = words.length ? pdu::to_seconds(*words.length) : ScaleSetting().seconds;
  if (!(seconds >= kShortest && seconds <= kLongest))
    throw tools::UsageError("--for: write 1s to 1h of simulated time");
  return seconds;
}

/// @throws UsageError if a flag is given that has no effect here
void check_used(bool given, std::string_view flag, bool used, std::string_view by) {
  if (given && !used)
    throw tools::UsageError(fmt::format("{0} needs {1}: add it, or remove {0}", flag, by));
}

/// Reads the flags for several hosts.
void read_hosts_plan(const ScaleWords& words, ScalePlan& plan) {
  const bool on_hosts = plan.meeting == Meeting::hosts, is_share = !words.share.empty();
  check_used(!words.hosts.empty(), "--hosts", on_hosts, "--whole hosts");
  check_used(!words.ssh.empty(), "--ssh", on_hosts, "--whole hosts");
  check_used(words.port.has_value(), "--port", is_share, "--share");
  if (!words.hosts.empty()) plan.hosts.hosts = read_hosts(words.hosts);
  if (!words.ssh.empty()) plan.hosts.ssh = words.ssh;
  if (!is_share) return;
  plan.share = read_host_share(words.share);
  const bool runs_more = words.json || words.hands || words.many_hands || !words.whole.empty() ||
                         !words.compare.empty() || !words.report.empty() || words.delay ||
                         !words.loss.empty() || !words.file.empty();
  if (runs_more)
    throw tools::UsageError(
        "--share: --whole hosts starts this verb itself on each host, with its arguments: run "
        "--whole hosts");
}

/// Replaces the settings by drawn ones. These are of processes, on lo unless --whole says another.
void draw_settings(const ScaleWords& words, const ScaleSetting& base, ScalePlan& plan) {
  if (*words.drawn < 1 || *words.drawn > kMostDrawn)
    throw tools::UsageError(fmt::format("--drawn: write 1 to {} exercises", kMostDrawn));
  const ScaleWords usual;
  const bool is_sized = words.peers != usual.peers || !words.entities.empty() ||
                        !words.movement.empty() || !words.file.empty() ||
                        words.radius != usual.radius || !words.scheme.empty() ||
                        !words.cell.empty() || !words.pool.empty() || !words.density.empty() ||
                        words.threshold != usual.threshold || words.rate != usual.rate;
  if (is_sized || words.hands || words.many_hands || !words.compare.empty() ||
      !words.pick.empty() || !words.share.empty())
    throw tools::UsageError(
        "--drawn draws the exercises by --seed: remove the other flags, except --whole lo, --whole "
        "lan, --for and --json");
  if (plan.meeting == Meeting::simulated) plan.meeting = Meeting::lo;
  plan.drawn = drawn_settings(base, *words.drawn, base.seed);
  for (const ScaleSetting& setting : plan.drawn) check_meeting(setting, plan.meeting);
}

/// Moves exercises of more than kMostWhole peers to `fitted`, unless peers run as processes.
void set_fitted_apart(ScalePlan& plan) {
  if (plan.meeting != Meeting::simulated || plan.share) return;
  const auto is_run = [](const ScaleSetting& setting) { return setting.peers <= kMostWhole; };
  const auto larger = std::ranges::stable_partition(plan.settings, is_run);
  plan.fitted.assign(larger.begin(), larger.end());
  plan.settings.erase(larger.begin(), larger.end());
  for (const ScaleSetting& setting : plan.fitted) {
    std::set<std::size_t> sizes;
    for (const ScaleSetting& run : plan.settings)
      if (are_alike(run, setting)) sizes.insert(run.peers);
    if (sizes.size() < kFewestSizes)
      throw tools::UsageError(
          fmt::format("--peers: {} need a fit to {} or more exercises of at most {} with as many "
                      "entities each; add them, for example --peers 64,128,{},{}",
                      setting.peers, kFewestSizes, kMostWhole, kMostWhole, setting.peers));
  }
}

}  // namespace

ScalePlan read_scale_plan(const ScaleWords& words) {
  ScaleSetting base;
  base.seconds = length_of(words);
  if (!(words.rate >= 1 && words.rate <= 1000))
    throw tools::UsageError("--rate: write 1 to 1000 ticks a second");
  base.rate = words.rate;
  base.radius = single(words.radius, {"m", 0, 1e5, true}, "--radius");
  if (!words.scheme.empty()) base.grid.scheme = read_scheme(words.scheme);
  if (!words.cell.empty()) base.grid.cell_size = single(words.cell, {"m", 1, 1e5, false}, "--cell");
  if (!words.pool.empty()) base.grid.pool = read_pool(words.pool);
  base.thresholds.position = single(words.threshold, {"m", 1e-4, 1e4, false}, "--threshold");
  if (!words.density.empty())
    base.crowd.density = single(words.density, {"", 1e-3, 1e7, false}, "--density");
  if (!words.movement.empty()) base.crowd.movement = words.movement;
  base.network =
      peer::delayed_by(pdu::to_seconds(words.delay.value_or(std::chrono::nanoseconds{})),
                       share_of(words.jitter, "--jitter"), share_of(words.loss, "--loss"));
  if (!words.jitter.empty() && base.network.delay.count() == 0)
    throw tools::UsageError(
        "--jitter is a share of --delay, which is 0; write --delay 80ms --jitter 40%");
  if (words.seed && !words.file.empty() && words.loss.empty() && words.jitter.empty())
    throw tools::UsageError(
        "--seed: this run has no randomness; add --jitter or --loss, or remove --seed");
  base.seed = base.crowd.seed = words.seed.value_or(1);

  ScalePlan plan;
  plan.meeting = read_meeting(words.whole);
  read_hosts_plan(words, plan);
  if (words.port.value_or(base.port) > kMostPort)
    throw tools::UsageError("--port: write 1 to 65535");
  base.port = static_cast<std::uint16_t>(words.port.value_or(base.port));
  if (words.drawn) {
    draw_settings(words, base, plan);
    return plan;
  }
  if (!words.pick.empty()) {
    plan.pick = single(words.pick, {"m", 1e-3, 1e4, false}, "--pick");
    if (plan.meeting == Meeting::hosts)
      throw tools::UsageError("--pick needs peers on this machine: write --whole lo or lan");
    if (plan.meeting == Meeting::simulated) plan.meeting = Meeting::lo;
  }
  plan.tracks = read_tracks(words, kWarmUp + base.seconds);
  base.crowd.tracks = plan.tracks;
  for (const std::size_t peers : counts_of(words.peers, kMostPeers, "--peers"))
    for (const std::size_t entities : entities_of(words, peers)) {
      plan.settings.push_back(base);
      plan.settings.back().peers = peers;
      plan.settings.back().crowd.entities = entities;
      check_scale_setting(plan.settings.back());
      if (base.grid.scheme == aoim::CellScheme::quad_tree) divide_by_crowd(plan.settings.back());
      check_meeting(plan.settings.back(), plan.meeting);
      if (plan.meeting == Meeting::hosts) check_hosts(plan.settings.back(), plan.hosts);
      plan.hands = std::max(plan.hands, std::min(peers, kManyHands));
    }
  set_fitted_apart(plan);
  if (words.many_hands && plan.hands < 2)
    throw tools::UsageError("--many-hands: one peer cannot touch another; write --peers 2 or more");
  return plan;
}

}  // namespace reckon::bench
