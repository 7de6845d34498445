// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tests/fuzz/touch/moving.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <utility>

#include "reckon/haptics/devices/simulated_device.hpp"
#include "reckon/pdu/seconds.hpp"

namespace reckon::fuzz {
namespace {

using Eigen::Vector3d;

constexpr double kCube = 0.04;       // [m], of the heap and the pinched cube
constexpr double kPaddleFrom = 0.2;  // [m], from the cube
constexpr double kPaddleFor = 0.4;   // [s]
const Vector3d kHeapAt(40, 0, 0), kPinchAt(0, 20, 0);

haptics::SceneObject& add(haptics::Scene& scene, std::string name, const haptics::Shape& shape,
                          const Vector3d& at, double mass = 0) {
  haptics::SceneObject& object = scene.objects.emplace_back();
  object.name = std::move(name);
  object.shape = shape;
  object.pose.position = at;
  object.effects.of<haptics::SpringDamper>() = {400, 0};
  object.matter.mass = mass;
  return object;
}

haptics::Shape cube_of(double edge) { return haptics::BoxShape{Vector3d::Constant(edge)}; }

bool is_box(const Scenario& s) { return static_cast<Falling>(s[Shared::body]) == Falling::box; }

// [N/m], at most the stiffness that a body of its mass allows at the rate of the hand below it,
// whose period is whole nanoseconds.
double stiffness_of_falling(const Scenario& s) {
  const double period = 1 / s.of_device(0, Shared::servo_rate, Shared::other_rate);
  return std::min(s[Shared::body_stiffness],
                  0.99 * haptics::stiffest_push(s[Shared::body_mass], period));
}

// Half of its height, turned about y [m].
double half_height(const Scenario& s) {
  const double turned = s[Shared::body_turned], half = 0.5 * s[Shared::body_size];
  return is_box(s) ? half * (std::abs(std::cos(turned)) + std::abs(std::sin(turned))) : half;
}

void add_falling(const Scenario& s, const Vector3d& home, haptics::Scene& scene) {
  const double size = s[Shared::body_size];
  const Vector3d from(s[Shared::body_beside], 0, s[Shared::body_drop] + half_height(s));
  haptics::SceneObject& body =
      add(scene, "falling", is_box(s) ? cube_of(size) : haptics::SphereShape{0.5 * size},
          home + from, s[Shared::body_mass]);
  body.effects.of<haptics::SpringDamper>() = {stiffness_of_falling(s), 0};
  body.pose.orientation = Eigen::AngleAxisd(s[Shared::body_turned], Vector3d::UnitY());
  if (s[Shared::body_floor] == 0) return;
  const Vector3d below(0, 0, s[Shared::body_floor] + 0.05);
  add(scene, "floor", haptics::BoxShape{{0.6, 0.6, 0.1}}, home - below);
}

void add_pinched(const Scenario& s, haptics::Scene& scene) {
  const Vector3d stand(0, 0, 0.5 * kCube);
  haptics::SceneObject& cube =
      add(scene, "pinched", cube_of(kCube), kPinchAt + stand, s[Shared::paddle_mass]);
  cube.pose.orientation = Eigen::AngleAxisd(s[Shared::paddle_turned], Vector3d::UnitZ());
  const haptics::Shape board = haptics::BoxShape{{0.02, 0.1, 0.1}};
  add(scene, "paddle", board, kPinchAt + Vector3d(-kPaddleFrom, 0, 0.05)).carried = true;
  add(scene, "post", board, kPinchAt + Vector3d(0.06, 0, 0.05));
  add(scene, "ground", haptics::BoxShape{{2, 2, 0.1}}, kPinchAt - Vector3d(0, 0, 0.05));
}

void add_heap(const Scenario& s, haptics::Scene& scene) {
  std::mt19937 random(s.seed);
  std::uniform_real_distribution<double> any(0, 1);
  add(scene, "far ground", haptics::BoxShape{{4, 4, 0.1}}, kHeapAt - Vector3d(0, 0, 0.05));
  for (int i = 0; i < static_cast<int>(s[Shared::pile]); ++i) {
    const Vector3d at(0.06 * any(random), 0.06 * any(random), 0.05 + 0.07 * i);
    const double mass = std::max(0.02, any(random) * s[Shared::pile_mass]);
    haptics::SceneObject& cube =
        add(scene, "far " + std::to_string(i), cube_of(kCube), kHeapAt + at, mass);
    cube.matter.restitution = s[Shared::pile_bounce];
    cube.pose.orientation =
        Eigen::Quaterniond(1, any(random), any(random), any(random)).normalized();
  }
}

class Paddle final : public haptics::ObjectMover {
 public:
  explicit Paddle(double speed) : speed_(speed) {}
  haptics::ObjectMotion motion_of(std::uint32_t /*object*/,
                                  std::chrono::nanoseconds now) noexcept override {
    const double t = pdu::to_seconds(now), end = kPaddleFor + kPaddleFrom / speed_;
    haptics::ObjectMotion out;
    out.position = kPinchAt + Vector3d(speed_ * std::min(t, end) - kPaddleFrom, 0, 0.05);
    if (t < end) out.velocity.x() = speed_;
    return out;
  }

 private:
  double speed_;
};

}  // namespace

void add_moving(const Scenario& s, const Vector3d& home, haptics::Scene& scene) {
  if (s[Shared::body] > 0) add_falling(s, home, scene);
  if (s[Shared::paddle] > 0) add_pinched(s, scene);
  if (s[Shared::pile] > 0) add_heap(s, scene);
}

std::shared_ptr<haptics::ObjectMover> paddle_of(const Scenario& s) {
  if (s[Shared::paddle] == 0) return nullptr;
  return std::make_shared<Paddle>(s[Shared::paddle]);
}

MovingBooks::MovingBooks(const Scenario& scenario, std::shared_ptr<const haptics::BodyWorld> world,
                         double stiffest)
    : scenario_(scenario),
      world_(std::move(world)),
      stiffness_(std::min(stiffness_of_falling(scenario), stiffest)),
      begin_(has_body() ? energy() : 0.0) {}

// Distance of a position from the falling body [m]; 0 inside.
double MovingBooks::clear_of(const Vector3d& place) const {
  const haptics::BodyState& body = world_->states().front();
  const Vector3d from = body.orientation.conjugate() * (place - body.position);
  const double half = 0.5 * scenario_[Shared::body_size];
  if (!is_box(scenario_)) return std::max(0.0, from.norm() - half);
  return (from.cwiseAbs().array() - half).max(0.0).matrix().norm();
}

// A contact ends when the handle is farther outside the body than the stretch of its spring at the
// greatest force plus 10 mm.
void MovingBooks::note(const haptics::ServoSnapshot& hand, double dt) {
  if (world_ == nullptr) return;
  const Scenario& s = scenario_;
  const std::size_t pinched = s[Shared::body] > 0 ? 1 : 0;
  if (s[Shared::paddle] > 0) {
    fastest_ = std::max(fastest_, world_->states()[pinched].velocity.norm());
  }
  if (!has_body()) return;
  const bool pushes = hand.mesh_force.norm() > 0;
  is_pushed_ = pushes || was_pushed_;
  was_pushed_ = pushes;
  if (pushes) pushed_ += dt;
  constexpr double kMargin = 0.01, kLeast = 1e-3;
  const double stretch = haptics::SimulatedDeviceConfig{}.max_force / stiffness_ + kMargin;
  clear_ = clear_of(hand.device) > stretch ? clear_ + dt : 0.0;
  if (hand.mesh_force.norm() > kLeast) haunted_ = std::max(haunted_, clear_ - 2 * dt);
}

// For a body with equal moments of inertia.
double MovingBooks::energy() const {
  const haptics::BodyState& body = world_->states().front();
  const double mass = scenario_[Shared::body_mass], size = scenario_[Shared::body_size];
  const double inertia = mass * size * size / (is_box(scenario_) ? 6 : 10);
  return 0.5 * mass * body.velocity.squaredNorm() + 0.5 * inertia * body.turn_rate.squaredNorm() +
         mass * 9.81 * body.position.z();
}

std::vector<Vector3d> MovingBooks::places() const {
  std::vector<Vector3d> out;
  if (world_ == nullptr) return out;
  const std::size_t count =
      (scenario_[Shared::body] > 0 ? 1 : 0) + (scenario_[Shared::paddle] > 0 ? 1 : 0);
  for (std::size_t i = 0; i < count; ++i) out.push_back(world_->states()[i].position);
  return out;
}

void MovingBooks::judge(Outcome& out) const {
  if (world_ == nullptr) return;
  out.pushed = pushed_;
  out.haunted = haunted_;
  if (scenario_[Shared::paddle] > 0) out.pinched = fastest_ / scenario_[Shared::paddle];
}

}  // namespace reckon::fuzz
