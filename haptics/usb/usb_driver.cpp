// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/usb/usb_driver.hpp"

#include <utility>

namespace reckon::haptics {
namespace {

constexpr std::chrono::microseconds kLook{500};
constexpr std::chrono::milliseconds kPatience{500};

}  // namespace

UsbSetUp::UsbSetUp(UsbLine& line, const std::function<std::chrono::nanoseconds()>& clock,
                   const std::atomic<bool>& stopped, std::function<void(std::string)> tell)
    : line_(line), clock_(clock), stopped_(stopped), tell_(std::move(tell)) {}

bool UsbSetUp::goes_on() const noexcept {
  return !stopped_.load(std::memory_order_relaxed) && line_.fault() == UsbFault::none;
}

void UsbSetUp::wait() noexcept { line_.pump(kLook); }

bool UsbSetUp::sends(std::span<const std::uint8_t> octets) {
  const std::chrono::nanoseconds end = clock_() + kPatience;
  if (!line_.send(octets)) return false;
  while (line_.is_sending() && clock_() < end && !stopped_) wait();
  return !line_.is_sending() && line_.fault() == UsbFault::none;
}

}  // namespace reckon::haptics
