// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/coupling/sample_datagram.hpp"

#include "reckon/pdu/management/data.hpp"

namespace reckon::bench {
namespace {

constexpr std::size_t kRecordSize = pdu::kFixedSize<SampleRecord>;
static_assert(kRecordSize == 64);

}  // namespace

SampleRecord to_record(std::uint32_t number, const std::optional<CouplingSample>& sample) noexcept {
  SampleRecord record;
  record.number = number;
  if (!sample) return record;
  record.due = 1;
  record.position = sample->position;
  record.velocity = sample->velocity;
  record.effort = sample->effort;
  record.stiffness = sample->stiffness;
  record.given = sample->given;
  record.need = sample->need;
  record.spring_need = sample->spring_need;
  return record;
}

std::optional<CouplingSample> from_record(const SampleRecord& r) noexcept {
  if (r.due == 0) return std::nullopt;
  return CouplingSample{r.number,    r.position, r.velocity, r.effort,
                        r.stiffness, r.given,    r.need,     r.spring_need};
}

std::size_t encode_samples(std::span<const SampleRecord> records, SampleDatagram& out) noexcept {
  std::array<std::byte, 2 * (8 + kRecordSize)> block;
  pdu::VariableDatumWriter writer(block);
  for (const SampleRecord& record : records) {
    std::array<std::byte, kRecordSize> octets;
    pdu::Encoder encoder(octets.data());
    fields(encoder, record);
    if (!writer.add(kSampleDatum, octets)) return 0;
  }
  pdu::Data data;
  data.variable_datums = writer.datums();
  return pdu::encode(data, out);
}

SampleRecords decode_samples(std::span<const std::byte> datagram) noexcept {
  SampleRecords out;
  pdu::Data data;
  if (pdu::decode(datagram, data) != pdu::DecodeError::none) return {};
  for (const pdu::VariableDatum& datum : data.variable_datums.records()) {
    if (datum.datum_id != kSampleDatum || datum.value.size() != kRecordSize) continue;
    if (out.count == out.records.size()) return {};
    SampleRecord& record = out.records[out.count];
    pdu::Decoder decoder(datum.value);
    fields(decoder, record);
    if (record.version == SampleRecord::kVersion) ++out.count;
  }
  return out;
}

}  // namespace reckon::bench
