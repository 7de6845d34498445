// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What `reckon bench scale` was asked for, read from its words.
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

inline constexpr std::size_t kEntitiesAPeer = 100;  ///< unless --entities says otherwise

/// The words as typed.
struct ScaleWords {
  std::string file;  ///< of tracks; empty: movement by a seed
  std::string peers = "8,16,32,64";
  std::string entities;  ///< empty: kEntitiesAPeer each
  std::string movement;  ///< empty: mixed
  std::string radius = "200 m";
  std::string scheme;      ///< of cells, a word of a scene; empty: hexagonal
  std::string cell, pool;  ///< empty: 125 m, 256 groups
  std::string density;     ///< entities a square kilometre; empty: 400
  std::string threshold = "1 m";
  double rate = 30;
  std::optional<std::chrono::nanoseconds> delay;
  std::string jitter, loss;  ///< shares
  std::optional<std::uint64_t> seed;
  std::optional<std::chrono::nanoseconds> length;  ///< 5 s
  std::string report;
  std::string compare;                ///< JSON Lines of an earlier run
  std::string whole;                  ///< where processes meet, see read_meeting(); empty: none
  std::string hosts;                  ///< for Meeting::hosts, see read_hosts()
  std::string ssh;                    ///< words; empty: of HostsPlan
  std::string share;                  ///< of one host, see read_host_share(); empty: none
  std::optional<std::uint64_t> port;  ///< of its peers
  bool hands = false;                 ///< hands in contact too
  bool many_hands = false;            ///< and hands among many
  bool json = false;
  bool wide = false;  ///< all columns
};

/// What is run.
struct ScalePlan {
  std::vector<Track> tracks;             ///< what settings' crowds refer to; none: by a seed
  Meeting meeting = Meeting::simulated;  ///< and there, unless simulated
  HostsPlan hosts;                       ///< of Meeting::hosts
  std::optional<HostShare> share;        ///< this alone is run, of the first setting
  std::vector<ScaleSetting> settings;    ///< peers times entities, entities fastest
  std::vector<ScaleSetting> fitted;      ///< likewise, of those with more than kMostWhole peers
  std::size_t hands = 0;  ///< among many: as many as the largest has peers, kManyHands at most
};

/// @throws UsageError with the word and the remedy, or what reading the file throws.
[[nodiscard]] ScalePlan read_scale_plan(const ScaleWords& words);

}  // namespace reckon::bench
