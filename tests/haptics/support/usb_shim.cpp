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
#include <cerrno>
#include <cstdarg>
#include <cstdlib>
#include <ctime>

namespace reckon::test {
namespace {

UsbShim* the_shim = nullptr;

constexpr std::chrono::nanoseconds kTick = std::chrono::microseconds(50);

int refuse(int error) {
  errno = error;
  return -1;
}

usbdevfs_urb& urb_of(void* urb) { return *static_cast<usbdevfs_urb*>(urb); }

}  // namespace

UsbShim* UsbShim::current() { return the_shim; }

UsbShim::UsbShim(UsbModel& model) : model_(model) {
  the_shim = this;
  plug();
}

UsbShim::~UsbShim() {
  the_shim = nullptr;
  ::close(file_);
}

void UsbShim::plug() {
  if (plugged_) return;
  if (file_ >= 0) ::close(file_);
  file_ = ::memfd_create("usb", MFD_CLOEXEC);
  const auto octets = model_.descriptors();
  if (file_ < 0 || ::write(file_, octets.data(), octets.size()) < 0) std::abort();
  requests_.clear();
  plugged_ = true;
}

void UsbShim::unplug() { plugged_ = false; }

libusb_device_handle* UsbShim::open(libusb_context* context) {
  libusb_device_handle* handle = nullptr;
  if (plugged_) libusb_wrap_sys_device(context, file_, &handle);
  return handle;
}

int UsbShim::answer(unsigned long request, void* argument) {
  if (request == USBDEVFS_REAPURBNDELAY || request == USBDEVFS_REAPURB) return reap(argument);
  if (request == USBDEVFS_DISCARDURB) {
    for (Request& r : requests_) {
      if (r.urb != argument || r.ended) continue;
      r.discarded = true;
      return 0;
    }
    return refuse(EINVAL);
  }
  if (!plugged_) return refuse(ENODEV);
  switch (request) {
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

// The library itself asks for the configuration only; others are waited for, as transfers.
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
  if (!plugged_ || request.discarded) {
    urb.status = plugged_ ? -ENOENT : -ESHUTDOWN;
    urb.actual_length = 0;
    request.ended = true;
  } else {
    request.ended = end_transfer(request.urb);
  }
}

bool UsbShim::is_ready() {
  // In order: of two that listen, the first gets what comes first.
  for (Request& request : requests_) end(request);
  return !plugged_ ||
         std::ranges::any_of(requests_, [](const Request& request) { return request.ended; });
}

int UsbShim::reap(void* argument) {
  static_cast<void>(is_ready());
  const auto done = std::ranges::find_if(requests_, [](const Request& r) { return r.ended; });
  if (done == requests_.end()) return refuse(plugged_ ? EAGAIN : ENODEV);
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

// The time to wait is the model's, and passes at once.
int shimmed_poll(UsbShim& shim, pollfd* files, nfds_t count, int wait_ms) {
  pollfd* const ours = std::find_if(files, files + count,
                                    [&](const pollfd& f) { return f.fd == shim.descriptor(); });
  if (ours != files + count) ours->fd = -1;  // the kernel leaves it out
  auto left = std::chrono::nanoseconds(std::chrono::milliseconds(wait_ms < 0 ? 1000 : wait_ms));
  int others = 0;
  bool ready = false;
  while (true) {
    others = real_poll(files, count, 0);
    ready = ours != files + count && shim.is_ready();
    if (others != 0 || ready || left <= left.zero()) break;
    shim.pass(kTick);
    left -= kTick;
  }
  if (ours == files + count) return others;
  ours->fd = shim.descriptor();
  ours->revents =
      ready ? static_cast<short>(shim.is_plugged() ? POLLOUT : POLLERR | POLLHUP) : short{0};
  return std::max(0, others) + (ready ? 1 : 0);
}

}  // namespace
}  // namespace reckon::test

// A program's own functions come before those that libusb would find in the C library.
extern "C" int ioctl(int file, unsigned long request, ...) noexcept {
  std::va_list arguments;
  va_start(arguments, request);
  void* const argument = va_arg(arguments, void*);
  va_end(arguments);
  reckon::test::UsbShim* const shim = reckon::test::UsbShim::current();
  if (shim != nullptr && file == shim->descriptor()) return shim->answer(request, argument);
  return static_cast<int>(::syscall(SYS_ioctl, file, request, argument));
}

extern "C" int poll(pollfd* files, nfds_t count, int wait_ms) {
  reckon::test::UsbShim* const shim = reckon::test::UsbShim::current();
  return shim != nullptr ? reckon::test::shimmed_poll(*shim, files, count, wait_ms)
                         : reckon::test::real_poll(files, count, wait_ms);
}
