// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A Falcon or a Polhem, through the real libusb; a model answers the kernel calls.
#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <utility>

#include "reckon/haptics/falcon/falcon_driver.hpp"
#include "reckon/haptics/polhem/polhem_driver.hpp"
#include "reckon/haptics/usb/usb_device.hpp"
#include "reckon/haptics/usb/usb_loop.hpp"
#include "reckon/tests/fuzz/unplugs/counted_usb.hpp"
#include "reckon/tests/fuzz/unplugs/tried_device.hpp"
#include "reckon/tests/haptics/support/falcon_model.hpp"
#include "reckon/tests/haptics/support/plugged_device.hpp"
#include "reckon/tests/haptics/support/polhem_model.hpp"
#include "reckon/tests/haptics/support/usb_shim.hpp"

namespace reckon::fuzz::unplugs {
namespace {

using Eigen::Vector3d;
using haptics::UsbStage;
using std::chrono::microseconds;
using std::chrono::milliseconds;

constexpr nanoseconds kMotionStep = microseconds(100);
constexpr int kTransfers = 3;  // per line: two for input, one for output

struct Falcon {
  using Model = test::FalconModel;
  static constexpr nanoseconds kWatchdog = milliseconds(100);
  static Vector3d start() { return {0, 0, HeldHand::kGap}; }
  static std::vector<std::uint8_t> firmware() { return std::vector<std::uint8_t>(1'000, 0x5A); }
  static test::FalconModelOptions options(const Plan& plan) {
    test::FalconModelOptions options;
    options.seed = static_cast<unsigned>(plan.seed);
    options.out_at = plan.line.out_at;
    options.motion_step = kMotionStep;
    options.tick_at = plan.line.in_at;
    options.firmware = firmware();
    return options;
  }
  static std::unique_ptr<haptics::UsbDriver> driver() {
    return std::make_unique<haptics::FalconDriver>(haptics::FalconFirmware{firmware()});
  }
  static const haptics::UsbFacts& facts() { return haptics::falcon_facts(); }
  static constexpr bool kCanBeHomedAnywhere = true;
  static void home(Model& model) { model.home(); }
  static void damage(Model& model, int count) { model.damage_visibly(count); }
  // Another device does not answer.
  static void be_another(Model& model, nanoseconds time) { model.mute(time); }
  static void be_itself(Model&) {}
};

struct Polhem {
  using Model = test::PolhemModel;
  static constexpr nanoseconds kWatchdog = milliseconds(500);
  static Vector3d start() { return Model::start(); }
  static test::PolhemModelOptions options(const Plan& plan) {
    test::PolhemModelOptions options;
    options.seed = static_cast<unsigned>(plan.seed);
    options.out_at = plan.line.out_at;
    options.motion_step = kMotionStep;
    options.in_at = plan.line.in_at;
    return options;
  }
  static std::unique_ptr<haptics::UsbDriver> driver() {
    return std::make_unique<haptics::PolhemDriver>();
  }
  static const haptics::UsbFacts& facts() { return haptics::polhem_facts(); }
  static constexpr bool kCanBeHomedAnywhere = false;
  static void home(Model& model) { model.press(); }
  static void damage(Model& model, int count) { model.merge(count); }
  static void be_another(Model& model, nanoseconds) { model.disguise(true); }
  static void be_itself(Model& model) { model.disguise(false); }
};

// A report in pieces takes one more tick of the chip's timer.
haptics::DeviceLimits limits_of(const haptics::UsbFacts& facts, const Line& line) {
  haptics::UsbSettings settings;
  settings.damping = 2.0;
  if (line.splits) settings.chain *= 2;
  return haptics::usb_limits(facts, settings);
}

template <class Kind>
class TriedUsbDevice final : public TriedDevice {
 public:
  TriedUsbDevice(const Plan& plan, const HeldHand& hand)
      : model_(Kind::options(plan), [&hand](double t) { return hand(t); }),
        device_(exchange_, limits_of(Kind::facts(), plan.line)) {
    model_.split(plan.line.splits);
    shim_.at_each_call([this] { calls_.count(); });
  }
  ~TriedUsbDevice() override { model_.beside({}); }

  haptics::HapticDevice& device() override { return device_; }
  haptics::Scene scene() const override { return test::stiff_floor(); }
  // The wall is at the beginning of the hand's path.
  Vector3d origin() const override { return HeldHand::kGap * Vector3d::UnitZ() - Kind::start(); }

  nanoseconds now() const override { return model_.now(); }
  void pass(nanoseconds time) override { model_.pass(time); }
  void beside(Beside call) override {
    model_.beside([this, call = std::move(call)](nanoseconds now) {
      book_own_work(now);
      if (call) call(now);
    });
  }
  Vector3d place() const override { return model_.position(); }
  void lead(const Vector3d& place) override { model_.lead(place); }
  void let_go() override { model_.let_go(); }
  bool is_led() const override { return model_.is_led(); }

  nanoseconds watchdog() const override { return Kind::kWatchdog; }
  bool rests() const override { return model_.motors() == decltype(model_.motors()){}; }
  double force() const override { return model_.force().norm(); }
  std::uint64_t commands() const override { return model_.commands(); }
  // Without the work that the device did by itself.
  double books(const haptics::ServoSnapshot& servo) const override {
    return model_.port_work() + model_.damping_loss() - own_work_ + servo.loan +
           servo.source_energy() + servo.encoder_allowance;
  }

  void begin_program() override;
  void end_program() override { loop_.reset(); }
  bool has_program() const override { return loop_ != nullptr; }
  void stop() override { loop_->stop(); }
  void step(microseconds longest) override { loop_->step(longest); }
  std::vector<std::string> take_notices() override { return loop_->take_notices(); }
  Stage stage() const override;
  nanoseconds obeys_within() const override { return milliseconds(2); }
  std::optional<std::string> surplus() const override;
  unsigned tries() const override { return tries_; }

  void pull(bool loses_power) override {
    shim_.unplug();
    model_.forget_line();
    if (loses_power) model_.forget();
  }
  void plug() override { shim_.plug(); }
  bool is_plugged() const override { return shim_.is_plugged(); }
  bool loosen() override {
    shim_.fail(EPROTO, 1'000'000);
    return true;
  }
  void be_another(const Fault&, nanoseconds time) override { Kind::be_another(model_, time); }
  void be_itself() override { Kind::be_itself(model_); }
  bool strike(const Fault& fault, nanoseconds time) override;
  void lose_place() override { model_.forget(); }
  bool can_be_homed_anywhere() const override { return Kind::kCanBeHomedAnywhere; }
  void home() override { Kind::home(model_); }

 private:
  void book_own_work(nanoseconds now);
  [[nodiscard]] bool strike_line(const Fault& fault);

  typename Kind::Model model_;
  test::UsbShim shim_{model_};
  haptics::UsbExchange exchange_;
  haptics::UsbDevice device_;
  std::unique_ptr<haptics::UsbLoop> loop_;
  unsigned tries_ = 0;
  nanoseconds commanded_at_{};
  std::uint64_t commands_ = 0;
  double own_work_ = 0, work_ = 0;  // [J], of the motors
};

template <class Kind>
void TriedUsbDevice<Kind>::begin_program() {
  haptics::UsbLoopOptions options;
  options.clock = [this] { return model_.now(); };
  options.discover = false;
  options.open = [this](libusb_context* context) {
    haptics::UsbOpening opening{shim_.open(context), {}};
    if (opening.handle == nullptr) opening.problem = "none is attached";
    ++tries_;
    return opening;
  };
  loop_ = std::make_unique<haptics::UsbLoop>(exchange_, Kind::driver(), std::move(options));
}

template <class Kind>
Stage TriedUsbDevice<Kind>::stage() const {
  const std::optional<UsbStage> stage = loop_ ? loop_->stage() : std::nullopt;
  if (!stage) return Stage::away;
  if (*stage == UsbStage::running) return Stage::running;
  return *stage == UsbStage::homing ? Stage::homing : Stage::opened;
}

template <class Kind>
std::optional<std::string> TriedUsbDevice<Kind>::surplus() const {
  const bool has_line = stage() != Stage::away;
  const UsbCount& usb = counted_usb();
  const int handles = has_line ? 1 : 0;
  if (usb.handles == handles && usb.transfers == kTransfers * handles &&
      (has_line || shim_.outstanding() == 0))
    return {};
  return fmt::format("{} handles, {} transfers, {} of them under way, {} a line",
                     usb.handles.load(), usb.transfers.load(), shim_.outstanding(),
                     has_line ? "with" : "without");
}

// A device that is pulled out holds its last force until its own watchdog acts. Its driver cannot
// change that, and the servo relies on 10 ms: later work is not in its ledger.
template <class Kind>
void TriedUsbDevice<Kind>::book_own_work(nanoseconds now) {
  if (model_.commands() != std::exchange(commands_, model_.commands())) commanded_at_ = now;
  const double work = model_.port_work() - std::exchange(work_, model_.port_work());
  if (now - commanded_at_ > haptics::HapticDevice::kWatchdog) own_work_ += work;
}

// A line that breaks but stays plugged. A cancelled transfer is not a failed one.
template <class Kind>
bool TriedUsbDevice<Kind>::strike_line(const Fault& fault) {
  static constexpr std::array kErrors{EPROTO, EILSEQ, EOVERFLOW, ETIME, EPIPE, ENOSR, ENOENT};
  const int error = kErrors[fault.call % kErrors.size()];
  switch (fault.kind) {
    case FaultKind::stall:
      model_.stall();
      return true;
    case FaultKind::cut:
      model_.cut();
      return true;
    case FaultKind::errors:
      shim_.fail(error, fault.number);
      return error != ENOENT;
    default:
      shim_.reset_port();
      model_.forget_line();
      return false;
  }
}

template <class Kind>
bool TriedUsbDevice<Kind>::strike(const Fault& fault, nanoseconds time) {
  switch (fault.kind) {
    case FaultKind::hang:
      model_.hang(time);
      return false;
    case FaultKind::mute:
      model_.mute(time);
      return false;
    case FaultKind::damage:
      Kind::damage(model_, static_cast<int>(fault.number));
      return false;
    default:
      return strike_line(fault);
  }
}

}  // namespace

Vector3d start_of(DeviceKind kind) {
  return kind == DeviceKind::polhem ? Polhem::start() : Falcon::start();
}

std::unique_ptr<TriedDevice> tried_usb_device(const Plan& plan, const HeldHand& hand) {
  if (plan.device == DeviceKind::polhem)
    return std::make_unique<TriedUsbDevice<Polhem>>(plan, hand);
  return std::make_unique<TriedUsbDevice<Falcon>>(plan, hand);
}

}  // namespace reckon::fuzz::unplugs
