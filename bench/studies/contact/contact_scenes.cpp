// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/contact/contact_scenes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "reckon/tools/exercise/scene_options.hpp"

namespace reckon::bench {
namespace {

using Eigen::Vector3d;
using haptics::HandTarget;

constexpr double kRadius = 0.02;      // [m]
constexpr double kAway = 0.02;        // [m], between hands before they touch
constexpr double kStart = 2.0;        // [s], discovery is complete by then
constexpr double kPlaceHeight = 0.2;  // [m]
constexpr double kTurn = 2 * std::numbers::pi;

/// A position along a line and the speed on it.
struct Way {
  double at = 0, speed = 0;
};

/// From 0 to 1 with minimum jerk, over `seconds` from `begin`.
Way rise(double time, double begin, double seconds) {
  const double u = std::clamp((time - begin) / seconds, 0.0, 1.0);
  return {u * u * u * (10 + u * (6 * u - 15)), 30 * u * u * (1 - u) * (1 - u) / seconds};
}

/// From 0 to 1 and back as a cosine with this period [s], from kStart.
Way to_and_fro(double time, double period) {
  if (time < kStart) return {};
  const double phase = kTurn * (time - kStart) / period;
  return {0.5 * (1 - std::cos(phase)), 0.5 * kTurn / period * std::sin(phase)};
}

Vector3d place_in_row(std::size_t hand) {
  return {2 * kRadius * static_cast<double>(hand), 0, kPlaceHeight};
}

HandTarget along(const Vector3d& place, const Vector3d& direction, const Way& way) {
  return {place + way.at * direction, way.speed * direction, Vector3d::Zero()};
}

/// The first hand of a row starts at kAway, is `depth` beyond the first touch after `in` seconds
/// and returns within half a second from `leave`; the others hold still.
Way press(double time, double depth, double in, double leave) {
  const Way there = rise(time, kStart, in), back = rise(time, leave, 0.5);
  return {-kAway + (kAway + depth) * (there.at - back.at),
          (kAway + depth) * (there.speed - back.speed)};
}

HandTarget first_moves(std::size_t hand, const Way& way) {
  return along(place_in_row(hand), Vector3d::UnitX(), hand == 0 ? way : Way{});
}

template <int kMillimetres>
HandTarget slow_press(std::size_t hand, double time) {
  return first_moves(hand, press(time, 1e-3 * kMillimetres, 1, 7));
}

constexpr double kStrokesBegin = 4, kStrokesEnd = 10;  // [s]

/// 15 mm in, then strokes of 5 mm at a tenth of `kTenths` Hz.
template <int kTenths>
HandTarget stroke(std::size_t hand, double time) {
  Way way = press(time, 0.015, 1, kStrokesEnd);
  if (time > kStrokesBegin && time < kStrokesEnd) {
    const double rate = kTurn * 0.1 * kTenths;
    way.at += 0.005 * std::sin(rate * (time - kStrokesBegin));
    way.speed += 0.005 * rate * std::cos(rate * (time - kStrokesBegin));
  }
  return first_moves(hand, way);
}

/// Approach, touch, hold, stroke, leave: from 150 mm away, with vertical motion of 20 mm meanwhile,
/// into the other hand by 10 mm, strokes of 5 mm at 0.5 Hz, and back.
HandTarget visit(std::size_t hand, double time) {
  if (hand != 0) return first_moves(hand, {});
  constexpr double kFar = 0.15, kDepth = 0.01, kStroke = 0.005, kStrokeHz = 0.5;
  constexpr double kComes = 6, kStrokes = 11, kEnds = 15, kLeaves = 16;  // [s]
  const Way there = rise(time, kComes, 2), back = rise(time, kLeaves, 2);
  Way way{-kFar + (kFar + kDepth) * (there.at - back.at),
          (kFar + kDepth) * (there.speed - back.speed)};
  if (time > kStrokes && time < kEnds) {
    const double rate = kTurn * kStrokeHz;
    way.at += kStroke * std::sin(rate * (time - kStrokes));
    way.speed += kStroke * rate * std::cos(rate * (time - kStrokes));
  }
  HandTarget target = first_moves(hand, way);
  if (time < kStart || time > kComes) return target;
  const Way up = to_and_fro(time, kComes - kStart);
  target.position.z() += 0.02 * up.at;
  target.velocity.z() += 0.02 * up.speed;
  return target;
}

/// 10 mm in within a tenth of a second and out at once, every two seconds.
HandTarget tap(std::size_t hand, double time) {
  const double within = time < kStart ? 0 : std::fmod(time - kStart, 2.0);
  const Way there = rise(within, 0, 0.1), back = rise(within, 0.1, 0.1);
  const double depth = kAway + 0.01;
  return first_moves(hand,
                     {-kAway + depth * (there.at - back.at), depth * (there.speed - back.speed)});
}

/// Two hands that approach and separate with periods of 2 and 3 s; meanwhile the second crosses the
/// line of the first by 10 mm to both sides with a period of 5 s.
HandTarget sweep_of_two(std::size_t hand, double time) {
  const bool first = hand == 0;
  const Vector3d way = Vector3d::UnitX() * (first ? 0.032 : -0.032);
  const Vector3d begin = place_in_row(hand) - 0.625 * way;
  HandTarget target = along(begin, way, to_and_fro(time, first ? 2.0 : 3.0));
  if (first || time < kStart) return target;
  const double phase = kTurn * (time - kStart) / 5;
  target.position.y() += 0.01 * std::sin(phase);
  target.velocity.y() += 0.01 * kTurn / 5 * std::cos(phase);
  return target;
}

/// Four hands that move from the corners of a square to its middle and back with periods of 2, 2.4,
/// 3 and 3.6 s.
HandTarget sweep_of_four(std::size_t hand, double time) {
  constexpr std::array kPeriods{2.0, 2.4, 3.0, 3.6};
  const double angle = kTurn * static_cast<double>(hand) / 4;
  const Vector3d outward(std::cos(angle), std::sin(angle), 0);
  const double apart = std::numbers::sqrt2 * kRadius;  // neighbours touch here
  const Vector3d begin = (apart + 0.02) * outward + kPlaceHeight * Vector3d::UnitZ();
  return along(begin, -0.03 * outward, to_and_fro(time, kPeriods[hand % kPeriods.size()]));
}

constexpr std::array kScenes{
    ContactScene{"light", "the shipped scene: two hands push each other beside a stone", 60, 2, 500,
                 0, 0, 0, true},
    ContactScene{"press-10", "10 mm into the other hand in 1 s, held for 4 s, out in half a second",
                 9, 2, 500, 0, 0, 0, false, slow_press<10>},
    ContactScene{"press-20", "the same with 20 mm", 9, 2, 500, 0, 0, 0, false, slow_press<20>},
    ContactScene{"press-stiff",
                 "the same with 10 mm and 1500 N/m, more than the devices can display", 9, 2, 1500,
                 0, 0, 0, false, slow_press<10>},
    ContactScene{"stroke-0.5", "15 mm in, then strokes of 5 mm at 0.5 Hz", 11.5, 2, 500, 0.5, 6, 10,
                 false, stroke<5>},
    ContactScene{"stroke-1.5", "the same at 1.5 Hz", 11.5, 2, 500, 1.5, 6, 10, false, stroke<15>},
    ContactScene{"stroke-3", "the same at 3 Hz", 11.5, 2, 500, 3, 6, 10, false, stroke<30>},
    ContactScene{"stroke-5", "the same at 5 Hz", 11.5, 2, 500, 5, 6, 10, false, stroke<50>},
    ContactScene{"stroke-stiff", "15 mm in, then strokes of 5 mm at 1.5 Hz, with 800 N/m", 11.5, 2,
                 800, 1.5, 6, 10, false, stroke<15>},
    ContactScene{"sweep-2", "two hands of 300 N/m sweep through each other", 20, 2, 300, 0, 0, 0,
                 false, sweep_of_two},
    ContactScene{"sweep-4", "four hands of 300 N/m sweep to one middle", 20, 4, 300, 0, 0, 0, false,
                 sweep_of_four},
    ContactScene{"tap", "10 mm in and out within 0.2 s, every 2 s", 12, 2, 500, 0, 0, 0, false,
                 tap},
    ContactScene{"visit", "from 150 mm away, 10 mm in, held, strokes at 0.5 Hz, held, and back", 22,
                 2, 500, 0, 0, 0, false, visit},
};

}  // namespace

std::span<const ContactScene> contact_scenes() { return kScenes; }

peer::SceneFile scene_of(const ContactScene& contact) {
  if (contact.shipped) return tools::load_scene({}, "two_hands.toml", 2);
  peer::SceneFile scene;
  scene.name = contact.name;
  scene.hand.radius = kRadius;
  scene.hand.k1 = contact.stiffness;
  scene.hand.damping = 0;
  scene.hand.static_friction = scene.hand.kinetic_friction = 0;
  scene.operators.resize(contact.hands);
  scene.dead_reckoning.algorithm = pdu::DeadReckoningAlgorithm::fpw;
  scene.hash = peer::scene_hash(scene);
  return scene;
}

std::vector<haptics::HandScript> scripts_of(const ContactScene& contact) {
  std::vector<haptics::HandScript> scripts;
  if (contact.path == nullptr) return scripts;
  for (std::size_t hand = 0; hand < contact.hands; ++hand)
    scripts.emplace_back([hand, path = contact.path](double time) { return path(hand, time); });
  return scripts;
}

}  // namespace reckon::bench
