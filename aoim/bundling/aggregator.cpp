// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/bundling/aggregator.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "reckon/aoim/bundling/attribute_records.hpp"
#include "reckon/pdu/entity/attribute.hpp"
#include "reckon/pdu/reckon/datagram_trailer.hpp"

namespace reckon::aoim {
namespace {

using std::chrono::nanoseconds;

constexpr std::size_t kLargestDatagram = 65507;  // UDP over IPv4
constexpr std::size_t kBareEntityState = 144;
// Overhead of one PDU with records in a datagram.
constexpr std::size_t kAround = pdu::kAttributeFixedSize + pdu::kAttributeSetHeaderSize +
                                pdu::kCompressedStatesSize + pdu::kDatagramTrailerSize;
constexpr std::size_t kMostWaiting = std::size_t{1} << 30;  // offsets have 32 bits
constexpr std::size_t kTypeAt = 2, kLengthAt = 8;           // in the header
constexpr nanoseconds kNever = nanoseconds::max();

pdu::PduType type_of(std::span<const std::byte> bytes) noexcept {
  return static_cast<pdu::PduType>(bytes[kTypeAt]);
}

// True if the octets are exactly one PDU by its own length field.
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
  if (config.waiting_limit > kMostWaiting) throw std::invalid_argument("more than 1 GiB waiting");
  lanes_.resize(config.pool + 1);
  reserve_rooms();
  active_.reserve(lanes_.size());
  datagram_.resize(config.payload_limit);
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
                          const BundleTerms& terms, std::span<const std::byte> mark) {
  if (group.value >= lanes_.size()) return refuse(AddResult::refused_group);
  if (!is_one_pdu(bytes)) return refuse(AddResult::refused_kind);
  const pdu::PduType type = type_of(bytes);
  Lane& lane = lanes_[group.value];
  if (type == pdu::PduType::entity_state) {
    pdu::EntityId entity;
    if (!pdu::load_record(bytes.subspan(pdu::kHeaderSize), entity)) {
      return refuse(AddResult::refused_kind);
    }
    return add_entity(group, entity, Place::entity, bytes, {}, terms);
  }
  const bool ours = pdu::is_experimental(type) || !mark.empty();
  const bool made_here = type == pdu::PduType::attribute || type == pdu::PduType::datagram_trailer;
  if (made_here || (ours && lane.interop)) return refuse(AddResult::refused_kind);

  const Place place = pdu::is_experimental(type) ? Place::experimental : Place::standard;
  return append_item(group, {kNoEntity, {}, place}, bytes, mark, terms);
}

AddResult Aggregator::add(GroupIndex group, const pdu::EntityState& state,
                          std::span<const std::byte> records, const BundleTerms& terms) {
  if (group.value >= lanes_.size()) return refuse(AddResult::refused_group);
  scratch_.resize(pdu::wire_size(state));
  const std::size_t size = pdu::encode(state, scratch_);
  if (size == 0) return refuse(AddResult::refused_kind);
  return add_entity(group, state.entity_id, Place::entity, std::span(scratch_).first(size), records,
                    terms);
}

AddResult Aggregator::add_records(GroupIndex group, const pdu::EntityId& entity,
                                  std::span<const std::byte> records, const BundleTerms& terms) {
  if (group.value >= lanes_.size()) return refuse(AddResult::refused_group);
  if (records.empty()) return refuse(AddResult::refused_kind);
  return add_entity(group, entity, Place::entity, {}, records, terms);
}

AddResult Aggregator::add_compressed(GroupIndex group, const pdu::EntityId& entity,
                                     pdu::CompressedForm form, std::span<const std::byte> state,
                                     std::span<const std::byte> records, const BundleTerms& terms) {
  if (group.value >= lanes_.size()) return refuse(AddResult::refused_group);
  Lane& lane = lanes_[group.value];
  const bool is_one = state.size() > pdu::kCompressedHeadSize &&
                      state.size() <= pdu::kCompressedHeadSize + pdu::kMostCompressedBody;
  if (lane.interop || !is_one || entity.simulation() != config_.sender) {
    return refuse(AddResult::refused_kind);
  }
  if (form != pdu::CompressedForm::compact) lane.form = form;
  return add_entity(group, entity, Place::compressed, state, records, terms);
}

AddResult Aggregator::add_entity(GroupIndex group, const pdu::EntityId& entity, Place place,
                                 std::span<const std::byte> state,
                                 std::span<const std::byte> records, const BundleTerms& terms) {
  if (!are_records(records)) return refuse(AddResult::refused_kind);
  const Found found = find(group, entity);
  if (found.item != nullptr) return replace(group, *found.item, place, state, records, terms);
  return append_item(group, {entity.key(), entity, place}, state, records, terms, found.ordinal);
}

// The pending update of this entity, or its ordinal in the index. A short queue is searched. For a
// long one the index has each item, and some that have been sent: such an ordinal is before the
// first one, or belongs to another entity by now.
Aggregator::Found Aggregator::find(GroupIndex group, const pdu::EntityId& entity) noexcept {
  Lane& lane = lanes_[group.value];
  const std::uint64_t key = entity.key();
  if (lane.items.size() <= kScanned) {
    for (Item& item : lane.items)
      if (item.key == key) return {&item, nullptr};
    return {};
  }
  std::uint32_t* ordinal = waiting_.find(group, entity);
  if (ordinal == nullptr) return {};
  const std::uint32_t at = *ordinal - lane.first;
  const bool waits = at < lane.items.size() && lane.items[at].key == key;
  return {waits ? &lane.items[at] : nullptr, ordinal};
}

// Indexes the last item, at `ordinal` if its row is there, or all items of a queue that has just
// become long.
void Aggregator::index_added(GroupIndex group, std::uint32_t* ordinal) {
  const Lane& lane = lanes_[group.value];
  const std::size_t last = lane.items.size() - 1;
  if (ordinal != nullptr) {
    *ordinal = lane.first + static_cast<std::uint32_t>(last);
  } else if (!index_from(group, last == kScanned ? 0 : last)) {
    rebuild_index();
  }
}

// False if the index has no room for all.
bool Aggregator::index_from(GroupIndex group, std::size_t first) noexcept {
  const Lane& lane = lanes_[group.value];
  for (std::size_t i = first; i < lane.items.size(); ++i) {
    if (lane.items[i].key == kNoEntity) continue;
    std::uint32_t* ordinal = waiting_.take(group, lane.items[i].entity);
    if (ordinal == nullptr) return false;
    *ordinal = lane.first + static_cast<std::uint32_t>(i);
  }
  return true;
}

bool Aggregator::index_all() noexcept {
  return std::ranges::all_of(active_, [this](std::uint16_t index) {
    return lanes_[index].items.size() <= kScanned || index_from({index}, 0);
  });
}

// Removes entities without pending updates. At least half of the rows are free then, which pays for
// this.
void Aggregator::rebuild_index() {
  waiting_.clear();
  while (!index_all() || !waiting_.is_roomy()) waiting_.grow();
}

// A PDU that is longer than the payload limit is sent alone; no other bundle is as long.
void Aggregator::make_datagram_room(std::size_t octets) {
  const std::size_t needed = std::min(octets + kAround, kLargestDatagram);
  if (datagram_.size() < needed) datagram_.resize(needed);
}

AddResult Aggregator::append_item(GroupIndex group, const Named& named,
                                  std::span<const std::byte> bytes,
                                  std::span<const std::byte> behind, const BundleTerms& terms,
                                  std::uint32_t* ordinal) {
  Lane& lane = lanes_[group.value];
  const std::size_t size = bytes.size() + behind.size();
  if (size + kAround > kLargestDatagram) return refuse(AddResult::refused_size);
  if (!make_room(lane, size)) return refuse(AddResult::refused_full);
  if (lane.items.capacity() == 0) take_room(lane);
  make_datagram_room(size);

  const auto offset = static_cast<std::uint32_t>(lane.octets.size());
  append(lane.octets, bytes);
  append(lane.octets, behind);
  // Constructed in place: a copy of what was just written member by member would stall.
  Item& item = lane.items.emplace_back();
  static_cast<Named&>(item) = named;
  item.offset = offset;
  item.pdu_size = static_cast<std::uint32_t>(bytes.size());
  (named.key == kNoEntity ? item.mark_size : item.records_size) =
      static_cast<std::uint32_t>(behind.size());
  hasten(item, terms);
  count_in(lane, item);
  list(group);
  if (lane.items.size() > kScanned) index_added(group, ordinal);
  ++counts_.updates;
  return AddResult::queued;
}

// Newest wins: the pending item keeps its turn and the earlier deadline, and gets the new content.
AddResult Aggregator::replace(GroupIndex group, Item& item, Place place,
                              std::span<const std::byte> state, std::span<const std::byte> records,
                              const BundleTerms& terms) {
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
  make_datagram_room(merged_.size());
  lane.size -= cost(item);
  lane.sets -= item.records_size > 0 ? 1 : 0;
  lane.compressed -= item.place == Place::compressed ? 1 : 0;
  if (!state.empty()) item.place = place;
  item.pdu_size = static_cast<std::uint32_t>(pdu_size);
  item.records_size = static_cast<std::uint32_t>(merged_.size() - pdu_size);
  hasten(item, terms);
  count_in(lane, item);
  ++counts_.updates;
  ++counts_.replaced;
  return AddResult::replaced;
}

// Keeps the earlier deadline and the lower quorum.
void Aggregator::hasten(Item& item, const BundleTerms& terms) noexcept {
  item.deadline = std::min(item.deadline, terms.deadline);
  if (terms.quorum != 0) item.quorum = std::min(item.quorum, terms.quorum);
}

// Octets an item adds to its bundle, without the Attribute PDU that all share.
std::size_t Aggregator::cost(const Item& item) noexcept {
  if (item.records_size == 0) return item.pdu_size + item.mark_size;
  return item.pdu_size + item.records_size + pdu::kAttributeSetHeaderSize;
}

// Octets of a bundle without trailer. `size` is the sum of cost; `sets` of the items have records,
// and `compressed` of them are compressed.
std::size_t Aggregator::bundled(std::size_t size, std::size_t sets,
                                std::size_t compressed) noexcept {
  return size + (sets > 0 ? pdu::kAttributeFixedSize : 0) +
         (compressed > 0 ? pdu::kCompressedStatesSize : 0);
}

void Aggregator::measure(Lane& lane) noexcept {
  lane.size = lane.sets = lane.compressed = 0;
  lane.earliest = kNever;
  lane.quorum = kNoQuorum;
  for (const Item& item : lane.items) count_in(lane, item);
}

void Aggregator::count_in(Lane& lane, const Item& item) noexcept {
  lane.size += cost(item);
  lane.sets += item.records_size > 0 ? 1 : 0;
  lane.compressed += item.place == Place::compressed ? 1 : 0;
  lane.earliest = std::min(lane.earliest, item.deadline);
  lane.quorum = std::min(lane.quorum, item.quorum);
}

void Aggregator::list(GroupIndex group) {
  if (!std::exchange(lanes_[group.value].listed, true)) active_.push_back(group.value);
}

// ----------------------------------------------------------------------------------------- flush

bool Aggregator::is_full(const Lane& lane, std::size_t limit) const noexcept {
  return lane.items.size() >= lane.quorum || lane.compressed >= kMostCompressed ||
         bundled(lane.size, lane.sets, lane.compressed) + kBareEntityState > limit;
}

void Aggregator::flush_due(nanoseconds now, DatagramSink sink) { flush(now, now, sink); }

void Aggregator::flush_all(nanoseconds now, DatagramSink sink) { flush(now, kNever, sink); }

void Aggregator::flush(nanoseconds now, nanoseconds until, DatagramSink sink) {
  std::size_t kept = 0;
  for (const std::uint16_t index : active_) {
    Lane& lane = lanes_[index];
    flush_lane({index}, now, until, sink);
    lane.listed = !lane.items.empty();
    if (lane.listed)
      active_[kept++] = index;
    else
      give_room_back(lane);
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
  lane.first += static_cast<std::uint32_t>(first);
  compact(lane);
  measure(lane);
}

// As many items as fit, in the order of their arrival; always at least one.
Aggregator::Bundle Aggregator::next_bundle(const Lane& lane, std::size_t first,
                                           std::size_t limit) const noexcept {
  std::size_t count = 0, size = 0, sets = 0, compressed = 0;
  std::uint32_t quorum = kNoQuorum;
  nanoseconds earliest = kNever;
  bool full = false;
  for (const Item& item : std::span(lane.items).subspan(first)) {
    sets += item.records_size > 0 ? 1 : 0;
    compressed += item.place == Place::compressed ? 1 : 0;
    size += cost(item);
    const std::size_t octets = bundled(size, sets, compressed);
    if (count > 0 && (octets > limit || compressed > kMostCompressed)) {
      full = true;
      break;
    }
    earliest = std::min(earliest, item.deadline);
    quorum = std::min(quorum, item.quorum);
    ++count;
    full = count >= quorum || compressed == kMostCompressed || octets + kBareEntityState > limit;
    if (count >= quorum) break;
  }
  return {count, full, earliest};
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
