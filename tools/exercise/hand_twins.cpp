// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/exercise/hand_twins.hpp"

#include <algorithm>
#include <deque>
#include <stdexcept>
#include <utility>

#include "reckon/tools/exercise/twin_line.hpp"

namespace reckon::tools {
namespace {

using haptics::HandMotion;
using std::chrono::nanoseconds;

haptics::ServoConfig servo_config(const peer::SceneFile& scene, const PointerHand& hand,
                                  nanoseconds period) {
  haptics::ServoConfig config;
  config.period = period;
  config.device_origin = hand.origin;
  config.device_orientation = hand.orientation;
  config.probe_radius = scene.hand.radius;
  config.contact_radius = scene.hand.contact_radius;
  config.patch_radius = scene.hand.patch_radius;
  return config;
}

/// [m], as for hands in contact: the position error that causes the scene's force error.
double threshold_of(const peer::SceneFile& scene) {
  const deadreckon::Thresholds& thresholds = scene.dead_reckoning.thresholds;
  return std::min(thresholds.position, thresholds.force / std::max(scene.hand.k1, 1e-9));
}

haptics::ContactRing& contacts_of(Exercise& exercise, std::size_t peer, std::size_t device) {
  haptics::ContactRing* contacts = exercise.contacts(peer, device);
  if (contacts == nullptr)
    throw std::logic_error("twins of hands need ExerciseOptions::trace_contacts");
  return *contacts;
}

}  // namespace

struct HandTwins::Twin {
  Twin(std::size_t of_peer, const PointerHand& pointer,
       std::unique_ptr<haptics::SimulatedDevice> made,
       std::shared_ptr<const haptics::EffectPlan> plan, const peer::SceneFile& scene,
       Exercise& exercise)
      : peer(of_peer),
        device(pointer.device),
        held(std::move(made)),
        inbox(*pointer.inbox),
        recorder(exercise.clock()),
        contacts(contacts_of(exercise, of_peer, device)),
        twin(*held, std::move(plan),
             servo_config(scene, pointer, exercise.peer(of_peer).servo_period_of(device))),
        teller(threshold_of(scene)) {}

  std::size_t peer, device;
  std::unique_ptr<haptics::SimulatedDevice> held;
  haptics::PointerInbox& inbox;  // of `held`
  PointerRecorder recorder;
  haptics::ContactRing& contacts;
  haptics::ContactSet received;
  bool is_changed = false;  // whether `received` changed since the last step of the twin
  haptics::UngatedTwin twin;
  std::deque<HandMotion> steps;  // of the hand, not yet done by the twin
  TwinTeller teller;
  std::uint64_t told = 0;
  std::vector<TwinLine> lines;  // one from each twin
};

HandTwins::HandTwins(const peer::SceneFile& scene, Exercise& exercise)
    : exercise_(exercise),
      begun_(exercise.clock().now()),
      hand_(to_force_model(scene.hand)),
      seed_(scene.impairment.seed) {
  const auto plan = std::make_shared<const haptics::EffectPlan>(scene.scene);
  if (plan->has_moving()) return;  // bodies exist once, and the real hands push them
  for (std::size_t peer = 0; peer < exercise.size(); ++peer) {
    SimulatedHands hands = make_simulated_hands(scene, static_cast<std::uint32_t>(peer + 1));
    for (const PointerHand& pointer : hands.pointers) {
      if (twins_.size() == kMost) break;
      twins_.push_back(std::make_unique<Twin>(peer, pointer, std::move(hands.devices[pointer.held]),
                                              plan, scene, exercise));
    }
  }
  for (const auto& twin : twins_) twin->lines.resize(twins_.size());
  impair(scene.impairment.law);
}

HandTwins::~HandTwins() = default;

void HandTwins::impair(const peer::ImpairmentLaw& law) {
  networks_.clear();
  for (std::size_t i = 0; i < twins_.size(); ++i)
    networks_.emplace_back(law, peer::direction_seed(seed_, i));
}

void HandTwins::change_impairment(const peer::ImpairmentLaw& law) {
  const std::scoped_lock lock(mutex_);
  new_law_ = law;
}

void HandTwins::take_law() {
  const std::scoped_lock lock(mutex_);
  if (new_law_) impair(*std::exchange(new_law_, std::nullopt));
}

void HandTwins::take(std::size_t peer, std::size_t device, const haptics::ServoSnapshot& step) {
  Twin* twin = twin_of(peer, device);
  if (twin == nullptr) return;
  take_law();
  twin->steps.push_back({step.time, step.device, step.device_velocity});
  while (Twin* due = next()) this->step(*due);
}

// The twin with the earliest step, once every twin has one. If one hand stops reporting, the others
// wait for kMostWaiting steps at most.
HandTwins::Twin* HandTwins::next() const noexcept {
  Twin* first = nullptr;
  bool is_complete = true;
  std::size_t most = 0;
  for (const auto& twin : twins_) {
    most = std::max(most, twin->steps.size());
    if (twin->steps.empty()) {
      is_complete = false;
    } else if (first == nullptr || twin->steps.front().time < first->steps.front().time) {
      first = twin.get();
    }
  }
  return is_complete || most > kMostWaiting ? first : nullptr;
}

void HandTwins::step(Twin& twin) {
  const HandMotion real = twin.steps.front();
  twin.steps.pop_front();
  twin.recorder.play(real.time, twin.inbox);
  take_contacts(twin, real.time);
  for (TwinLine& line : twin.lines) twin.is_changed |= line.receive(real.time);
  if (std::exchange(twin.is_changed, false)) show_contacts(twin);
  twin.twin.step(real);
  look_for_lost(twin);
  report_others(twin);
}

// All are reset together: if only one were, its energy account would keep its exchange with the
// others.
void HandTwins::look_for_lost(const Twin& twin) {
  const bool is_lost = twin.twin.resets() > resets_;
  if (!is_lost && energy() >= -kMostMade) return;
  ++resets_;
  for (const auto& one : twins_)
    if (one->twin.resets() < resets_) one->twin.stand_aside();
}

double HandTwins::energy() const noexcept {
  double sum = 0;
  for (const auto& twin : twins_) sum += twin->twin.energy();
  return sum;
}

void HandTwins::take_contacts(Twin& twin, nanoseconds now) const {
  for (const haptics::TimedContactSet* next = twin.contacts.front();
       next != nullptr && next->time <= now; next = twin.contacts.front()) {
    twin.received = next->set;
    twin.is_changed = true;
    twin.contacts.pop();
  }
}

// A model that its sender has softened for lack of energy is shown at full stiffness: a raw
// coupling keeps no energy account.
void HandTwins::show_contacts(Twin& twin) const {
  haptics::ContactSet set = twin.received;
  for (std::size_t i = 0; i < set.count; ++i) {
    haptics::RemoteHand& hand = set.hands[i];
    const auto index = index_of(hand.id);
    if (!index) continue;
    const auto& last = twin.lines[*index].last();
    if (!last) continue;
    const Twin& other = *twins_[*index];
    const auto& shown = exercise_.view(other.peer).hands[other.device].stiffness;
    hand.state = last->state;
    hand.state_time = last->time;
    hand.model.k1 = std::min(hand_.k1, shown.hands);
    hand.model.k3 = hand_.k3;
    hand.model.point.setZero();
  }
  twin.twin.take(set);
}

void HandTwins::report_others(Twin& twin) {
  const auto update = twin.teller.tell(twin.twin.motion());
  if (!update) return;
  const auto own = static_cast<std::size_t>(
      std::ranges::find_if(twins_, [&](const auto& one) { return one.get() == &twin; }) -
      twins_.begin());
  for (std::size_t i = 0; i < twins_.size(); ++i) {
    if (i == own) continue;
    peer::Fate fate = networks_[i].decide(own, twin.told, update->time - begun_);
    if (twins_[i]->peer == twin.peer) fate = {};  // no network between them
    for (std::size_t copy = 0; copy < fate.copies; ++copy)
      twins_[i]->lines[own].send(*update, update->time + fate.delay.at(copy));
  }
  ++twin.told;
}

std::optional<std::size_t> HandTwins::index_of(const pdu::EntityId& id) const noexcept {
  for (std::size_t i = 0; i < twins_.size(); ++i) {
    const peer::PeerView& view = exercise_.view(twins_[i]->peer);
    if (twins_[i]->device < view.hand_count && view.hands[twins_[i]->device].id == id) return i;
  }
  return std::nullopt;
}

const haptics::UngatedTwin* HandTwins::find(std::size_t peer, std::size_t device) const noexcept {
  const Twin* twin = twin_of(peer, device);
  return twin == nullptr ? nullptr : &twin->twin;
}

PointerHand HandTwins::followed(std::size_t peer, const PointerHand& pointer) const noexcept {
  PointerHand followed = pointer;
  if (Twin* twin = twin_of(peer, pointer.device)) followed.recorder = &twin->recorder;
  return followed;
}

HandTwins::Twin* HandTwins::twin_of(std::size_t peer, std::size_t device) const noexcept {
  const auto found = std::ranges::find_if(twins_, [&](const std::unique_ptr<Twin>& twin) {
    return twin->peer == peer && twin->device == device;
  });
  return found == twins_.end() ? nullptr : found->get();
}

}  // namespace reckon::tools
