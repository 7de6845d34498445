// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/usb/usb_line.hpp"

#include <libusb-1.0/libusb.h>
#include <sys/time.h>

#include <algorithm>
#include <stdexcept>

namespace reckon::haptics {
namespace {

constexpr std::uint8_t kToDevice = 0x40;  // bmRequestType of vendor requests
constexpr std::uint8_t kFromDevice = 0xC0;
constexpr std::uint16_t kPort = 0;   // wIndex: the only port
constexpr unsigned kPatience = 100;  // [ms], time-out of a request
constexpr std::size_t kInbox = 4096;

std::string reason(int code) { return libusb_strerror(static_cast<libusb_error>(code)); }

UsbFault fault_of(int status) {
  if (status == LIBUSB_TRANSFER_NO_DEVICE) return UsbFault::gone;
  return status == LIBUSB_TRANSFER_STALL ? UsbFault::stalled : UsbFault::failed;
}

}  // namespace

void UsbContext::End::operator()(libusb_context* context) const noexcept { libusb_exit(context); }

UsbContext::UsbContext(bool discover) {
  if (!discover) libusb_set_option(nullptr, LIBUSB_OPTION_NO_DEVICE_DISCOVERY);
  libusb_context* context = nullptr;
  const int code = libusb_init(&context);
  if (code != 0) throw std::runtime_error("USB cannot be used: " + reason(code));
  context_.reset(context);
}

void UsbContext::wait(std::chrono::microseconds longest) noexcept {
  timeval time{};
  time.tv_sec = static_cast<time_t>(longest.count() / 1'000'000);
  time.tv_usec = static_cast<suseconds_t>(longest.count() % 1'000'000);
  static_cast<void>(libusb_handle_events_timeout_completed(get(), &time, nullptr));
}

void UsbContext::look_again() noexcept {
  libusb_context* context = nullptr;
  if (libusb_init(&context) == 0) context_.reset(context);
}

UsbOpening open_usb_device(libusb_context* context, std::uint16_t vendor, std::uint16_t product) {
  UsbOpening opening;
  opening.problem = "none is attached: plug it in, and its power supply";
  libusb_device** list = nullptr;
  const ssize_t count = libusb_get_device_list(context, &list);
  for (ssize_t i = 0; i < count && opening.handle == nullptr; ++i) {
    libusb_device_descriptor about{};
    if (libusb_get_device_descriptor(list[i], &about) != 0) continue;
    if (about.idVendor != vendor || about.idProduct != product) continue;
    const int code = libusb_open(list[i], &opening.handle);
    if (code == LIBUSB_ERROR_ACCESS) {
      opening.problem = "this user may not open it: `reckon devices` prints the udev rule";
    } else if (code != 0 && code != LIBUSB_ERROR_NO_DEVICE) {
      opening.problem = "it cannot be opened: " + reason(code);
    }
  }
  if (count >= 0) libusb_free_device_list(list, 1);
  if (opening.handle != nullptr) opening.problem.clear();
  return opening;
}

void close_usb_device(libusb_device_handle* handle) noexcept { libusb_close(handle); }

namespace {

// @return std::nullopt unless the interface has an interrupt endpoint each way
std::optional<UsbPipes> pipes_of(const libusb_interface_descriptor& about) {
  if (about.bInterfaceClass != LIBUSB_CLASS_HID) return std::nullopt;
  UsbPipes pipes{true, 0, 0, about.bInterfaceNumber, 0};
  for (int i = 0; i < about.bNumEndpoints; ++i) {
    const libusb_endpoint_descriptor& end = about.endpoint[i];
    if ((end.bmAttributes & LIBUSB_TRANSFER_TYPE_MASK) != LIBUSB_TRANSFER_TYPE_INTERRUPT) continue;
    const bool is_in = (end.bEndpointAddress & LIBUSB_ENDPOINT_IN) != 0;
    (is_in ? pipes.in : pipes.out) = end.bEndpointAddress;
  }
  if (pipes.in == 0 || pipes.out == 0) return std::nullopt;
  return pipes;
}

}  // namespace

std::optional<UsbPipes> hid_pipes(libusb_device_handle* handle) {
  libusb_config_descriptor* config = nullptr;
  if (libusb_get_active_config_descriptor(libusb_get_device(handle), &config) != 0)
    return std::nullopt;
  std::optional<UsbPipes> pipes;
  for (int i = 0; i < config->bNumInterfaces && !pipes; ++i) {
    const libusb_interface& interface = config->interface[i];
    if (interface.num_altsetting > 0) pipes = pipes_of(interface.altsetting[0]);
  }
  libusb_free_config_descriptor(config);
  return pipes;
}

void UsbLine::Free::operator()(libusb_transfer* transfer) const noexcept {
  libusb_free_transfer(transfer);
}

UsbLine::UsbLine(UsbContext& context, libusb_device_handle* handle, const UsbPipes& pipes)
    : context_(context), handle_(handle), pipes_(pipes), inbox_(kInbox) {
  // The kernel's driver, if any, is detached and comes back when the interface is released.
  static_cast<void>(libusb_set_auto_detach_kernel_driver(handle, 1));
  const int code = libusb_claim_interface(handle, pipes_.interface);
  if (code != 0) {
    libusb_close(handle);
    const bool is_gone = code == LIBUSB_ERROR_NO_DEVICE;
    throw std::runtime_error(
        (is_gone ? "was unplugged while it opened: " : "another program uses it: ") + reason(code));
  }
  out_.reset(libusb_alloc_transfer(0));
  for (std::size_t i = 0; i < kListeners; ++i) {
    in_[i].reset(libusb_alloc_transfer(0));
    fill(*in_[i], pipes_.in, in_octets_[i], &UsbLine::ended_in);
    listen(in_[i].get());
  }
}

UsbLine::~UsbLine() {
  closing_ = true;
  if (sending_) libusb_cancel_transfer(out_.get());
  for (const Transfer& transfer : in_) libusb_cancel_transfer(transfer.get());
  while (listening_ > 0 || sending_) context_.wait(std::chrono::milliseconds(10));
  libusb_release_interface(handle_, pipes_.interface);
  libusb_close(handle_);
}

void UsbLine::fill(libusb_transfer& transfer, std::uint8_t end, std::span<std::uint8_t> octets,
                   void (*ended)(libusb_transfer*)) noexcept {
  const auto count = static_cast<int>(octets.size());
  if (pipes_.are_interrupts) {
    libusb_fill_interrupt_transfer(&transfer, handle_, end, octets.data(), count, ended, this, 0);
  } else {
    libusb_fill_bulk_transfer(&transfer, handle_, end, octets.data(), count, ended, this, 0);
  }
}

bool UsbLine::request(std::uint8_t request, std::uint16_t value) noexcept {
  return control(kToDevice, request, value, {}) >= 0;
}

int UsbLine::control(std::uint8_t kind, std::uint8_t request, std::uint16_t value,
                     std::span<std::uint8_t> octets) noexcept {
  const int code = libusb_control_transfer(handle_, kind, request, value, kPort, octets.data(),
                                           static_cast<std::uint16_t>(octets.size()), kPatience);
  if (code == LIBUSB_ERROR_NO_DEVICE) fault_ = UsbFault::gone;
  return code;
}

std::optional<std::uint8_t> UsbLine::ask(std::uint8_t request) noexcept {
  std::array<std::uint8_t, 1> octet{};
  if (control(kFromDevice, request, 0, octet) != 1) return std::nullopt;
  return octet[0];
}

bool UsbLine::send(std::span<const std::uint8_t> octets) noexcept {
  if (sending_ || fault_ != UsbFault::none || octets.size() > kMost) return false;
  std::ranges::copy(octets, out_octets_.begin());
  fill(*out_, pipes_.out, std::span(out_octets_).first(octets.size()), &UsbLine::ended_out);
  const int code = libusb_submit_transfer(out_.get());
  if (code == 0) {
    sending_ = true;
  } else {
    fault_ = code == LIBUSB_ERROR_NO_DEVICE ? UsbFault::gone : UsbFault::failed;
  }
  return sending_;
}

void UsbLine::listen(libusb_transfer* transfer) noexcept {
  const int code = libusb_submit_transfer(transfer);
  if (code == 0) {
    ++listening_;
  } else {
    fault_ = code == LIBUSB_ERROR_NO_DEVICE ? UsbFault::gone : UsbFault::failed;
  }
}

void UsbLine::note(int status) noexcept {
  if (closing_ || status == LIBUSB_TRANSFER_COMPLETED) return;
  if (fault_ == UsbFault::none) fault_ = fault_of(status);
}

// A full inbox has not been read for long, so further data is dropped.
void UsbLine::take(const libusb_transfer& transfer) noexcept {
  const auto count = static_cast<std::size_t>(std::max(0, transfer.actual_length));
  if (transfers_ == ends_.size() || count > inbox_.size() - length_) return;
  each_payload_octet({transfer.buffer, count}, pipes_.header,
                     [&](std::uint8_t octet) { inbox_[length_++] = octet; });
  const std::size_t before = transfers_ == 0 ? 0 : ends_[transfers_ - 1];
  if (length_ > before) ends_[transfers_++] = length_;
}

void UsbLine::ended_in(libusb_transfer* transfer) {
  UsbLine& line = *static_cast<UsbLine*>(transfer->user_data);
  --line.listening_;
  line.note(transfer->status);
  if (transfer->status == LIBUSB_TRANSFER_COMPLETED && !line.closing_) line.take(*transfer);
  if (!line.closing_ && line.fault_ == UsbFault::none) line.listen(transfer);
}

void UsbLine::ended_out(libusb_transfer* transfer) {
  UsbLine& line = *static_cast<UsbLine*>(transfer->user_data);
  line.sending_ = false;
  line.note(transfer->status);
  // The rest of a cut command would be taken as the start of the next, so the line must be set up
  // again.
  if (!line.closing_ && line.fault_ == UsbFault::none &&
      transfer->actual_length != transfer->length)
    line.fault_ = UsbFault::failed;
}

}  // namespace reckon::haptics
