// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/datagrams/pdu_row.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <concepts>

#include "reckon/pdu/finite.hpp"
#include "reckon/pdu/fixed_fields.hpp"
#include "reckon/pdu/pdu_types.hpp"
#include "reckon/pdu/type_names.hpp"
#include "reckon/pdu/zero_length.hpp"
#include "reckon/tools/datagrams/restored_states.hpp"
#include "reckon/tools/datagrams/trailing.hpp"

namespace reckon::tools {
namespace {

using pdu::DecodeError;

/// Visitor that stores the first entity ID among the fields of a PDU. Live entities have shorter
/// IDs.
class FirstId : public pdu::FixedFields {
 public:
  template <typename T>
  void operator()(std::string_view, const T& value) {
    if constexpr (std::same_as<T, pdu::EntityId>) {
      if (!id_.has_value()) id_ = value;
    } else if constexpr (std::same_as<T, pdu::LiveEntityId>) {
      if (id_.has_value()) return;
      id_ = pdu::EntityId{value.site, value.application, value.entity};
      is_live_ = true;
    }
  }

  [[nodiscard]] const std::optional<pdu::EntityId>& id() const { return id_; }
  /// Whether it is an EntityId of 6 octets.
  [[nodiscard]] bool is_of_6_octets() const { return id_.has_value() && !is_live_; }

 private:
  std::optional<pdu::EntityId> id_;
  bool is_live_ = false;
};

/// The subject or issuing entity of a PDU; for an Attribute PDU, the entity of its only record set.
template <typename Pdu>
std::optional<pdu::EntityId> id_of(const Pdu& pdu) {
  if constexpr (std::same_as<Pdu, pdu::Attribute>) {
    if (pdu.record_sets.count != 1) return std::nullopt;
    return (*pdu::AttributeReader(pdu).begin()).entity_id;
  } else {
    FirstId first;
    fields(first, pdu);
    return first.id();
  }
}

/// Whether the first ID of this type's PDUs is an EntityId.
template <typename Pdu>
bool has_id_of_6_octets() {
  if constexpr (std::same_as<Pdu, pdu::Attribute>) return false;
  const Pdu pdu{};
  FirstId first;
  fields(first, pdu);
  return first.is_of_6_octets();
}

/// The entity after the header of a broken PDU, if its type has an EntityId there.
template <typename... T>
std::optional<pdu::EntityId> id_behind_header(std::span<const std::byte> octets, pdu::PduType type,
                                              pdu::TypeList<T...>) {
  pdu::EntityId id;
  const bool has_one = ((T::kPduType == type && has_id_of_6_octets<T>()) || ...);
  if (!has_one || octets.size() < pdu::kHeaderSize ||
      !pdu::load_record(octets.subspan(pdu::kHeaderSize), id))
    return std::nullopt;
  return id;
}

std::string_view portion_text(peer::Portion portion) {
  switch (portion) {
    case peer::Portion::whole:
      return "";
    case peer::Portion::first_fragment:
      return "; IP fragments after these octets are missing";
    case peer::Portion::later_fragment:
    case peer::Portion::overlapping_fragment:
      return "";
    case peer::Portion::cut:
      return "; the capture kept only a part of the frame";
  }
  return "";
}

constexpr std::size_t kLengthAt = 8;  // in the header

/// Whether these octets after the last PDU form no PDU.
bool is_trailing(const pdu::BundledPdu& bundled) {
  const bool is_cut_header =
      bundled.error == DecodeError::truncated && bundled.bytes.size() < pdu::kHeaderSize;
  return bundled.index > 0 && (bundled.error == DecodeError::stray || is_cut_header);
}

void set_fault(PduRow& row, std::string_view rule, const PduFault& fault) {
  row.rule = rule;
  row.status = status_of(rule);
  row.reason = fault.reason;
  row.fault_offset = row.offset + fault.offset;
}

}  // namespace

std::string_view name(PduStatus status) noexcept {
  constexpr std::array<std::string_view, 4> kNames{"ok", "note", "warning", "error"};
  return kNames[static_cast<std::size_t>(status)];
}

PduStatus status_of(std::string_view rule) noexcept {
  if (rule.empty()) return PduStatus::ok;
  if (rule.front() == 'I') return PduStatus::note;
  return rule.front() == 'W' ? PduStatus::warning : PduStatus::error;
}

std::string_view PduRow::type() const noexcept {
  if (rule == kForeignRule) return "foreign";
  if (rule == kTrailingRule && !has_header) return "trailing";
  return has_header ? pdu::snake_name(header.pdu_type) : "unreadable";
}

void DatagramInspector::begin(const peer::SourceDatagram& datagram) {
  ++tally_.datagrams;
  if (datagram.portion == peer::Portion::first_fragment || peer::is_headless(datagram.portion))
    ++tally_.fragments;
  row_.frame = datagram.frame;
  row_.time = datagram.time;
  if (!start_.has_value()) start_ = datagram.time;
  row_.start = *start_;
  row_.interface = datagram.interface;
  bytes_ = datagram.bytes;
  without_length_.reset();
  if (!lenient_ || peer::is_headless(datagram.portion)) return;
  without_length_ = pdu::find_zero_length(bytes_);
  if (!without_length_.has_value()) return;
  mended_.assign(bytes_.begin(), bytes_.end());
  pdu::set_length(mended_, *without_length_,
                  static_cast<std::uint16_t>(mended_.size() - *without_length_));
  bytes_ = mended_;
}

void DatagramInspector::fill(const peer::SourceDatagram& datagram, const pdu::BundledPdu& bundled) {
  row_.pdu = bundled.index + 1;
  row_.offset = bundled.offset;
  row_.bytes = bundled.bytes;
  row_.has_header = bundled.bytes.size() >= pdu::kHeaderSize && bundled.error != DecodeError::stray;
  row_.header = row_.has_header ? bundled.header : pdu::PduHeader{};
  row_.decoded = false;
  row_.status = PduStatus::ok;
  row_.rule = {};
  row_.reason.clear();
  row_.fault_offset = bundled.offset;
  row_.id.reset();
  row_.entity_state = nullptr;
  row_.restored = nullptr;

  PduFault fault;
  DecodeError error = bundled.error;
  std::size_t behind = 0;
  if (error == DecodeError::none) error = decode_body(bundled, fault, behind);
  row_.decoded = error == DecodeError::none;
  if (error == DecodeError::length && without_length_ == bundled.offset)
    fault = explain_shortness(bundled.bytes, bundled.header);
  else if (!row_.decoded)
    fault = explain_fault(bundled.bytes, bundled.header, error);
  if (lenient_ && (fault.error == DecodeError::none || is_trailing(bundled)))
    return excuse(bundled, behind);
  if (fault.error == DecodeError::none && behind > 0)
    return set_fault(row_, kTrailingWarning,
                     {DecodeError::stray, bundled.bytes.size() - behind,
                      explain_trailing(bundled.bytes, bundled.header, behind)});
  if (fault.error == DecodeError::none) return;
  if (!row_.decoded && row_.has_header && fault.error != DecodeError::version)
    row_.id = id_behind_header(row_.bytes, row_.header.pdu_type, pdu::PduTypes{});
  const bool exchanged =
      !row_.decoded && has_exchanged_length(bundled.bytes, bundled.header, error);
  set_fault(row_, exchanged ? kByteOrderRule : pdu::rule(fault.error), fault);
  if (fault.error == DecodeError::truncated && !exchanged)
    row_.reason += portion_text(datagram.portion);
}

void DatagramInspector::excuse(const pdu::BundledPdu& bundled, std::size_t behind) {
  const std::size_t size = bundled.bytes.size();
  if (!row_.decoded && row_.rule.empty() && is_trailing(bundled))
    return set_fault(row_, kTrailingRule,
                     {DecodeError::stray, 0,
                      fmt::format("{} octets after the last PDU are kept: {}", size,
                                  start_in_hex(bundled.bytes))});
  std::string kept;
  if (behind > 0)
    kept = fmt::format("{} octets after the last field are kept: {}", behind,
                       start_in_hex(bundled.bytes.last(behind)));
  if (without_length_ == bundled.offset) {
    kept =
        fmt::format("the length field is 0: the {} octets to the end of the datagram are used{}{}",
                    size, kept.empty() ? "" : "; ", kept);
    return set_fault(row_, kNoLengthRule, {DecodeError::length, kLengthAt, kept});
  }
  if (behind > 0) set_fault(row_, kTrailingRule, {DecodeError::stray, size - behind, kept});
}

DecodeError DatagramInspector::decode_body(const pdu::BundledPdu& bundled, PduFault& fault,
                                           std::size_t& behind) {
  return pdu::visit(bundled.bytes, bundled.header, [&]<typename Pdu>(const Pdu& pdu) {
    row_.id = id_of(pdu);
    behind = pdu::trailing_octets(bundled.bytes, pdu).size();
    const std::string_view field = pdu::first_not_finite(pdu);
    if (!field.empty()) fault = explain_not_finite(bundled.bytes, bundled.header, field);
    if constexpr (std::same_as<Pdu, pdu::Attribute>) {
      if (field.empty()) fault = examine_records(bundled.bytes, pdu);
    }
    if constexpr (std::same_as<Pdu, pdu::EntityState>) {
      entity_state_ = pdu;
      row_.entity_state = &entity_state_;
      if (restored_ != nullptr) restored_->note_plain(pdu);
    }
    if constexpr (std::same_as<Pdu, pdu::CompressedStates>) {
      if (restored_ == nullptr) restored_ = std::make_shared<RestoredStates>();
      row_.restored = &restored_->restore(pdu, row_);
    }
  });
}

void DatagramInspector::fill_whole(const peer::SourceDatagram& datagram) {
  row_.pdu = 1;
  row_.offset = 0;
  row_.header = {};
  row_.bytes = datagram.bytes;
  row_.has_header = false;
  row_.decoded = false;
  row_.id.reset();
  row_.entity_state = nullptr;
  row_.restored = nullptr;
}

void DatagramInspector::fill_foreign(const peer::SourceDatagram& datagram) {
  ++tally_.foreign;
  fill_whole(datagram);
  set_fault(row_, kForeignRule, {DecodeError::none, 0, foreign_reason(datagram)});
}

void DatagramInspector::fill_fragment(const peer::SourceDatagram& datagram) {
  fill_whole(datagram);
  set_fault(
      row_, "E-FRAGMENT",
      {DecodeError::truncated, 0,
       fmt::format("{} octets of {}", datagram.bytes.size(),
                   datagram.portion == peer::Portion::later_fragment
                       ? "IP fragments without the first one"
                       : "an IP fragment that overlaps earlier ones; its datagram is refused")});
}

}  // namespace reckon::tools
