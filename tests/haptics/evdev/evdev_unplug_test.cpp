// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// An event device that is pulled out before any of the calls that its loop makes, and at random
// instants.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <functional>
#include <memory>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "reckon/haptics/evdev/evdev_device.hpp"
#include "reckon/haptics/evdev/evdev_loop.hpp"
#include "reckon/haptics/servo/servo_loop.hpp"
#include "reckon/tests/haptics/support/evdev_model.hpp"

namespace reckon::haptics {
namespace {

using Eigen::Vector3d;
using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using test::EvdevModel;
using test::EvdevModelOptions;
using test::settings_for;
using ::testing::AnyOf;
using ::testing::Each;
using ::testing::HasSubstr;

/// A file that was open when the device was pulled out stays as dead as it was.
class PulledCalls final : public EventCalls {
 public:
  explicit PulledCalls(EvdevModel& model) : model_(model) {}

  void pull() {
    model_.plug(false);
    is_dead_ = true;
  }
  void plug() { model_.plug(true); }
  std::function<void()> at_each_call = [] {};

  std::vector<std::string> paths() override { return at_each_call(), model_.paths(); }
  std::string closed_name(const std::string& path) override { return model_.closed_name(path); }
  ReportIntervals report_intervals(const std::string& path) override {
    return model_.report_intervals(path);
  }
  int open(const std::string& path) override {
    at_each_call();
    const int file = model_.open(path);
    if (file >= 0) is_dead_ = false;
    return file;
  }
  void close(int file) noexcept override { model_.close(file); }
  int control(int file, unsigned long request, void* argument) noexcept override {
    at_each_call();
    return is_dead_ ? -ENODEV : model_.control(file, request, argument);
  }
  int read(int file, std::span<input_event> events) noexcept override {
    at_each_call();
    return is_dead_ ? -ENODEV : model_.read(file, events);
  }
  int write(int file, const input_event& event) noexcept override {
    at_each_call();
    return is_dead_ ? -ENODEV : model_.write(file, event);
  }
  void wait(int file, microseconds longest) noexcept override { model_.wait(file, longest); }

 private:
  EvdevModel& model_;
  bool is_dead_ = false;
};

Scene one_wall() {
  Scene scene;
  SceneObject& wall = scene.objects.emplace_back();
  wall.name = "wall";
  wall.shape = PlaneShape{Vector3d::UnitX()};
  wall.pose.position = {-0.02, 0, 0};
  wall.effects.of<SpringDamper>().stiffness = 1'000;
  return scene;
}

// Into the wall and out of it, five times a second.
EvdevModel::Places swaying(double t) { return {-0.02 + 0.01 * std::sin(30 * t), 0}; }

class Plugged {
 public:
  Plugged()
      : model(EvdevModelOptions{}, swaying),
        device(exchange, evdev_limits(settings)),
        servo(device, EffectPlan(one_wall()), {}) {
    auto owned = std::make_unique<PulledCalls>(model);
    calls = owned.get();
    loop = std::make_unique<EvdevLoop>(exchange, settings, std::move(owned),
                                       [this] { return model.now(); });
    model.beside([this](nanoseconds now) {
      if (now < next_step_) return;
      next_step_ += milliseconds(1);
      servo.step(now);
      servo.snapshots().update();
    });
  }

  void run(nanoseconds time) {
    for (const nanoseconds end = model.now() + time; model.now() < end;) {
      const nanoseconds before = model.now();
      loop->step(milliseconds(1));
      for (std::string& notice : loop->take_notices()) notices.push_back(std::move(notice));
      if (model.now() == before) model.pass(microseconds(50));  // it looked for the device
    }
  }
  [[nodiscard]] bool is_ready() const {
    return std::ranges::any_of(
        notices, [](const std::string& one) { return one.find("ready") != std::string::npos; });
  }
  // 10 ms after it was pulled out.
  void expect_nothing() {
    EXPECT_EQ(servo.snapshots().read().force, Vector3d::Zero());
    EXPECT_FALSE(servo.snapshots().read().enabled);
    EXPECT_EQ(model.open_files(), 0);
    EXPECT_EQ(model.force(0), 0);
  }
  void expect_back() {
    notices.clear();
    calls->plug();
    run(EvdevLoop::kRetry + milliseconds(10));
    EXPECT_TRUE(is_ready());
    EXPECT_LE(notices.size(), 1U);
  }

  EvdevModel model;
  EvdevSettings settings = settings_for(EvdevModelOptions{});
  EvdevExchange exchange;
  EvdevDevice device;
  ServoLoop servo;
  PulledCalls* calls = nullptr;
  std::unique_ptr<EvdevLoop> loop;
  std::vector<std::string> notices;

 private:
  nanoseconds next_step_{0};
};

TEST(EvdevUnplug, BeforeEachCallItIsSaidAndTakenUpAgain) {
  constexpr unsigned kCalls = 60;  // those of the set-up, and some of its use
  for (unsigned call = 0; call < kCalls; ++call) {
    SCOPED_TRACE(call);
    Plugged plugged;
    unsigned made = 0;
    bool is_pulled = false;
    plugged.calls->at_each_call = [&] {
      if (made++ != call) return;
      is_pulled = true;
      plugged.calls->pull();
    };
    while (!is_pulled) plugged.run(microseconds(50));
    plugged.run(milliseconds(10));
    plugged.expect_nothing();
    EXPECT_THAT(plugged.notices,
                Each(AnyOf(HasSubstr("was unplugged"), HasSubstr("attached"), HasSubstr("ready"))));
    EXPECT_LE(plugged.notices.size(), 2U);
    plugged.expect_back();
  }
}

TEST(EvdevUnplug, AtRandomInstantsNoForceIsLeftAndItIsTakenUpAgain) {
  std::mt19937 random(11);
  Plugged plugged;
  double most = 0;
  for (int round = 0; round < 100; ++round) {
    SCOPED_TRACE(round);
    plugged.run(microseconds(50) * (random() % 8'000));
    most = std::max(most, plugged.model.force(0));
    plugged.notices.clear();
    plugged.calls->pull();
    // It may be there again before anything was noticed.
    if (round % 4 == 0) plugged.calls->plug();
    plugged.run(milliseconds(10));
    plugged.expect_nothing();
    EXPECT_THAT(plugged.notices, ::testing::SizeIs(1));
    if (round % 4 == 1) plugged.run(milliseconds(1) * (random() % 600));
    plugged.expect_back();
  }
  EXPECT_GT(most, 1) << "pulled out under a force";
  EXPECT_GE(plugged.model.least_absorbed(), -1e-9);
}

}  // namespace
}  // namespace reckon::haptics
