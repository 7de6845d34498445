// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tests/haptics/support/usb_shim.hpp"

#include <libusb-1.0/libusb.h>
#include <linux/usbdevice_fs.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdarg>
#include <cstdlib>
#include <ctime>

namespace reckon::test {
namespace {

std::vector<UsbShim*>& shims() {
  static std::vector<UsbShim*> all;
  return all;
}
std::mutex all_guard;

constexpr std::chrono::nanoseconds kTick = std::chrono::microseconds(50);
constexpr std::chrono::nanoseconds kIdleTick = std::chrono::milliseconds(1);

// Name of the open file; empty if no device is searched by name.
std::string name_of(int descriptor, bool is_wanted) {
  std::array<char, 256> name{};
  if (!is_wanted) return {};
  const std::string link = "/proc/self/fd/" + std::to_string(descriptor);
  const auto length = ::readlink(link.c_str(), name.data(), name.size());
  return {name.data(), static_cast<std::size_t>(std::max<ssize_t>(0, length))};
}

int refuse(int error) {
  errno = error;
  return -1;
}

usbdevfs_urb& urb_of(void* urb) { return *static_cast<usbdevfs_urb*>(urb); }

}  // namespace

UsbShim* UsbShim::of(int descriptor) {
  const std::lock_guard lock(all_guard);
  if (descriptor < 0) return nullptr;
  const bool is_wanted =
      std::ranges::any_of(shims(), [](const UsbShim* shim) { return !shim->node_.empty(); });
  const std::string name = name_of(descriptor, is_wanted);
  const auto is_its = [&](const UsbShim* shim) {
    return shim->node_.empty() ? shim->file_ == descriptor : name.ends_with(shim->node_);
  };
  const auto found = std::ranges::find_if(shims(), is_its);
  if (found == shims().end()) return nullptr;
  (*found)->file_ = descriptor;
  return *found;
}

UsbShim* UsbShim::that_keeps_time() {
  const std::lock_guard lock(all_guard);
  const auto found = std::ranges::find_if(shims(), [](UsbShim* shim) { return !shim->clock_; });
  return found == shims().end() ? nullptr : *found;
}

UsbShim::UsbShim(UsbModel& model) : UsbShim(model, nullptr) {}

UsbShim::UsbShim(UsbModel& model, Clock clock) : model_(model), clock_(std::move(clock)) {
  const std::lock_guard lock(all_guard);
  shims().push_back(this);
}

UsbShim::~UsbShim() {
  const std::lock_guard lock(all_guard);
  std::erase(shims(), this);
  if (node_.empty()) ::close(file_);
}

void UsbShim::plug() {
  const std::lock_guard lock(guard_);
  plugged_ = true;
}

void UsbShim::unplug() {
  const std::lock_guard lock(guard_);
  plugged_ = false;
  gone_ = true;
  errors_ = 0;
}

void UsbShim::be_at(std::string node) {
  const std::lock_guard lock(all_guard);
  node_ = std::move(node);
}

// The library asks each device that it opens for its capabilities.
void UsbShim::be_opened_anew() {
  requests_.clear();
  gone_ = !plugged_;
}

void UsbShim::fail(int error, unsigned count) {
  const std::lock_guard lock(guard_);
  error_ = error;
  errors_ = count;
}

void UsbShim::reset_port() {
  const std::lock_guard lock(guard_);
  for (Request& request : requests_) request.discarded = true;
}

libusb_device_handle* UsbShim::open(libusb_context* context) {
  int file = -1;
  {
    const std::lock_guard lock(guard_);
    if (!plugged_) return nullptr;
    if (!requests_.empty()) std::abort();  // the library still waits for a closed device
    const std::lock_guard all(all_guard);
    if (file_ >= 0) ::close(file_);
    file = file_ = ::memfd_create("usb", MFD_CLOEXEC);
    const auto octets = model_.descriptors();
    if (file_ < 0 || ::write(file_, octets.data(), octets.size()) < 0) std::abort();
    gone_ = false;
  }
  libusb_device_handle* handle = nullptr;
  libusb_wrap_sys_device(context, file, &handle);
  return handle;
}

std::chrono::nanoseconds UsbShim::pass(std::chrono::nanoseconds most) {
  const std::lock_guard lock(guard_);
  std::chrono::nanoseconds time = std::min(most, requests_.empty() ? kIdleTick : kTick);
  if (clock_) time = clock_() - passed_;
  passed_ += time;
  model_.pass(time);
  return time;
}

int UsbShim::answer(unsigned long request, void* argument) {
  const std::lock_guard lock(guard_);
  if (at_call_) at_call_();
  if (request == USBDEVFS_REAPURBNDELAY || request == USBDEVFS_REAPURB) return reap(argument);
  if (request == USBDEVFS_GET_CAPABILITIES && !node_.empty()) be_opened_anew();
  if (gone_) return refuse(ENODEV);
  switch (request) {
    case USBDEVFS_DISCARDURB: {
      const auto found = std::ranges::find_if(
          requests_, [&](const Request& r) { return r.urb == argument && !r.ended; });
      if (found == requests_.end()) return refuse(EINVAL);
      found->discarded = true;
      return 0;
    }
    case USBDEVFS_CONNECTINFO:
      *static_cast<usbdevfs_connectinfo*>(argument) = {2, 0};
      return 0;
    case USBDEVFS_GET_SPEED:
      return 2;  // full speed
    case USBDEVFS_GET_CAPABILITIES:
      *static_cast<std::uint32_t*>(argument) = USBDEVFS_CAP_BULK_CONTINUATION |
                                               USBDEVFS_CAP_NO_PACKET_SIZE_LIM |
                                               USBDEVFS_CAP_REAP_AFTER_DISCONNECT;
      return 0;
    case USBDEVFS_CONTROL:
      return control(argument);
    case USBDEVFS_SUBMITURB: {
      const usbdevfs_urb& urb = urb_of(argument);
      if (urb.type != USBDEVFS_URB_TYPE_CONTROL && (urb.endpoint & 0x80) == 0) {
        model_.begin_out({static_cast<const std::uint8_t*>(urb.buffer),
                          static_cast<std::size_t>(urb.buffer_length)});
      }
      requests_.push_back({argument});
      return 0;
    }
    case USBDEVFS_CLAIMINTERFACE:
    case USBDEVFS_RELEASEINTERFACE:
    case USBDEVFS_DISCONNECT_CLAIM:
      return 0;
    default:
      return refuse(request == USBDEVFS_GETDRIVER ? ENODATA : ENOTTY);
  }
}

// The library itself requests only the configuration; other requests are awaited, like transfers.
int UsbShim::control(void* argument) {
  const auto& request = *static_cast<usbdevfs_ctrltransfer*>(argument);
  if (request.bRequestType != 0x80 || request.bRequest != LIBUSB_REQUEST_GET_CONFIGURATION ||
      request.wLength == 0)
    return refuse(EPIPE);
  *static_cast<std::uint8_t*>(request.data) = 1;
  return 1;
}

bool UsbShim::end_transfer(void* pointer) {
  usbdevfs_urb& urb = urb_of(pointer);
  auto* const octets = static_cast<std::uint8_t*>(urb.buffer);
  std::optional<int> result;
  if (urb.type == USBDEVFS_URB_TYPE_CONTROL) {
    const auto word = [&](int i) {
      return static_cast<std::uint16_t>(octets[i] | octets[i + 1] << 8);
    };
    const std::size_t room =
        std::min<std::size_t>(word(6), static_cast<std::size_t>(urb.buffer_length) - 8);
    result = model_.control(octets[1], word(2), {octets + 8, room});
  } else if ((urb.endpoint & 0x80) != 0) {
    result = model_.in_done({octets, static_cast<std::size_t>(urb.buffer_length)});
  } else {
    result = model_.out_done();
  }
  if (!result) return false;
  urb.status = std::min(0, *result);
  urb.actual_length = std::max(0, *result);
  return true;
}

void UsbShim::end(Request& request) {
  if (request.ended) return;
  usbdevfs_urb& urb = urb_of(request.urb);
  if (gone_ || request.discarded) {
    urb.status = gone_ ? -ESHUTDOWN : -ENOENT;
    urb.actual_length = 0;
    request.ended = true;
  } else if (errors_ > 0) {
    --errors_;
    urb.status = -error_;
    urb.actual_length = 0;
    request.ended = true;
  } else {
    request.ended = end_transfer(request.urb);
  }
}

bool UsbShim::is_ready() {
  const std::lock_guard lock(guard_);
  // In order: of two readers, the first gets the first data.
  for (Request& request : requests_) end(request);
  return gone_ ||
         std::ranges::any_of(requests_, [](const Request& request) { return request.ended; });
}

int UsbShim::reap(void* argument) {
  static_cast<void>(is_ready());
  const auto done = std::ranges::find_if(requests_, [](const Request& r) { return r.ended; });
  if (done == requests_.end()) return refuse(gone_ ? ENODEV : EAGAIN);
  *static_cast<void**>(argument) = done->urb;
  requests_.erase(done);
  return 0;
}

namespace {

int real_poll(pollfd* files, nfds_t count, int wait_ms) {
  const timespec wait{wait_ms / 1000, wait_ms % 1000 * 1'000'000L};
  return static_cast<int>(
      ::syscall(SYS_ppoll, files, count, wait_ms < 0 ? nullptr : &wait, nullptr, 0));
}

// Without a clock, the wait advances the model's time at once. With a clock, it lasts until the
// clock has advanced. The other files are polled once a millisecond of the wait, which suffices.
int shimmed_poll(UsbShim& shim, pollfd* files, nfds_t count, int wait_ms) {
  pollfd* const end = files + count;
  pollfd* const ours =
      std::find_if(files, end, [&](const pollfd& f) { return f.fd == shim.descriptor(); });
  if (ours != end) ours->fd = -1;  // the kernel ignores it
  auto left = std::chrono::nanoseconds(std::chrono::milliseconds(wait_ms < 0 ? 1000 : wait_ms));
  auto unseen = std::chrono::nanoseconds(0);
  int others = real_poll(files, count, 0);
  bool ready = ours != end && shim.is_ready();
  while (others == 0 && !ready && left > left.zero()) {
    if (shim.has_clock()) ::usleep(50);
    const auto time = shim.pass(left);
    left -= time;
    unseen += time;
    if (unseen >= std::chrono::milliseconds(1)) {
      others = real_poll(files, count, 0);
      unseen = unseen.zero();
    }
    ready = ours != end && shim.is_ready();
  }
  if (ours == end) return std::max(0, others);
  ours->fd = shim.descriptor();
  ours->revents =
      ready ? static_cast<short>(shim.is_gone() ? POLLERR | POLLHUP : POLLOUT) : short{0};
  return std::max(0, others) + (ready ? 1 : 0);
}

}  // namespace
}  // namespace reckon::test

// A program's own functions precede the functions of the C library for libusb.
extern "C" int ioctl(int file, unsigned long request, ...) noexcept {
  std::va_list arguments;
  va_start(arguments, request);
  void* const argument = va_arg(arguments, void*);
  va_end(arguments);
  reckon::test::UsbShim* const shim = reckon::test::UsbShim::of(file);
  if (shim != nullptr) return shim->answer(request, argument);
  return static_cast<int>(::syscall(SYS_ioctl, file, request, argument));
}

extern "C" int poll(pollfd* files, nfds_t count, int wait_ms) {
  using reckon::test::UsbShim;
  UsbShim* shim = nullptr;
  for (nfds_t i = 0; i < count && shim == nullptr; ++i) shim = UsbShim::of(files[i].fd);
  if (shim == nullptr) shim = UsbShim::that_keeps_time();
  return shim != nullptr ? reckon::test::shimmed_poll(*shim, files, count, wait_ms)
                         : reckon::test::real_poll(files, count, wait_ms);
}
