// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The servo that measures a real device: no force until somebody has said so, and none for good
// after the first surprise, stop or wish to end.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <optional>

#include "reckon/haptics/devices/haptic_device.hpp"
#include "reckon/haptics/exchange/force_stop.hpp"
#include "reckon/haptics/measurement/device_measurement.hpp"
#include "reckon/haptics/usb/usb_device.hpp"

namespace reckon::haptics {

/// How far a MeasuringServo is.
enum class MeasuringStage : std::uint8_t {
  waiting,     ///< its readings fail: not plugged in, not homed
  switch_off,  ///< the operator's switch is not held
  ready,       ///< its readings have been good for kReady
  pushing,
  ended,    ///< done, or stopped by its measurement: problem() of it says why
  halted,   ///< by halt()
  stopped,  ///< by the software stop
};

/// step() belongs to the servo's thread; all else to one other thread, which asks and judges. In
/// each step a force is written, zero in all stages but `pushing`, so that drivers see a servo that
/// runs. Neither side waits for the other.
class MeasuringServo {
 public:
  static constexpr std::chrono::milliseconds kReady{300};

  /// @param device, stop outlive it  @param period of the steps, 0.1 to 10 ms  @param reports the
  /// same device, where it reports at times of its own; null: it does not
  MeasuringServo(HapticDevice& device, const ForceStop& stop, std::chrono::nanoseconds period,
                 const UsbDevice* reports = nullptr);

  /// One servo step. @param now steady
  void step(std::chrono::nanoseconds now);

  [[nodiscard]] MeasuringStage stage() const noexcept {
    const MeasuringStage stage = stage_;
    return begin_ && stage < MeasuringStage::pushing ? MeasuringStage::pushing : stage;
  }
  /// Pushes from the next step on. @param axes see DeviceMeasurement  @return false, and nothing
  /// happens, where it is not ready, or the software stop is pressed
  [[nodiscard]] bool begin(DeviceMeasurement::Axes axes);
  /// No force any more, from the next step on and for good.
  void halt() noexcept { halt_ = true; }
  /// Works out an axis whose pushes have ended, if one is waiting; some 0.5 s then. Call it now and
  /// then. @return whether one was
  bool judge();
  /// The run, once it was begun; what it found once the stage is `ended`.
  [[nodiscard]] const std::optional<DeviceMeasurement>& run() const noexcept { return run_; }

 private:
  [[nodiscard]] MeasuringStage looked_at(const DeviceSample& sample) noexcept;

  HapticDevice& device_;
  const ForceStop& stop_;
  std::chrono::nanoseconds period_;
  const UsbDevice* reports_;
  std::optional<DeviceMeasurement> run_;
  std::atomic<MeasuringStage> stage_{MeasuringStage::waiting};  // as of the last step
  std::atomic<bool> halt_{false}, begin_{false};
  std::int64_t good_ = 0;  // readings in a row
};

}  // namespace reckon::haptics
