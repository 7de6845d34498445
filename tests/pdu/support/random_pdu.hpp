// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Random values for any PDU or record: another visitor of the field tables.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <random>
#include <span>
#include <string_view>
#include <vector>

#include "reckon/pdu/pdu_types.hpp"

namespace reckon::test {

/// Fills fields with random bits; floats stay finite. Owns the octets of the views, so it must
/// outlive the PDU. Variable parts have 0 to 5 records.
class RandomFields {
 public:
  explicit RandomFields(std::uint64_t seed) : random_(seed) {}

  template <typename T>
  void operator()(std::string_view, T& value) {
    if constexpr (pdu::Scalar<T>) {
      value = scalar<T>();
    } else if constexpr (pdu::kIsStdArray<T>) {
      for (auto& element : value) element = scalar<typename T::value_type>();
    } else {
      fields(*this, value);
    }
  }
  void operator()(std::string_view, pdu::PduHeader& header) {
    fields(*this, header);
    header.protocol_version = static_cast<std::uint8_t>(5 + random_() % 3);
  }
  template <typename Record, typename Count>
  void count(std::string_view, std::span<const std::byte>&, pdu::Records<Record, Count>) {}
  template <typename Record, typename Count>
  void records(std::string_view, std::span<const std::byte>& view, pdu::Records<Record, Count>) {
    view = octets(random_() % 6 * pdu::kFixedSize<Record>);
  }
  void walked(std::string_view, pdu::VariableDatums& datums) {
    pdu::VariableDatumWriter writer(room());
    for (std::uint64_t n = random_() % 6; n > 0; --n)
      if (!writer.add(scalar<std::uint32_t>(), octets(random_() % 40))) break;
    datums = writer.datums();
  }
  void walked(std::string_view, pdu::AttributeRecordSets& sets) {
    std::span<std::byte> buffer = room();
    pdu::AttributeWriter writer(buffer, pdu::Attribute{});
    std::uint16_t count = 0;
    for (std::uint64_t n = random_() % 6; n > 0; --n) {
      if (add_set(writer)) ++count;
    }
    sets = {count, buffer.subspan(32, writer.size() - 32)};
  }

  template <typename Count>
  void walked(std::string_view, pdu::OctetBlock<Count>& block) {
    block = pdu::OctetBlock<Count>::of(octets(random_() % 40));
  }
  void walked(std::string_view, pdu::BitBlock& block) {
    block.count = static_cast<std::uint16_t>(random_() % 400);
    block.bytes = octets((block.count + 31U) / 32 * 4);
  }
  void walked(std::string_view, pdu::RestOfPdu& rest) { rest.bytes = octets(random_() % 40); }
  template <typename Head, typename Count>
  void walked(std::string_view, pdu::SizedRecords<Head, Count>& records) {
    records.count = static_cast<Count>(random_() % 6);
    records.bytes = sized<Head>(records.count);
  }
  template <typename Head>
  void walked(std::string_view, pdu::SizedRecordsToEnd<Head>& records) {
    records.bytes = sized<Head>(random_() % 6);
  }

  std::span<const std::byte> octets(std::size_t size) {
    auto& octets = store_.emplace_back(size);
    for (std::byte& octet : octets) octet = static_cast<std::byte>(random_());
    return octets;
  }
  std::uint64_t bits() { return random_(); }

 private:
  template <typename T>
  T scalar() {
    if constexpr (std::is_floating_point_v<T>) {
      for (;;) {
        const auto value =
            std::bit_cast<T>(static_cast<typename pdu::UnsignedOf<sizeof(T)>::Type>(random_()));
        if (std::isfinite(value)) return value;
      }
    } else {
      return static_cast<T>(random_());
    }
  }
  template <typename Head>
  std::span<const std::byte> sized(std::size_t count) {
    const std::span<std::byte> buffer = room();
    std::size_t size = 0;
    for (; count > 0; --count) {
      Head head;
      (*this)("", head);
      const auto body = octets(head.claim(random_() % 64));
      size += pdu::store_record(head, buffer.subspan(size));
      std::ranges::copy(body, buffer.begin() + static_cast<std::ptrdiff_t>(size));
      size += body.size();
    }
    return buffer.first(size);
  }
  std::span<std::byte> room() { return store_.emplace_back(4096); }
  bool add_set(pdu::AttributeWriter& writer) {
    pdu::EntityId entity;
    (*this)("", entity);
    bool good = writer.begin_set(entity);
    for (std::uint64_t n = random_() % 4; n > 0; --n) good = good && add_record(writer);
    return good;
  }
  bool add_record(pdu::AttributeWriter& writer) {
    const std::uint64_t kind = random_() % 4;
    pdu::HapticRecord haptic;
    pdu::EnergyAccountRecord energy;
    (*this)("", haptic);
    pdu::OwnershipRecord ownership;
    (*this)("", energy);
    (*this)("", ownership);
    haptic.version = pdu::HapticRecord::kVersion;
    if (kind == 0) return writer.add(haptic);
    if (kind == 1) return writer.add(energy);
    if (kind == 2) return writer.add(ownership);
    return writer.add(252000 + static_cast<std::uint32_t>(random_() % 200), octets(random_() % 64));
  }

  std::mt19937_64 random_;
  std::deque<std::vector<std::byte>> store_;
};

}  // namespace reckon::test
