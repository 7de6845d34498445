// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A force feedback device behind the calls of the kernel.
#include <linux/input.h>

#include <cerrno>
#include <utility>

#include "reckon/haptics/evdev/evdev_loop.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/tests/fuzz/touch/model_handle.hpp"
#include "reckon/tests/haptics/support/evdev_model.hpp"

namespace reckon::fuzz {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr nanoseconds kReady = milliseconds(500);

constexpr double kSteps = 2;  // position steps, one per axis

class EventHandle final : public ModelHandle {
 public:
  EventHandle(const Scenario& s, Way way)
      : ModelHandle(s, std::move(way)),
        settings_(settings(s)),
        device_(exchange_, haptics::evdev_limits(settings_)) {
    auto calls = std::make_unique<test::EvdevModel>(options(s), [this](double t) {
      const Eigen::Vector3d place = wanted(t);
      return test::EvdevModel::Places{place.x(), place.y()};
    });
    model_ = calls.get();
    loop_ = std::make_unique<haptics::EvdevLoop>(exchange_, settings_, std::move(calls),
                                                 [this] { return model_->now(); });
    begin_books();
    while (now() < kReady) {
      device_.state({}, now());
      pass(milliseconds(1));
    }
    model_->beside([this](nanoseconds now) { tick(now); });
    begin_at(now());
  }
  ~EventHandle() override { model_->beside({}); }

  [[nodiscard]] haptics::HapticDevice& device() override { return device_; }
  [[nodiscard]] Eigen::Vector3d force() const override {
    return {model_->force(0), model_->force(1), 0};
  }
  [[nodiscard]] bool tells_why() const override { return is_gone_; }
  // The servo knows its positions to a whole step.
  [[nodiscard]] double work_known() const override {
    return ModelHandle::work_known() +
           kSteps * settings_.scale.travel / 65535 * model_->greatest_force();
  }
  [[nodiscard]] bool keeps_limits() const override {
    return model_->fastest() <= settings_.max_speed;
  }

 private:
  static test::EvdevModelOptions options(const Scenario& s) {
    test::EvdevModelOptions options;
    options.seed = s.seed;
    options.mass = s[Shared::mass];
    options.hand_stiffness = s[Shared::grip];
    options.hand_damping = s[Shared::grip_damping];
    options.report = std::chrono::duration_cast<microseconds>(pdu::from_seconds(s[Shared::report]));
    options.latency = std::chrono::duration_cast<microseconds>(pdu::from_seconds(s[Shared::lag]));
    options.takes = s.seed % 2 == 0 ? milliseconds(1) : microseconds(125);
    options.misses_turns = s.seed % 4 > 1;
    options.ends_effects = s.seed % 3 != 0;
    return options;
  }
  static haptics::EvdevSettings settings(const Scenario& s) {
    haptics::EvdevSettings settings = test::settings_for(options(s));
    settings.chain += pdu::from_seconds(s[Shared::chain]);
    return settings;
  }

  void pass(nanoseconds time) override {
    for (const nanoseconds end = now() + time; now() < end;) {
      loop_->step(milliseconds(1));
      static_cast<void>(loop_->take_notices());
    }
  }
  [[nodiscard]] nanoseconds now() const override { return model_->now(); }
  // It has no damping.
  [[nodiscard]] double port_work_now() const override { return model_->absorbed(); }
  [[nodiscard]] double work_now() const override { return model_->absorbed(); }
  [[nodiscard]] nanoseconds known_until() const override {
    return now() - settings_.chain - milliseconds(10);
  }

  void befall(Fault fault, nanoseconds /*lasts*/) override {
    switch (fault) {
      case Fault::cut:
        return model_->fail_writes(EAGAIN);
      case Fault::damage:
        return model_->drop_events();
      case Fault::errors:
        return model_->fail(EVIOCSFF, EIO);
      case Fault::unplug:
      case Fault::power:
        is_gone_ = true;
        return model_->plug(false);
      default:
        return;
    }
  }
  void mend(Fault fault) override {
    model_->fail_writes(0);
    model_->fail(EVIOCSFF, 0);
    if (fault == Fault::unplug || fault == Fault::power) model_->plug(true);
    is_gone_ = false;
  }

  haptics::EvdevSettings settings_;
  haptics::EvdevExchange exchange_;
  haptics::EvdevDevice device_;
  test::EvdevModel* model_ = nullptr;  // owned by the loop
  std::unique_ptr<haptics::EvdevLoop> loop_;
  bool is_gone_ = false;
};

}  // namespace

std::unique_ptr<ModelHandle> event_handle(const Scenario& scenario, ModelHandle::Way way) {
  return std::make_unique<EventHandle>(scenario, std::move(way));
}

}  // namespace reckon::fuzz
