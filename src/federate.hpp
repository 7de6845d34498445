// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The interface of the library: the terms of HLA over DIS packets. A program states the true motion
// of its entities, at any rate. The library decides which updates are sent, when, and to which
// peers. The program reads the entities of others at any instant, and sends and receives
// interactions.
#pragma once

#include <Eigen/Core>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "reckon/haptics/exchange/force_stop.hpp"
#include "reckon/pdu/codec/codec.hpp"
#include "reckon/peer/federate_options.hpp"
#include "reckon/peer/federation/delivery.hpp"
#include "reckon/peer/federation/entity_class.hpp"
#include "reckon/peer/federation/federate_bodies.hpp"
#include "reckon/peer/federation/federate_records.hpp"
#include "reckon/peer/federation/remote_object.hpp"
#include "reckon/peer/notation/entity_type_text.hpp"
#include "reckon/peer/world/entity_description.hpp"
#include "reckon/peer/world/interaction_sender.hpp"
#include "reckon/peer/world/removal.hpp"

namespace reckon::deadreckon {
class LocalFrame;
struct PartState;
}  // namespace reckon::deadreckon

namespace reckon::peer {

class Clock;
class JoinedPeer;
class Link;
class Peer;
struct News;

/// A scene for plain DIS: every entity within 1,000 km of `latitude`, `longitude` [rad] is shown,
/// all PDUs go to one multicast group, and other DIS programs can take part.
[[nodiscard]] SceneHolder dis_exercise(std::uint8_t exercise, double latitude = 0.0,
                                       double longitude = 0.0);

/// An entity that a federate has registered.
struct ObjectHandle {
  EntityNumber number = 0;
  friend constexpr bool operator==(const ObjectHandle&, const ObjectHandle&) = default;
};

/// A federate: joins at construction, resigns at destruction.
///
///   peer::FederateOptions options;
///   options.scene = peer::dis_exercise(1, 0.82, 0.145);
///   peer::Federate federate(options);
///   federate.publish(peer::EntityClass{truck.type});
///   const peer::ObjectHandle handle =
///       federate.register_object(truck, federate.place(0.82, 0.145));
///   federate.subscribe<pdu::Fire>([](const pdu::Fire& fire) { ... });
///   for (;;) federate.update_attributes(handle, true_motion()), federate.step(), sleep();
///
/// One thread of the program calls all functions. Callbacks run inside step() on that thread. They
/// may call any function except step() and resign(). Frame S (east, north, up at the scene's
/// origin), SI units.
class Federate {
 public:
  /// Joins over UDP multicast. @throws SceneFileError, StepTooDear, std::invalid_argument,
  /// std::runtime_error or std::system_error with the value and the remedy.
  explicit Federate(const FederateOptions& options);
  /// The same with a link and a clock of the caller, for tests and simulated time. Both must
  /// outlive the federate. @param epoch identifies this run of the peer: not 0, and different for
  /// each run
  Federate(const FederateOptions& options, Link& link, const Clock& clock, std::uint32_t epoch);
  ~Federate();
  Federate(const Federate&) = delete;
  Federate& operator=(const Federate&) = delete;

  /// Leaves the exercise: gives its bodies to other federates, sends pending PDUs, deactivates all
  /// own entities, and announces the end of the peer. After that only const functions may be
  /// called. The bodies take some 0.2 s, at most 1.5 s. With a link of the caller or
  /// FederateLoops::by_hand it cannot wait for that: see begin_resign().
  void resign();
  /// Begins to give its bodies away. Optional: where resign() cannot wait, others adopt the bodies
  /// some seconds later, unless the caller steps on.
  ///
  ///   federate.begin_resign();
  ///   while (!federate.can_resign() && now() < end) advance_time(), federate.step();
  ///   federate.resign();
  void begin_resign() noexcept;
  /// Whether they are given away. At the latest 1.5 s later it will not come true any more.
  [[nodiscard]] bool can_resign() const noexcept;

  // Publish and subscribe -------------------------------------------------------------------------

  /// Entities of this class may be registered.
  void publish(const EntityClass& entities);
  /// Interactions of this type may be sent.
  template <pdu::Pdu T>
  void publish() {
    publish_interaction(T::kPduType);
  }
  /// Entities of this class are discovered, reflected and removed from now on, and no others.
  void subscribe(const EntityClass& entities);
  /// Calls back with each interaction of this type and its sender. A PDU whose issuing entity
  /// belongs to another sender is refused, counted (`interactions_refused`) and reported.
  /// `sender.owns` is true if the issuing entity belongs to the sender, and false if it has no
  /// known owner. A second call replaces the first.
  ///
  ///   federate.subscribe<pdu::Fire>([](const pdu::Fire& fire, const peer::InteractionSender& by) {
  ///     if (by.owns) take_damage(fire);
  ///   });
  template <pdu::Pdu T>
  void subscribe(std::function<void(const T&, const InteractionSender&)> callback) {
    subscribe_interaction(T::kPduType, [callback](std::span<const std::byte> octets,
                                                  const InteractionSender& sender) {
      T message;
      if (pdu::decode(octets, message) == pdu::DecodeError::none) callback(message, sender);
    });
  }
  /// The same without the sender.
  template <pdu::Pdu T>
  void subscribe(std::function<void(const T&)> callback) {
    subscribe<T>(std::function<void(const T&, const InteractionSender&)>(
        [callback](const T& message, const InteractionSender&) { callback(message); }));
  }
  void on_discover(std::function<void(const RemoteObject&)> callback);
  /// Calls back after each step() with updates, once for each updated entity.
  void on_reflect(std::function<void(const RemoteObject&)> callback);
  /// Calls back with each removed entity, in its last state, and the reason. Its ID is then
  /// unknown, and may be discovered again later. The object is valid within the callback.
  ///
  ///   federate.on_remove([](const peer::RemoteObject& object, peer::Removal cause) {
  ///     log(object.marking(), cause == peer::Removal::silent ? "fell silent" : "is gone");
  ///   });
  void on_remove(std::function<void(const RemoteObject&, Removal)> callback);
  /// Calls back with each assured interaction that some peers did not get, and the reason for each.
  /// More than once for an interaction whose peers fail at different times.
  ///
  ///   federate.on_undelivered([&](const peer::UndeliveredMessage& lost) {
  ///     if (lost.message == shot) log(lost.peers.size(), "peers did not get the shot");
  ///   });
  void on_undelivered(std::function<void(const UndeliveredMessage&)> callback);

  // Own entities ----------------------------------------------------------------------------------
  // For an object that is not registered or is deleted they throw std::logic_error.

  /// @param truth its true state; without a time: now. A default truth (all zero) is at the origin.
  /// @throws std::logic_error if its class is not published, std::length_error if kMostOwned are
  /// registered, std::invalid_argument for a marking that is too long or not ASCII
  ObjectHandle register_object(const EntityDescription& description, const EntityTruth& truth);
  /// States its true motion, at any rate. Between two calls the last truth is extrapolated.
  /// @param truth without a time: now. A truth that is not finite or older than the last is
  /// ignored.
  void update_attributes(ObjectHandle object, const EntityTruth& truth);
  /// Appearance bits as on the wire; a change is sent at once.
  void update_appearance(ObjectHandle object, std::uint32_t appearance);
  /// Articulated parts (deadreckon/motion/articulation.hpp); sent if the error at peers exceeds the
  /// threshold.
  void update_parts(ObjectHandle object, const deadreckon::PartState& parts);
  /// Deletes it: its last Entity State has the deactivated bit.
  void delete_object(ObjectHandle object);
  /// Its present ID. Site and application change if this peer loses an identity conflict.
  [[nodiscard]] pdu::EntityId id_of(ObjectHandle object) const noexcept;
  /// The hand that device `index` of the options moves, counted from 0.
  [[nodiscard]] ObjectHandle hand(std::size_t index) const noexcept;
  /// The software stop of this federate: takes the force off all its hands while it is pressed,
  /// from the next servo step on. The returned object lives as long as the federate, and any thread
  /// or signal handler may use it.
  ///
  ///   federate.force_stop().press(haptics::StopCause::program);
  [[nodiscard]] haptics::ForceStop& force_stop() noexcept;

  // The entities of others ------------------------------------------------------------------------

  /// Nothing for an unknown entity or a class without subscription. Valid until the next step().
  [[nodiscard]] std::optional<RemoteObject> find(const pdu::EntityId& id) const;
  /// Calls visit(RemoteObject) for all.
  void for_each(auto&& visit) const {
    for (std::size_t i = 0; i < size(); ++i) visit(object_at(i));
  }
  [[nodiscard]] std::size_t size() const noexcept;

  // Bodies ----------------------------------------------------------------------------------------

  /// The bodies of the scene: their ownership and motion. Registered entities have no other owner.
  [[nodiscard]] FederateBodies& bodies() noexcept;
  /// Goes on without the other federates, if this one receives too few of them and its bodies
  /// therefore rest: it owns all bodies then. When they meet again, the older world counts.
  void go_alone();

  // Records ---------------------------------------------------------------------------------------

  /// Records that are equal at all federates, whoever joins, leaves or is cut off.
  [[nodiscard]] FederateRecords& records() noexcept;

  // Interactions ----------------------------------------------------------------------------------

  /// Sends any PDU, with exercise and timestamp filled in. A PDU with a world location (Fire,
  /// Detonation) goes to peers that can sense the place, any other PDU to all peers.
  /// An assured one goes to all joined peers whatever its place, and on_undelivered() reports each
  /// peer that does not get it. Peers take it once: as it arrives, or with Order::per_source in the
  /// order in which this federate sent those interactions. resign() ends the repeats.
  ///
  ///   const peer::MessageHandle shot = federate.send(fire, peer::Delivery::assured);
  ///   federate.send(door_opens, peer::Delivery::assured, peer::Order::per_source);
  ///
  /// @throws std::logic_error if its type is not published, or if an order is given with
  /// Delivery::best_effort; for an assured one also as check_assured() does: interop scene, Entity
  /// State, Attribute, more than 1,200 octets
  template <pdu::Pdu T>
  MessageHandle send(T message, Delivery delivery = Delivery::best_effort,
                     Order order = Order::none) {
    message.header.exercise_id = exercise();
    std::optional<Eigen::Vector3d> place;
    if constexpr (requires { message.location_in_world_coordinates; }) {
      const auto& at = message.location_in_world_coordinates;
      place = scene_position({at.x, at.y, at.z});
    }
    std::vector<std::byte> octets(pdu::wire_size(message));
    octets.resize(pdu::encode(message, octets));
    return send_octets({T::kPduType, delivery, order}, octets, place);
  }

  /// Interactions that were lost because step() was not called: at most 8 MiB of them are pending.
  [[nodiscard]] std::uint64_t dropped_interactions() const noexcept;

  // Time and place --------------------------------------------------------------------------------

  /// Steady time; the argument of RemoteObject::shown().
  [[nodiscard]] std::chrono::nanoseconds now() const noexcept;
  /// UTC since 1970, without the discontinuities of the host's clock.
  [[nodiscard]] std::chrono::nanoseconds utc() const noexcept;
  /// Simulation time since 1970, as set by Start/Resume and Stop/Freeze. Before the first: UTC.
  [[nodiscard]] std::chrono::nanoseconds exercise_time() const noexcept;
  /// Converts between the scene's frame and geocentric coordinates
  /// (deadreckon/motion/geocentric.hpp).
  [[nodiscard]] const deadreckon::LocalFrame& frame() const noexcept;
  /// A truth at rest at a geodetic place [rad, rad, m above the ellipsoid], with a heading [rad]
  /// clockwise from north.
  [[nodiscard]] EntityTruth place(double latitude, double longitude, double height = 0.0,
                                  double heading = 0.0) const;

  // Running ---------------------------------------------------------------------------------------

  /// Runs all due work, and calls back. Call it often: at 60 Hz for graphics, at 1 kHz with devices
  /// and FederateLoops::in_step. Never waits.
  void step();

  /// The peer below: counters, views, notices, threads, reports of its link. The federate runs its
  /// loops and ends it, except with FederateLoops::by_hand. Include joined_peer.hpp to use it.
  [[nodiscard]] JoinedPeer& joined() noexcept;
  [[nodiscard]] Peer& peer() noexcept;

 private:
  struct Participation;
  void publish_interaction(pdu::PduType type);
  void subscribe_interaction(
      pdu::PduType type,
      std::function<void(std::span<const std::byte>, const InteractionSender&)> callback);
  struct SendOptions {
    pdu::PduType type;
    Delivery delivery;
    Order order;
  };
  MessageHandle send_octets(const SendOptions& sending, std::span<const std::byte> octets,
                            const std::optional<Eigen::Vector3d>& place);
  [[nodiscard]] std::uint8_t exercise() const noexcept;
  [[nodiscard]] RemoteObject object_at(std::size_t index) const noexcept;
  [[nodiscard]] Eigen::Vector3d scene_position(const Eigen::Vector3d& world) const noexcept;
  void call_back(News& news);

  std::unique_ptr<Participation> participation_;
};

}  // namespace reckon::peer
