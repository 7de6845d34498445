// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/federation/federate_bodies.hpp"

#include <algorithm>
#include <stdexcept>

#include "reckon/peer/federation/loop_side.hpp"
#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/peer/world/shared_bodies.hpp"

namespace reckon::peer {

FederateBodies::FederateBodies(LoopSide& side, const SceneFile& scene, bool may_own)
    : side_(side), scene_(scene), may_own_(may_own) {
  for (const haptics::SceneObject& object : scene.scene.objects) {
    const bool has_mass = object.matter.mass > 0 && !object.carried;
    if (!has_mass && !object.carried) continue;
    bodies_.push_back({object.name, has_mass && bodies_.size() < kMostSharedBodies});
    known_.emplace_back();
    known_.back().motion.position = object.pose.position;
    known_.back().motion.orientation = object.pose.orientation;
  }
}

BodyHandle FederateBodies::find(std::string_view name) const {
  const auto body = std::ranges::find_if(
      bodies_, [name](const Body& one) { return one.has_mass && one.name == name; });
  if (body == bodies_.end())
    throw std::invalid_argument("the scene '" + scene_.name + "' has no body '" +
                                std::string(name) +
                                "': name an [[object]] that has a mass, and no node that moves it");
  return {static_cast<std::uint32_t>(body - bodies_.begin())};
}

const std::string& FederateBodies::name_of(BodyHandle body) const {
  static_cast<void>(known(body));
  return bodies_[body.number].name;
}

const KnownBody& FederateBodies::known(BodyHandle body) const {
  if (body.number >= known_.size() || !bodies_[body.number].has_mass)
    throw std::logic_error("number " + std::to_string(body.number) +
                           " is no body of the scene: get the handle from find(name)");
  return known_[body.number];
}

void FederateBodies::acquire(BodyHandle body) {
  static_cast<void>(known(body));
  if (scene_.network.interop)
    throw std::logic_error(
        "in an interop scene the first peer keeps all bodies: use a scene without interop = true");
  if (!may_own_)
    throw std::logic_error(
        "a federate without a hand and without a number in the scene owns no bodies: set "
        "FederateOptions::scene_peer, or deal");
  side_.wishes().letter().owned.push_back({body.number, true});
}

void FederateBodies::divest(BodyHandle body) {
  static_cast<void>(known(body));
  side_.wishes().letter().owned.push_back({body.number, false});
}

bool FederateBodies::order(const haptics::BodyOrder& order) {
  if (!known({order.body}).is_ours) return false;
  side_.wishes().letter().orders.push_back(order);
  return true;
}

void FederateBodies::call_back(News& news) {
  for (const std::uint32_t body : news.refused) {
    if (refused_) refused_({body});
  }
  if (news.bodies.size() != known_.size()) return;
  std::swap(news.bodies, known_);
  for (std::uint32_t i = 0; i < known_.size(); ++i) report({i}, news.bodies[i], known_[i]);
}

void FederateBodies::report(BodyHandle body, const KnownBody& before, const KnownBody& now) const {
  if (now.is_ours != before.is_ours) {
    const auto& callback = now.is_ours ? acquired_ : lost_;
    if (callback) callback(body);
  }
  const bool is_asked = now.is_ours && now.asker != aoim::PeerId{} && now.asker != before.asker;
  if (is_asked && requested_) requested_(body, now.asker);
}

}  // namespace reckon::peer
