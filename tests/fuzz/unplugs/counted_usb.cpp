// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tests/fuzz/unplugs/counted_usb.hpp"

#include <libusb-1.0/libusb.h>

#include <cstdint>

namespace reckon::fuzz::unplugs {
namespace {

UsbCount count;

}  // namespace

const UsbCount& counted_usb() noexcept { return count; }

bool is_usb_given_back() noexcept { return count.handles == 0 && count.transfers == 0; }

}  // namespace reckon::fuzz::unplugs

using reckon::fuzz::unplugs::count;

extern "C" {

int __real_libusb_wrap_sys_device(libusb_context* context, std::intptr_t file,
                                  libusb_device_handle** handle);
int __real_libusb_open(libusb_device* device, libusb_device_handle** handle);
void __real_libusb_close(libusb_device_handle* handle);
libusb_transfer* __real_libusb_alloc_transfer(int packets);
void __real_libusb_free_transfer(libusb_transfer* transfer);

int __wrap_libusb_wrap_sys_device(libusb_context* context, std::intptr_t file,
                                  libusb_device_handle** handle) {
  const int code = __real_libusb_wrap_sys_device(context, file, handle);
  if (code == 0) ++count.handles;
  return code;
}

int __wrap_libusb_open(libusb_device* device, libusb_device_handle** handle) {
  const int code = __real_libusb_open(device, handle);
  if (code == 0) ++count.handles;
  return code;
}

void __wrap_libusb_close(libusb_device_handle* handle) {
  --count.handles;
  __real_libusb_close(handle);
}

libusb_transfer* __wrap_libusb_alloc_transfer(int packets) {
  ++count.transfers;
  return __real_libusb_alloc_transfer(packets);
}

void __wrap_libusb_free_transfer(libusb_transfer* transfer) {
  if (transfer != nullptr) --count.transfers;
  __real_libusb_free_transfer(transfer);
}
}
