// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// [[aoim.tier]]: the recipients of an update, its rate and its accuracy.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/peer/scene/scene_sections.hpp"

namespace reckon::peer {
namespace {

constexpr std::string_view kTo = "to";

std::string place_of(std::size_t tier, std::string_view key = {}) {
  return fmt::format("tier[{}]{}{}", tier, key.empty() ? "" : ".", key);
}

std::string tier_text(const TierConfig& tier) {
  std::string text = "[[aoim.tier]]\n";
  const auto say = [&](std::string_view key, const std::string& value) {
    text += fmt::format("{} = {}\n", key, value);
  };
  const auto quantity = [&](std::string_view key, double value, std::string_view unit) {
    say(key, fmt::format("\"{}\"", format_quantity(value, unit)));
  };
  if (!is_by_distance(tier)) {
    say("to", "\"touch\"");
    return text;
  }
  const aoim::Channel& row = tier.channel;
  if (std::isfinite(row.farthest)) quantity("farthest", row.farthest, "m");
  if (row.body != aoim::Channel{}.body) say("body", fmt::format("\"{}\"", word_of(row.body)));
  quantity("active", row.active_hz, "Hz");
  quantity("passive", row.passive_hz, "Hz");
  quantity("octets", row.octets, "B");
  if (row.kept) say("kept", "true");
  if (row.coarser != 1.0) say("coarser", fmt::format("{:.9g}", row.coarser));
  if (tier.own_group) say("own_group", "true");
  return text;
}

void check_tier(TomlReader& table, TierConfig& tier) {
  if (is_by_distance(tier)) {
    if (!table.has("farthest")) tier.channel.farthest = std::numeric_limits<double>::infinity();
    table.require("active");
    table.require("octets");
    return;
  }
  for (const KeyRow& row : tier_section().rows) {
    const std::string& key = row.key().key;
    if (key != kTo && table.has(key))
      table.problem(
          key,
          fmt::format("'{}' is for tiers by distance; to = \"touch\" takes no other key: remove it",
                      key));
  }
}

void check_touch(TomlReader& aoim, const Tiers& tiers) {
  bool had_one = false;
  for (std::size_t i = 0; i < tiers.size(); ++i) {
    if (is_by_distance(tiers[i])) continue;
    if (had_one)
      aoim.problem_at(place_of(i, kTo), "there is a tier with to = \"touch\" already: keep one");
    else if (i > 0)
      aoim.problem_at(place_of(i, kTo),
                      "the tier with to = \"touch\" is the nearest: move it before all others");
    had_one = true;
  }
}

/// The error of a row relative to the row before it; nothing if both are valid.
std::optional<std::string> refusal_of(std::span<const aoim::Channel> pair) {
  try {
    static_cast<void>(aoim::ChannelTable(pair));
    return std::nullopt;
  } catch (const std::invalid_argument& error) {
    const std::string_view what = error.what();  // "channel 1: why"
    return std::string(what.substr(what.find(": ") + 2));
  }
}

void check_distances(TomlReader& aoim, const Tiers& tiers) {
  std::vector<aoim::Channel> pair;
  for (std::size_t i = 0; i < tiers.size(); ++i) {
    if (!is_by_distance(tiers[i])) continue;
    if (pair.size() == 2) pair.erase(pair.begin());
    pair.push_back(tiers[i].channel);
    const auto why = refusal_of(pair);
    if (why) return aoim.problem_at(place_of(i), fmt::format("'tier': {}", *why));
  }
}

void check_own_groups(TomlReader& aoim, const Tiers& tiers) {
  bool is_nearest = true;
  for (std::size_t i = 0; i < tiers.size() && own_group_count(tiers) > 0; ++i) {
    if (!is_by_distance(tiers[i])) continue;
    const std::string why = own_group_refusal(tiers, i);
    if (!why.empty()) {
      if (tiers[i].own_group)
        aoim.problem_at(place_of(i, "own_group"),
                        fmt::format("'own_group': {}: remove it here", why));
      continue;
    }
    if (!tiers[i].own_group)
      aoim.problem_at(
          place_of(i, "own_group"),
          "'own_group' applies to all tiers by distance that are neither 'kept' nor the last, or "
          "to none: write own_group = true here too, or remove it from the others");
    if (is_nearest && tiers[i].channel.coarser > 1.0)
      aoim.problem_at(
          place_of(i, "coarser"),
          "'own_group' needs the thresholds of the scene in the nearest tier: write coarser = 1");
    is_nearest = false;
  }
}

}  // namespace

Section<TierConfig> tier_section() {
  using aoim::Channel;
  const auto of = [](auto member) { return in(&TierConfig::channel, member); };
  return {{
              {"to", &TierConfig::to,
               "distance: peers up to `farthest` away. touch: peers that can touch the entity; "
               "each cell has a group for felt states that only they join and read first. touch is "
               "the first row and takes no other key"},
              {"own_group", &TierConfig::own_group,
               "each cell has a multicast group for this row, which only peers within its distance "
               "join; set it for all rows that are neither `kept` nor the last, or for none"},
              {"farthest", of(&Channel::farthest), within("m", 0, kWorld),
               "greatest distance of the receivers; when absent, unbounded"},
              {"body", of(&Channel::body),
               "rigid: position and orientation; approximate: also articulated parts; full: also "
               "force models. New or abrupt states and heartbeats are sent in full"},
              {"active", of(&Channel::active_hz), within("Hz", 0, 1000),
               "most updates a second of a moving entity"},
              {"passive", of(&Channel::passive_hz), within("Hz", 0, 1000),
               "most updates a second of an entity at rest"},
              {"octets", of(&Channel::octets), within("B", 1, kMaxDatagram),
               "octets that an update counts against `budget`"},
              {"kept", of(&Channel::kept), "this row is exempt from `budget`"},
              {"coarser", of(&Channel::coarser), within("", 1, 1e6),
               "with `own_group`: factor of the thresholds of position and orientation for these "
               "receivers; at least that of the row before"},
          },
          check_tier};
}

void check_tiers(TomlReader& aoim, const Tiers& tiers) {
  check_touch(aoim, tiers);
  check_distances(aoim, tiers);
  check_own_groups(aoim, tiers);
}

std::string tiers_text(const Tiers& tiers) {
  std::string text;
  for (const TierConfig& tier : tiers) text += tier_text(tier);
  return text;
}

}  // namespace reckon::peer
