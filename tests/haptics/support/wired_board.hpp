// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A serial board, its line, its session and the servo that uses it, all on the board's clock.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/haptics/serial/serial_session.hpp"
#include "reckon/haptics/servo/servo_loop.hpp"
#include "reckon/haptics/usb/usb_device.hpp"
#include "reckon/tests/haptics/support/drawn_touch.hpp"
#include "reckon/tests/haptics/support/line_way.hpp"
#include "reckon/tests/haptics/support/serial_board.hpp"

namespace reckon::test {

/// Rates of damaged frames of the board, each of a thousand.
struct LineFaults {
  unsigned lost = 0, changed = 0, doubled = 0, swapped = 0;
  bool next_lost = false;    ///< the next of the board's, once
  unsigned changed_out = 0;  ///< rate of changed frames to the board
};

/// The servo steps every millisecond.
class WiredBoard {
 public:
  using Vector3d = Eigen::Vector3d;

  WiredBoard(const SerialBoardOptions& options, std::function<Vector3d(double)> hand,
             const haptics::DeviceLimits& limits, const haptics::Scene& scene)
      : WiredBoard(options, std::move(hand), limits, scene,
                   std::make_shared<const haptics::EffectPlan>(scene)) {}
  WiredBoard(const SerialBoardOptions& options, std::function<Vector3d(double)> hand,
             const haptics::DeviceLimits& limits, const haptics::Scene& scene,
             std::shared_ptr<const haptics::EffectPlan> plan)
      : board(options, std::move(hand)),
        device(exchange, limits),
        servo(device, plan, servo_config(), haptics::make_bodies(*plan, scene)),
        session(std::in_place, exchange, limits, 1U, static_cast<std::uint16_t>(65'530),
                board.now()),
        random_(options.seed),
        next_step_(std::chrono::microseconds(50 * (options.seed % 20))) {}

  void run(std::chrono::nanoseconds time) {
    for (const auto end = board.now() + time; board.now() < end;) step();
  }

  SerialBoard board;
  haptics::UsbExchange exchange;
  haptics::UsbDevice device;
  haptics::ServoLoop servo;
  std::optional<haptics::SerialSession> session;
  LineWay in, out;
  LineFaults faults;
  bool servo_runs = true;
  std::function<void(std::chrono::nanoseconds)> before_step;  // of the servo
  /// Replaces the servo's steps, if set.
  std::function<void(std::chrono::nanoseconds)> other_servo;
  bool in_is_cut = false, out_is_cut = false;  // no octets
  double least_books = 0;  // [J], of the board's own ledger with loan and allowance
  double least_own = 0;    // [J], with loan alone
  haptics::ServoSnapshot last;

 private:
  static haptics::ServoConfig servo_config() {
    haptics::ServoConfig config;
    config.probe_radius = 0;
    return config;
  }

  [[nodiscard]] bool happens(unsigned of_thousand) { return random_() % 1'000 < of_thousand; }

  void flip(std::vector<std::uint8_t>& octets) {
    std::uint8_t& octet = octets[random_() % octets.size()];
    octet = static_cast<std::uint8_t>(octet ^ (1U << random_() % 8));
  }

  void step() {
    for (std::vector<std::uint8_t>& frame : board.pass()) bring(std::move(frame));
    const auto now = board.now();
    for (const std::uint8_t octet : out.take(now)) board.take(octet);
    if (now >= next_step_) {
      next_step_ += std::chrono::milliseconds(1);
      if (servo_runs) step_servo(now);
    }
    const std::vector<std::uint8_t> octets = in.take(now);
    if (octets.empty() && now < next_wake_) return;
    next_wake_ = now + std::chrono::milliseconds(1);
    session->take(octets, now);
    if (out.is_sending(now)) return;
    if (const auto frame = session->next(now)) {
      std::vector<std::uint8_t> told(frame->span().begin(), frame->span().end());
      if (happens(faults.changed_out)) flip(told);
      if (!out_is_cut) out.send(told, now);
    }
  }

  void bring(std::vector<std::uint8_t> frame) {
    if (std::exchange(faults.next_lost, false) || in_is_cut || happens(faults.lost)) return;
    if (happens(faults.changed)) flip(frame);
    if (!kept_.empty()) {
      in.send(frame, board.now());
      in.send(std::exchange(kept_, {}), board.now());
      return;
    }
    if (happens(faults.swapped)) {
      kept_ = std::move(frame);
      return;
    }
    in.send(frame, board.now());
    if (happens(faults.doubled)) in.send(frame, board.now());
  }

  void step_servo(std::chrono::nanoseconds now) {
    if (other_servo) return other_servo(now);
    if (before_step) before_step(now);
    servo.step(now);
    servo.snapshots().update();
    last = servo.snapshots().read();
    const double own = board.books() + transferred(last) + last.loan + last.source_energy();
    least_own = std::min(least_own, own);
    least_books = std::min(least_books, own + last.encoder_allowance);
  }

  std::mt19937 random_;
  std::vector<std::uint8_t> kept_;
  std::chrono::nanoseconds next_step_, next_wake_{0};
};

/// Of a board with 2 N s/m of its own.
inline haptics::DeviceLimits board_limits(
    std::chrono::nanoseconds chain = haptics::UsbSettings::kChain) {
  haptics::UsbSettings settings;
  settings.damping = 2.0;
  settings.max_force = 5.0;
  settings.resolution = 20e-6;
  settings.chain = chain;
  return haptics::usb_limits(haptics::serial_facts(), settings);
}

inline haptics::Scene wall_of(const Eigen::Vector3d& normal, double stiffness = 20'000) {
  haptics::Scene scene;
  haptics::SceneObject object;
  object.effects.of<haptics::SpringDamper>().stiffness = stiffness;
  object.name = "wall";
  object.shape = haptics::PlaneShape{normal.normalized()};
  scene.objects.push_back(object);
  return scene;
}

inline Eigen::Vector3d pressing(double t) { return {0, 0, 0.02 - 0.04 * std::min(1.0, 2 * t)}; }

class PressingBoard : public WiredBoard {
 public:
  explicit PressingBoard(const SerialBoardOptions& options = {},
                         std::function<Vector3d(double)> hand = pressing,
                         const haptics::DeviceLimits& limits = board_limits(),
                         const haptics::Scene& scene = wall_of(Vector3d::UnitZ()))
      : WiredBoard(options, std::move(hand), limits, scene) {}

  // Until the force has arrived.
  void press() {
    run(std::chrono::seconds(3));
    ASSERT_GT(board.force().z(), 0.5) << "no wall is felt";
  }
};

}  // namespace reckon::test
