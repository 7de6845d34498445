// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/devices/mapped_device.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

namespace reckon::haptics {

using Eigen::Vector3d;

MappedDevice::MappedDevice(HapticDevice& device, const HandMapping& mapping)
    : device_(device), mapping_(mapping), delay_(device.limits().delay_samples) {
  if (!(mapping.scale > 0) || !std::isfinite(mapping.scale))
    throw std::invalid_argument("the scale of a device must be above 0, got " +
                                std::to_string(mapping.scale));
  if (mapping.clutch_button && (*mapping.clutch_button < 0 || *mapping.clutch_button > 31))
    throw std::invalid_argument("the clutch button must be 0 to 31, got " +
                                std::to_string(*mapping.clutch_button));
}

DeviceLimits MappedDevice::limits() const noexcept { return mapped(device_.limits(), mapping_); }

DeviceSample MappedDevice::read(std::chrono::nanoseconds now) noexcept {
  DeviceSample sample = device_.read(now);
  if (!sample.ok) return sample;
  map(sample);
  engage(sample);
  return sample;
}

void MappedDevice::map(DeviceSample& sample) const noexcept {
  const auto place = [this](const Vector3d& in_device) {
    return Vector3d(mapping_.scale * (mapping_.mirrored ? mirrored(in_device) : in_device));
  };
  sample.position = place(sample.position);
  sample.velocity = place(sample.velocity);
  if (sample.released_at) sample.released_at = place(*sample.released_at);
  if (sample.damping) *sample.damping /= mapping_.scale * mapping_.scale;
  if (sample.resolution) *sample.resolution *= mapping_.scale;
  if (!mapping_.mirrored) return;
  if (sample.turn) {
    sample.turn->orientation = mirrored(sample.turn->orientation);
    sample.turn->rate = mirrored_turn(sample.turn->rate);
  }
  if (sample.released_turned) sample.released_turned = mirrored(*sample.released_turned);
}

bool MappedDevice::is_clutched(const DeviceSample& sample) const noexcept {
  return mapping_.clutch_button && (sample.buttons >> *mapping_.clutch_button & 1U) != 0;
}

void MappedDevice::engage(DeviceSample& sample) noexcept {
  if (!sample.position.allFinite()) return;
  if (!is_clutched(sample)) {
    if (clutched_ > delay_) offset_ = stands_ - sample.position;
    clutched_ = 0;
  }
  const bool stood = clutched_ > delay_;
  sample.position += offset_;
  if (sample.released_at) *sample.released_at += offset_;
  if (!is_clutched(sample)) return;
  sample.enabled = false;
  if (!stood) {
    stands_ = sample.position;
    ++clutched_;
    return;
  }
  sample.position = stands_;
  sample.velocity.setZero();
  if (sample.released_at) sample.released_at = stands_;
}

Vector3d MappedDevice::to_device(const Vector3d& force) const noexcept {
  return mapping_.scale * (mapping_.mirrored ? mirrored(force) : force);
}

void MappedDevice::write(const Vector3d& force, std::chrono::nanoseconds now) noexcept {
  device_.write(to_device(force), now);
}

void MappedDevice::write_wrench(const Vector3d& force, const Vector3d& torque,
                                std::chrono::nanoseconds now) noexcept {
  device_.write_wrench(to_device(force), mapping_.mirrored ? mirrored_turn(torque) : torque, now);
}

}  // namespace reckon::haptics
