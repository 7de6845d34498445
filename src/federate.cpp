// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/federate.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "reckon/peer/federation/exercise_clock.hpp"
#include "reckon/peer/federation/loop_side.hpp"
#include "reckon/peer/federation/remote_objects.hpp"
#include "reckon/peer/joined_peer.hpp"
#include "reckon/peer/notation/entity_type_text.hpp"
#include "reckon/peer/scene/belongings.hpp"
#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/peer/world/addressed.hpp"
#include "reckon/peer/world/scene_position.hpp"

namespace reckon::peer {
namespace {

using std::chrono::nanoseconds;
using HearOctets = std::function<void(std::span<const std::byte>, const InteractionSender&)>;

constexpr std::size_t kLongestMarking = 11;

void check_marking(const std::string& marking) {
  const bool ascii =
      std::all_of(marking.begin(), marking.end(), [](char c) { return c >= 0x20 && c < 0x7F; });
  if (!ascii || marking.size() > kLongestMarking)
    throw std::invalid_argument("marking '" + marking + "': a marking holds " +
                                std::to_string(kLongestMarking) + " ASCII characters at most");
}

// Numbers of hands, and of the scene's entities and bodies.
std::size_t given_already(const FederateOptions& options) {
  const auto moves = [](const haptics::SceneObject& object) {
    return object.matter.mass > 0 || object.carried;
  };
  const auto bodies = std::ranges::count_if(options.scene->scene.objects, moves);
  return options.devices.size() + entities_of(*options.scene, options.scene_peer).size() +
         static_cast<std::size_t>(bodies);
}

}  // namespace

SceneHolder dis_exercise(std::uint8_t exercise, double latitude, double longitude) {
  constexpr double kFar = 1e8;  // [m], beyond satellites on the other side
  SceneFile scene;
  scene.name = "DIS exercise " + std::to_string(exercise);
  scene.origin = {latitude, longitude, 0.0};
  scene.aoim.radius = scene.aoim.cell = kFar;
  scene.network.interop = true;
  scene.network.exercise = exercise;
  return scene;
}

// The joined peer, the declarations of the program, and its callbacks.
struct Federate::Participation {
  // Over a link of its own, or of the caller.
  explicit Participation(const FederateOptions& given) : joined(checked(given), &side) { begin(); }
  Participation(const FederateOptions& given, Link& link, const Clock& time, std::uint32_t epoch)
      : joined(checked(given), link, time, epoch, &side) {
    begin();
  }

  static const FederateOptions& checked(const FederateOptions& given) {
    check_marking(given.name);
    return given;
  }
  void begin() {
    simulation = joined.peer().model().owned().simulation();
    side.listen_for(pdu::PduType::start_resume);
    side.listen_for(pdu::PduType::stop_freeze);
    joined.run();
  }
  [[nodiscard]] const FederateOptions& options() const noexcept { return joined.options(); }

  // Whether an object may be changed: one that was registered and not deleted, or a hand.
  void check(ObjectHandle object, bool or_hand) const {
    const bool registered = object.number < alive.size() && alive[object.number];
    const bool hand = object.number > 0 && object.number <= options().devices.size();
    if (registered || (hand && or_hand)) return;
    throw std::logic_error(
        "object " + std::to_string(object.number) +
        (hand ? " is a hand and follows its device" : " is not registered, or was deleted"));
  }

  // Sends the requests of this thread to the loop, unless it still processes the last ones.
  void post() {
    if (side.wishes().letter().empty() || !side.wishes().is_free()) return;
    side.wishes().send();
    if (joined.threads() != nullptr) joined.threads()->wake();
  }
  [[nodiscard]] Wishes& wishes() { return side.wishes().letter(); }

  // Orders to start and to stop set the exercise's time.
  void set_time(std::span<const std::byte> octets, nanoseconds utc) {
    const auto means_us = [&](const pdu::EntityId& receiver) {
      return is_addressed(receiver, simulation.simulation()) && is_whole(receiver);
    };
    pdu::StartResume start;
    pdu::StopFreeze stop;
    if (pdu::decode(octets, start) == pdu::DecodeError::none) {
      if (means_us(start.receiving_entity_id)) exercise_clock.take(start, utc);
    } else if (pdu::decode(octets, stop) == pdu::DecodeError::none) {
      if (means_us(stop.receiving_entity_id)) exercise_clock.take(stop, utc);
    }
  }

  [[nodiscard]] bool is_subscribed(const pdu::EntityType& type) const {
    return std::any_of(subscribed.begin(), subscribed.end(),
                       [&](const EntityClass& entities) { return entities.contains(type); });
  }

  LoopSide side;
  JoinedPeer joined;
  FederateBodies bodies{side, *options().scene,
                        !options().devices.empty() || options().scene_peer > 0};
  FederateRecords records{side, options().scene->network.interop};
  EntityNumbers numbers{given_already(joined.options())};
  std::vector<bool> alive;  // registered and not deleted, by number
  std::uint64_t dropped = 0, messages = 0;
  std::vector<EntityClass> published, subscribed;
  std::vector<pdu::PduType> published_interactions;
  std::map<pdu::PduType, HearOctets> interactions;
  std::function<void(const RemoteObject&)> discovered, reflected;
  std::function<void(const RemoteObject&, Removal)> removed;
  std::function<void(const UndeliveredMessage&)> undelivered;
  RemoteObjects objects;
  ExerciseClock exercise_clock;
  nanoseconds utc_ahead{0};  // of now
  bool heard_news = false;
  pdu::EntityId simulation;
  bool resigned = false;
};

Federate::Federate(const FederateOptions& options)
    : participation_(std::make_unique<Participation>(options)) {}

Federate::Federate(const FederateOptions& options, Link& link, const Clock& clock,
                   std::uint32_t epoch)
    : participation_(std::make_unique<Participation>(options, link, clock, epoch)) {}

Federate::~Federate() { resign(); }

void Federate::resign() {
  Participation& s = *participation_;
  if (s.resigned) return;
  s.resigned = true;
  s.post();
  s.joined.leave_bodies();
  s.joined.stop_loops();
  // Executes the last requests: the loop may have one letter with requests, the program another.
  for (int letter = 0; letter < 2; ++letter) {
    s.post();
    const Clock& clock = s.joined.clock();
    s.joined.peer().model_step(clock.now(), clock.utc_now());
    s.joined.peer().write_step();
  }
  s.joined.resign();
}

void Federate::begin_resign() noexcept { participation_->joined.peer().begin_leaving(); }

bool Federate::can_resign() const noexcept { return participation_->joined.peer().has_left(); }

// Publish and subscribe ---------------------------------------------------------------------------

void Federate::publish(const EntityClass& entities) {
  participation_->published.push_back(entities);
}

void Federate::subscribe(const EntityClass& entities) {
  participation_->subscribed.push_back(entities);
}

void Federate::publish_interaction(pdu::PduType type) {
  participation_->published_interactions.push_back(type);
}

void Federate::subscribe_interaction(pdu::PduType type, HearOctets callback) {
  participation_->interactions[type] = std::move(callback);
  participation_->side.listen_for(type);
}

void Federate::on_discover(std::function<void(const RemoteObject&)> callback) {
  participation_->discovered = std::move(callback);
}

void Federate::on_reflect(std::function<void(const RemoteObject&)> callback) {
  participation_->reflected = std::move(callback);
}

void Federate::on_remove(std::function<void(const RemoteObject&, Removal)> callback) {
  participation_->removed = std::move(callback);
}

void Federate::on_undelivered(std::function<void(const UndeliveredMessage&)> callback) {
  participation_->undelivered = std::move(callback);
}

// Our entities ------------------------------------------------------------------------------------

ObjectHandle Federate::register_object(const EntityDescription& description,
                                       const EntityTruth& truth) {
  Participation& s = *participation_;
  const bool published =
      std::any_of(s.published.begin(), s.published.end(),
                  [&](const EntityClass& entities) { return entities.contains(description.type); });
  if (!published)
    throw std::logic_error("entity type " + entity_type_numbers(description.type) +
                           " is not published: call publish(EntityClass{type}) first");
  check_marking(description.marking);
  const auto number = s.numbers.take();
  if (!number)
    throw std::length_error(
        "a federate owns " + std::to_string(kMostOwned) +
        " entities at most: join another federate with another application number");
  s.alive.resize(std::max(s.alive.size(), std::size_t{*number} + 1));
  s.alive[*number] = true;
  s.wishes().registered.push_back({*number, description});
  s.wishes().moved.push_back({*number, truth});
  return {*number};
}

void Federate::update_attributes(ObjectHandle object, const EntityTruth& truth) {
  participation_->check(object, false);
  participation_->wishes().moved.push_back({object.number, truth});
}

void Federate::update_appearance(ObjectHandle object, std::uint32_t appearance) {
  participation_->check(object, true);
  participation_->wishes().appearances.push_back({object.number, appearance});
}

void Federate::update_parts(ObjectHandle object, const deadreckon::PartState& parts) {
  participation_->check(object, true);
  participation_->wishes().parts.push_back({object.number, parts});
}

void Federate::delete_object(ObjectHandle object) {
  participation_->check(object, false);
  participation_->alive[object.number] = false;
  participation_->wishes().removed.push_back(object.number);
  participation_->numbers.give_back(object.number);
}

pdu::EntityId Federate::id_of(ObjectHandle object) const noexcept {
  pdu::EntityId id = participation_->simulation;
  id.entity = object.number;
  return id;
}

ObjectHandle Federate::hand(std::size_t index) const noexcept {
  return {
      static_cast<EntityNumber>(index < participation_->options().devices.size() ? index + 1 : 0)};
}

haptics::ForceStop& Federate::force_stop() noexcept {
  return participation_->joined.peer().force_stop();
}

// The entities of others --------------------------------------------------------------------------

std::size_t Federate::size() const noexcept { return participation_->objects.rows().size(); }

RemoteObject Federate::object_at(std::size_t index) const noexcept {
  return RemoteObject(participation_->objects.rows()[index]);
}

std::optional<RemoteObject> Federate::find(const pdu::EntityId& id) const {
  const RemoteCopy* copy = participation_->objects.find(id);
  return copy == nullptr ? std::nullopt : std::optional(RemoteObject(*copy));
}

// Bodies ------------------------------------------------------------------------------------------

FederateBodies& Federate::bodies() noexcept {
  participation_->side.read_bodies();
  return participation_->bodies;
}

FederateRecords& Federate::records() noexcept { return participation_->records; }

void Federate::go_alone() { participation_->joined.peer().go_alone(); }

// Interactions ------------------------------------------------------------------------------------

MessageHandle Federate::send_octets(const SendOptions& sending, std::span<const std::byte> octets,
                                    const std::optional<Eigen::Vector3d>& place) {
  const pdu::PduType type = sending.type;
  const auto& published = participation_->published_interactions;
  if (std::find(published.begin(), published.end(), type) == published.end())
    throw std::logic_error("PDU type " + std::to_string(static_cast<int>(type)) +
                           " is not published: call publish<pdu::Type>() first");
  const bool is_assured = sending.delivery == Delivery::assured;
  const bool is_ordered = sending.order != Order::none;
  check_order(sending.delivery, sending.order);
  if (is_assured)
    check_assured(type, octets.size(), participation_->options().scene->network.interop);
  Wishes& wishes = participation_->wishes();
  std::optional<aoim::Position> at;
  if (place) at = to_position(*place);
  const MessageHandle message{is_assured ? ++participation_->messages : 0};
  wishes.said.push_back({wishes.octets.size(), octets.size(), at,
                         is_assured ? message_tag(message, type) : 0, is_ordered});
  wishes.octets.insert(wishes.octets.end(), octets.begin(), octets.end());
  return message;
}

std::uint64_t Federate::dropped_interactions() const noexcept { return participation_->dropped; }

std::uint8_t Federate::exercise() const noexcept {
  return participation_->options().scene->network.exercise;
}

// Time and place ----------------------------------------------------------------------------------

nanoseconds Federate::now() const noexcept { return participation_->joined.clock().now(); }

nanoseconds Federate::utc() const noexcept {
  return participation_->heard_news ? now() + participation_->utc_ahead
                                    : participation_->joined.clock().utc_now();
}

nanoseconds Federate::exercise_time() const noexcept {
  return participation_->exercise_clock.at(utc());
}

const deadreckon::LocalFrame& Federate::frame() const noexcept {
  return participation_->joined.peer().frame();
}

Eigen::Vector3d Federate::scene_position(const Eigen::Vector3d& world) const noexcept {
  return frame().scene_from_world(world);
}

EntityTruth Federate::place(double latitude, double longitude, double height,
                            double heading) const {
  const deadreckon::LocalFrame there(latitude, longitude, height);
  // North, east, down to east, north, up, after the turn about down.
  const Eigen::Quaterniond level(0.0, std::sqrt(0.5), std::sqrt(0.5), 0.0);
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(heading, Eigen::Vector3d::UnitZ()));
  EntityTruth truth;
  truth.position = frame().scene_from_world(there.origin());
  truth.orientation = frame().scene_from_world(there.world_from_scene(level * turn));
  return truth;
}

// Running -----------------------------------------------------------------------------------------

void Federate::step() {
  Participation& s = *participation_;
  if (s.resigned) return;
  s.post();
  if (s.options().loops == FederateLoops::in_step) s.joined.pass();
  News* news = s.side.news().take();
  if (news == nullptr) return;
  s.simulation = news->simulation;
  s.dropped = news->dropped;
  s.utc_ahead = news->utc - news->now;
  s.heard_news = true;
  call_back(*news);
  news->clear();
  s.side.news().give_back();
}

void Federate::call_back(News& news) {
  Participation& s = *participation_;
  for (const News::Removed& gone : news.removed) {
    const RemoteCopy* known = s.objects.find(gone.id);
    if (known == nullptr) continue;
    const RemoteCopy last = *known;
    s.objects.erase(gone.id);
    if (s.removed) s.removed(RemoteObject(last), gone.cause);
  }
  for (const RemoteCopy& copy : news.states) {
    if (!s.is_subscribed(copy.entity().type)) continue;
    const bool added = s.objects.put(copy);
    const auto& callback = added ? s.discovered : s.reflected;
    if (callback) callback(RemoteObject(copy));
  }
  for (const News::Heard& heard : news.heard) {
    const std::span<const std::byte> octets =
        std::span<const std::byte>(news.octets).subspan(heard.offset, heard.size);
    const auto interaction = s.interactions.find(heard.type);
    s.set_time(octets, utc());
    if (interaction != s.interactions.end()) interaction->second(octets, heard.sender);
  }
  s.bodies.call_back(news);
  s.records.call_back(news);
  report_undelivered(news.undelivered, s.undelivered);
}

JoinedPeer& Federate::joined() noexcept { return participation_->joined; }
Peer& Federate::peer() noexcept { return joined().peer(); }

}  // namespace reckon::peer
