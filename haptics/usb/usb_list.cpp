// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/usb/usb_list.hpp"

#include <libusb-1.0/libusb.h>

namespace reckon::haptics {

std::vector<UsbDeviceSeen> usb_devices(UsbContext& context,
                                       const std::function<bool(const UsbDeviceSeen&)>& is_ours) {
  std::vector<UsbDeviceSeen> seen;
  libusb_device** list = nullptr;
  const ssize_t count = libusb_get_device_list(context.get(), &list);
  for (ssize_t i = 0; i < count; ++i) {
    libusb_device_descriptor about{};
    if (libusb_get_device_descriptor(list[i], &about) != 0) continue;
    UsbDeviceSeen& device = seen.emplace_back();
    device.vendor = about.idVendor;
    device.product = about.idProduct;
    device.bus = libusb_get_bus_number(list[i]);
    device.address = libusb_get_device_address(list[i]);
    if (!is_ours(device)) continue;
    libusb_device_handle* handle = nullptr;
    const int code = libusb_open(list[i], &handle);
    device.is_open_to_us = code == 0;
    device.is_denied = code == LIBUSB_ERROR_ACCESS;
    if (code != 0) device.problem = libusb_strerror(static_cast<libusb_error>(code));
    if (handle != nullptr) libusb_close(handle);
  }
  if (count >= 0) libusb_free_device_list(list, 1);
  return seen;
}

}  // namespace reckon::haptics
