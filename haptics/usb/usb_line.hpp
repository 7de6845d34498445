// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A line to a device on USB: octets both ways by asynchronous transfers of libusb.
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
  /// Looks for devices anew; no line may be open. Where udev does not run, as in a container, the
  /// library finds only what was plugged in before it looked. Some ms.
  void look_again() noexcept;

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
/// Gives a handle back that no UsbLine has.
void close_usb_device(libusb_device_handle* handle) noexcept;

/// Where the octets of a device go.
struct UsbPipes {
  bool are_interrupts = false;  ///< of transfers; false: bulk
  std::uint8_t in = 0x81, out = 0x02;
  std::uint8_t interface = 0;
  /// Octets before the payload of each packet of 64 that came: a serial chip's own.
  std::size_t header = 0;
};

/// The pipes of the first interface of class HID that has an interrupt each way. @return nothing
/// where there is none, or its descriptors cannot be read
[[nodiscard]] std::optional<UsbPipes> hid_pipes(libusb_device_handle* handle);

/// Calls `each` with every octet of a transfer that is payload.
template <class Each>
void each_payload_octet(std::span<const std::uint8_t> transfer, std::size_t header, Each&& each) {
  constexpr std::size_t kUsbPacket = 64;
  for (std::size_t i = 0; i < transfer.size(); ++i) {
    if (i % kUsbPacket >= header) each(transfer[i]);
  }
}

/// One line. The constructor, the destructor and requests may wait for the device, at most 0.1 s
/// each; all else is immediate, and allocates nothing.
class UsbLine {
 public:
  /// Claims the device and listens from now on. @param handle of an open device, which becomes the
  /// line's own @throws std::runtime_error if it cannot be claimed, with the reason
  UsbLine(UsbContext& context, libusb_device_handle* handle, const UsbPipes& pipes);
  ~UsbLine();
  UsbLine(const UsbLine&) = delete;
  UsbLine& operator=(const UsbLine&) = delete;

  /// A request of its maker's. @return false if it is refused
  bool request(std::uint8_t request, std::uint16_t value) noexcept;
  /// One that asks for an octet. @return nothing if it is refused
  [[nodiscard]] std::optional<std::uint8_t> ask(std::uint8_t request) noexcept;

  /// Handles transfers that have ended, and waits for one so long at most.
  void pump(std::chrono::microseconds longest) noexcept { context_.wait(longest); }
  /// Payload that came over the line since clear().
  [[nodiscard]] std::span<const std::uint8_t> received() const noexcept {
    return {inbox_.data(), length_};
  }
  /// The same, transfer by transfer, but for those without any.
  template <class Each>
  void each_transfer(Each&& each) const {
    std::size_t from = 0;
    for (std::size_t i = 0; i < transfers_; ++i) {
      each(received().subspan(from, ends_[i] - from));
      from = ends_[i];
    }
  }
  void clear() noexcept { length_ = transfers_ = 0; }
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
  std::array<std::size_t, 256> ends_{};  // of transfers in the inbox
  std::size_t transfers_ = 0;
  std::size_t listening_ = 0;
  bool sending_ = false;
  bool closing_ = false;
  UsbFault fault_ = UsbFault::none;
};

}  // namespace reckon::haptics
