// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A USB device below libusb: the test program answers the calls by which libusb talks with the
// kernel, ioctl() and poll(), for one descriptor. The library above it is the real one. Where it
// waits, the model's time passes and no other.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

struct libusb_context;
struct libusb_device_handle;

namespace reckon::test {

/// What a device does. All calls come from the thread that uses libusb.
class UsbModel {
 public:
  virtual ~UsbModel() = default;
  /// Device and configuration descriptors, one after the other.
  [[nodiscard]] virtual std::vector<std::uint8_t> descriptors() const = 0;
  /// A request of its own, at once. @return octets moved, or a negative errno
  virtual int control(std::uint8_t request, std::uint16_t value,
                      std::span<std::uint8_t> answer) = 0;
  /// A transfer to it was handed in; out_done() says when it has ended.
  virtual void begin_out(std::span<const std::uint8_t> octets) = 0;
  /// @return octets taken or a negative errno; nothing: not yet
  virtual std::optional<int> out_done() = 0;
  /// @return octets that came or a negative errno; nothing: not yet
  virtual std::optional<int> in_done(std::span<std::uint8_t> octets) = 0;
  /// Time goes on.
  virtual void pass(std::chrono::nanoseconds time) = 0;
};

/// The plug of one device at a time.
class UsbShim {
 public:
  /// @param model outlives it
  explicit UsbShim(UsbModel& model);
  ~UsbShim();
  UsbShim(const UsbShim&) = delete;
  UsbShim& operator=(const UsbShim&) = delete;

  /// What is under way then ends as unplugging ends it.
  void unplug();
  void plug();
  [[nodiscard]] bool is_plugged() const { return plugged_; }
  /// A handle of libusb's on the device, null while it is not plugged in.
  [[nodiscard]] libusb_device_handle* open(libusb_context* context);

  // For ioctl() and poll().
  static UsbShim* current();
  [[nodiscard]] int descriptor() const { return file_; }
  int answer(unsigned long request, void* argument);
  [[nodiscard]] bool is_ready();
  void pass(std::chrono::nanoseconds time) { model_.pass(time); }

 private:
  struct Request {
    void* urb;
    bool discarded = false;
    bool ended = false;
  };
  int control(void* argument);
  int reap(void* argument);
  void end(Request& request);
  bool end_transfer(void* urb);

  UsbModel& model_;
  int file_ = -1;
  bool plugged_ = false;
  std::vector<Request> requests_;  // in the order in which they came
};

}  // namespace reckon::test
