// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The position thresholds at which a scene's entities send an update. They are in the scene, not on
// the wire.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/peer/scene/scene_file.hpp"

namespace reckon::tools {

/// Immutable.
class ShownThresholds {
 public:
  static constexpr std::size_t kMost = 3;

  explicit ShownThresholds(const peer::SceneFile& scene) {
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

  /// The different thresholds [m], ascending; of more than kMost the least, the middle and the
  /// greatest.
  [[nodiscard]] const std::vector<double>& told() const noexcept { return told_; }
  /// Threshold of an entity by its marking [m]; none if the scene does not identify it.
  [[nodiscard]] std::optional<double> of(std::string_view marking, bool is_haptic) const {
    const auto known = entities_.find(marking);
    if (known != entities_.end()) return known->second;
    return is_haptic ? hands_ : std::nullopt;
  }

 private:
  std::optional<double> hands_;                                         // none: there are no hands
  std::map<std::string, std::optional<double>, std::less<>> entities_;  // by marking
  std::vector<double> told_;
};

}  // namespace reckon::tools
