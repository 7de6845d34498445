// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A FalconModel on the USB of this kernel, and the hand that holds it.
#pragma once

#include <Eigen/Core>
#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "reckon/tests/haptics/support/falcon_model.hpp"
#include "reckon/tests/haptics/support/usbip_device.hpp"

namespace reckon::test {

/// Its time begins at its construction.
class UsbipFalcon {
 public:
  static constexpr double kHandSpeed = 0.1;  // [m/s]

  /// @param hand_at start of the hand [m, frame D]
  UsbipFalcon(const FalconModelOptions& options, const Eigen::Vector3d& hand_at)
      : model_(options, hand_at) {}

  /// @throws std::runtime_error if the kernel refuses it
  void plug_in() { device_.plug_in(); }
  void unplug() { device_.unplug(); }
  /// The hand moves there [m, frame D] at kHandSpeed.
  void go(const Eigen::Vector3d& place) {
    device_.with_model([&] { model_.go(place); });
  }
  /// Result of `use` on the Falcon at the present time. Any thread.
  template <class Use>
  auto with(Use&& use) {
    return device_.with_model([&] { return use(model_.falcon); });
  }

 private:
  class Model final : public UsbipModel {
   public:
    Model(const FalconModelOptions& options, const Eigen::Vector3d& hand_at);
    void go(const Eigen::Vector3d& place);

    [[nodiscard]] std::vector<std::uint8_t> descriptor(std::uint8_t kind,
                                                       std::uint8_t index) const override;
    std::optional<std::vector<std::uint8_t>> control(std::span<const std::uint8_t, 8> setup,
                                                     std::span<const std::uint8_t> data) override;
    bool take(std::span<const std::uint8_t> octets) override;
    void call_off() override { begun_ = false; }
    std::optional<std::vector<std::uint8_t>> give() override;
    void run_until(std::chrono::nanoseconds now) override;
    void lose_power() override;

   private:
    [[nodiscard]] Eigen::Vector3d hand(double t) const;

    std::chrono::nanoseconds made_ = UsbipDevice::now();
    Eigen::Vector3d from_, to_;
    double left_ = 0;  // [s], start of the hand's motion
    bool begun_ = false;

   public:
    FalconModel falcon;
  };

  Model model_;
  // Bulk transfers move when the bus has room, not once a frame; the model keeps its own times.
  UsbipDevice device_{model_, std::chrono::microseconds(250)};
};

}  // namespace reckon::test
