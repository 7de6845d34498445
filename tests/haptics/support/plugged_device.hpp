// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A device on USB behind the real libusb, with the thread and the servo that use it; a model
// answers the kernel's calls. All of them use the model's clock.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/haptics/servo/servo_loop.hpp"
#include "reckon/haptics/usb/usb_device.hpp"
#include "reckon/haptics/usb/usb_loop.hpp"
#include "reckon/tests/haptics/support/drawn_touch.hpp"
#include "reckon/tests/haptics/support/usb_shim.hpp"

namespace reckon::test {

/// A floor at z = 0 of 20,000 N/m, softened to the device's limit.
inline haptics::Scene stiff_floor() {
  haptics::Scene scene;
  haptics::SceneObject object;
  object.effects.of<haptics::SpringDamper>().stiffness = 20'000;
  object.name = "wall";
  object.shape = haptics::PlaneShape{Eigen::Vector3d::UnitZ()};
  scene.objects.push_back(object);
  return scene;
}

/// Limits of a device with 2 N s/m of its own.
inline haptics::DeviceLimits damped_limits(const haptics::UsbFacts& facts) {
  haptics::UsbSettings settings;
  settings.damping = 2.0;
  return haptics::usb_limits(facts, settings);
}

/// The servo steps every millisecond, beside the thread.
template <class Model>
class PluggedDevice {
 public:
  using Hand = std::function<Eigen::Vector3d(double)>;

  /// @param middle of the scene's origin [m, frame D]
  template <class Options>
  PluggedDevice(const Options& options, Hand wanted, std::unique_ptr<haptics::UsbDriver> driver,
                const haptics::DeviceLimits& limits, const haptics::Scene& scene = stiff_floor(),
                const Eigen::Vector3d& middle = Eigen::Vector3d::Zero())
      : PluggedDevice(options, std::move(wanted), std::move(driver), limits, scene,
                      std::make_shared<const haptics::EffectPlan>(scene), middle) {}
  template <class Options>
  PluggedDevice(const Options& options, Hand wanted, std::unique_ptr<haptics::UsbDriver> driver,
                const haptics::DeviceLimits& limits, const haptics::Scene& scene,
                std::shared_ptr<const haptics::EffectPlan> plan,
                const Eigen::Vector3d& middle = Eigen::Vector3d::Zero())
      : model(options, tended(std::move(wanted))),
        shim(model),
        device(exchange, limits),
        servo(device, plan, servo_config(middle), haptics::make_bodies(*plan, scene)) {
    begin_thread(std::move(driver));
    model.beside([this](std::chrono::nanoseconds now) {
      tend();
      if (!motors_rest()) pulled_at = now;
      if (now < next_step_) return;
      next_step_ += std::chrono::milliseconds(1);
      if (servo_runs) step_servo(now);
    });
  }

  /// Replaces the present thread.
  void begin_thread(std::unique_ptr<haptics::UsbDriver> driver) {
    loop.reset();
    loop = std::make_unique<haptics::UsbLoop>(exchange, std::move(driver), loop_options());
  }

  void run(std::chrono::nanoseconds time) {
    const std::chrono::nanoseconds end = model.now() + time;
    while (model.now() < end) {
      loop->step(std::chrono::milliseconds(1));
      for (std::string& notice : loop->take_notices()) notices.push_back(std::move(notice));
    }
  }

  /// A step of 50 us of a person's actions on it.
  void tend() {
    if (loop) care_.tend(model, *loop);
  }
  [[nodiscard]] bool motors_rest() const { return model.motors() == decltype(model.motors()){}; }
  /// [J], of the device's own ledger: the hand's input since its start.
  [[nodiscard]] double books() const {
    return model.port_work() + model.damping_loss() + model.lifted() - first_;
  }
  /// Starts the ledger now; nothing may be touched.
  void begin_books() {
    first_ += books();
    least_own = least_books = 0;
  }

 private:
  typename Model::Care care_;  // actions of a person on it

 public:
  std::function<void(std::chrono::nanoseconds)> before_step;  // of the servo
  Model model;
  UsbShim shim;
  haptics::UsbExchange exchange;
  haptics::UsbDevice device;
  haptics::ServoLoop servo;
  std::unique_ptr<haptics::UsbLoop> loop;
  std::vector<std::string> notices;
  bool servo_runs = true;
  std::chrono::nanoseconds pulled_at{0};  // last force of its motors
  double least_own = 0;                   // [J], of the device's own ledger with loan
  double least_books = 0;                 // [J], of the device's own ledger with loan and allowance
  haptics::ServoSnapshot last;

 private:
  Hand tended(Hand wanted) {
    return [this, wanted = std::move(wanted)](double t) { return care_.hand(wanted(t)); };
  }

  static haptics::ServoConfig servo_config(const Eigen::Vector3d& middle) {
    haptics::ServoConfig config;
    config.probe_radius = 0;
    config.device_origin = -middle;
    return config;
  }

  haptics::UsbLoopOptions loop_options() {
    haptics::UsbLoopOptions options;
    options.clock = [this] { return model.now(); };
    options.open = [this](libusb_context* context) {
      haptics::UsbOpening opening{shim.open(context), {}};
      if (opening.handle == nullptr) opening.problem = "none is attached";
      return opening;
    };
    options.discover = false;
    return options;
  }

  void step_servo(std::chrono::nanoseconds now) {
    if (before_step) before_step(now);
    servo.step(now);
    servo.snapshots().update();
    last = servo.snapshots().read();
    const double own = books() + transferred(last) + last.loan + last.source_energy();
    least_own = std::min(least_own, own);
    least_books = std::min(least_books, own + last.encoder_allowance);
  }

  double first_ = 0;
  std::chrono::nanoseconds next_step_ = std::chrono::milliseconds(1);
};

}  // namespace reckon::test
