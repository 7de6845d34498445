// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A USB device below libusb: the test program answers libusb's calls to the kernel, ioctl() and
// poll(), for one descriptor. The library above it is the real one. While it waits, only the
// model's time passes, unless it is given a clock.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

struct libusb_context;
struct libusb_device_handle;

namespace reckon::test {

/// Behaviour of a device. All calls come from the thread that uses libusb.
class UsbModel {
 public:
  virtual ~UsbModel() = default;
  /// Device and configuration descriptors, one after the other.
  [[nodiscard]] virtual std::vector<std::uint8_t> descriptors() const = 0;
  /// A request of its own, at once. @return octets moved, or a negative errno
  virtual int control(std::uint8_t request, std::uint16_t value,
                      std::span<std::uint8_t> answer) = 0;
  /// A transfer to it was submitted; out_done() reports its end.
  virtual void begin_out(std::span<const std::uint8_t> octets) = 0;
  /// @return octets taken or a negative errno; nothing: not yet
  virtual std::optional<int> out_done() = 0;
  /// @return octets received or a negative errno; nothing: not yet
  virtual std::optional<int> in_done(std::span<std::uint8_t> octets) = 0;
  /// Advances its time.
  virtual void pass(std::chrono::nanoseconds time) = 0;
};

/// The plug of one device. Several at a time have a descriptor each.
class UsbShim {
 public:
  using Clock = std::function<std::chrono::nanoseconds()>;

  /// @param model outlives it
  explicit UsbShim(UsbModel& model);
  /// @param clock from 0; a wait then takes its time, and another thread may plug and unplug
  UsbShim(UsbModel& model, Clock clock);
  ~UsbShim();
  UsbShim(const UsbShim&) = delete;
  UsbShim& operator=(const UsbShim&) = delete;

  /// Ends pending transfers as an unplug does.
  void unplug();
  /// Files opened before stay dead.
  void plug();
  [[nodiscard]] bool is_plugged() const { return plugged_; }
  /// A handle of libusb's on the device, null while it is not plugged in.
  [[nodiscard]] libusb_device_handle* open(libusb_context* context);

  /// From now on the library finds and opens the device by itself, by a file of this name.
  void be_at(std::string node);

  /// The next `count` transfers end with this errno, as with a half-plugged cable.
  void fail(int error, unsigned count);
  /// Cancels pending transfers, as when a hub resets its port. The device stays open.
  void reset_port();
  /// Called at each call to the kernel for this device, before it is answered.
  void at_each_call(std::function<void()> call) { at_call_ = std::move(call); }
  /// Calls it while no other thread has the model.
  template <class Call>
  auto with_model(Call&& call) {
    const std::lock_guard lock(guard_);
    return call();
  }
  /// Transfers that the library has not fetched.
  [[nodiscard]] std::size_t outstanding() const { return requests_.size(); }

  // For ioctl() and poll().
  static UsbShim* of(int descriptor);
  /// The first without a clock: its time passes if none of them has its device open.
  static UsbShim* that_keeps_time();
  [[nodiscard]] int descriptor() const { return file_; }
  int answer(unsigned long request, void* argument);
  [[nodiscard]] bool is_ready();
  [[nodiscard]] bool is_gone() const { return gone_; }
  /// Advances its time by at most this. @return by how much
  std::chrono::nanoseconds pass(std::chrono::nanoseconds most);
  [[nodiscard]] bool has_clock() const { return clock_ != nullptr; }

 private:
  struct Request {
    void* urb;
    bool discarded = false;
    bool ended = false;
  };
  int control(void* argument);
  int reap(void* argument);
  void end(Request& request);
  void be_opened_anew();
  bool end_transfer(void* urb);

  UsbModel& model_;
  Clock clock_;
  mutable std::recursive_mutex guard_;
  std::chrono::nanoseconds passed_{0};
  std::string node_;
  int file_ = -1;      // that is open
  bool gone_ = false;  // the file that was open at the unplug
  bool plugged_ = true;
  std::vector<Request> requests_;  // in the order of their submission
  std::function<void()> at_call_;
  int error_ = 0;
  unsigned errors_ = 0;
};

}  // namespace reckon::test
