// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A PidWheel on the USB of this kernel.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "reckon/tests/haptics/support/pid_wheel.hpp"
#include "reckon/tests/haptics/support/usbip_device.hpp"

namespace reckon::test {

/// Like a full-speed board whose interrupt endpoints move one report per millisecond, in each
/// direction.
class UsbipWheel {
 public:
  static constexpr const char* kMaker = "Reckon";
  static constexpr const char* kProduct = "FFBoard model";

  explicit UsbipWheel(const PidWheelOptions& options) : model_(options) {}

  /// @throws std::runtime_error if the kernel refuses it
  void plug_in() { device_.plug_in(); }
  void unplug() { device_.unplug(); }

  /// Result of `use` on the wheel at the present time. Any thread.
  template <class Use>
  auto with(Use&& use) {
    return device_.with_model([&] { return use(model_.wheel); });
  }

 private:
  class Model final : public UsbipModel {
   public:
    explicit Model(const PidWheelOptions& options) : wheel(options) {}

    [[nodiscard]] std::vector<std::uint8_t> descriptor(std::uint8_t kind,
                                                       std::uint8_t index) const override;
    std::optional<std::vector<std::uint8_t>> control(std::span<const std::uint8_t, 8> setup,
                                                     std::span<const std::uint8_t> data) override;
    bool take(std::span<const std::uint8_t> octets) override;
    std::optional<std::vector<std::uint8_t>> give() override;
    void run_until(std::chrono::nanoseconds now) override { wheel.run_until(now); }
    void lose_power() override;

    PidWheel wheel;

   private:
    std::vector<std::uint8_t> sent_;
  };

  Model model_;
  UsbipDevice device_{model_, std::chrono::milliseconds(1)};
};

}  // namespace reckon::test
