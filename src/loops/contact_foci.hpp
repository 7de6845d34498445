// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// From how far away what is ours can be touched, and hence whose contact groups this peer listens
// to. Part of the model loop.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "reckon/aoim/interest/focus_cover.hpp"
#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/peer/world/owned_entity.hpp"

namespace reckon::peer {

/// How far from an entity's surface the contact groups of cells are listened to [m], for a probe of
/// this radius: that of contact, and as far as another hand comes while a group is joined.
[[nodiscard]] double contact_reach(const HandModel& hand) noexcept;

/// The foci for AreaOfInterestManager::listen(). One thread; allocates where there are
/// more than ever before. Some 50 ns for each entity that hands feel.
class ContactFoci {
 public:
  /// @param scene outlives this
  explicit ContactFoci(const SceneFile& scene);

  void clear() noexcept { balls_.clear(); }
  /// One of ours; what nobody feels is passed over. A plane is felt as far as its owner senses.
  void add(const OwnedEntity& entity);
  /// Where something of others is that one of ours could touch, however large it is.
  void add_near(const Eigen::Vector3d& position);
  /// Good until the next call.
  [[nodiscard]] std::span<const aoim::Focus> foci() noexcept { return cover_.cover(balls_); }

 private:
  const SceneFile& scene_;
  std::vector<aoim::Focus> balls_;
  aoim::FocusCover cover_;
};

}  // namespace reckon::peer
