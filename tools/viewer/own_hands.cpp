// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/viewer/own_hands.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "reckon/deadreckon/force/force_model.hpp"
#include "reckon/tools/viewer/protocol/short_messages.hpp"

namespace reckon::tools {
namespace {

using haptics::ContactAccount;
using haptics::ServoSnapshot;

/// A spring below this share is reported as softened.
constexpr double kWhole = 0.999;

bool touches(const ContactAccount& contact) { return contact.depth > 0; }

Eigen::Vector3d hand_force(const ServoSnapshot& step) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < step.count; ++i)
    sum += step.contacts[i].force + step.contacts[i].damper_force;
  return sum;
}

static_assert(ToolMark::kMost == haptics::kMostProbes);

ToolMark tool_mark(std::uint16_t index, const ServoSnapshot& step) {
  ToolMark mark;
  mark.hand = index;
  mark.count = static_cast<std::uint16_t>(step.tool.count);
  mark.handle = step.tool.handle.cast<float>();
  mark.torque = step.tool.torque.cast<float>();
  for (std::size_t i = 0; i < step.tool.count; ++i)
    mark.probes[i] = step.tool.probes[i].cast<float>();
  return mark;
}

bool is_in_contact(const ServoSnapshot& step) {
  return step.in_mesh_contact || step.held.number > 0 ||
         std::any_of(step.contacts.begin(),
                     step.contacts.begin() + static_cast<std::ptrdiff_t>(step.count), touches);
}

}  // namespace

void OwnHands::add(std::size_t peer, const peer::HandView& view) {
  Hand& hand = hands_.emplace_back();
  hand.peer = peer;
  hand.id = view.id;
  hand.limit = std::isfinite(view.stiffness.force) ? view.stiffness.force : 0.0;
  hand.step = view.servo;
}

void OwnHands::take(std::size_t hand, const ServoSnapshot& step) {
  if (hand < hands_.size() && step.time >= hands_[hand].step.time) hands_[hand].step = step;
}

void OwnHands::take_bodies(std::span<const haptics::BodyState> bodies) {
  bodies_.clear();
  for (const haptics::BodyState& body : bodies)
    bodies_.push_back({body.position.cast<float>(), body.orientation, body.carried});
}

void OwnHands::take_owners(std::span<const peer::BodyOwnerView> owners, bool rests) {
  if (owners.empty() ||
      (owners_text_ != nullptr && rests_ == rests && std::ranges::equal(owners, owners_)))
    return;
  owners_.assign(owners.begin(), owners.end());
  rests_ = rests;
  owners_text_ = std::make_shared<const std::string>(bodies_message(owners, rests_));
}

std::vector<TouchHand> OwnHands::names() const {
  std::vector<TouchHand> names;
  for (std::size_t i = 0; i < hands_.size(); ++i)
    names.push_back({fmt::format("hand {}", i + 1), hand_.radius,
                     hands_[i].pointer_free ? "pointer" : "simulated", hands_[i].limit});
  return names;
}

void OwnHands::note_bodies() {
  for (Hand& hand : hands_) {
    const haptics::ServoTally& tally = hand.step.tally;
    const double at_bodies = tally.at_bodies + tally.grabbed;
    hand.is_at_others = std::exchange(hand.at_others, tally.bodies) < tally.bodies;
    hand.is_at_body = std::exchange(hand.at_bodies, at_bodies) < at_bodies || hand.is_at_others;
  }
}

// Whether the network may change the force of a body on this hand: another peer simulates the body,
// or a hand of another peer is at a body, which may be the same one.
bool OwnHands::shares_body(std::size_t index) const {
  const Hand& own = hands_[index];
  return own.is_at_others ||
         (own.is_at_body && std::ranges::any_of(hands_, [&own](const Hand& other) {
            return other.peer != own.peer && other.is_at_body;
          }));
}

// [N], as in DemoMeasurement: the others' full models at the true positions of their devices.
std::optional<double> OwnHands::true_force(std::size_t index) const {
  if (shares_body(index)) return std::nullopt;
  const ServoSnapshot& own = hands_[index].step;
  Eigen::Vector3d sum = own.mesh_force;
  for (std::size_t i = 0; i < hands_.size(); ++i) {
    if (hands_[i].peer == hands_[index].peer) continue;
    deadreckon::Pose pose;
    pose.position = hands_[i].step.device;
    pose.velocity = hands_[i].step.device_velocity;
    const Eigen::Vector3d force = deadreckon::evaluate(to_force_model(hand_), pose, own.device,
                                                       own.device_velocity, hand_.radius);
    // A body may be between the two hands; then they do not feel each other.
    if (!force.isZero(0.0) && (hands_[index].is_at_body || hands_[i].is_at_body))
      return std::nullopt;
    sum += force;
  }
  // The true state of entities without a hand is unknown here.
  for (std::size_t k = 0; k < own.count; ++k)
    if (touches(own.contacts[k]) && !own.contacts[k].has_device) return std::nullopt;
  return sum.norm();
}

HandMark OwnHands::mark(std::size_t index) {
  Hand& hand = hands_[index];
  const ServoSnapshot& step = hand.step;
  HandMark mark;
  mark.index = static_cast<std::uint16_t>(index);
  unsigned flags = 0;
  if (is_in_contact(step)) flags |= kHandInContact;
  if (std::min({step.spring_share, step.crowd_share, step.softening}) < kWhole)
    flags |= kHandSoftened;
  if (std::exchange(hand.rate_limited, step.tally.rate.seconds) < step.tally.rate.seconds)
    flags |= kHandRateLimited;
  const std::uint64_t force_drops = step.tally.force_drops + step.trips;
  if (std::exchange(hand.force_drops, force_drops) < force_drops ||
      (!step.enabled && !step.stopped))
    flags |= kHandLetGo;
  if (step.stopped) flags |= kHandStopped;
  if (hand.pointer_free)
    flags |= kHandPointer | (*hand.pointer_free ? unsigned{kHandPointerFree} : 0U);
  if (hand.twin && hand.twin->force) {
    flags |= kHandTwin;
    mark.twin_force = static_cast<float>(*hand.twin->force);
  }
  mark.flags = static_cast<std::uint16_t>(flags);
  mark.patch = static_cast<std::uint16_t>(step.mesh_patch);
  mark.position = step.device.cast<float>();
  mark.contact_point = step.scp.cast<float>();
  mark.force = step.force.cast<float>();
  const Eigen::Vector3d pushed = hand_force(step);
  Eigen::Vector3d normal = step.mesh_normal;
  if (!step.in_mesh_contact)
    normal = pushed.norm() > 0 ? pushed.normalized() : Eigen::Vector3d::Zero();
  mark.normal = normal.cast<float>();
  mark.energy = static_cast<float>(step.port_energy + step.oscillation_energy);
  mark.loan = static_cast<float>(step.loan + step.region_loan);
  return mark;
}

HandFrame OwnHands::frame(std::chrono::nanoseconds steady_to_utc, bool knows_all) {
  HandFrame frame;
  frame.bodies = bodies_;
  frame.owners = owners_text_;
  note_bodies();
  for (std::size_t i = 0; i < hands_.size(); ++i) {
    HandMark& hand = frame.hands.emplace_back(mark(i));
    frame.ids.push_back(hands_[i].id);
    if (hands_[i].step.tool.turns) frame.tools.push_back(tool_mark(hand.index, hands_[i].step));
    if (const auto& twin = hands_[i].twin)
      frame.twins.push_back({hand.index, twin->energy, twin->resets});
    frame.time = std::max(frame.time, hands_[i].step.time + steady_to_utc);
    if (!knows_all) continue;
    if (const auto force = true_force(i)) {
      hand.true_force = static_cast<float>(*force);
      hand.flags |= kHandTrueForce;
    }
  }
  return frame;
}

}  // namespace reckon::tools
