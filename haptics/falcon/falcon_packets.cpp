// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/falcon/falcon_packets.hpp"

namespace reckon::haptics {
namespace {

constexpr std::uint8_t kBegin = '<';
constexpr std::uint8_t kEnd = '>';
constexpr std::uint8_t kLetter = 'A';
constexpr std::size_t kFlags = 13;  // index of buttons and homed arms, or of lights
constexpr std::size_t kSpare = 14;
constexpr std::uint8_t kMostFlags = 0x7F;  // three arms and four buttons

// Whether an octet is valid at an index of a report.
bool fits(std::size_t place, std::uint8_t octet) noexcept {
  if (place == 0) return octet == kBegin;
  if (place == kFalconPacket - 1) return octet == kEnd;
  if (octet < kLetter) return false;
  if (place == kFlags) return octet - kLetter <= kMostFlags;
  return place == kSpare || octet - kLetter <= 0xF;
}

}  // namespace

std::array<std::uint8_t, kFalconPacket> octets_of(const FalconCommand& command) noexcept {
  std::array<std::uint8_t, kFalconPacket> octets{};
  octets.fill(kLetter);
  octets.front() = kBegin;
  octets.back() = kEnd;
  for (std::size_t i = 0; i < 12; ++i) {
    const auto word = static_cast<std::uint16_t>(command.motors[i / 4]);
    octets[1 + i] = static_cast<std::uint8_t>(kLetter + ((word >> (4 * (i % 4))) & 0xF));
  }
  octets[kFlags] =
      static_cast<std::uint8_t>(kLetter + (command.lights & 0xE) + (command.homing ? 1 : 0));
  return octets;
}

std::optional<FalconReport> FalconReportParser::take(std::uint8_t octet) noexcept {
  if (octet == kBegin) {
    if (length_ > 0) ++malformed_;
    length_ = 0;
  }
  if (!fits(length_, octet)) {
    if (length_ > 0) ++malformed_;
    length_ = 0;
    return std::nullopt;
  }
  octets_[length_++] = octet;
  if (length_ < kFalconPacket) return std::nullopt;
  length_ = 0;
  return report();
}

FalconReport FalconReportParser::report() const noexcept {
  FalconReport report;
  for (std::size_t arm = 0; arm < 3; ++arm) {
    unsigned word = 0;
    for (std::size_t i = 4; i-- > 0;) word = word << 4 | (octets_[1 + 4 * arm + i] - kLetter);
    report.counts[arm] = static_cast<std::int16_t>(word);
  }
  const unsigned flags = octets_[kFlags] - unsigned{kLetter};
  report.buttons = flags & 0xF;
  report.homed = static_cast<std::uint8_t>(flags >> 4);
  return report;
}

}  // namespace reckon::haptics
