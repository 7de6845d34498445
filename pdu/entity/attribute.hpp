// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Attribute PDU (type 72, IEEE 1278.1-2012 7.2.6): tagged records for entities, here the force
// models, energy accounts and owners of bodies. It follows the Entity States that it extends, in
// the same datagram.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/record_range.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/pdu/reckon/energy_account_record.hpp"
#include "reckon/pdu/reckon/haptic_record.hpp"
#include "reckon/pdu/reckon/ownership_record.hpp"

namespace reckon::pdu {

/// The action code of recorded VR-Forces traffic, and ours; the table of SISO-REF-010 names only 0.
inline constexpr AttributeActionCode kAttributeActionUpdate{1};

/// `count` record sets of varying size, read with AttributeReader.
struct AttributeRecordSets {
  std::uint16_t count = 0;
  std::span<const std::byte> bytes;

  /// Checks sets and records with bounds; at most one step for each 6 octets.
  [[nodiscard]] static WalkResult walk(std::size_t count,
                                       std::span<const std::byte> octets) noexcept;
};

struct Attribute {
  static constexpr PduType kPduType = PduType::attribute;
  static constexpr ProtocolFamily kProtocolFamily = ProtocolFamily::entity_information_interaction;

  PduHeader header = header_of<Attribute>();
  SimulationAddress originating_simulation;
  std::uint32_t padding_1 = 0;
  std::uint16_t padding_2 = 0;
  PduType record_pdu_type = PduType::entity_state;  ///< type of the extended PDU
  std::uint8_t record_protocol_version = kProtocolVersion;
  std::uint32_t master_record_type = 0;  ///< 0: the records are of several types
  AttributeActionCode action_code = kAttributeActionUpdate;
  std::uint8_t padding_3 = 0;
  AttributeRecordSets record_sets;
};

constexpr void fields(auto& visitor, Is<Attribute> auto& pdu) {
  visitor("header", pdu.header);
  visitor("originating_simulation_address", pdu.originating_simulation);
  visitor("padding_1", pdu.padding_1);
  visitor("padding_2", pdu.padding_2);
  visitor("attribute_record_pdu_type", pdu.record_pdu_type);
  visitor("attribute_record_protocol_version", pdu.record_protocol_version);
  visitor("master_attribute_record_type", pdu.master_record_type);
  visitor("action_code", pdu.action_code);
  visitor("padding_3", pdu.padding_3);
  visitor("number_of_attribute_record_sets", pdu.record_sets.count);
  visitor.walked("attribute_record_sets", pdu.record_sets);
}

static_assert(kFixedSize<Attribute> == 32);

inline constexpr std::size_t kAttributeFixedSize = kFixedSize<Attribute>;  ///< octets
inline constexpr std::size_t kAttributeSetHeaderSize = 8;     ///< entity id, number of records
inline constexpr std::size_t kAttributeRecordHeaderSize = 6;  ///< type, length

/// One record in the datagram.
struct AttributeRecord {
  std::uint32_t type = 0;
  std::uint16_t length = 0;          ///< header, body and padding [octets]
  std::span<const std::byte> bytes;  ///< the whole record: `length` octets
  [[nodiscard]] std::span<const std::byte> body() const noexcept {
    return bytes.subspan(kAttributeRecordHeaderSize);
  }
};

/// Iterates over the records of one set.
class AttributeRecordCursor {
 public:
  AttributeRecordCursor() = default;
  AttributeRecordCursor(std::size_t count, std::span<const std::byte> rest) noexcept
      : count_(count), rest_(rest) {}
  /// False at the end and at the first record that does not fit (then error() has the reason).
  [[nodiscard]] bool next(AttributeRecord& out) noexcept;
  [[nodiscard]] DecodeError error() const noexcept { return error_; }
  [[nodiscard]] std::span<const std::byte> rest() const noexcept { return rest_; }

 private:
  std::size_t count_ = 0;
  std::span<const std::byte> rest_;
  DecodeError error_ = DecodeError::none;
};

/// The records of one entity.
struct AttributeSet {
  EntityId entity_id;
  std::uint16_t count = 0;
  std::span<const std::byte> bytes;  ///< the records, without the set's own 8 octets

  [[nodiscard]] auto records() const noexcept {
    return CursorRange<AttributeRecordCursor, AttributeRecord>(AttributeRecordCursor(count, bytes));
  }
};

/// Iterates over the record sets of an Attribute PDU.
class AttributeSetCursor {
 public:
  AttributeSetCursor(std::size_t count, std::span<const std::byte> rest) noexcept
      : count_(count), rest_(rest) {}
  [[nodiscard]] bool next(AttributeSet& out) noexcept;
  [[nodiscard]] DecodeError error() const noexcept { return error_; }
  [[nodiscard]] std::span<const std::byte> rest() const noexcept { return rest_; }

 private:
  std::size_t count_;
  std::span<const std::byte> rest_;
  DecodeError error_ = DecodeError::none;
};

/// `for (const AttributeSet& set : AttributeReader(attribute)) for (const AttributeRecord& record :
/// set.records()) ...`; the octets are not copied.
class AttributeReader : public CursorRange<AttributeSetCursor, AttributeSet> {
 public:
  explicit AttributeReader(const Attribute& pdu) noexcept
      : CursorRange(AttributeSetCursor(pdu.record_sets.count, pdu.record_sets.bytes)) {}
};

/// Reads a HapticRecord. Of a longer body (a later version's) the part of version 1 is read, but
/// only if the record states version 1. Errors: pdu_type (another record), length, version.
[[nodiscard]] DecodeError decode(const AttributeRecord& record, HapticRecord& out) noexcept;
/// Reads an EnergyAccountRecord. Errors: pdu_type (another record), length.
[[nodiscard]] DecodeError decode(const AttributeRecord& record, EnergyAccountRecord& out) noexcept;
/// Reads an OwnershipRecord. Errors: pdu_type (another record), length.
[[nodiscard]] DecodeError decode(const AttributeRecord& record, OwnershipRecord& out) noexcept;

/// Calls `f` with the record in its own type if its type, length and version are known here. Then
/// returns none, else unknown_type, or the reason why a record of a known type could not be read.
[[nodiscard]] DecodeError visit_attribute_record(const AttributeRecord& record, auto&& f) {
  DecodeError error = DecodeError::unknown_type;
  const auto attempt = [&]<typename Record>(Record typed) {
    if (record.type != Record::kType) return;
    error = decode(record, typed);
    if (error == DecodeError::none) f(static_cast<const Record&>(typed));
  };
  attempt(HapticRecord{});
  attempt(EnergyAccountRecord{});
  attempt(OwnershipRecord{});
  return error;
}

/// Builds an Attribute PDU in place. A call that returns false has changed nothing. One thread.
class AttributeWriter {
 public:
  /// @param pdu header and fixed fields; its record_sets are ignored
  /// @param buffer outlives the writer
  AttributeWriter(std::span<std::byte> buffer, const Attribute& pdu) noexcept;

  /// Opens the set of an entity; the records added next belong to it.
  [[nodiscard]] bool begin_set(EntityId entity) noexcept;
  [[nodiscard]] bool add(const HapticRecord& record) noexcept;
  [[nodiscard]] bool add(const EnergyAccountRecord& record) noexcept;
  [[nodiscard]] bool add(const OwnershipRecord& record) noexcept;
  /// Adds any record: type, length and padding to a multiple of 8 octets are set around `body`.
  [[nodiscard]] bool add(std::uint32_t type, std::span<const std::byte> body) noexcept;

  /// Whether no set was begun.
  [[nodiscard]] bool empty() const noexcept { return sets_ == 0; }
  /// Octets so far, as finish() would return them.
  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  /// Writes the header and the counts. Returns the octets of the PDU, 0 if it is empty or the fixed
  /// part does not fit. Further records and another finish() may follow.
  [[nodiscard]] std::size_t finish() noexcept;

 private:
  [[nodiscard]] std::byte* grow(std::size_t octets) noexcept;
  template <typename Record>
  [[nodiscard]] bool add_fixed(const Record& record) noexcept;
  void count_record() noexcept;

  std::span<std::byte> buffer_;
  Attribute pdu_;
  std::size_t size_ = kAttributeFixedSize;
  std::size_t set_at_ = 0;  // offset of the open set; 0 = none
  std::uint16_t sets_ = 0;
  std::uint16_t records_ = 0;  // in the open set
};

}  // namespace reckon::pdu
