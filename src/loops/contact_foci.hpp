// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The distance at which our entities can be touched, and from it the contact groups that this peer
// subscribes to. Part of the model loop.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "reckon/aoim/interest/focus_cover.hpp"
#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/peer/world/owned_entity.hpp"

namespace reckon::peer {

/// Distance from an entity's surface within which the contact groups of cells are subscribed to
/// [m], for a probe of this radius: the reach of contact, plus the path of another hand while a
/// group is being joined.
[[nodiscard]] double contact_reach(const HandModel& hand) noexcept;

/// The foci for AreaOfInterestManager::listen(). One thread; allocates if there are more than ever
/// before. Some 50 ns for each felt entity.
class ContactFoci {
 public:
  /// @param scene outlives this
  explicit ContactFoci(const SceneFile& scene);

  void clear() noexcept { balls_.clear(); }
  /// Adds an entity of ours if it can be felt. A plane is felt as far as its owner senses.
  void add(const OwnedEntity& entity);
  /// Adds the position of a remote entity that one of ours could touch, regardless of its size.
  void add_near(const Eigen::Vector3d& position);
  /// Valid until the next call.
  [[nodiscard]] std::span<const aoim::Focus> foci() noexcept { return cover_.cover(balls_); }

 private:
  const SceneFile& scene_;
  std::vector<aoim::Focus> balls_;
  aoim::FocusCover cover_;
};

}  // namespace reckon::peer
