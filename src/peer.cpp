// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/peer.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/haptics/scene/effect_plan.hpp"
#include "reckon/haptics/servo/pressing_hands.hpp"
#include "reckon/haptics/servo/servo_loop.hpp"
#include "reckon/peer/scene/belongings.hpp"
#include "reckon/peer/tracks/entity_track.hpp"

namespace reckon::peer {
namespace {

constexpr std::size_t kShownRing = 8192;

std::chrono::nanoseconds period_of(const PeerOptions& options, const PeerDevice& device) {
  return device.period > std::chrono::nanoseconds(0) ? device.period : options.servo_period;
}

haptics::ServoConfig servo_config(const SceneFile& scene, const PeerOptions& options,
                                  const PeerDevice& device, haptics::ForceStop& stop) {
  haptics::ServoConfig config;
  config.stop = &stop;
  if (device.stop_button >= 0) config.stop_button = device.stop_button;
  config.period = period_of(options, device);
  config.device_origin = device.origin;
  config.device_orientation = device.orientation;
  config.probe_radius = scene.hand.radius;
  config.contact_radius = scene.hand.contact_radius;
  config.patch_radius = scene.hand.patch_radius;
  config.grab = scene.hand.grab;
  config.grab_buttons = std::uint32_t{1} << device.grab_button % 32;
  // A button that stops all forces cannot hold a body.
  if (device.stop_button == static_cast<int>(device.grab_button)) config.grab_buttons = 0;
  config.continuous_force = device.continuous_force;
  config.thermal_time = device.thermal_time;
  if (device.max_force_rate > 0) config.max_force_rate = device.max_force_rate;
  if (device.received_power > 0) config.max_received_power = device.received_power;
  if (device.region_loan >= 0) config.region_loan = device.region_loan;
  if (device.oscillation_power >= 0) config.oscillation_power = device.oscillation_power;
  if (device.oscillation_energy >= 0) config.oscillation_energy = device.oscillation_energy;
  config.probes = device.probes;
  config.transfer = options.transfer;
  return config;
}

// The first peer of a scene owns its bodies from the start. A program that states a body by itself
// moves it without simulation.
bool owns_first(const PeerOptions& options, std::span<const PeerDevice> devices) {
  if (!devices.empty()) return options.scene_peer <= 1;
  return options.scene_peer == 1 &&
         std::ranges::none_of(options.entities, [](const EntityConfig& entity) {
           return body_of(entity.type).has_value();
         });
}

// At all other peers the bodies begin as carried objects.
haptics::Scene felt_by(const SceneFile& scene, bool owns) {
  haptics::Scene felt = scene.scene;
  if (owns) return felt;
  for (haptics::SceneObject& object : felt.objects) object.carried |= object.matter.mass > 0;
  return felt;
}

bool has_bodies(const haptics::Scene& scene) {
  return std::ranges::any_of(scene.objects,
                             [](const auto& object) { return object.matter.mass > 0; });
}

// Any body may be carried at some time.
std::shared_ptr<BodyMover> mover_of(const haptics::Scene& scene, const SceneNodes& nodes,
                                    std::span<const PeerDevice> devices) {
  const bool has_carried = std::ranges::any_of(scene.objects, &haptics::SceneObject::carried);
  if (!has_bodies(scene) && (devices.empty() || !has_carried)) return nullptr;
  return std::make_shared<BodyMover>(haptics::EffectPlan(scene), nodes);
}

// Without a hand, nobody feels what the scene carries.
std::shared_ptr<haptics::BodyWorld> bodies_of(const haptics::Scene& scene,
                                              std::span<const PeerDevice> devices,
                                              std::shared_ptr<BodyMover> mover) {
  const auto moving = std::ranges::count_if(
      scene.objects, [](const auto& object) { return object.carried || object.matter.mass > 0; });
  if (moving > static_cast<long>(kMostSharedBodies)) {
    throw std::invalid_argument("the scene moves " + std::to_string(moving) +
                                " objects, and the limit is " + std::to_string(kMostSharedBodies) +
                                ": remove the mass of some");
  }
  if (devices.empty() && !has_bodies(scene)) return nullptr;
  return haptics::make_bodies(haptics::EffectPlan(scene), scene, std::move(mover));
}

std::vector<std::unique_ptr<haptics::ServoLoop>> make_servos(
    const SceneFile& scene, const std::shared_ptr<const haptics::EffectPlan>& plan,
    const PeerOptions& options, std::span<const PeerDevice> devices,
    const std::shared_ptr<haptics::BodyWorld>& bodies, haptics::ForceStop& stop) {
  std::vector<std::unique_ptr<haptics::ServoLoop>> servos;
  for (const PeerDevice& device : devices) {
    servos.push_back(std::make_unique<haptics::ServoLoop>(
        *device.device, plan, servo_config(scene, options, device, stop), bodies));
  }
  return servos;
}

// All servos share one plan.
std::vector<std::shared_ptr<const haptics::GuardReport>> custom_effects_of(
    const std::vector<std::unique_ptr<haptics::ServoLoop>>& servos) {
  if (servos.empty()) return {};
  return servos.front()->plan().custom_effects();
}

std::string marking_of(const PeerOptions& options, const PeerDevice& device, std::size_t index) {
  if (!device.marking.empty()) return device.marking;
  return index == 0 ? options.name : options.name + std::to_string(index + 1);
}

std::optional<UrgentRing> urgent_ring(const SceneFile& scene, DatagramRing* ring) {
  if (ring == nullptr) return {};
  return UrgentRing{*urgent_pool_of(scene), *ring};
}

// Adds the entities that follow tracks, from number `first` on. Returns the next free number.
EntityNumber add_tracked(ModelLoop& model, const PeerOptions& options, std::size_t first) {
  const std::vector<EntityTrack> tracks = tracks_of(options.entities);
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    const auto number = static_cast<EntityNumber>(first + i);
    model.add(number, description_of(options.entities[i]));
    model.follow(number, tracks[i]);
  }
  return static_cast<EntityNumber>(first + tracks.size());
}

}  // namespace

Peer::Peer(const SceneFile& scene, const PeerOptions& options, Link& link,
           std::span<const PeerDevice> devices)
    : scene_(scene),
      link_(link),
      frame_(scene.origin.latitude, scene.origin.longitude, scene.origin.height),
      pool_(pool_of(scene)),
      commands_(4 * pool_.size() + 16),
      inbound_(options.datagram_ring),
      urgent_(urgent_pool_of(scene) ? std::make_unique<DatagramRing>(options.datagram_ring)
                                    : nullptr),
      outbound_(options.datagram_ring),
      shown_(options.record_shown ? kShownRing : 2),
      force_stop_(options.force_stop != nullptr ? options.force_stop : &own_stop_),
      owns_(owns_first(options, devices) && (options.founds || scene.network.interop)),
      felt_(felt_by(scene, owns_)),
      mover_(mover_of(felt_, scene.nodes, devices)),
      bodies_(bodies_of(felt_, devices, mover_)),
      pressed_(pressed_of(options, devices)),
      servos_(make_servos(scene, pressed_.plan, options, devices, bodies_, *force_stop_)),
      servo_period_(options.servo_period),
      read_(link, commands_, inbound_, counters_, scene.network.exercise, scene.network.lenient,
            options.tap, urgent_ring(scene, urgent_.get())),
      write_(link, outbound_, counters_),
      model_({scene_,
              frame_,
              pool_,
              inbound_,
              outbound_,
              commands_,
              link_,
              options.record_shown ? &shown_ : nullptr,
              counters_,
              options.record_changes,
              &read_.muted(),
              &read_.refused(),
              options.tap,
              urgent_.get(),
              &read_.known(),
              &read_.felt(),
              bodies_.get(),
              pressed_.handless.get(),
              mover_.get(),
              pressed_.others ? &pressed_.others->hands() : nullptr,
              custom_effects_of(servos_),
              options.mechanisms},
             {{options.site, options.application},
              options.name,
              options.epoch,
              options.started,
              !devices.empty(),
              sends_bodies() ? std::uint8_t{1} : options.scene_peer,
              options.chain_secret,
              !devices.empty() || options.scene_peer > 0,
              owns_,
              options.requests_at_touch}) {
  add_hands(options, devices);
  const EntityNumber next = add_tracked(model_, options, devices.size() + 1);
  if (sends_bodies() || (bodies_ != nullptr && !scene.network.interop)) model_.add_bodies(next);
}

// In an interop exercise, hands have no force models that other peers know.
Peer::Pressed Peer::pressed_of(const PeerOptions& options,
                               std::span<const PeerDevice> devices) const {
  Pressed out;
  const bool may_press = bodies_ != nullptr && has_bodies(scene_.scene) && !scene_.network.interop;
  if (!devices.empty() || may_press) out.plan = std::make_shared<const haptics::EffectPlan>(felt_);
  if (may_press) {
    haptics::ServoConfig config;
    config.period = devices.empty() ? SteppedBodies::kPeriod : period_of(options, devices.front());
    config.contact_radius = scene_.hand.contact_radius;
    config.patch_radius = scene_.hand.patch_radius;
    config.probe_radius = scene_.hand.radius;
    config.grab = scene_.hand.grab;
    out.others =
        std::make_unique<haptics::PressingHands>(*bodies_, out.plan, config, options.body_loan);
  }
  if (bodies_ != nullptr && devices.empty())
    out.handless = std::make_unique<SteppedBodies>(*bodies_);
  return out;
}

void Peer::add_hands(const PeerOptions& options, std::span<const PeerDevice> devices) {
  for (std::size_t i = 0; i < devices.size(); ++i) {
    haptics::ServoLoop& servo = *servos_[i];
    const std::string marking = marking_of(options, devices[i], i);
    model_.add_hand(marking, servo.snapshots(), servo.contacts(), stiffness_of(servo, scene_.hand));
    servo_due_.push_back({period_of(options, devices[i])});
    servo_period_ = i == 0 ? servo_due_[0].period : std::min(servo_period_, servo_due_[i].period);
  }
}

Peer::Peer(const SceneFile& scene, const PeerOptions& options, Link& link,
           haptics::HapticDevice& device)
    : Peer(scene, options, link, std::array<PeerDevice, 1>{PeerDevice{&device, {}}}) {}

Peer::~Peer() = default;

void Peer::servo_step_of(std::size_t device, std::chrono::nanoseconds now) noexcept {
  servos_[device]->step(now);
}

void Peer::trace(haptics::TraceRing* ring, std::size_t device) noexcept {
  if (device < servos_.size()) servos_[device]->trace(ring);
}

// A servo that is due within half of the shortest period is due now, because steps come slightly
// early or late. Its next step is due one period after this one was due, so that the rate is right
// even if the shortest period does not divide its period. After a pause, it is due one period from
// now.
void Peer::servo_step(std::chrono::nanoseconds now) noexcept {
  for (std::size_t i = 0; i < servos_.size(); ++i) {
    ServoDue& due = servo_due_[i];
    const bool paces = due.period == servo_period_;
    if (!paces && now + servo_period_ / 2 < due.time) continue;
    servos_[i]->step(now);
    due.time = (now - due.time < servo_period_ ? due.time : now) + due.period;
  }
}

const haptics::EffectPlan* Peer::plan() const noexcept {
  return servos_.empty() ? nullptr : &servos_.front()->plan();
}

bool Peer::has_near_servo() noexcept {
  return std::ranges::any_of(servos_, [](const auto& servo) { return servo->has_near(); });
}

bool Peer::take_servo_news() noexcept {
  const double moved = scene_.dead_reckoning.thresholds.position / 8;
  bool any = false;
  for (const auto& servo : servos_) any = servo->take_news(moved) || any;
  return any;
}

void Peer::start(std::chrono::nanoseconds now) {
  model_.start(now);
  read_.step(now);  // joins the base group before the first datagram is sent
}

void Peer::stop(std::chrono::nanoseconds now, std::chrono::nanoseconds utc) noexcept {
  link_.settle();
  model_.report_unread();
  bool done = false;
  while (!done) {
    done = model_.stop(now, utc);
    write_.step();
  }
}

}  // namespace reckon::peer
