// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A force feedback device without a kernel driver, by its HID reports.
#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <utility>

#include "reckon/tests/fuzz/unplugs/tried_event_loop.hpp"
#include "reckon/tests/haptics/support/hid_wheel.hpp"

namespace reckon::fuzz::unplugs {
namespace {

using std::chrono::microseconds;
using test::HidWheel;

constexpr unsigned kUntilPulled = 1'000'000;
// Refused calls; each may cost an attempt, and attempts are half a second apart.
constexpr unsigned kMostRefused = 4;

class TriedHidDevice final : public TriedEventLoop {
 public:
  TriedHidDevice(const Plan& plan, const HeldHand& hand)
      : TriedEventLoop(settings(plan)), model_(options(plan), [&hand](double t) {
          return HidWheel::Places{hand(t).z(), 0};
        }) {
    model_.at_each_call = [this] { calls_.count(); };
  }
  ~TriedHidDevice() override {
    end_loop();
    model_.beside({});
  }

  nanoseconds now() const override { return model_.now(); }
  void pass(nanoseconds time) override { model_.pass(time); }
  void beside(Beside call) override { model_.beside(std::move(call)); }
  Vector3d place() const override { return {0, model_.wheel.place(1), model_.wheel.place(0)}; }
  void lead(const Vector3d& place) override { model_.wheel.hold({{place.z(), place.y()}}); }
  void let_go() override { model_.wheel.hold({}); }
  bool is_led() const override { return model_.wheel.is_held(); }

  double force() const override { return std::hypot(model_.wheel.force(0), model_.wheel.force(1)); }
  std::uint64_t commands() const override { return model_.wheel.orders(); }
  // Energy of its springs: the device's own ledger has no debts and no allowances.
  double books(const haptics::ServoSnapshot&) const override {
    return model_.wheel.least_absorbed();
  }
  unsigned tries() const override { return model_.tries(); }

  void pull(bool) override {
    model_.plug(false);
    model_.fail(HidWheel::Call::write, 0, 0);
    model_.fail(HidWheel::Call::set_feature, 0, 0);
    model_.fail(HidWheel::Call::get_feature, 0, 0);
    model_.fail_reads(0);
    model_.slow_down({}, 0);
  }
  void plug() override { model_.plug(true); }
  bool is_plugged() const override { return model_.is_plugged(); }
  bool loosen() override {
    model_.fail(HidWheel::Call::write, -EIO, kUntilPulled);
    return false;
  }
  void be_another(const Fault& fault, nanoseconds) override {
    static constexpr std::array<int, 4> kLacking{0x63, 0x50, 0x23, 0x25};
    test::PidWheelOptions another = options({}).wheel;
    another.without = {kLacking[fault.call % kLacking.size()]};
    model_.seen.descriptor = test::PidWheel(another).descriptor();
  }
  void be_itself() override { model_.seen.descriptor = model_.wheel.descriptor(); }
  void deny(int error) override { model_.opening = -error; }
  bool strike(const Fault& fault, nanoseconds time) override {
    if (fault.kind == FaultKind::errors) {
      model_.fail_reads(fault.number);
      return true;
    }
    if (fault.kind == FaultKind::slow) {
      model_.slow_down(std::chrono::duration_cast<microseconds>(time), fault.number);
      return false;
    }
    static constexpr std::array kErrors{EPIPE, ETIMEDOUT, EIO, ENOMEM};
    static constexpr std::array kCalls{HidWheel::Call::write, HidWheel::Call::set_feature,
                                       HidWheel::Call::get_feature};
    model_.fail(kCalls[fault.call % kCalls.size()], -kErrors[fault.call % kErrors.size()],
                1 + fault.number % kMostRefused);
    return false;
  }

 protected:
  std::unique_ptr<haptics::EventCalls> make_calls() override { return test::calls_of(model_); }
  int open_files() const override { return model_.open_files(); }
  std::size_t effects() const override { return model_.wheel.effects(); }

 private:
  static test::HidWheelOptions options(const Plan& plan) {
    test::HidWheelOptions options;
    options.wheel.hand_speed = 2.0;
    options.takes = microseconds(plan.seed % 2 == 0 ? 250 : 125);
    options.answers = microseconds(125);
    return options;
  }
  static haptics::EvdevSettings settings(const Plan& plan) {
    haptics::EvdevSettings settings = test::settings_for(options(plan));
    settings.max_speed = 2.0;
    return settings;
  }

  HidWheel model_;
};

}  // namespace

std::unique_ptr<TriedDevice> tried_hid_device(const Plan& plan, const HeldHand& hand) {
  return std::make_unique<TriedHidDevice>(plan, hand);
}

}  // namespace reckon::fuzz::unplugs
