// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tests/haptics/support/usbip_wheel.hpp"

#include <linux/usb/ch9.h>

#include <string_view>
#include <utility>

namespace reckon::test {
namespace {

constexpr std::uint8_t kHid = 0x21, kReport = 0x22;  // descriptors of the class HID
constexpr std::uint8_t kGetReport = 0x01, kSetReport = 0x09;

std::uint8_t low(std::size_t value) { return static_cast<std::uint8_t>(value); }
std::uint8_t high(std::size_t value) { return static_cast<std::uint8_t>(value >> 8); }

std::vector<std::uint8_t> text_descriptor(std::string_view text) {
  std::vector<std::uint8_t> out(2 + 2 * text.size());
  out[0] = low(out.size());
  out[1] = USB_DT_STRING;
  for (std::size_t i = 0; i < text.size(); ++i) out[2 + 2 * i] = static_cast<std::uint8_t>(text[i]);
  return out;
}

}  // namespace

std::vector<std::uint8_t> UsbipWheel::Model::descriptor(std::uint8_t kind,
                                                        std::uint8_t index) const {
  const std::size_t length = wheel.descriptor().size();
  switch (kind) {
    case USB_DT_DEVICE:  // with OpenFFBoard's number
      return {18, kind, 0, 2, 0, 0, 0, 64, 0x09, 0x12, 0xB0, 0xFF, 0, 1, 1, 2, 0, 1};
    case USB_DT_CONFIG:  // with its interface, class descriptor, and two endpoints
      return {9,
              kind,
              41,
              0,
              1,
              1,
              0,
              0x80,
              50,  //
              9,
              USB_DT_INTERFACE,
              0,
              0,
              2,
              USB_CLASS_HID,
              0,
              0,
              0,  //
              9,
              kHid,
              0x11,
              1,
              0,
              1,
              kReport,
              low(length),
              high(length),  //
              7,
              USB_DT_ENDPOINT,
              0x81,
              USB_ENDPOINT_XFER_INT,
              64,
              0,
              1,  //
              7,
              USB_DT_ENDPOINT,
              0x01,
              USB_ENDPOINT_XFER_INT,
              64,
              0,
              1};
    case USB_DT_STRING:
      if (index == 0) return {4, kind, 0x09, 0x04};
      return text_descriptor(index == 1 ? kMaker : kProduct);
    case kReport:
      return wheel.descriptor();
    default:
      return {};
  }
}

std::optional<std::vector<std::uint8_t>> UsbipWheel::Model::control(
    std::span<const std::uint8_t, 8> setup, std::span<const std::uint8_t> data) {
  if ((setup[0] & USB_TYPE_MASK) != USB_TYPE_CLASS) return std::nullopt;
  const std::uint8_t what = setup[1], index = setup[2], kind = setup[3];
  if (what == kGetReport) return kind == 1 ? std::optional(wheel.input()) : wheel.feature(index);
  if (what == kSetReport) wheel.take(data);
  if ((setup[0] & USB_DIR_IN) != 0) return std::nullopt;
  return std::vector<std::uint8_t>{};
}

bool UsbipWheel::Model::take(std::span<const std::uint8_t> octets) {
  wheel.take(octets);
  return true;
}

std::optional<std::vector<std::uint8_t>> UsbipWheel::Model::give() {
  std::vector<std::uint8_t> report = wheel.input();
  if (report == sent_) return std::nullopt;
  sent_ = report;
  return report;
}

void UsbipWheel::Model::lose_power() {
  wheel.lose_power();
  sent_.clear();
}

}  // namespace reckon::test
