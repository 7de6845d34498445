// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// One step of rigid bodies under forces, among what stands still: contacts, friction, energy, rest.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "reckon/haptics/bodies/body_geoms.hpp"
#include "reckon/haptics/bodies/contact_islands.hpp"
#include "reckon/haptics/bodies/flight.hpp"
#include "reckon/haptics/bodies/ode_calls.hpp"
#include "reckon/haptics/scene/effect_plan.hpp"

namespace reckon::haptics {

/// A force on a body in one step.
struct BodyForce {
  std::size_t body = 0;
  Eigen::Vector3d place = Eigen::Vector3d::Zero();  ///< [m], in the axes of its shape
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  ///< [N], S
  /// [N m], S: it holds the body against turning, and its work is none of the hand's.
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();
  double work = 0.0;  ///< [J], that it did, after the step
};

/// Bodies by their numbers: bit i is body i.
using BodySet = std::uint64_t;

/// The bodies of a plan, in the plan's order, and ODE's world of them. After some steps it
/// allocates nothing. One thread at a time.
class BodySolver {
 public:
  /// @param gravity [m/s^2], S  @throws std::invalid_argument for a body that cannot be one
  BodySolver(const EffectPlan& plan, const Eigen::Vector3d& gravity, const WorkSpace& work_space);
  ~BodySolver();
  BodySolver(const BodySolver&) = delete;
  BodySolver& operator=(const BodySolver&) = delete;

  [[nodiscard]] std::size_t size() const noexcept { return bodies_.size(); }
  [[nodiscard]] std::uint32_t object(std::size_t body) const noexcept {
    return bodies_[body].object;
  }
  [[nodiscard]] double mass(std::size_t body) const noexcept { return bodies_[body].mass; }
  /// Moved by carry() alone.
  [[nodiscard]] bool is_carried(std::size_t body) const noexcept {
    return (carried_ >> body & 1) != 0;
  }
  /// Puts a carried one there; in the next steps it goes on at this velocity.
  void carry(std::size_t body, const ObjectMotion& motion) noexcept;
  [[nodiscard]] ObjectMotion motion(std::size_t body) const noexcept;
  [[nodiscard]] bool awake(std::size_t body) const noexcept;
  /// Of its principal ones [kg m^2].
  [[nodiscard]] double least_inertia(std::size_t body) const noexcept {
    return bodies_[body].least_inertia;
  }
  /// Of a place in the body's axes [m/s].
  [[nodiscard]] Eigen::Vector3d velocity(std::size_t body,
                                         const Eigen::Vector3d& place) const noexcept;

  /// `some` and all that lie against one another with them.
  [[nodiscard]] BodySet island(BodySet some) const noexcept;
  /// Bodies outside `some` are neither moved nor met by the next steps.
  void only(BodySet some) noexcept;
  [[nodiscard]] static constexpr BodySet all() noexcept { return ~BodySet{0}; }

  /// Goes on by dt [s]. Energy that the solver makes beyond the work of the forces is taken out of
  /// the bodies' speeds in the same step.
  void step(double dt, std::span<BodyForce> forces) noexcept;

  /// Keeps the bodies of only(), and puts them back as they were kept.
  void keep() noexcept;
  void restore() noexcept;

  /// See BodyWorld.
  [[nodiscard]] double energy() const noexcept;
  [[nodiscard]] double taken_out() const noexcept { return ledger_.taken_out; }
  [[nodiscard]] std::uint64_t approximated() const noexcept { return ledger_.lost; }

 private:
  /// How a body stands and moves.
  struct State {
    std::array<dReal, 3> at{}, velocity{}, turn_rate{}, force{}, torque{};
    std::array<dReal, 4> turned{};
    bool awake = true;
    double still = 0.0;  // [s]
  };
  struct Body {
    dBodyID id = nullptr;
    dGeomID geom = nullptr;
    std::uint32_t object = 0;
    double mass = 0.0;
    double drag = 0.0;           // [N s/m]
    double inner = 0.0;          // [m], radius of the ball about its middle within it
    double least_inertia = 0.0;  // [kg m^2], of its principal ones
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();  // of mass, in the axes of its shape [m]
    Eigen::Vector3d start = Eigen::Vector3d::Zero();
    double still = 0.0;  // [s]
    bool flies = true;   // nothing pushes it in this step but its weight
    State before, kept;  // of a step; of keep()

    [[nodiscard]] State state() const noexcept;
    void set(const State& state) noexcept;
  };
  struct Ledger {
    double energy = 0.0;  // [J], that the bodies may have
    double taken_out = 0.0;
    std::uint64_t lost = 0;
  };

  void destroy() noexcept;
  void add(const PlannedObject& object, std::uint32_t number);
  static void give_mass(Body& body, const PlannedObject& object);
  [[nodiscard]] bool acts(std::size_t body) const noexcept { return (only_ >> body & 1) != 0; }
  [[nodiscard]] Eigen::Quaterniond orientation(std::size_t body) const noexcept;
  [[nodiscard]] bool rests() const noexcept;
  void apply(std::span<BodyForce> forces) noexcept;
  void solve(double dt) noexcept;
  [[nodiscard]] double lifted_ahead(double dt) const noexcept;
  void collide(dGeomID a, dGeomID b) noexcept;
  void note_contacts(dBodyID first, dBodyID second, int count) noexcept;
  [[nodiscard]] Walls walls_of(const Body& body, int axis) const noexcept;
  void fly_exactly(double dt) noexcept;
  void catch_fast() noexcept;
  [[nodiscard]] double length_free(const Body& body, const Eigen::Vector3d& from,
                                   const Eigen::Vector3d& way, double length) noexcept;
  void take_out(double given) noexcept;
  void rest(double dt) noexcept;

  dWorldID world_ = nullptr;
  std::optional<BodyGeoms> geoms_;  // begins when ODE has
  dJointGroupID joints_ = nullptr;
  dGeomID ray_ = nullptr;  // in no space
  Eigen::Vector3d gravity_;
  WorkSpace work_space_;
  std::vector<Body> bodies_;
  ContactIslands<8 * sizeof(BodySet)> islands_;  // of a step
  BodySet carried_ = 0;
  bool is_driven_ = false;  // something that is carried touches a body in this step
  BodySet only_ = all();
  BodySet parked_awake_ = 0;  // of those that only() leaves out
  Ledger ledger_, kept_;
};

}  // namespace reckon::haptics
