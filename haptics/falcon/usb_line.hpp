// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A serial line behind an FTDI chip on USB: octets both ways by asynchronous transfers of libusb.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

struct libusb_context;
struct libusb_device_handle;
struct libusb_transfer;

namespace reckon::haptics {

/// Why a line is of no use any more.
enum class UsbFault : std::uint8_t {
  none,
  gone,     ///< unplugged, or its hub was reset
  stalled,  ///< the device refuses transfers
  failed,   ///< any other error
};

/// The library's state, one for each thread that has devices.
class UsbContext {
 public:
  /// @param discover whether it looks for devices itself; false: handles come from elsewhere.
  /// @throws std::runtime_error where the host has no USB, with the library's reason
  explicit UsbContext(bool discover = true);

  [[nodiscard]] libusb_context* get() const noexcept { return context_.get(); }
  /// Handles what has happened, and waits for it so long at most.
  void wait(std::chrono::microseconds longest) noexcept;

 private:
  struct End {
    void operator()(libusb_context* context) const noexcept;
  };
  std::unique_ptr<libusb_context, End> context_;
};

/// A device that was found, or why there is none.
struct UsbOpening {
  libusb_device_handle* handle = nullptr;
  std::string problem;  ///< a sentence with a remedy, where there is no handle
};
using UsbOpener = std::function<UsbOpening(libusb_context*)>;

/// Opens the first device of these numbers that is attached.
[[nodiscard]] UsbOpening open_usb_device(libusb_context* context, std::uint16_t vendor,
                                         std::uint16_t product);

/// One line. The constructor, the destructor and control() may wait for the device, at most 0.1 s
/// each; all else is immediate, and allocates nothing.
class UsbLine {
 public:
  /// Claims the device and listens from now on. @param handle of an open device, which becomes the
  /// line's own @throws std::runtime_error if it cannot be claimed, with the reason
  UsbLine(UsbContext& context, libusb_device_handle* handle);
  ~UsbLine();
  UsbLine(const UsbLine&) = delete;
  UsbLine& operator=(const UsbLine&) = delete;

  /// A request to the chip itself. @return false if it is refused
  bool control(std::uint8_t request, std::uint16_t value) noexcept;
  /// Its latency timer [ms]; 0: it does not tell.
  [[nodiscard]] std::uint8_t latency_timer() noexcept;

  /// Handles transfers that have ended, and waits for one so long at most.
  void pump(std::chrono::microseconds longest) noexcept { context_.wait(longest); }
  /// Octets that came over the line since clear(), without the chip's own.
  [[nodiscard]] std::span<const std::uint8_t> received() const noexcept {
    return {inbox_.data(), length_};
  }
  void clear() noexcept { length_ = 0; }
  /// Sends up to kMost octets. @return false while the last ones are under way, or after a fault
  bool send(std::span<const std::uint8_t> octets) noexcept;
  [[nodiscard]] bool is_sending() const noexcept { return sending_; }
  [[nodiscard]] UsbFault fault() const noexcept { return fault_; }

  /// Octets of one transfer.
  static constexpr std::size_t kMost = 64;

 private:
  static constexpr std::size_t kListeners = 2;  // one waits while the other is read
  struct Free {
    void operator()(libusb_transfer* transfer) const noexcept;
  };
  using Transfer = std::unique_ptr<libusb_transfer, Free>;

  void listen(libusb_transfer* transfer) noexcept;
  void note(int status) noexcept;
  void take(const libusb_transfer& transfer) noexcept;
  static void ended_in(libusb_transfer* transfer);
  static void ended_out(libusb_transfer* transfer);

  UsbContext& context_;
  libusb_device_handle* handle_;
  std::array<Transfer, kListeners> in_;
  std::array<std::array<std::uint8_t, kMost>, kListeners> in_octets_{};
  Transfer out_;
  std::array<std::uint8_t, kMost> out_octets_{};
  std::vector<std::uint8_t> inbox_;
  std::size_t length_ = 0;
  std::size_t listening_ = 0;
  bool sending_ = false;
  bool closing_ = false;
  UsbFault fault_ = UsbFault::none;
};

}  // namespace reckon::haptics
