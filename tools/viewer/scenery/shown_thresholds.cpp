// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/viewer/scenery/shown_thresholds.hpp"

#include <set>

namespace reckon::tools {

ShownThresholds::ShownThresholds(const peer::SceneFile& scene) {
  std::set<double> all;
  if (scene.entities.empty() || !scene.operators.empty() || !scene.devices.empty()) {
    hands_ = scene.dead_reckoning.thresholds.position;
    all.insert(*hands_);
  }
  for (const peer::EntityConfig& entity : scene.entities) {
    const double threshold = entity.dead_reckoning.thresholds.position;
    all.insert(threshold);
    const auto [known, is_new] = entities_.try_emplace(entity.marking, threshold);
    if (!is_new && known->second != threshold) known->second.reset();
  }
  told_.assign(all.begin(), all.end());
  if (told_.size() > kMost) told_ = {told_.front(), told_[told_.size() / 2], told_.back()};
}

std::optional<double> ShownThresholds::of(std::string_view marking, bool is_haptic) const {
  const auto known = entities_.find(marking);
  if (known != entities_.end()) return known->second;
  return is_haptic ? hands_ : std::nullopt;
}

}  // namespace reckon::tools
