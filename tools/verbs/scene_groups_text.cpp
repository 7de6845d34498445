// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/verbs/scene_groups_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

#include "reckon/peer/loops/aoim_setup.hpp"
#include "reckon/peer/network/host_limits.hpp"

namespace reckon::tools {
namespace {

/// Cells with a beacon, and the beacons that this peer follows.
void add_beacons(const peer::SceneFile& file, SettingRows& rows) {
  std::string beacons;
  for (const peer::EntityConfig& entity : file.entities) {
    if (entity.beacon.empty()) continue;
    beacons +=
        fmt::format("{}{} of peer {}", beacons.empty() ? "" : ", ", entity.beacon, entity.peer);
  }
  if (!beacons.empty()) rows.emplace_back("beacons", beacons + ": located by the map of groups");
  if (!file.aoim.follow.empty())
    rows.emplace_back("follows",
                      file.aoim.follow + ": joins the cell of each, and shows its entities");
}

// Maximum number of groups that the tiers with these recipients need at once.
std::size_t within_tiers(const peer::SceneFile& file, peer::Recipients to) {
  const std::vector<std::size_t> within = peer::group_needs(file).within_tiers;
  std::size_t sum = 0;
  for (std::size_t i = 0; i < within.size(); ++i)
    sum += file.aoim.tiers[i].to == to ? within[i] : 0;
  return sum;
}

}  // namespace

std::string groups_text(const peer::SceneFile& file) {
  if (file.network.interop) return fmt::format("{} only, plain DIS", file.network.group.text());
  const peer::GroupNeeds needs = peer::group_needs(file);
  return fmt::format("{} and {} after it; the radius needs up to {} of them",
                     file.network.group.text(), file.aoim.pool, needs.within_radius);
}

void add_group_rows(const peer::SceneFile& file, SettingRows& rows) {
  if (file.aoim.leaders)
    rows.emplace_back("leaders",
                      "of the scene and of each cell; the leader of a cell introduces its entities "
                      "to newcomers, instead of their owners");
  if (file.aoim.hand_out)
    rows.emplace_back("handed out",
                      "groups, by the leader of the scene; a cell without one uses the base group, "
                      "which all peers receive");
  add_beacons(file, rows);
  const std::size_t own_groups = own_group_count(file.aoim.tiers);
  if (has_touch_tier(file.aoim.tiers))
    rows.emplace_back("felt",
                      fmt::format("in {} more groups, which only peers that can touch there join; "
                                  "a hand needs up to {} of them",
                                  file.aoim.pool, within_tiers(file, peer::Recipients::touch)));
  if (own_groups > 0)
    rows.emplace_back(
        "near",
        fmt::format(
            "{} in {} more groups, which only near peers join; a focus needs up to {} of them",
            own_groups == 1 ? "one tier" : fmt::format("{} tiers", own_groups),
            own_groups * file.aoim.pool, within_tiers(file, peer::Recipients::distance)));
}

std::vector<std::string> group_warnings(const peer::SceneFile& file) {
  const peer::GroupNeeds needs = peer::group_needs(file);
  const std::size_t joined = std::accumulate(needs.within_tiers.begin(), needs.within_tiers.end(),
                                             std::min(needs.within_radius, needs.most_joined) + 1);
  std::vector<std::string> warnings;
  for (const peer::Finding& finding : {peer::probe_open_files(joined), peer::probe_memberships()}) {
    if (finding.level != peer::FindingLevel::problem) continue;
    warnings.push_back(fmt::format("{}; {}", finding.what, finding.remedy));
  }
  return warnings;
}

}  // namespace reckon::tools
