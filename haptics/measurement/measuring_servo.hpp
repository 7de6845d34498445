// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The servo that measures a real device: no force before begin(), and none after the first anomaly,
// software stop or halt().
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

/// Stage of a MeasuringServo.
enum class MeasuringStage : std::uint8_t {
  waiting,     ///< its readings fail: not attached, not homed
  switch_off,  ///< the operator's switch is not held
  ready,       ///< its readings have been valid for kReady
  pushing,
  ended,    ///< done, or stopped by its measurement: see its problem()
  halted,   ///< by halt()
  stopped,  ///< by the software stop
};

/// step() is for the servo's thread, all else for one other thread. Each step writes a force, zero
/// in all stages except `pushing`, so that drivers see a running servo. Neither side blocks on the
/// other.
class MeasuringServo {
 public:
  static constexpr std::chrono::milliseconds kReady{300};

  /// @param device, stop outlive it @param period of the steps, 0.1 to 10 ms @param reports the
  /// same device if it sends reports at its own times; null otherwise
  MeasuringServo(HapticDevice& device, const ForceStop& stop, std::chrono::nanoseconds period,
                 const UsbDevice* reports = nullptr)
      : device_(device), stop_(stop), period_(period), reports_(reports) {}

  /// One servo step. @param now steady
  void step(std::chrono::nanoseconds now) {
    DeviceSample sample = device_.read(now);
    // The receive time of a report is more accurate than the times of the writes.
    if (reports_ != nullptr && !reports_->has_clock()) sample.took.reset();
    Eigen::Vector3d force = Eigen::Vector3d::Zero();
    MeasuringStage stage = stage_;
    if (stage < MeasuringStage::pushing)
      stage = begin_ ? MeasuringStage::pushing : looked_at(sample);
    if (stage == MeasuringStage::pushing) {
      if (halt_) {
        stage = MeasuringStage::halted;
      } else if (stop_.is_pressed()) {
        stage = MeasuringStage::stopped;
      } else {
        force = reports_ == nullptr ? run_->step(sample, now)
                                    : run_->step(sample, now, reports_->heard());
        if (run_->is_done()) stage = MeasuringStage::ended;
      }
    }
    device_.write(force, now);
    stage_ = stage;
  }

  [[nodiscard]] MeasuringStage stage() const noexcept {
    const MeasuringStage stage = stage_;
    return begin_ && stage < MeasuringStage::pushing ? MeasuringStage::pushing : stage;
  }
  /// Pushes from the next step on. @param axes see DeviceMeasurement @return false, without effect,
  /// if it is not ready or the software stop is pressed
  [[nodiscard]] bool begin(DeviceMeasurement::Axes axes) {
    if (stage() != MeasuringStage::ready || stop_.is_pressed()) return false;
    run_.emplace(device_.limits(), period_, axes);
    begin_ = true;
    return true;
  }
  /// Zero force from the next step on, permanently.
  void halt() noexcept { halt_ = true; }
  /// Fits an axis with completed pushes, if one is pending, in about 0.5 s. Call it regularly.
  /// @return whether one was pending
  bool judge() {
    if (stage() != MeasuringStage::pushing || !run_->needs_judging()) return false;
    run_->judge();
    return true;
  }
  /// The run, from begin() on; its result is valid from stage `ended` on.
  [[nodiscard]] const std::optional<DeviceMeasurement>& run() const noexcept { return run_; }

 private:
  [[nodiscard]] MeasuringStage looked_at(const DeviceSample& sample) noexcept {
    const bool is_good = sample.ok && sample.enabled;
    good_ = is_good ? good_ + 1 : 0;
    if (sample.ok && !sample.enabled) return MeasuringStage::switch_off;
    return good_ * period_ >= kReady ? MeasuringStage::ready : MeasuringStage::waiting;
  }

  HapticDevice& device_;
  const ForceStop& stop_;
  std::chrono::nanoseconds period_;
  const UsbDevice* reports_;
  std::optional<DeviceMeasurement> run_;
  std::atomic<MeasuringStage> stage_{MeasuringStage::waiting};  // of the last step
  std::atomic<bool> halt_{false}, begin_{false};
  std::int64_t good_ = 0;  // valid readings in a row
};

}  // namespace reckon::haptics
