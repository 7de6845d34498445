// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/aggregator.hpp"

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "reckon/aoim/attribute_records.hpp"
#include "reckon/pdu/entity/attribute.hpp"
#include "reckon/pdu/reckon/datagram_trailer.hpp"
#include "reckon/pdu/timestamp.hpp"

namespace reckon::aoim {
namespace {

using std::chrono::nanoseconds;

constexpr std::size_t kLargestDatagram = 65507;  // UDP over IPv4
constexpr std::size_t kBareEntityState = 144;
constexpr std::size_t kReservedOctets = 16 * 1024;
constexpr std::size_t kReservedItems = 128;
constexpr std::size_t kTypeAt = 2, kTimestampAt = 4, kLengthAt = 8,
                      kStatusAt = 10;  // in the header
constexpr nanoseconds kNever = nanoseconds::max();

pdu::PduType type_of(std::span<const std::byte> bytes) noexcept {
  return static_cast<pdu::PduType>(bytes[kTypeAt]);
}

// True where the octets are exactly one PDU by its own length field.
bool is_one_pdu(std::span<const std::byte> bytes) noexcept {
  if (bytes.size() < pdu::kHeaderSize) return false;
  return pdu::load_big_endian<std::uint16_t>(bytes.data() + kLengthAt) == bytes.size();
}

void append(std::vector<std::byte>& to, std::span<const std::byte> bytes) {
  to.insert(to.end(), bytes.begin(), bytes.end());
}

}  // namespace

Aggregator::Aggregator(const AggregatorConfig& config) : config_(config) {
  static_assert(kLeastPayload == kBareEntityState + pdu::kAttributeFixedSize +
                                     pdu::kAttributeSetHeaderSize + pdu::kHapticRecordLength +
                                     pdu::kDatagramTrailerSize);
  if (config.payload_limit < config.reserved + kLeastPayload ||
      config.payload_limit > kLargestDatagram) {
    throw std::invalid_argument(
        "payload limit: take the path's MTU less the IP and UDP headers, e.g. 1352 octets");
  }
  if (config.pool > kMaximumPool) throw std::invalid_argument("a pool above 1000 groups");
  lanes_.resize(config.pool + 1);
  for (Lane& lane : lanes_) {
    lane.octets.reserve(kReservedOctets);
    lane.items.reserve(kReservedItems);
  }
  active_.reserve(lanes_.size());
  datagram_.resize(kLargestDatagram);
  scratch_.reserve(kReservedOctets);
  merged_.reserve(kReservedOctets);
  compacted_.reserve(kReservedOctets);
}

std::size_t Aggregator::room(GroupIndex group) const noexcept {
  const std::size_t trailer = lanes_[group.value].interop ? 0 : pdu::kDatagramTrailerSize;
  return config_.payload_limit - config_.reserved - trailer;
}

void Aggregator::set_interop(GroupIndex group, bool interop) noexcept {
  if (group.value < lanes_.size()) lanes_[group.value].interop = interop;
}

void Aggregator::set_utc_offset(nanoseconds offset, bool synchronised) noexcept {
  utc_offset_ = offset;
  synchronised_ = synchronised;
}

AddResult Aggregator::refuse(AddResult why) noexcept {
  ++counts_.refused;
  return why;
}

// ------------------------------------------------------------------------------------------- add

AddResult Aggregator::add(GroupIndex group, std::span<const std::byte> bytes,
                          nanoseconds deadline) {
  if (group.value >= lanes_.size()) return refuse(AddResult::refused_group);
  if (!is_one_pdu(bytes)) return refuse(AddResult::refused_kind);
  const pdu::PduType type = type_of(bytes);
  Lane& lane = lanes_[group.value];
  if (type == pdu::PduType::entity_state) {
    pdu::EntityId entity;
    if (!pdu::load_record(bytes.subspan(pdu::kHeaderSize), entity)) {
      return refuse(AddResult::refused_kind);
    }
    return add_entity(group, entity, bytes, {}, deadline);
  }
  const bool ours = pdu::is_experimental(type);
  const bool made_here = type == pdu::PduType::attribute || type == pdu::PduType::datagram_trailer;
  if (made_here || (ours && lane.interop)) return refuse(AddResult::refused_kind);

  Item item;
  item.place = ours ? Place::experimental : Place::standard;
  return append_item(group, item, bytes, {}, deadline);
}

AddResult Aggregator::add(GroupIndex group, const pdu::EntityState& state,
                          std::span<const std::byte> records, nanoseconds deadline) {
  if (group.value >= lanes_.size()) return refuse(AddResult::refused_group);
  scratch_.resize(pdu::wire_size(state));
  const std::size_t size = pdu::encode(state, scratch_);
  if (size == 0) return refuse(AddResult::refused_kind);
  return add_entity(group, state.entity_id, std::span(scratch_).first(size), records, deadline);
}

AddResult Aggregator::add_records(GroupIndex group, const pdu::EntityId& entity,
                                  std::span<const std::byte> records, nanoseconds deadline) {
  if (group.value >= lanes_.size()) return refuse(AddResult::refused_group);
  if (records.empty()) return refuse(AddResult::refused_kind);
  return add_entity(group, entity, {}, records, deadline);
}

AddResult Aggregator::add_entity(GroupIndex group, const pdu::EntityId& entity,
                                 std::span<const std::byte> state,
                                 std::span<const std::byte> records, nanoseconds deadline) {
  if (!are_records(records)) return refuse(AddResult::refused_kind);
  Lane& lane = lanes_[group.value];
  const auto waiting = std::find_if(lane.items.begin(), lane.items.end(), [&](const Item& item) {
    return item.place == Place::entity && item.entity == entity;
  });
  if (waiting != lane.items.end()) return replace(group, *waiting, state, records, deadline);
  Item item;
  item.place = Place::entity;
  item.entity = entity;
  return append_item(group, item, state, records, deadline);
}

bool Aggregator::make_room(Lane& lane, std::size_t octets) {
  if (lane.octets.size() + octets > config_.waiting_limit) compact(lane);
  return lane.octets.size() + octets <= config_.waiting_limit;
}

AddResult Aggregator::append_item(GroupIndex group, Item item, std::span<const std::byte> bytes,
                                  std::span<const std::byte> records, nanoseconds deadline) {
  constexpr std::size_t kAround =
      pdu::kAttributeFixedSize + pdu::kAttributeSetHeaderSize + pdu::kDatagramTrailerSize;
  Lane& lane = lanes_[group.value];
  const std::size_t size = bytes.size() + records.size();
  if (size + kAround > kLargestDatagram) return refuse(AddResult::refused_size);
  if (!make_room(lane, size)) return refuse(AddResult::refused_full);

  item.offset = static_cast<std::uint32_t>(lane.octets.size());
  item.pdu_size = static_cast<std::uint32_t>(bytes.size());
  item.records_size = static_cast<std::uint32_t>(records.size());
  item.deadline = deadline;
  append(lane.octets, bytes);
  append(lane.octets, records);
  lane.items.push_back(item);
  lane.size += cost(item, lane.sets > 0);
  lane.sets += item.records_size > 0 ? 1 : 0;
  lane.earliest = std::min(lane.earliest, deadline);
  list(group);
  ++counts_.updates;
  return AddResult::queued;
}

// Newest wins: the waiting item keeps its turn and the earlier deadline, its content is renewed.
AddResult Aggregator::replace(GroupIndex group, Item& item, std::span<const std::byte> state,
                              std::span<const std::byte> records, nanoseconds deadline) {
  Lane& lane = lanes_[group.value];
  const auto old = std::span(lane.octets).subspan(item.offset, item.pdu_size + item.records_size);
  const auto old_state = old.first(item.pdu_size);
  merged_.clear();
  append(merged_, state.empty() ? old_state : state);
  const std::size_t pdu_size = merged_.size();
  for (std::span<const std::byte> rest = old.subspan(item.pdu_size); !rest.empty();) {
    const auto record = take_record(rest);
    if (!has_successor(record, records)) append(merged_, record);
  }
  append(merged_, records);

  if (merged_.size() > old.size()) {
    if (!make_room(lane, merged_.size())) return refuse(AddResult::refused_full);
    item.offset = static_cast<std::uint32_t>(lane.octets.size());
    lane.octets.resize(lane.octets.size() + merged_.size());
  }
  std::copy(merged_.begin(), merged_.end(),
            lane.octets.begin() + static_cast<std::ptrdiff_t>(item.offset));
  item.pdu_size = static_cast<std::uint32_t>(pdu_size);
  item.records_size = static_cast<std::uint32_t>(merged_.size() - pdu_size);
  item.deadline = std::min(item.deadline, deadline);
  lane.earliest = std::min(lane.earliest, deadline);
  measure(lane);
  ++counts_.updates;
  ++counts_.replaced;
  return AddResult::replaced;
}

// Octets an item adds to its bundle.
std::size_t Aggregator::cost(const Item& item, bool has_attribute) noexcept {
  if (item.records_size == 0) return item.pdu_size;
  return item.pdu_size + item.records_size + pdu::kAttributeSetHeaderSize +
         (has_attribute ? 0 : pdu::kAttributeFixedSize);
}

void Aggregator::measure(Lane& lane) noexcept {
  lane.size = lane.sets = 0;
  lane.earliest = kNever;
  for (const Item& item : lane.items) {
    lane.size += cost(item, lane.sets > 0);
    lane.sets += item.records_size > 0 ? 1 : 0;
    lane.earliest = std::min(lane.earliest, item.deadline);
  }
}

void Aggregator::list(GroupIndex group) {
  Lane& lane = lanes_[group.value];
  if (lane.listed) return;
  lane.listed = true;
  active_.push_back(group.value);
}

// ----------------------------------------------------------------------------------------- flush

bool Aggregator::is_full(const Lane& lane, std::size_t limit) const noexcept {
  const bool quorum = config_.maximum_updates != 0 && lane.items.size() >= config_.maximum_updates;
  return quorum || lane.size + kBareEntityState > limit;
}

void Aggregator::flush_due(nanoseconds now, DatagramSink sink) { flush(now, now, sink); }

void Aggregator::flush_all(nanoseconds now, DatagramSink sink) { flush(now, kNever, sink); }

void Aggregator::flush(nanoseconds now, nanoseconds until, DatagramSink sink) {
  std::size_t kept = 0;
  for (const std::uint16_t index : active_) {
    Lane& lane = lanes_[index];
    flush_lane({index}, now, until, sink);
    lane.listed = !lane.items.empty();
    if (lane.listed) active_[kept++] = index;
  }
  active_.resize(kept);
}

void Aggregator::flush_lane(GroupIndex group, nanoseconds now, nanoseconds until,
                            DatagramSink sink) {
  Lane& lane = lanes_[group.value];
  const std::size_t limit = room(group);
  if (lane.earliest > until && !is_full(lane, limit)) return;

  std::size_t first = 0;
  while (first < lane.items.size()) {
    const Bundle bundle = next_bundle(lane, first, limit);
    if (!bundle.full && bundle.earliest > until) break;
    ++(bundle.full ? counts_.full : counts_.by_deadline);
    emit(group, std::span(lane.items).subspan(first, bundle.count), now, sink);
    first += bundle.count;
  }
  lane.items.erase(lane.items.begin(), lane.items.begin() + static_cast<std::ptrdiff_t>(first));
  compact(lane);
  measure(lane);
}

// As many items as fit, in the order they came; always at least one.
Aggregator::Bundle Aggregator::next_bundle(const Lane& lane, std::size_t first,
                                           std::size_t limit) const noexcept {
  Bundle bundle;
  std::size_t size = 0, sets = 0;
  for (std::size_t i = first; i < lane.items.size(); ++i) {
    const Item& item = lane.items[i];
    const std::size_t next = size + cost(item, sets > 0);
    bundle.full = bundle.count > 0 && next > limit;
    if (bundle.full) return bundle;
    size = next;
    sets += item.records_size > 0 ? 1 : 0;
    bundle.earliest = std::min(bundle.earliest, item.deadline);
    ++bundle.count;
    bundle.full = bundle.count == config_.maximum_updates || size + kBareEntityState > limit;
    if (bundle.count == config_.maximum_updates) return bundle;
  }
  return bundle;
}

void Aggregator::emit(GroupIndex group, std::span<const Item> items, nanoseconds now,
                      DatagramSink sink) {
  Lane& lane = lanes_[group.value];
  const std::span<std::byte> out(datagram_);
  std::size_t size = write_pdus(lane, items, Place::entity, 0);
  size = write_pdus(lane, items, Place::standard, size);
  size = write_attribute(lane, items, size, now);
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
    if (item.place != place || item.pdu_size == 0) continue;
    std::memcpy(datagram_.data() + at, lane.octets.data() + item.offset, item.pdu_size);
    if (item.records_size > 0) {
      datagram_[at + kStatusAt] |= std::byte{pdu::kStatusCoupledExtension};
    }
    at += item.pdu_size;
  }
  return at;
}

std::size_t Aggregator::write_attribute(const Lane& lane, std::span<const Item> items,
                                        std::size_t at, nanoseconds now) noexcept {
  pdu::Attribute attribute;
  attribute.header.exercise_id = config_.exercise_id;
  attribute.header.timestamp = pdu::to_dis_timestamp(now + utc_offset_, synchronised_);
  attribute.originating_simulation = config_.sender;

  // The coupled Entity State gives the timestamp; they are to agree.
  const auto coupled = std::find_if(items.begin(), items.end(), [](const Item& item) {
    return item.records_size > 0 && item.pdu_size > 0;
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

// Drops octets that no item refers to.
void Aggregator::compact(Lane& lane) {
  compacted_.clear();
  for (Item& item : lane.items) {
    const auto bytes =
        std::span(lane.octets).subspan(item.offset, item.pdu_size + item.records_size);
    item.offset = static_cast<std::uint32_t>(compacted_.size());
    append(compacted_, bytes);
  }
  lane.octets.assign(compacted_.begin(), compacted_.end());
}

std::optional<nanoseconds> Aggregator::next_deadline() const noexcept {
  std::optional<nanoseconds> next;
  for (const std::uint16_t index : active_) {
    const Lane& lane = lanes_[index];
    const nanoseconds due = is_full(lane, room({index})) ? nanoseconds::min() : lane.earliest;
    next = next ? std::min(*next, due) : due;
  }
  return next;
}

}  // namespace reckon::aoim
