// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A device of one kind with its line and its thread's loop, as seen by a trial of the unplug
// simulation. The trial contains the common parts of all kinds.
#pragma once

#include <Eigen/Core>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "reckon/haptics/devices/haptic_device.hpp"
#include "reckon/haptics/exchange/servo_types.hpp"
#include "reckon/haptics/scene/scene.hpp"
#include "reckon/tests/fuzz/unplugs/held_hand.hpp"
#include "reckon/tests/fuzz/unplugs/plan.hpp"

namespace reckon::fuzz::unplugs {

/// How far the thread is.
enum class Stage : std::uint8_t {
  away,  ///< no line is open
  opened,
  homing,
  running,  ///< it reports that forces are shown
};

/// Counts kernel calls down to one at which an action follows.
class NthCall {
 public:
  void arm(unsigned calls, std::function<void()> act) {
    left_ = calls;
    act_ = std::move(act);
  }
  void disarm() { left_.reset(); }
  void count() {
    if (!left_ || (*left_)-- != 0) return;
    left_.reset();
    std::exchange(act_, {})();
  }

 private:
  std::optional<unsigned> left_;
  std::function<void()> act_;
};

/// All times are of the model.
class TriedDevice {
 public:
  using Vector3d = Eigen::Vector3d;
  using Beside = std::function<void(nanoseconds)>;

  TriedDevice() = default;
  TriedDevice(const TriedDevice&) = delete;
  TriedDevice& operator=(const TriedDevice&) = delete;
  virtual ~TriedDevice() = default;

  // As the servo uses it.
  [[nodiscard]] virtual haptics::HapticDevice& device() = 0;
  [[nodiscard]] virtual haptics::Scene scene() const = 0;
  [[nodiscard]] virtual Vector3d origin() const = 0;  ///< [m], of frame D in frame S

  // Time, and the handle in the hand. In positions the wall is along z.
  [[nodiscard]] virtual nanoseconds now() const = 0;
  /// Advances the time without work of the thread.
  virtual void pass(nanoseconds time) = 0;
  /// Called at least every millisecond of its time, whichever function advances it.
  virtual void beside(Beside call) = 0;
  [[nodiscard]] virtual Vector3d place() const = 0;
  /// Holds the handle at `place` until let_go().
  virtual void lead(const Vector3d& place) = 0;
  virtual void let_go() = 0;
  [[nodiscard]] virtual bool is_led() const = 0;

  // --- state by its own measure
  [[nodiscard]] virtual nanoseconds watchdog() const = 0;    ///< of the device itself
  [[nodiscard]] virtual bool rests() const = 0;              ///< whether its motors rest
  [[nodiscard]] virtual double force() const = 0;            ///< [N]
  [[nodiscard]] virtual std::uint64_t commands() const = 0;  ///< that it has obeyed
  /// [N], requested part of the force that a servo reports
  [[nodiscard]] virtual double asked(const haptics::ServoSnapshot& servo) const {
    return servo.force.norm();
  }
  /// [J], own energy ledger, including the servo's debts and allowances
  [[nodiscard]] virtual double books(const haptics::ServoSnapshot& servo) const = 0;

  // --- the thread's loop
  virtual void begin_program() = 0;
  /// May advance the time.
  virtual void end_program() = 0;
  [[nodiscard]] virtual bool has_program() const = 0;
  virtual void stop() {}  ///< called before its end
  virtual void step(std::chrono::microseconds longest) = 0;
  [[nodiscard]] virtual std::vector<std::string> take_notices() = 0;
  [[nodiscard]] virtual Stage stage() const = 0;
  /// After this time the device has obeyed its last command.
  [[nodiscard]] virtual nanoseconds obeys_within() const = 0;
  /// A superfluous or missing resource of the host, as a sentence.
  [[nodiscard]] virtual std::optional<std::string> surplus() const = 0;
  [[nodiscard]] NthCall& calls() { return calls_; }
  /// Attempts to open its line.
  [[nodiscard]] virtual unsigned tries() const = 0;

  // --- faults
  virtual void pull(bool loses_power) = 0;
  virtual void plug() = 0;
  [[nodiscard]] virtual bool is_plugged() const = 0;
  /// Until it is pulled. @return whether its line breaks
  virtual bool loosen() = 0;
  virtual void be_another(const Fault& fault, nanoseconds time) = 0;
  virtual void be_itself() = 0;
  /// Forbids opening it. @param error errno; 0: it may be opened again
  virtual void deny(int /*error*/) {}
  /// Any other fault of its kind. @return whether its line breaks
  virtual bool strike(const Fault& fault, nanoseconds time) = 0;
  virtual void lose_place() = 0;
  [[nodiscard]] virtual bool can_be_homed_anywhere() const { return true; }
  virtual void home() = 0;
  /// Time from the setup until it shows walls to a hand that enters them. 0: also to a hand already
  /// in them.
  [[nodiscard]] virtual nanoseconds shows_after() const { return nanoseconds(0); }

 protected:
  NthCall calls_;
};

/// The first position of the hand, in front of the wall [m].
[[nodiscard]] Eigen::Vector3d start_of(DeviceKind kind);
/// @param hand outlives it
[[nodiscard]] std::unique_ptr<TriedDevice> tried_usb_device(const Plan& plan, const HeldHand& hand);
[[nodiscard]] std::unique_ptr<TriedDevice> tried_serial_board(const Plan& plan,
                                                              const HeldHand& hand);
[[nodiscard]] std::unique_ptr<TriedDevice> tried_event_device(const Plan& plan,
                                                              const HeldHand& hand);
[[nodiscard]] std::unique_ptr<TriedDevice> tried_hid_device(const Plan& plan, const HeldHand& hand);

}  // namespace reckon::fuzz::unplugs
