// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/sealing/hello.hpp"

#include <cassert>

#include "reckon/pdu/codec/byte_order.hpp"

namespace reckon::peer {
namespace {

using pdu::load_big_endian;
using pdu::store_big_endian;

constexpr std::size_t kEchoCount = 8, kWantedCount = 10, kReserved = 12;

std::uint64_t number_at(std::span<const std::byte> octets, std::size_t at) noexcept {
  return load_big_endian<std::uint64_t>(octets.data() + at);
}

}  // namespace

HelloWriter::HelloWriter(std::uint64_t nonce, std::span<std::byte> room) noexcept : room_(room) {
  assert(room.size() >= kHead);
  store_big_endian(room_.data(), nonce);
}

std::byte* HelloWriter::grow(std::size_t octets) noexcept {
  if (size_ + octets > room_.size()) return nullptr;
  std::byte* const at = room_.data() + size_;
  size_ += octets;
  return at;
}

bool HelloWriter::echo(const NonceEcho& echo) noexcept {
  assert(wanted_ == 0);
  std::byte* const at = grow(kEcho);
  if (at == nullptr) return false;
  store_big_endian(at, echo.boot);
  store_big_endian(at + 8, echo.nonce);
  ++echoes_;
  return true;
}

bool HelloWriter::want(std::uint64_t boot) noexcept {
  std::byte* const at = grow(kWanted);
  if (at == nullptr) return false;
  store_big_endian(at, boot);
  ++wanted_;
  return true;
}

std::span<const std::byte> HelloWriter::finish() noexcept {
  store_big_endian(room_.data() + kEchoCount, echoes_);
  store_big_endian(room_.data() + kWantedCount, wanted_);
  store_big_endian(room_.data() + kReserved, std::uint32_t{0});
  return room_.first(size_);
}

bool Hello::read(std::span<const std::byte> octets) noexcept {
  if (octets.size() < HelloWriter::kHead) return false;
  octets_ = octets;
  echoes_ = load_big_endian<std::uint16_t>(octets.data() + kEchoCount);
  wanted_ = load_big_endian<std::uint16_t>(octets.data() + kWantedCount);
  return octets.size() ==
         HelloWriter::kHead + echoes_ * HelloWriter::kEcho + wanted_ * HelloWriter::kWanted;
}

std::uint64_t Hello::nonce() const noexcept { return number_at(octets_, 0); }

bool Hello::has_echo(const NonceEcho& echo) const noexcept {
  for (std::size_t i = 0; i < echoes_; ++i) {
    const std::size_t at = HelloWriter::kHead + i * HelloWriter::kEcho;
    if (number_at(octets_, at) == echo.boot && number_at(octets_, at + 8) == echo.nonce)
      return true;
  }
  return false;
}

bool Hello::wants(std::uint64_t boot) const noexcept {
  const std::size_t begin = HelloWriter::kHead + echoes_ * HelloWriter::kEcho;
  for (std::size_t i = 0; i < wanted_; ++i)
    if (number_at(octets_, begin + i * HelloWriter::kWanted) == boot) return true;
  return false;
}

}  // namespace reckon::peer
