// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The samples of a coupling study as a standard Data PDU (type 20), each in one variable datum with
// an identifier of this project: any DIS tool skips them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "reckon/bench/baselines/coupling_end.hpp"
#include "reckon/pdu/codec/codec.hpp"

namespace reckon::bench {

inline constexpr std::uint32_t kSampleDatum = 0x48415010;  ///< "HAP", 16

/// Data of one side at one sample: 64 octets.
struct SampleRecord {
  static constexpr std::uint8_t kVersion = 1;

  std::uint8_t version = kVersion;
  std::uint8_t due = 0;  ///< 1: the following numbers were sent; 0: no sample was due
  std::uint16_t padding = 0;
  std::uint32_t number = 0;  ///< of the sample, from 0
  double position = 0.0;     ///< from here on the members of CouplingSample
  double velocity = 0.0;
  double effort = 0.0;
  double stiffness = 0.0;
  double given = 0.0;
  double need = 0.0;
  double spring_need = 0.0;
};

template <typename Visitor, pdu::Is<SampleRecord> Record>
constexpr void fields(Visitor& visitor, Record& record) {
  visitor("version", record.version);
  visitor("due", record.due);
  visitor("padding", record.padding);
  visitor("number", record.number);
  visitor("position", record.position);
  visitor("velocity", record.velocity);
  visitor("effort", record.effort);
  visitor("stiffness", record.stiffness);
  visitor("given", record.given);
  visitor("need", record.need);
  visitor("spring_need", record.spring_need);
}

[[nodiscard]] SampleRecord to_record(std::uint32_t number,
                                     const std::optional<CouplingSample>& sample) noexcept;
[[nodiscard]] std::optional<CouplingSample> from_record(const SampleRecord& record) noexcept;

/// Buffer for a datagram of two records.
using SampleDatagram = std::array<std::byte, 256>;

/// Encodes the newest two records, so that one lost datagram loses no sample. @returns octets in
/// `out`
[[nodiscard]] std::size_t encode_samples(std::span<const SampleRecord> records,
                                         SampleDatagram& out) noexcept;

/// Up to two records of a datagram; none if it is not such a Data PDU, is damaged or has another
/// version.
struct SampleRecords {
  std::array<SampleRecord, 2> records{};
  std::size_t count = 0;
};
[[nodiscard]] SampleRecords decode_samples(std::span<const std::byte> datagram) noexcept;

}  // namespace reckon::bench
