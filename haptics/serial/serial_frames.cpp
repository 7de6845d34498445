// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/serial/serial_frames.hpp"

#include <algorithm>
#include <cassert>

namespace reckon::haptics {
namespace {

constexpr std::size_t kCrc = 2;

}  // namespace

std::uint16_t serial_crc(std::span<const std::uint8_t> octets) noexcept {
  unsigned crc = 0xFFFF;
  for (const std::uint8_t octet : octets) {
    crc ^= unsigned{octet} << 8;
    for (int bit = 0; bit < 8; ++bit)
      crc = (crc & 0x8000) != 0 ? (crc << 1 ^ 0x1021) & 0xFFFF : crc << 1;
  }
  return static_cast<std::uint16_t>(crc);
}

SerialFrame serial_frame(std::span<const std::uint8_t> carried) noexcept {
  assert(!carried.empty() && carried.size() <= kSerialMost);
  const std::uint16_t crc = serial_crc(carried);
  SerialFrame frame;
  auto& out = frame.octets;
  // COBS: each group of octets other than zero follows a code octet, the distance to the next zero.
  std::size_t code = 1;
  std::size_t next = 2;
  const auto put = [&](std::uint8_t octet) {
    if (octet != 0) {
      out[next++] = octet;
      return;
    }
    out[code] = static_cast<std::uint8_t>(next - code);
    code = next++;
  };
  for (const std::uint8_t octet : carried) put(octet);
  put(static_cast<std::uint8_t>(crc & 0xFF));
  put(static_cast<std::uint8_t>(crc >> 8));
  out[code] = static_cast<std::uint8_t>(next - code);
  frame.length = next + 1;  // the array starts as zeros: the first and the last octet stay zero
  return frame;
}

// The octet 0xFF, as a COBS code, puts the next zero beyond the end of any frame.
SerialFrame spoiling(const SerialFrame& frame) noexcept {
  assert(frame.length < kSerialLongest);
  SerialFrame out;
  out.octets[0] = 0xFF;
  std::copy_n(frame.octets.begin(), frame.length, out.octets.begin() + 1);
  out.length = frame.length + 1;
  return out;
}

std::span<const std::uint8_t> SerialFrameParser::take(std::uint8_t octet) noexcept {
  if (octet == 0) return end();
  if (length_ == stuffed_.size())
    overrun_ = true;
  else
    stuffed_[length_++] = octet;
  return {};
}

std::span<const std::uint8_t> SerialFrameParser::end() noexcept {
  if (length_ == 0 && !overrun_) return {};  // two zeros in a row
  const std::size_t length = overrun_ ? 0 : unstuff();
  length_ = 0;
  overrun_ = false;
  const auto all = std::span<const std::uint8_t>(carried_).first(length);
  if (length > kCrc) {
    const auto frame = all.first(length - kCrc);
    const unsigned crc = all[length - 2] | unsigned{all[length - 1]} << 8;
    if (crc == serial_crc(frame)) return frame;
  }
  ++damaged_;
  return {};
}

// @return length of the decoded frame; 0: malformed
std::size_t SerialFrameParser::unstuff() noexcept {
  std::size_t length = 0;
  for (std::size_t at = 0; at < length_;) {
    const std::size_t end = at + stuffed_[at];
    if (end > length_) return 0;
    for (++at; at < end; ++at) carried_[length++] = stuffed_[at];
    if (at < length_) carried_[length++] = 0;
  }
  return length;
}

}  // namespace reckon::haptics
