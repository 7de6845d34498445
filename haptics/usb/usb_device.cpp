// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/usb/usb_device.hpp"

#include <algorithm>
#include <utility>

namespace reckon::haptics {
namespace {

constexpr double kAhead =
    1.1;  // margin over the lever of the newest report, for the motion that follows

}  // namespace

UsbDevice::UsbDevice(UsbExchange& exchange, const DeviceLimits& limits)
    : exchange_(exchange),
      limits_(limits),
      write_times_(static_cast<std::size_t>(limits.delay_samples) + 2) {}

void UsbDevice::take_readings() noexcept {
  UsbReading reading;
  while (exchange_.readings.pop(reading)) {
    if (reading.run != run_) {
      dropped_ = dropped_ || has_shown_;
      run_ = reading.run;
      has_shown_ = false;
      told_at_.reset();
      count_ = 0;
    }
    if (count_ == waiting_.size()) return;
    waiting_[(first_ + count_++) % waiting_.size()] = reading;
  }
}

// Whether all readings are outdated and their force was dropped.
bool UsbDevice::is_over(std::chrono::nanoseconds now) const noexcept {
  return (written_ > 0 && now - written_at_ > kWatchdog) ||
         run_ <= exchange_.ended_run.load(std::memory_order_acquire);
}

void UsbDevice::forget_readings() noexcept {
  dropped_ = dropped_ || has_shown_;
  has_shown_ = false;
  told_at_.reset();
  count_ = 0;
}

// How long the force acted under which the motion of this reading was made.
std::optional<std::chrono::nanoseconds> UsbDevice::held_for() const noexcept {
  const std::int64_t due = written_ - limits_.delay_samples;
  if (due < 1 || due >= written_) return std::nullopt;
  const auto at = [this](std::int64_t number) {
    return write_times_[static_cast<std::size_t>(number) % write_times_.size()];
  };
  return at(due + 1) - at(due);
}

DeviceSample UsbDevice::read(std::chrono::nanoseconds now) noexcept {
  take_readings();
  if (is_over(now)) forget_readings();
  // Before the first write the device holds no force: number 0.
  const std::int64_t due = std::max<std::int64_t>(0, written_ - limits_.delay_samples);
  while (count_ > 0 && waiting_[first_].before <= due) {
    shown_ = waiting_[first_];
    has_shown_ = true;
    held_ = std::min(held_, shown_.held);
    first_ = (first_ + 1) % waiting_.size();
    --count_;
  }
  DeviceSample sample;
  sample.ok = has_shown_ && shown_.after > due;
  if (!sample.ok) return sample;
  const UsbReading& newest =
      count_ > 0 ? waiting_[(first_ + count_ - 1) % waiting_.size()] : shown_;
  needed_ = std::max(needed_, static_cast<int>(written_ + 1 - newest.after));
  sample.position = shown_.position;
  if (shown_.orientation) sample.turn = DeviceTurn{*shown_.orientation};
  if (!shown_.at) {
    sample.took = held_for();
  } else if (told_at_) {
    sample.took = *shown_.at - *told_at_;
  }
  told_at_ = shown_.at;
  sample.buttons = shown_.buttons;
  sample.held = std::exchange(held_, 1.0);
  note_pose(sample);
  sample.watchdog = dropped_;
  dropped_ = false;
  return sample;
}

// The lever is the longest of all reports received, including those not shown yet: they are nearer
// to the present pose.
void UsbDevice::note_pose(DeviceSample& sample) noexcept {
  if (shown_.step > 0) sample.resolution = shown_.step;
  if (!(limits_.lever > 0) || !(shown_.lever > 0)) return;
  double longest = shown_.lever;
  for (std::size_t i = 0; i < count_; ++i)
    longest = std::max(longest, waiting_[(first_ + i) % waiting_.size()].lever);
  lever_ = std::max(limits_.lever, kAhead * longest);
  const double ratio = limits_.lever / lever_;
  sample.damping = ratio * ratio * limits_.damping;
}

void UsbDevice::write(const Eigen::Vector3d& force, std::chrono::nanoseconds now) noexcept {
  UsbForce& newest = exchange_.force.write_slot();
  newest.force = force.allFinite() ? force : Eigen::Vector3d(Eigen::Vector3d::Zero());
  newest.number = ++written_;
  newest.at = written_at_ = now;
  write_times_[static_cast<std::size_t>(written_) % write_times_.size()] = now;
  newest.lever = lever_;
  exchange_.force.publish();
}

}  // namespace reckon::haptics
