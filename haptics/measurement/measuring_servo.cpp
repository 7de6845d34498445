// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/measurement/measuring_servo.hpp"

namespace reckon::haptics {

MeasuringServo::MeasuringServo(HapticDevice& device, const ForceStop& stop,
                               std::chrono::nanoseconds period, const UsbDevice* reports)
    : device_(device), stop_(stop), period_(period), reports_(reports) {}

void MeasuringServo::step(std::chrono::nanoseconds now) {
  DeviceSample sample = device_.read(now);
  // The receive time of a report is more accurate than the times of the writes.
  if (reports_ != nullptr && !reports_->has_clock()) sample.took.reset();
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  MeasuringStage stage = stage_;
  if (stage < MeasuringStage::pushing) stage = begin_ ? MeasuringStage::pushing : looked_at(sample);
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

MeasuringStage MeasuringServo::looked_at(const DeviceSample& sample) noexcept {
  const bool is_good = sample.ok && sample.enabled;
  good_ = is_good ? good_ + 1 : 0;
  if (sample.ok && !sample.enabled) return MeasuringStage::switch_off;
  return good_ * period_ >= kReady ? MeasuringStage::ready : MeasuringStage::waiting;
}

bool MeasuringServo::begin(DeviceMeasurement::Axes axes) {
  if (stage() != MeasuringStage::ready || stop_.is_pressed()) return false;
  run_.emplace(device_.limits(), period_, axes);
  begin_ = true;
  return true;
}

bool MeasuringServo::judge() {
  if (stage() != MeasuringStage::pushing || !run_->needs_judging()) return false;
  run_->judge();
  return true;
}

}  // namespace reckon::haptics
