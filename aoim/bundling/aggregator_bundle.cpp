// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Writes the bundles of the aggregator.
#include <algorithm>
#include <cstring>

#include "reckon/aoim/bundling/aggregator.hpp"
#include "reckon/aoim/bundling/attribute_records.hpp"
#include "reckon/pdu/entity/attribute.hpp"
#include "reckon/pdu/reckon/datagram_trailer.hpp"
#include "reckon/pdu/timestamp.hpp"

namespace reckon::aoim {
namespace {

using std::chrono::nanoseconds;

constexpr std::size_t kTimestampAt = 4, kLengthAt = 8, kStatusAt = 10;  // in the header

}  // namespace

void Aggregator::emit(GroupIndex group, std::span<const Item> items, nanoseconds now,
                      DatagramSink sink) {
  Lane& lane = lanes_[group.value];
  const std::span<std::byte> out(datagram_);
  std::size_t size = write_pdus(lane, items, Place::entity, 0);
  size = write_pdus(lane, items, Place::standard, size);
  size = write_attribute(lane, items, size, now);
  size = write_compressed(lane, items, size, now);
  size = write_pdus(lane, items, Place::experimental, size);
  if (size > room(group)) ++counts_.oversized;
  if (!lane.interop) size += write_trailer(lane, out.subspan(size), now);
  ++counts_.datagrams;
  counts_.octets += size;
  sink(group, out.first(size));
}

std::size_t Aggregator::write_pdus(const Lane& lane, std::span<const Item> items, Place place,
                                   std::size_t at) noexcept {
  for (const Item& item : items) {
    const bool marks = item.place != place && place == Place::experimental;
    const std::uint32_t size = marks ? item.mark_size : item.place == place ? item.pdu_size : 0;
    if (size == 0) continue;
    const std::byte* from = lane.octets.data() + item.offset + (marks ? item.pdu_size : 0);
    std::memcpy(datagram_.data() + at, from, size);
    if (item.records_size > 0) datagram_[at + kStatusAt] |= std::byte{pdu::kStatusCoupledExtension};
    at += size;
  }
  return at;
}

std::size_t Aggregator::write_compressed(const Lane& lane, std::span<const Item> items,
                                         std::size_t at, nanoseconds now) noexcept {
  if (lane.compressed == 0) return at;
  pdu::CompressedStates states;
  std::size_t end = at + pdu::kCompressedStatesSize;
  for (const Item& item : items) {
    if (item.place != Place::compressed) continue;
    std::memcpy(datagram_.data() + end, lane.octets.data() + item.offset, item.pdu_size);
    end += item.pdu_size;
    ++states.number_of_states;
  }
  if (states.number_of_states == 0) return at;
  states.header.exercise_id = config_.exercise_id;
  states.header.timestamp = pdu::to_dis_timestamp(now + utc_offset_, synchronised_);
  states.simulation = config_.sender;
  states.form = lane.form;
  const std::size_t head = pdu::encode(states, std::span(datagram_).subspan(at));
  if (head != pdu::kCompressedStatesSize) return at;
  pdu::store_big_endian(datagram_.data() + at + kLengthAt, static_cast<std::uint16_t>(end - at));
  return end;
}

std::size_t Aggregator::write_attribute(const Lane& lane, std::span<const Item> items,
                                        std::size_t at, nanoseconds now) noexcept {
  if (lane.sets == 0) return at;
  pdu::Attribute attribute;
  attribute.header.exercise_id = config_.exercise_id;
  attribute.header.timestamp = pdu::to_dis_timestamp(now + utc_offset_, synchronised_);
  attribute.originating_simulation = config_.sender;

  // The coupled Entity State gives the timestamp, because both must agree.
  const auto coupled = std::find_if(items.begin(), items.end(), [](const Item& item) {
    return item.place == Place::entity && item.records_size > 0 && item.pdu_size > 0;
  });
  if (coupled != items.end()) {
    attribute.header.timestamp =
        pdu::load_big_endian<std::uint32_t>(lane.octets.data() + coupled->offset + kTimestampAt);
  }
  pdu::AttributeWriter writer(std::span<std::byte>(datagram_).subspan(at), attribute);
  for (const Item& item : items) {
    if (item.records_size == 0) continue;
    bool fits = writer.begin_set(item.entity);
    std::span<const std::byte> rest(lane.octets.data() + item.offset + item.pdu_size,
                                    item.records_size);
    while (fits && !rest.empty()) {
      const auto record = take_record(rest);
      fits = writer.add(pdu::load_big_endian<std::uint32_t>(record.data()),
                        record.subspan(pdu::kAttributeRecordHeaderSize));
    }
  }
  return at + (writer.empty() ? 0 : writer.finish());
}

std::size_t Aggregator::write_trailer(Lane& lane, std::span<std::byte> out,
                                      nanoseconds now) noexcept {
  pdu::DatagramTrailer trailer;
  trailer.header.exercise_id = config_.exercise_id;
  trailer.header.timestamp = pdu::to_dis_timestamp(now + utc_offset_, synchronised_);
  trailer.sequence = ++lane.sequence;
  trailer.epoch = config_.epoch;
  trailer.send_time = pdu::trailer_time(now + utc_offset_);
  return pdu::encode(trailer, out);
}

}  // namespace reckon::aoim
