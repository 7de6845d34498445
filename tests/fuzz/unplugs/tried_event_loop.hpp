// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Common parts of devices that render springs by themselves in a trial: the loop that uploads
// walls, and the servo's side. Their x is the trial's z.
#pragma once

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "reckon/haptics/evdev/evdev_device.hpp"
#include "reckon/haptics/evdev/evdev_loop.hpp"
#include "reckon/tests/fuzz/unplugs/tried_device.hpp"

namespace reckon::fuzz::unplugs {

class TriedEventLoop : public TriedDevice {
 public:
  explicit TriedEventLoop(const haptics::EvdevSettings& settings)
      : settings_(settings), device_(exchange_, haptics::evdev_limits(settings_)) {}

  haptics::HapticDevice& device() override { return device_; }
  haptics::Scene scene() const override {
    haptics::Scene scene;
    haptics::SceneObject& wall = scene.objects.emplace_back();
    wall.name = "wall";
    wall.shape = haptics::PlaneShape{Vector3d::UnitX()};
    wall.effects.of<haptics::SpringDamper>().stiffness = 1'000;
    return scene;
  }
  Vector3d origin() const override { return Vector3d::Zero(); }

  nanoseconds watchdog() const override { return haptics::EvdevLoop::kLength + kTakesUp; }
  bool rests() const override { return force() == 0; }
  // The servo reports the device's own force until its effects end.
  double asked(const haptics::ServoSnapshot& servo) const override {
    return servo.enabled ? servo.force.norm() : 0;
  }

  void begin_program() override {
    loop_ = std::make_unique<haptics::EvdevLoop>(exchange_, settings_, make_calls(),
                                                 [this] { return now(); });
  }
  void end_program() override {
    is_ready_ = false;
    loop_.reset();
    pass(kBegins);
  }
  bool has_program() const override { return loop_ != nullptr; }
  void step(std::chrono::microseconds longest) override { loop_->step(longest); }
  std::vector<std::string> take_notices() override {
    std::vector<std::string> notices = loop_->take_notices();
    for (const std::string& notice : notices)
      is_ready_ = notice.find(": ready") != std::string::npos;
    return notices;
  }
  Stage stage() const override {
    if (open_files() == 0) return Stage::away;
    return is_ready_ ? Stage::running : Stage::opened;
  }
  nanoseconds obeys_within() const override { return std::chrono::milliseconds(2); }
  std::optional<std::string> surplus() const override {
    if (open_files() > 1) return std::to_string(open_files()) + " files are open";
    if (open_files() == 1 && loop_ == nullptr) return "a file is left open";
    if (open_files() == 1 && effects() > 2 * kEffects)
      return std::to_string(effects()) + " effects are held";
    return {};
  }
  void lose_place() override {}
  void home() override {}
  // A wall that already contains the hand would cost energy.
  nanoseconds shows_after() const override { return std::chrono::milliseconds(105); }

 protected:
  /// The calls of the next loop.
  [[nodiscard]] virtual std::unique_ptr<haptics::EventCalls> make_calls() = 0;
  [[nodiscard]] virtual int open_files() const = 0;
  [[nodiscard]] virtual std::size_t effects() const = 0;
  void end_loop() { loop_.reset(); }

 private:
  static constexpr std::size_t kEffects = 2;  // of the loop
  // A change that it takes while its effects end.
  static constexpr nanoseconds kTakesUp = std::chrono::milliseconds(2);
  // A restarted program is not ready sooner.
  static constexpr nanoseconds kBegins = std::chrono::milliseconds(20);

  haptics::EvdevSettings settings_;
  haptics::EvdevExchange exchange_;
  haptics::EvdevDevice device_;
  bool is_ready_ = false;  // the loop reported it
  std::unique_ptr<haptics::EvdevLoop> loop_;
};

}  // namespace reckon::fuzz::unplugs
