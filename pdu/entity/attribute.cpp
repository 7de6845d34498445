// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/pdu/entity/attribute.hpp"

#include <algorithm>
#include <limits>

namespace reckon::pdu {
namespace {

constexpr std::size_t kMaxCount = std::numeric_limits<std::uint16_t>::max();

template <typename Record>
DecodeError decode_fixed(const AttributeRecord& record, Record& out) noexcept {
  if (record.type != Record::kType) return DecodeError::pdu_type;
  return load_record(record.bytes, out) ? DecodeError::none : DecodeError::length;
}

}  // namespace

bool AttributeRecordCursor::next(AttributeRecord& out) noexcept {
  if (count_ == 0) return false;
  if (rest_.size() < kAttributeRecordHeaderSize) {
    error_ = DecodeError::count;
    return false;
  }
  out.type = load_big_endian<std::uint32_t>(rest_.data());
  out.length = load_big_endian<std::uint16_t>(rest_.data() + 4);
  if (out.length < kAttributeRecordHeaderSize || out.length > rest_.size()) {
    error_ = DecodeError::record;
    return false;
  }
  out.bytes = rest_.first(out.length);
  rest_ = rest_.subspan(out.length);
  --count_;
  return true;
}

bool AttributeSetCursor::next(AttributeSet& out) noexcept {
  if (count_ == 0) return false;
  if (rest_.size() < kAttributeSetHeaderSize) {
    error_ = DecodeError::count;
    return false;
  }
  static_cast<void>(load_record(rest_, out.entity_id));
  out.count = load_big_endian<std::uint16_t>(rest_.data() + kFixedSize<EntityId>);

  const std::span<const std::byte> behind = rest_.subspan(kAttributeSetHeaderSize);
  AttributeRecordCursor records(out.count, behind);
  AttributeRecord record;
  while (records.next(record)) {
  }
  error_ = records.error();
  if (error_ != DecodeError::none) return false;

  out.bytes = behind.first(behind.size() - records.rest().size());
  rest_ = records.rest();
  --count_;
  return true;
}

WalkResult AttributeRecordSets::walk(std::size_t count,
                                     std::span<const std::byte> octets) noexcept {
  AttributeSetCursor cursor(count, octets);
  AttributeSet set;
  while (cursor.next(set)) {
  }
  return {octets.size() - cursor.rest().size(), cursor.error()};
}

DecodeError decode(const AttributeRecord& record, HapticRecord& out) noexcept {
  const DecodeError error = decode_fixed(record, out);
  if (error != DecodeError::none) return error;
  return out.version == HapticRecord::kVersion ? DecodeError::none : DecodeError::version;
}

DecodeError decode(const AttributeRecord& record, EnergyAccountRecord& out) noexcept {
  return decode_fixed(record, out);
}

DecodeError decode(const AttributeRecord& record, OwnershipRecord& out) noexcept {
  return decode_fixed(record, out);
}

AttributeWriter::AttributeWriter(std::span<std::byte> buffer, const Attribute& pdu) noexcept
    : buffer_(buffer.first(std::min(buffer.size(), kMaxPduSize))), pdu_(pdu) {}

// Room for further `octets`, or nullptr.
std::byte* AttributeWriter::grow(std::size_t octets) noexcept {
  if (size_ + octets > buffer_.size()) return nullptr;
  std::byte* at = buffer_.data() + size_;
  size_ += octets;
  return at;
}

bool AttributeWriter::begin_set(EntityId entity) noexcept {
  if (sets_ == kMaxCount) return false;
  std::byte* at = grow(kAttributeSetHeaderSize);
  if (at == nullptr) return false;
  set_at_ = size_ - kAttributeSetHeaderSize;
  ++sets_;
  records_ = 0;
  static_cast<void>(store_record(entity, {at, kFixedSize<EntityId>}));
  store_big_endian(at + kFixedSize<EntityId>, records_);
  return true;
}

void AttributeWriter::count_record() noexcept {
  ++records_;
  store_big_endian(buffer_.data() + set_at_ + kFixedSize<EntityId>, records_);
}

template <typename Record>
bool AttributeWriter::add_fixed(const Record& record) noexcept {
  if (sets_ == 0 || records_ == kMaxCount) return false;
  std::byte* at = grow(kFixedSize<Record>);
  if (at == nullptr) return false;
  static_cast<void>(store_record(record, {at, kFixedSize<Record>}));
  store_big_endian(at, Record::kType);
  store_big_endian(at + sizeof(Record::kType), Record::kLength);
  count_record();
  return true;
}

bool AttributeWriter::add(const HapticRecord& record) noexcept { return add_fixed(record); }

bool AttributeWriter::add(const EnergyAccountRecord& record) noexcept { return add_fixed(record); }

bool AttributeWriter::add(const OwnershipRecord& record) noexcept { return add_fixed(record); }

bool AttributeWriter::add(std::uint32_t type, std::span<const std::byte> body) noexcept {
  const std::size_t used = kAttributeRecordHeaderSize + body.size();
  const std::size_t length = (used + 7) / 8 * 8;
  if (sets_ == 0 || records_ == kMaxCount || length > kMaxPduSize) return false;
  std::byte* at = grow(length);
  if (at == nullptr) return false;
  store_big_endian(at, type);
  store_big_endian(at + sizeof type, static_cast<std::uint16_t>(length));
  std::byte* padding = std::copy(body.begin(), body.end(), at + kAttributeRecordHeaderSize);
  std::fill_n(padding, length - used, std::byte{0});
  count_record();
  return true;
}

std::size_t AttributeWriter::finish() noexcept {
  if (empty() || buffer_.size() < kAttributeFixedSize) return 0;
  // The records are already in place, so that only the fixed part is encoded and the length set.
  pdu_.record_sets = {sets_, {}};
  if (encode(pdu_, buffer_.first(kAttributeFixedSize)) == 0) return 0;
  store_big_endian(buffer_.data() + 8, static_cast<std::uint16_t>(size_));
  return size_;
}

}  // namespace reckon::pdu
