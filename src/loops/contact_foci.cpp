// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/contact_foci.hpp"

#include <algorithm>

#include "reckon/peer/scene/scene_cells.hpp"
#include "reckon/peer/world/near_search.hpp"
#include "reckon/peer/world/scene_position.hpp"

namespace reckon::peer {
namespace {

constexpr double kJoin = 0.1;  // [s], with a margin; see aoim::SubscriptionConfig::lookahead

}  // namespace

double contact_reach(const HandModel& hand) noexcept {
  return kContactReach + hand.radius + kJoin * NearSearch::kHandSpeed;
}

ContactFoci::ContactFoci(const SceneFile& scene) : scene_(scene), cover_(cells_of(scene.aoim)) {}

void ContactFoci::add(const OwnedEntity& entity) {
  const TouchSide* touch = entity.touch();
  if (touch == nullptr || touch->model().kind == pdu::ForceModelKind::none) return;
  const deadreckon::ForceModel& model = touch->model();
  const bool is_endless = model.kind == pdu::ForceModelKind::plane;
  const double size = is_endless ? scene_.aoim.radius : model.point.norm() + model.radius;
  const double radius = std::min(size + contact_reach(scene_.hand), scene_.aoim.radius);
  const EntityTruth& truth = entity.truth();
  balls_.push_back({to_position(truth.position), truth.velocity.norm(), radius});
}

void ContactFoci::add_near(const Eigen::Vector3d& position) {
  balls_.push_back({to_position(position), 0.0, contact_reach(scene_.hand)});
}

}  // namespace reckon::peer
