// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/exercise/real_measuring.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <stdexcept>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "reckon/haptics/measurement/measuring_servo.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/notation/units.hpp"
#include "reckon/peer/scene/belongings.hpp"
#include "reckon/peer/scene/device_descriptor.hpp"
#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/peer/threads/servo_thread.hpp"
#include "reckon/tools/exercise/device_measuring.hpp"
#include "reckon/tools/exercise/simulated_hand.hpp"
#include "reckon/tools/exercise/stop_control.hpp"
#include "reckon/tools/terminal/keys.hpp"

namespace reckon::tools {
namespace {

using haptics::DeviceMeasurement;
using haptics::MeasuringServo;
using haptics::MeasuringStage;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr milliseconds kServoPeriod{1};
constexpr milliseconds kKeyPollInterval{20};  // maximum delay of a key
constexpr milliseconds kSettling{3000};       // after Enter, for readings that fail now and then
constexpr milliseconds kShutdownDrain{50};    // for a zero force to reach the device
constexpr std::chrono::seconds kReadyWithin{60};  // until it is ready, if there is no terminal

// Whether the maker of its devices alone knows their force.
bool states_force(const peer::Driver& driver) {
  return driver.force != nullptr && driver.force->assumed_force > 0;
}

void check_measurable(const RealMeasuring& wanted) {
  const std::string& name = wanted.choice.device;
  check_device_choice(wanted.choice);
  const peer::Driver& driver = driver_of(name);
  if (driver.springs != nullptr) {
    throw UsageError(
        fmt::format("{}: it renders springs itself and takes no force, so it cannot be pushed: "
                    "measure 'travel', 'full_force', 'full_stiffness' and 'max_stiffness' with a "
                    "ruler and a spring balance (docs/devices.md)",
                    name));
  }
  if (!wanted.max_force.empty() && !states_force(driver)) {
    throw UsageError(
        "--max-force applies to serial boards only, because other drivers know their limits: "
        "remove it");
  }
}

/// The device of an otherwise empty scene, and its driver.
class OpenedDevice {
 public:
  /// @throws UsageError, EnvironmentError with the remedy
  explicit OpenedDevice(const RealMeasuring& wanted)
      : scene_(peer::parse_scene_file("[[operator]]\npassive = true\n", "measure")),
        real_(plugins_of(wanted.choice)) {
    choose_device(wanted.choice, scene_, 1, 1);
    peer::DeviceConfig& config = scene_.devices.front();
    if (states_force(*config.driver)) {
      config.resolution = 1e-3;  // is measured: boards with any step are accepted
      if (!wanted.max_force.empty()) config.max_force = max_force_of(wanted.max_force);
    }
    try {
      hands_ = make_simulated_hands(scene_, 1);
      real_.plug_in(scene_, 1, hands_.wired);
    } catch (const std::runtime_error& error) {
      throw EnvironmentError(error.what());
    }
    // Notices about limits that a servo would use; here no servo uses them.
    static_cast<void>(real_.take_notices());
    const haptics::DeviceLimits limits = device().limits();
    if (limits.kind != haptics::DeviceKind::impedance || limits.axes != 3) {
      throw UsageError(
          fmt::format("{}: only devices that take a force along three axes can be measured",
                      wanted.choice.device));
    }
  }

  [[nodiscard]] haptics::HapticDevice& device() noexcept { return *hands_.wired.front().device; }
  [[nodiscard]] RealDevices& real() noexcept { return real_; }
  /// The properties that are known without a measurement.
  [[nodiscard]] peer::DeviceDescriptor known() {
    const haptics::DeviceLimits limits = device().limits();
    peer::DeviceDescriptor known;
    if (const haptics::UsbFacts* facts = peer::usb_facts_of(scene_.devices.front());
        facts != nullptr && facts->vendor != 0) {
      known.usb = {{facts->vendor, facts->product}};
      known.resolution = limits.resolution;
    }
    known.axes = limits.axes;
    known.max_force = limits.max_force;
    known.max_stiffness = limits.max_stiffness;
    known.max_speed = limits.max_speed;
    known.work_space = {limits.workspace_min, limits.workspace_max};
    return known;
  }

 private:
  static double max_force_of(const std::string& text) {
    const peer::Quantity force = peer::parse_quantity(text, "N");
    if (!force.good()) throw UsageError("--max-force: " + force.error);
    if (!(force.value >= 0.01 && force.value <= 1e3))
      throw UsageError(fmt::format("--max-force: '{}' is not from 10 mN to 1 kN", text));
    return force.value;
  }

  peer::SceneFile scene_;
  SimulatedHands hands_;
  RealDevices real_;
};

/// Steps a servo at 1 kHz during its lifetime.
class ServoBeside {
 public:
  ServoBeside(const peer::Clock& clock, MeasuringServo& servo) : servo_(servo), thread_(clock) {
    peer::Servo stepped;
    stepped.period = kServoPeriod;
    stepped.step = [&servo](nanoseconds now) { servo.step(now); };
    stepped.is_urgent = [&servo] { return servo.stage() == MeasuringStage::pushing; };
    number_ = thread_.add(std::move(stepped));
  }
  /// Ends a running push first.
  ~ServoBeside() {
    if (servo_.stage() == MeasuringStage::pushing) {
      servo_.halt();
      std::this_thread::sleep_for(kShutdownDrain);
    }
    thread_.remove(number_);
  }
  /// Why its steps may be late; empty: no known reason.
  [[nodiscard]] std::string weakness() const {
    return thread_.real_time() ? std::string() : "the servo has " + thread_.describe();
  }
  ServoBeside(const ServoBeside&) = delete;
  ServoBeside& operator=(const ServoBeside&) = delete;

 private:
  MeasuringServo& servo_;
  peer::ServoThread thread_;
  std::size_t number_ = 0;
};

/// The dialogue with the user from the start to the end of the pushes.
class Conversation {
 public:
  Conversation(const RealMeasuring& wanted, const Console& console, OpenedDevice& opened,
               haptics::ForceStop& stop, MeasuringServo& servo)
      : wanted_(wanted),
        console_(console),
        opened_(opened),
        stop_(stop),
        servo_(servo),
        keys_(wanted.keys) {}

  void wait_until_ready() {
    const nanoseconds end = clock_.now() + kReadyWithin;
    bool told = false, told_switch = false;
    while (servo_.stage() != MeasuringStage::ready) {
      if (servo_.stage() == MeasuringStage::switch_off && !std::exchange(told_switch, true))
        say("its operator's switch is released: hold only the switch");
      if (!std::exchange(told, true)) say("waiting until it is ready; Ctrl-C ends");
      static_cast<void>(key());
      check_ended("nothing moved");
      if (!keys_.is_active() && clock_.now() > end)
        throw EnvironmentError("it was not ready within 60 s: see the notices above, and home it");
    }
  }

  void ask() {
    say(warning_of(opened_.device().limits(), !wanted_.is_agreed));
    while (!wanted_.is_agreed) {
      const char pressed = key();
      check_ended("nothing moved");
      if (pressed == '\n' || pressed == '\r') return;
      if (pressed != 0) throw EnvironmentError("a key other than Enter: nothing moved");
    }
  }

  void push() {
    const DeviceMeasurement::Axes axes = pushed_axes();
    const nanoseconds end = clock_.now() + kSettling;
    while (!servo_.begin(axes)) {
      if (key() != 0) throw EnvironmentError("a key: nothing moved");
      check_ended("nothing moved");
      if (clock_.now() > end)
        throw EnvironmentError("it is no longer ready: plug it in, and home it");
    }
    std::size_t told = 0;
    while (servo_.stage() == MeasuringStage::pushing) {
      if (key() != 0) servo_.halt(), by_key_ = true;
      if (console_.stopped()) servo_.halt();
      if (servo_.judge() && servo_.run()->judged() > told)
        say(fmt::format("{} of {} axes measured", ++told, std::ranges::count(axes, true)));
    }
    // From now on the servo writes zeros.
    std::this_thread::sleep_for(kShutdownDrain);
    tell_notices();
  }

  /// @throws EnvironmentError if there is no result
  [[nodiscard]] const haptics::MeasuredDevice& found() const {
    const MeasuringStage stage = servo_.stage();
    if (stage == MeasuringStage::halted)
      throw EnvironmentError(
          fmt::format("{} stopped it, and its force is zero: start again to continue",
                      by_key_ ? "a key" : "Ctrl-C"));
    if (stage == MeasuringStage::stopped)
      throw EnvironmentError("SIGUSR1 stopped it, and its force is zero: start again to continue");
    const DeviceMeasurement& run = *servo_.run();
    if (!run.result())
      throw EnvironmentError(fmt::format("{} (its force is zero)", sentence_of(run.problem())));
    return *run.result();
  }

  [[nodiscard]] DeviceMeasurement::Axes pushed_axes() const {
    const unsigned axes = opened_.real().axes();
    return {(axes & 1U) != 0, (axes & 2U) != 0, (axes & 4U) != 0};
  }

 private:
  void say(std::string_view sentence) const { fmt::print(console_.err, "{}\n", sentence); }
  void tell_notices() const {
    for (const std::string& notice : opened_.real().take_notices()) say(notice);
  }
  // Waits kKeyPollInterval for a key. @return 0: none was pressed
  char key() {
    std::array<char, 16> pressed{};
    const std::size_t count = keys_.read(pressed, kKeyPollInterval);
    tell_notices();
    return count > 0 ? pressed[0] : '\0';
  }
  void check_ended(std::string_view what) const {
    if (console_.stopped()) throw EnvironmentError(fmt::format("ended by Ctrl-C: {}", what));
    if (stop_.is_pressed()) throw EnvironmentError(fmt::format("SIGUSR1: {}", what));
  }

  const RealMeasuring& wanted_;
  const Console& console_;
  OpenedDevice& opened_;
  haptics::ForceStop& stop_;
  MeasuringServo& servo_;
  TerminalKeys keys_;
  peer::SteadyClock clock_;
  bool by_key_ = false;
};

std::vector<std::string_view> names_of(const DeviceMeasurement::Axes& axes) {
  constexpr std::array<std::string_view, 3> kNames{"x", "y", "z"};
  std::vector<std::string_view> names;
  for (std::size_t i = 0; i < kNames.size(); ++i)
    if (axes[i]) names.push_back(kNames[i]);
  return names;
}

std::string name_of(const DeviceChoice& choice) {
  const std::string line = choice.device.substr(0, choice.device.rfind('@'));
  return std::filesystem::path(line).stem().string();
}

}  // namespace

std::string warning_of(const haptics::DeviceLimits& limits, bool asks) {
  const double most = std::min(DeviceMeasurement::kMostPush, 0.4 * limits.max_force);
  return fmt::format(
      "Release the handle in the middle of its work space. It will move by itself, by up to {:.0f} "
      "mm, with up to {:.2g} N.\n{}",
      1e3 * DeviceMeasurement::kMostWay, most,
      asks ? "Press Enter to begin; then any key or Ctrl-C stops it."
           : "It begins now; any key or Ctrl-C stops it.");
}

double delay_to_state(const MeasuredChain& chain) {
  if (chain.needed_delay == 0) return chain.found.delay;
  const double lag = chain.found.delay - chain.limits.delay_samples * chain.period;
  return chain.needed_delay * chain.period + (lag > 0.5 * chain.period ? lag : 0.0);
}

std::vector<std::string> remarks_of(const MeasuredChain& chain) {
  const double relied = chain.limits.damping, found = chain.found.damping;
  std::vector<std::string> remarks{
      fmt::format("damping: its driver assumed {:.3g} N s/m; measured {:.3g} +- {:.1g}{}", relied,
                  found, chain.found.damping_error,
                  found < relied ? ": LESS, so walls were stiffer than is safe" : "")};
  const double stated = 1e3 * chain.limits.delay_samples * chain.period;
  std::string delay = fmt::format("delay: its driver assumed {:.3g} ms; pushes were {:.3g} ms late",
                                  stated, 1e3 * chain.found.delay);
  if (chain.needed_delay > 0)
    delay += fmt::format("; reports on this host need {:.3g} ms",
                         1e3 * chain.needed_delay * chain.period);
  remarks.push_back(std::move(delay));
  return remarks;
}

std::string measure_real(const RealMeasuring& wanted, const Console& console) {
  check_measurable(wanted);
  if (!wanted.is_agreed && isatty(wanted.keys) != 1) {
    throw UsageError(
        "measure asks before it moves the handle, but stdin is not a terminal: use one, or add "
        "--yes to skip the question");
  }
  StopControl stop;
  const peer::SteadyClock clock;
  OpenedDevice opened(wanted);
  const haptics::UsbDevice* const reports = opened.real().reports();
  MeasuringServo servo(opened.device(), stop.stop(), kServoPeriod, reports);
  MeasuredChain chain;
  DeviceMeasurement::Axes axes{};
  {
    const ServoBeside beside(clock, servo);
    Conversation conversation(wanted, console, opened, stop.stop(), servo);
    if (const std::string weakness = beside.weakness(); !weakness.empty())
      fmt::print(console.err, "{}: load on this host may end the measurement\n", weakness);
    conversation.wait_until_ready();
    conversation.ask();
    conversation.push();
    chain.found = conversation.found();
    axes = conversation.pushed_axes();
  }
  chain.limits = opened.device().limits();
  chain.period = pdu::to_seconds(kServoPeriod);
  chain.needed_delay = reports == nullptr ? 0 : reports->needed_delay();
  std::vector<std::string> remarks = remarks_of(chain);
  if (std::ranges::count(axes, false) > 0)
    remarks.push_back(fmt::format("pushed along {} only: it has no other axis",
                                  fmt::join(names_of(axes), " and ")));
  chain.found.delay = delay_to_state(chain);
  return descriptor_text(name_of(wanted.choice), opened.known(), chain.found, remarks);
}

}  // namespace reckon::tools
