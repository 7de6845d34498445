// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A connection to a device on USB: octets both ways by asynchronous transfers of libusb.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

struct libusb_context;
struct libusb_device_handle;
struct libusb_transfer;

namespace reckon::haptics {

/// Why a line has failed.
enum class UsbFault : std::uint8_t {
  none,
  gone,     ///< unplugged, or its hub was reset
  stalled,  ///< the device refuses transfers
  failed,   ///< any other error
};

/// A context of libusb, one for each thread with devices.
class UsbContext {
 public:
  /// @param discover whether it enumerates devices; false: handles are passed in.
  /// @throws std::runtime_error if the host has no USB, with libusb's reason
  explicit UsbContext(bool discover = true);

  [[nodiscard]] libusb_context* get() const noexcept { return context_.get(); }
  /// Handles events, and waits for one at most `longest`.
  void wait(std::chrono::microseconds longest) noexcept;
  /// Searches for devices again, in a few ms; no line may be open. Without udev, as in a container,
  /// libusb finds only devices attached before its search.
  void look_again() noexcept;

 private:
  struct End {
    void operator()(libusb_context* context) const noexcept;
  };
  std::unique_ptr<libusb_context, End> context_;
};

/// A device that was opened, or why none was.
struct UsbOpening {
  libusb_device_handle* handle = nullptr;
  std::string problem;  ///< if there is no handle: a sentence with a remedy
};
using UsbOpener = std::function<UsbOpening(libusb_context*)>;

/// Opens the first attached device with these IDs.
[[nodiscard]] UsbOpening open_usb_device(libusb_context* context, std::uint16_t vendor,
                                         std::uint16_t product);
/// Closes a handle that no UsbLine owns.
void close_usb_device(libusb_device_handle* handle) noexcept;

/// Endpoints of a device.
struct UsbPipes {
  bool are_interrupts = false;  ///< interrupt transfers; false: bulk
  std::uint8_t in = 0x81, out = 0x02;
  std::uint8_t interface = 0;
  /// Octets of header before the payload of each received packet of 64, from a serial chip.
  std::size_t header = 0;
};

/// Endpoints of the first HID interface with an interrupt endpoint each way. @return std::nullopt:
/// none, or its descriptors cannot be read
[[nodiscard]] std::optional<UsbPipes> hid_pipes(libusb_device_handle* handle);

/// Calls `each` with every payload octet of a transfer.
void each_payload_octet(std::span<const std::uint8_t> transfer, std::size_t header, auto&& each) {
  constexpr std::size_t kUsbPacket = 64;
  for (std::size_t i = 0; i < transfer.size(); ++i) {
    if (i % kUsbPacket >= header) each(transfer[i]);
  }
}

/// One connection. Constructor, destructor and requests may block on the device, at most 0.1 s
/// each; the other functions do not block, except pump(), and allocate nothing.
class UsbLine {
 public:
  /// Claims the device and starts to receive. @param handle of an open device; the line takes
  /// ownership @throws std::runtime_error if it cannot be claimed, with the reason
  UsbLine(UsbContext& context, libusb_device_handle* handle, const UsbPipes& pipes);
  ~UsbLine();
  UsbLine(const UsbLine&) = delete;
  UsbLine& operator=(const UsbLine&) = delete;

  /// Sends a vendor request. @return false if it is refused
  bool request(std::uint8_t request, std::uint16_t value) noexcept;
  /// A vendor request that reads an octet. @return std::nullopt if it is refused
  [[nodiscard]] std::optional<std::uint8_t> ask(std::uint8_t request) noexcept;

  /// Handles completed transfers, and waits for one at most `longest`.
  void pump(std::chrono::microseconds longest) noexcept { context_.wait(longest); }
  /// Payload received since clear().
  [[nodiscard]] std::span<const std::uint8_t> received() const noexcept {
    return {inbox_.data(), length_};
  }
  /// The same, transfer by transfer; empty ones are left out.
  void each_transfer(auto&& each) const {
    std::size_t from = 0;
    for (std::size_t i = 0; i < transfers_; ++i) {
      each(received().subspan(from, ends_[i] - from));
      from = ends_[i];
    }
  }
  void clear() noexcept { length_ = transfers_ = 0; }
  /// Sends up to kMost octets. @return false while the last transfer is pending, or after a fault
  bool send(std::span<const std::uint8_t> octets) noexcept;
  [[nodiscard]] bool is_sending() const noexcept { return sending_; }
  [[nodiscard]] UsbFault fault() const noexcept { return fault_; }

  /// Octets of one transfer.
  static constexpr std::size_t kMost = 64;

 private:
  static constexpr std::size_t kListeners = 2;  // one receives while the other is handled
  struct Free {
    void operator()(libusb_transfer* transfer) const noexcept;
  };
  using Transfer = std::unique_ptr<libusb_transfer, Free>;

  int control(std::uint8_t kind, std::uint8_t request, std::uint16_t value,
              std::span<std::uint8_t> octets) noexcept;
  void fill(libusb_transfer& transfer, std::uint8_t end, std::span<std::uint8_t> octets,
            void (*ended)(libusb_transfer*)) noexcept;
  void listen(libusb_transfer* transfer) noexcept;
  void note(int status) noexcept;
  void take(const libusb_transfer& transfer) noexcept;
  static void ended_in(libusb_transfer* transfer);
  static void ended_out(libusb_transfer* transfer);

  UsbContext& context_;
  libusb_device_handle* handle_;
  UsbPipes pipes_;
  std::array<Transfer, kListeners> in_;
  std::array<std::array<std::uint8_t, kMost>, kListeners> in_octets_{};
  Transfer out_;
  std::array<std::uint8_t, kMost> out_octets_{};
  std::vector<std::uint8_t> inbox_;
  std::size_t length_ = 0;
  std::array<std::size_t, 256> ends_{};  // ends of the transfers in the inbox
  std::size_t transfers_ = 0;
  std::size_t listening_ = 0;
  bool sending_ = false;
  bool closing_ = false;
  UsbFault fault_ = UsbFault::none;
};

}  // namespace reckon::haptics
