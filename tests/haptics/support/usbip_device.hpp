// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A device on the USB of this kernel: vhci_hcd has one end of a socket pair, and this code runs the
// USB/IP protocol on the other. It needs root, and is only for a virtual machine.
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <span>
#include <thread>
#include <vector>

namespace reckon::test {

/// Behaviour of a device with one endpoint in each direction. One thread at a time.
class UsbipModel {
 public:
  virtual ~UsbipModel() = default;
  /// Empty: there is none.
  [[nodiscard]] virtual std::vector<std::uint8_t> descriptor(std::uint8_t kind,
                                                             std::uint8_t index) const = 0;
  /// A request of its class or its maker's. @param data with it, if it goes to the device
  /// @return its answer; nothing: the request is unknown
  virtual std::optional<std::vector<std::uint8_t>> control(std::span<const std::uint8_t, 8> setup,
                                                           std::span<const std::uint8_t> data) = 0;
  /// The oldest transfer to it that it has not taken. @return false: not yet
  virtual bool take(std::span<const std::uint8_t> octets) = 0;
  /// Cancels a transfer to it.
  virtual void call_off() {}
  /// Its next report, if the host reads.
  virtual std::optional<std::vector<std::uint8_t>> give() = 0;
  /// Advances its time to `now`.
  virtual void run_until(std::chrono::nanoseconds now) = 0;
  /// It is unplugged.
  virtual void lose_power() = 0;
};

/// Its plug, at full speed.
class UsbipDevice {
 public:
  static constexpr const char* kBus = "/sys/devices/platform/vhci_hcd.0";

  /// @param model outlives it
  /// @param frame interval of transfers in each direction
  UsbipDevice(UsbipModel& model, std::chrono::nanoseconds frame);
  ~UsbipDevice();
  UsbipDevice(const UsbipDevice&) = delete;
  UsbipDevice& operator=(const UsbipDevice&) = delete;

  /// After an unplug; waits until its port is free. @throws std::runtime_error if the kernel
  /// refuses it
  void plug_in();
  void unplug();

  /// Time of the model, and of this machine.
  [[nodiscard]] static std::chrono::nanoseconds now();
  /// Calls it with the model at the present time, while no other thread has the model.
  template <class Call>
  auto with_model(Call&& call) {
    const std::lock_guard lock(having_);
    model_.run_until(now());
    return call();
  }

 private:
  struct Request {
    std::uint32_t number = 0, length = 0;
    bool is_in = false;
    std::uint32_t endpoint = 0;
    std::array<std::uint8_t, 8> setup{};
    std::vector<std::uint8_t> data;
  };

  void serve();
  void move_transfers();
  [[nodiscard]] bool take_request();
  void cancel(std::uint32_t number, std::uint32_t victim);
  void control(const Request& request);
  void answer(const Request& request, int status, std::span<const std::uint8_t> data);
  void send(std::span<const std::uint32_t> head, std::span<const std::uint8_t> data);
  [[nodiscard]] bool receive(std::span<std::uint8_t> into);

  std::mutex having_;  // of all below
  UsbipModel& model_;
  std::chrono::nanoseconds frame_;
  int socket_ = -1;
  std::deque<Request> in_, out_;
  std::atomic<bool> ends_{false};
  std::thread thread_;
};

}  // namespace reckon::test
