// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The way into an exercise for a program: HLA's words over DIS packets. A federate owns entities
// and says where they truly are, as often as it likes; what is sent, when and to whom is the
// library's business. It sees the entities of others at any instant, and hears and says
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
#include <string>
#include <vector>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/peer/federate_options.hpp"
#include "reckon/peer/federation/entity_class.hpp"
#include "reckon/peer/federation/remote_object.hpp"
#include "reckon/peer/world/entity_description.hpp"
#include "reckon/peer/world/interaction_sender.hpp"

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

/// A scene for plain DIS: every entity within 1,000 km of `latitude`, `longitude` [rad] is seen,
/// all is said to one multicast group, and no peer need know Reckon.
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
///   const peer::ObjectHandle handle = federate.register_object(truck, federate.place(0.82,
///   0.145)); federate.subscribe<pdu::Fire>([](const pdu::Fire& fire) { ... }); for (;;)
///   federate.update_attributes(handle, where_it_is()), federate.step(), sleep();
///
/// All functions by one thread, the program's; callbacks run inside step() on that thread, and may
/// call anything but step() and resign(). Frame S (east, north, up at the scene's origin), SI.
class Federate {
 public:
  /// Joins over UDP multicast. @throws SceneFileError, std::invalid_argument, std::runtime_error or
  /// std::system_error with the value and the remedy.
  explicit Federate(const FederateOptions& options);
  /// The same over a link and a clock of the caller's, which outlive it: tests, simulated time.
  /// @param epoch names this life; never 0, never the same twice
  Federate(const FederateOptions& options, Link& link, const Clock& clock, std::uint32_t epoch);
  ~Federate();
  Federate(const Federate&) = delete;
  Federate& operator=(const Federate&) = delete;

  /// Leaves: what was said before goes out, every entity of ours says that it goes, then the peer.
  /// Nothing may follow but questions.
  void resign();

  // What we say and what we want to hear ----------------------------------------------------------

  /// Entities of this class may be registered.
  void publish(const EntityClass& entities);
  /// Interactions of this type may be sent.
  template <pdu::Pdu T>
  void publish() {
    publish_interaction(T::kPduType);
  }
  /// Entities of this class are discovered, reflected and removed; no others are, nor any before.
  void subscribe(const EntityClass& entities);
  /// Calls back with each interaction of this type and who said it. Those in the name of another's
  /// entity are refused, counted (`interactions_refused`) and reported; with `sender.owns` the
  /// entity that the PDU is said for is the sender's, else nobody is heard under its name. A second
  /// call replaces the first.
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
  /// The same for who does not ask who said it.
  template <pdu::Pdu T>
  void subscribe(std::function<void(const T&)> callback) {
    subscribe<T>(std::function<void(const T&, const InteractionSender&)>(
        [callback](const T& message, const InteractionSender&) { callback(message); }));
  }
  void on_discover(std::function<void(const RemoteObject&)> callback);
  /// After each step() in which an update came, once an entity: what it says now.
  void on_reflect(std::function<void(const RemoteObject&)> callback);
  void on_remove(std::function<void(const pdu::EntityId&)> callback);

  // Our entities ----------------------------------------------------------------------------------
  // Of an object that is not registered, or deleted: @throws std::logic_error.

  /// @param truth where it is; without a time: now. A default truth (all zero) is the origin.
  /// @throws std::logic_error where its class is not published, std::length_error where
  /// kMostOwned are registered, std::invalid_argument for a marking that is too long or not ASCII
  ObjectHandle register_object(const EntityDescription& description, const EntityTruth& truth);
  /// Its true motion, at any rate. Between two calls it goes on as the last one said.
  /// @param truth without a time: now. One that is not finite, or older than the last, is ignored.
  void update_attributes(ObjectHandle object, const EntityTruth& truth);
  /// Appearance as on the wire; sent at once where it is another.
  void update_appearance(ObjectHandle object, std::uint32_t appearance);
  /// Articulated parts (deadreckon/motion/articulation.hpp); sent where others are wrong about
  /// them.
  void update_parts(ObjectHandle object, const deadreckon::PartState& parts);
  /// Its last Entity State has the deactivated bit.
  void delete_object(ObjectHandle object);
  /// Its ID now; the first half changes where an identity conflict was lost.
  [[nodiscard]] pdu::EntityId id_of(ObjectHandle object) const noexcept;
  /// The hand that device `index` of the options moves.
  [[nodiscard]] ObjectHandle hand(std::size_t index) const noexcept;

  // The entities of others ------------------------------------------------------------------------

  /// None where it is not known, or of a class not subscribed. Good until the next step().
  [[nodiscard]] std::optional<RemoteObject> find(const pdu::EntityId& id) const;
  /// Calls visit(RemoteObject) for all.
  template <typename Visit>
  void for_each(Visit&& visit) const {
    for (std::size_t i = 0; i < size(); ++i) visit(object_at(i));
  }
  [[nodiscard]] std::size_t size() const noexcept;

  // Interactions ----------------------------------------------------------------------------------

  /// Sends any PDU: exercise and timestamp are filled in. One with a world location (Fire,
  /// Detonation) goes to those who can sense the place, all else to everybody.
  /// @throws std::logic_error where its type is not published
  template <pdu::Pdu T>
  void send(T message) {
    message.header.exercise_id = exercise();
    std::optional<Eigen::Vector3d> place;
    if constexpr (requires { message.location_in_world_coordinates; }) {
      const auto& at = message.location_in_world_coordinates;
      place = scene_position({at.x, at.y, at.z});
    }
    std::vector<std::byte> octets(pdu::wire_size(message));
    octets.resize(pdu::encode(message, octets));
    send_octets(T::kPduType, octets, place);
  }

  /// Interactions that were lost because step() was not called for long: 8 MiB of them may wait.
  [[nodiscard]] std::uint64_t dropped_interactions() const noexcept;

  // Time and place --------------------------------------------------------------------------------

  /// Steady time; what RemoteObject::shown() takes.
  [[nodiscard]] std::chrono::nanoseconds now() const noexcept;
  /// UTC since 1970 as this peer tells it: without the leaps of its host's clock.
  [[nodiscard]] std::chrono::nanoseconds utc() const noexcept;
  /// Simulation time since 1970 by Start/Resume and Stop/Freeze for us or all; UTC before.
  [[nodiscard]] std::chrono::nanoseconds exercise_time() const noexcept;
  /// Between the scene and the earth (deadreckon/motion/geocentric.hpp).
  [[nodiscard]] const deadreckon::LocalFrame& frame() const noexcept;
  /// Standing at a geodetic place [rad, rad, m over the ellipsoid], with a heading [rad] clockwise
  /// from north.
  [[nodiscard]] EntityTruth place(double latitude, double longitude, double height = 0.0,
                                  double heading = 0.0) const;

  // Running ---------------------------------------------------------------------------------------

  /// Lets everything happen that is due, and calls back. Call it often: at 60 Hz for pictures, at
  /// 1 kHz for devices in step. Never waits.
  void step();

  /// What it stands on: the peer with its counters, pictures and notices, its threads, what there
  /// is to report of its link. Steps, threads and leaving are the federate's, unless
  /// FederateLoops::by_hand. Include joined_peer.hpp to use them.
  [[nodiscard]] JoinedPeer& joined() noexcept;
  [[nodiscard]] Peer& peer() noexcept;

 private:
  struct Participation;
  void publish_interaction(pdu::PduType type);
  void subscribe_interaction(
      pdu::PduType type,
      std::function<void(std::span<const std::byte>, const InteractionSender&)> callback);
  void send_octets(pdu::PduType type, std::span<const std::byte> octets,
                   const std::optional<Eigen::Vector3d>& place);
  [[nodiscard]] std::uint8_t exercise() const noexcept;
  [[nodiscard]] RemoteObject object_at(std::size_t index) const noexcept;
  [[nodiscard]] Eigen::Vector3d scene_position(const Eigen::Vector3d& world) const noexcept;
  void call_back(News& news);

  std::unique_ptr<Participation> participation_;
};

}  // namespace reckon::peer
