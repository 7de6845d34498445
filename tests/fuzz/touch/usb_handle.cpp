// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A Falcon or a Polhem below the real libusb.
#include <cerrno>
#include <cmath>
#include <utility>

#include "reckon/haptics/falcon/falcon_driver.hpp"
#include "reckon/haptics/polhem/polhem_driver.hpp"
#include "reckon/haptics/usb/usb_limits.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/tests/fuzz/touch/model_handle.hpp"
#include "reckon/tests/haptics/support/falcon_model.hpp"
#include "reckon/tests/haptics/support/plugged_device.hpp"
#include "reckon/tests/haptics/support/polhem_model.hpp"

namespace reckon::fuzz {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr nanoseconds kReady = std::chrono::seconds(8);
constexpr nanoseconds kSettles = milliseconds(50);
constexpr nanoseconds kPollInterval = milliseconds(10);
constexpr nanoseconds kMotionStep = std::chrono::microseconds(100);
constexpr double kThere = 1e-3;  // [m]
constexpr double kStill = 1e-8;  // [m] in a poll
constexpr int kDamaged = 5;
constexpr unsigned kErrors = 3;

struct Falcon {
  using Model = test::FalconModel;
  static test::FalconModelOptions options(const Scenario& s) {
    test::FalconModelOptions options;
    options.tick_at = s[Shared::phase_in];
    if (s[Shared::lag] > 0) options.latency_set = static_cast<int>(std::ceil(1e3 * s[Shared::lag]));
    return options;
  }
  static std::unique_ptr<haptics::UsbDriver> driver() {
    return std::make_unique<haptics::FalconDriver>(haptics::FalconFirmware{});
  }
  static const haptics::UsbFacts& facts() { return haptics::falcon_facts(); }
  static void lose_power(Model& model) {
    model.forget();
    model.wake();
  }
  static void damage(Model& model) { model.damage_visibly(kDamaged); }
  static void disorder(Model& model, bool on) { model.split(on); }
};

struct Polhem {
  using Model = test::PolhemModel;
  static test::PolhemModelOptions options(const Scenario& s) {
    test::PolhemModelOptions options;
    options.in_at = s[Shared::phase_in];
    return options;
  }
  static std::unique_ptr<haptics::UsbDriver> driver() {
    return std::make_unique<haptics::PolhemDriver>();
  }
  static const haptics::UsbFacts& facts() { return haptics::polhem_facts(); }
  static void lose_power(Model& model) { model.forget(); }
  static void damage(Model& model) { model.merge(kDamaged); }
  static void disorder(Model& model, bool on) { model.merge(on ? 1 : 0); }
};

template <class Kind>
class UsbHandle final : public ModelHandle {
 public:
  UsbHandle(const Scenario& s, nanoseconds period, Way way)
      : ModelHandle(s, std::move(way)),
        lag_(pdu::from_seconds(s[Shared::lag]) + milliseconds(3)),
        plugged_(
            options(s), [this](double t) { return wanted(t); }, Kind::driver(),
            haptics::usb_limits(Kind::facts(), settings(s, period)), haptics::Scene()) {
    for (Eigen::Vector3d last = plugged_.model.position(); plugged_.model.now() < kReady;) {
      plugged_.run(kPollInterval);
      const Eigen::Vector3d& place = plugged_.model.position();
      if (is_ready() && (place - std::exchange(last, place)).norm() < kStill) break;
    }
    begin_books();
    plugged_.run(kSettles);
    plugged_.model.beside([this](nanoseconds now) {
      plugged_.tend();
      book_own_work(now);
      tick(now);
    });
    begin_at(plugged_.model.now());
  }
  ~UsbHandle() override { plugged_.model.beside({}); }

  [[nodiscard]] haptics::HapticDevice& device() override { return plugged_.device; }
  [[nodiscard]] Eigen::Vector3d force() const override { return plugged_.model.force(); }
  [[nodiscard]] double rounding() const override { return plugged_.model.rounding(); }
  [[nodiscard]] bool tells_why() const override { return !runs(); }

 private:
  static auto options(const Scenario& s) {
    auto options = Kind::options(s);
    options.seed = s.seed;
    options.mass = s[Shared::mass];
    options.damping = s[Shared::model_damping];
    options.hand_stiffness = s[Shared::grip];
    options.hand_damping = s[Shared::grip_damping];
    options.out_at = s[Shared::phase_out];
    options.motion_step = kMotionStep;
    return options;
  }
  static haptics::UsbSettings settings(const Scenario& s, nanoseconds period) {
    haptics::UsbSettings settings;
    settings.damping = s[Shared::stated] * s[Shared::model_damping];
    settings.period = period;
    settings.chain = pdu::from_seconds(s[Shared::chain]);
    return settings;
  }

  [[nodiscard]] bool runs() const { return plugged_.loop->stage() == haptics::UsbStage::running; }
  [[nodiscard]] bool is_ready() const {
    return runs() && (plugged_.model.position() - wanted(0)).norm() < kThere;
  }
  // Work of a device that has received no command for 10 ms is not in the servo's ledger: its own
  // watchdog is slower.
  void book_own_work(nanoseconds now) {
    if (plugged_.model.commands() != std::exchange(commands_, plugged_.model.commands()))
      commanded_at_ = now;
    const double work = plugged_.model.port_work();
    if (now - commanded_at_ > haptics::HapticDevice::kWatchdog) own_work_ += work - work_;
    work_ = work;
  }

  void pass(nanoseconds time) override { plugged_.run(time); }
  [[nodiscard]] nanoseconds now() const override { return plugged_.model.now(); }
  [[nodiscard]] double port_work_now() const override {
    return plugged_.model.port_work() - own_work_;
  }
  [[nodiscard]] double work_now() const override {
    return port_work_now() + plugged_.model.damping_loss() + plugged_.model.lifted();
  }
  [[nodiscard]] nanoseconds known_until() const override { return plugged_.device.heard() - lag_; }

  void befall(Fault fault, nanoseconds lasts) override {
    auto& model = plugged_.model;
    switch (fault) {
      case Fault::hang:
        return model.hang(lasts);
      case Fault::mute:
        return model.mute(lasts);
      case Fault::cut:
        return scenario().seed % 2 == 0 ? model.stall() : model.cut();
      case Fault::damage:
        return Kind::damage(model);
      case Fault::disorder:
        return Kind::disorder(model, true);
      case Fault::errors:
        return plugged_.shim.fail(EPROTO, kErrors);
      case Fault::reset:
        plugged_.shim.reset_port();
        return model.forget_line();
      case Fault::unplug:
        plugged_.shim.unplug();
        return model.forget_line();
      case Fault::power:
        plugged_.shim.unplug();
        return Kind::lose_power(model);
      default:
        return;
    }
  }
  void mend(Fault fault) override {
    if (fault == Fault::disorder) Kind::disorder(plugged_.model, false);
    if (fault == Fault::unplug || fault == Fault::power) plugged_.shim.plug();
  }

  nanoseconds lag_;
  mutable test::PluggedDevice<typename Kind::Model> plugged_;
  std::uint64_t commands_ = 0;
  nanoseconds commanded_at_{0};
  double own_work_ = 0, work_ = 0;
};

}  // namespace

std::unique_ptr<ModelHandle> usb_handle(const Scenario& scenario, nanoseconds period,
                                        ModelHandle::Way way) {
  if (scenario.model() == Model::falcon)
    return std::make_unique<UsbHandle<Falcon>>(scenario, period, std::move(way));
  return std::make_unique<UsbHandle<Polhem>>(scenario, period, std::move(way));
}

}  // namespace reckon::fuzz
