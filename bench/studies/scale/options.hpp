// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The plan of a `reckon bench scale` run, read from its flags.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "reckon/bench/studies/scale/fit.hpp"
#include "reckon/bench/studies/scale/host_share.hpp"
#include "reckon/bench/studies/scale/hosts.hpp"
#include "reckon/bench/studies/scale/setting.hpp"
#include "reckon/bench/studies/scale/whole_runs.hpp"

namespace reckon::bench {

inline constexpr std::size_t kEntitiesAPeer = 100;  ///< default of --entities

/// The flags as typed.
struct ScaleWords {
  std::string file;  ///< of tracks; empty: movement from a seed
  std::string peers = "8,16,32,64";
  std::string entities;  ///< empty: kEntitiesAPeer each
  std::string movement;  ///< empty: mixed
  std::string radius = "200 m";
  std::string scheme;      ///< of cells, as in a scene; empty: hexagonal
  std::string cell, pool;  ///< empty: 125 m, 256 groups
  std::string density;     ///< entities a square kilometre; empty: 400
  std::string threshold = "1 m";
  double rate = 30;
  std::optional<std::chrono::nanoseconds> delay;
  std::string jitter, loss;  ///< shares
  std::optional<std::uint64_t> seed;
  std::optional<std::chrono::nanoseconds> length;  ///< none: 5 s
  std::string report;
  std::optional<std::uint64_t> drawn;  ///< exercises that a seed draws
  std::string pick;                    ///< p99 pose error that a policy may have; empty: no pick
  std::string compare;                 ///< JSON Lines of an earlier run
  std::string whole;                   ///< network of processes, see read_meeting(); empty: none
  std::string hosts;                   ///< for Meeting::hosts, see read_hosts()
  std::string ssh;                     ///< command; empty: HostsPlan::ssh
  std::string share;                   ///< peers of one host, see read_host_share(); empty: none
  std::optional<std::uint64_t> port;   ///< of the share's peers
  bool hands = false;                  ///< hands in contact too
  bool many_hands = false;             ///< hands of many peers too
  bool json = false;
  bool wide = false;  ///< all columns
};

/// The runs of the study.
struct ScalePlan {
  std::vector<Track> tracks;             ///< the settings' crowds refer to them; none: a seed
  Meeting meeting = Meeting::simulated;  ///< peers also run there, unless simulated
  HostsPlan hosts;                       ///< of Meeting::hosts
  std::optional<HostShare> share;        ///< if set, only this runs, with the first setting
  std::vector<ScaleSetting> settings;    ///< peers times entities; entities vary fastest
  std::vector<ScaleSetting> drawn;       ///< run as processes only; then `settings` is empty
  std::optional<double> pick;            ///< error of the policy for the last setting [m]
  std::vector<ScaleSetting> fitted;      ///< with more than kMostWhole peers; not run
  std::size_t hands = 0;  ///< of many peers: peers of the largest setting, kManyHands at most
};

/// @throws UsageError with the flag and the remedy, or as read_track_file() does.
[[nodiscard]] ScalePlan read_scale_plan(const ScaleWords& words);

}  // namespace reckon::bench
