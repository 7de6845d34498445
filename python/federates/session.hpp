// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A federate that Python drives: guards its thread, and carries calls back to Python.
#pragma once

#include <pybind11/pybind11.h>

#include <array>
#include <cstdint>
#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "reckon/haptics/effects/effect_custom.hpp"
#include "reckon/peer/federate.hpp"

namespace reckon::python {

using Triple = std::array<double, 3>;
using Quadruple = std::array<double, 4>;

/// A remote entity at one instant, for Python. Frame S.
struct Seen {
  std::array<std::uint16_t, 3> id{};
  std::string type, marking;
  unsigned force_id = 0;
  std::uint32_t appearance = 0;
  Triple position{}, velocity{};
  Quadruple orientation{};  ///< w, x, y, z; body to S
  double age = 0;           ///< since its last update [s]
};

/// Pose and motion of an entity of the program. Frame S.
struct Motion {
  Triple position{}, velocity{}, acceleration{};
  Quadruple orientation{0, 1, 0, 0};  ///< w, x, y, z; body to S
  Triple angular_velocity{};          ///< body axes [rad/s]
};

/// How to join.
struct JoinOptions {
  std::string scene;  ///< file; empty: plain DIS at the place below
  std::uint8_t exercise = 1;
  double latitude = 0, longitude = 0;  ///< [rad]
  std::string interface, name;
  std::optional<std::uint16_t> site, application;
  haptics::CustomEffects effects{};  ///< that the scene may declare
};

/// The thread that made it makes all calls, except the destructor; callbacks run only within
/// tick().
class Session {
 public:
  /// @throws the exceptions of peer::Federate
  explicit Session(const JoinOptions& options);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// Leaves the exercise; further calls do nothing.
  void resign();
  [[nodiscard]] bool is_joined() const noexcept { return federate_ != nullptr; }

  /// @return number of the entity
  std::uint16_t own(const std::string& marking, const std::string& type, unsigned force_id,
                    const Motion& motion);
  void move(std::uint16_t entity, const Motion& motion);
  void set_appearance(std::uint16_t entity, std::uint32_t appearance);
  void remove(std::uint16_t entity);
  [[nodiscard]] std::array<std::uint16_t, 3> id_of(std::uint16_t entity);

  void on_discover(pybind11::function callback);
  void on_update(pybind11::function callback);
  void on_remove(pybind11::function callback);
  /// Calls back with each PDU of this type and whether its sender owns the entity that issued it.
  void on_interaction(unsigned pdu_type, pybind11::function callback);
  /// @param octets one PDU
  void send(std::span<const std::byte> octets);

  /// Runs all due work. An exception of a callback is raised after all callbacks were called.
  void tick();
  [[nodiscard]] std::vector<Seen> entities();
  [[nodiscard]] std::optional<Seen> find(const std::array<std::uint16_t, 3>& id);
  [[nodiscard]] double utc();
  /// A place in S. Latitude, longitude [rad], height [m].
  [[nodiscard]] Triple position(double latitude, double longitude, double height);
  /// From S to W.
  [[nodiscard]] Triple world(const Triple& position);

 private:
  peer::Federate& federate();
  [[nodiscard]] Seen seen(const peer::RemoteObject& object);
  void call(const pybind11::function& callback, auto&& arguments);

  std::thread::id thread_ = std::this_thread::get_id();
  std::unique_ptr<peer::Federate> federate_;
  std::vector<pybind11::function> callbacks_;  // that the federate refers to
  std::exception_ptr first_fault_;             // of the callbacks of this tick
  bool in_tick_ = false;
};

}  // namespace reckon::python
