// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/datagrams/fault.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <string_view>
#include <vector>

#include "reckon/pdu/codec/byte_order.hpp"
#include "reckon/pdu/pdu_types.hpp"
#include "reckon/pdu/type_names.hpp"

namespace reckon::tools {
namespace {

using pdu::DecodeError;

/// Greatest number of variable-size records that are counted to name the faulty one; an Attribute
/// PDU has fewer.
constexpr std::size_t kMostRecords = 65535;
constexpr std::size_t kLengthFieldAt = 8;

/// Visitor that reads a PDU field by field and stops at the first faulty one. Slower than the
/// codec; it only runs if the codec refused the PDU or a value is not finite.
class FaultFinder {
 public:
  /// Goal of the search: any fault, or only the place where the octets end.
  enum class Search : std::uint8_t { any, end };
  explicit FaultFinder(std::span<const std::byte> octets, Search search = Search::any)
      : octets_(octets), search_(search) {}

  template <typename T>
  void operator()(std::string_view name, T& value) {
    const std::size_t outer = path_.size();
    enter(name);
    if constexpr (pdu::Scalar<T>)
      scalar(value);
    else if constexpr (pdu::kIsStdArray<T>)
      (void)take(value.size());
    else
      fields(*this, value);
    path_.resize(outer);
  }
  template <typename Record, typename Count>
  void count(std::string_view name, std::span<const std::byte>& view, pdu::Records<Record, Count>) {
    if (!take(sizeof(Count))) return;
    const std::size_t offset = at_ - sizeof(Count);
    counts_.push_back({&view, name, offset, pdu::load_big_endian<Count>(octets_.data() + offset)});
  }
  template <typename Record, typename Count>
  void records(std::string_view, std::span<const std::byte>& view, pdu::Records<Record, Count>) {
    const auto counted = std::ranges::find(counts_, &view, &Counted::view);
    if (failed() || counted == counts_.end()) return;
    const std::uint64_t needed = std::uint64_t{counted->count} * pdu::kFixedSize<Record>;
    if (needed <= left()) {
      at_ += static_cast<std::size_t>(needed);
      return;
    }
    fail(DecodeError::count, counted->offset,
         fmt::format("{} {} need {} octets, {} remain", counted->name, counted->count, needed,
                     left()));
  }
  template <typename View>
  void walked(std::string_view name, View& view) {
    if (failed()) return;
    const std::span<const std::byte> rest = octets_.subspan(at_);
    const pdu::WalkResult whole = View::walk(view.count, rest);
    if (whole.error == DecodeError::none) {
      at_ += whole.size;
      return;
    }
    // The good records are those before the fault. Bisection finds their number, because a datagram
    // may have thousands of records and each walk starts at the first.
    std::size_t good = 0;
    std::size_t bad = std::min<std::size_t>(view.count, kMostRecords);
    while (good + 1 < bad) {
      const std::size_t middle = good + (bad - good) / 2;
      const bool walks = View::walk(middle, rest).error == DecodeError::none;
      (walks ? good : bad) = middle;
    }
    const std::size_t size = View::walk(good, rest).size;
    fail(whole.error, at_ + size,
         fmt::format("{}: number {} of {} does not fit into the {} octets that remain", name,
                     good + 1, view.count, rest.size() - size));
  }

  template <pdu::OctetView View>
  void walked(std::string_view name, View& view) {
    if (failed()) return;
    const pdu::WalkResult whole = View::walk(view.count, octets_.subspan(at_));
    at_ += whole.size;
    if (whole.error != DecodeError::none)
      fail(whole.error, at_,
           fmt::format("{} of {} {} is longer than the {} octets that remain", name, view.count,
                       View::kUnit, left()));
  }

  template <pdu::SizedView View>
  void walked(std::string_view name, View& view) {
    if (failed()) return;
    const std::span<const std::byte> all = octets_.subspan(at_);
    const pdu::WalkResult whole = View::walk(view.count, all);
    at_ += whole.size;
    if (whole.error == DecodeError::none) return;
    // A record has at least one octet. The record that does not fit ends the loop.
    pdu::SizedRecordCursor<typename View::Head> cursor(all.size(), all);
    std::size_t number = 1;
    for (pdu::SizedRecord<typename View::Head> record; cursor.next(record);) ++number;
    fail(whole.error, offset_of(cursor.rest()),
         fmt::format("{}: number {} does not fit into the {} octets that remain", name, number,
                     cursor.rest().size()));
  }

  void walked(std::string_view name, pdu::AttributeRecordSets& sets) {
    if (failed()) return;
    pdu::AttributeSetCursor cursor(sets.count, octets_.subspan(at_));
    std::size_t number = 1;
    for (pdu::AttributeSet set; cursor.next(set);) ++number;
    if (cursor.error() == DecodeError::none) return;
    const std::span<const std::byte> rest = cursor.rest();
    if (rest.size() < pdu::kAttributeSetHeaderSize)
      return fail(cursor.error(), offset_of(rest),
                  fmt::format("{}: number {} of {} needs 8 octets, {} remain", name, number,
                              sets.count, rest.size()));
    attribute_record(number, rest);
  }

  [[nodiscard]] bool failed() const { return fault_.error != DecodeError::none; }
  [[nodiscard]] const PduFault& fault() const { return fault_; }

 private:
  struct Counted {
    const void* view;
    std::string_view name;
    std::size_t offset;
    std::uint32_t count;
  };

  void enter(std::string_view name) {
    if (!path_.empty()) path_ += '.';
    path_ += name;
  }
  [[nodiscard]] std::size_t left() const { return octets_.size() - at_; }
  [[nodiscard]] std::size_t offset_of(std::span<const std::byte> part) const {
    return static_cast<std::size_t>(part.data() - octets_.data());
  }
  /// Finds the faulty record in attribute record set `number`, whose octets start with `set`.
  void attribute_record(std::size_t number, std::span<const std::byte> set) {
    const auto count = pdu::load_big_endian<std::uint16_t>(set.data() + 6);
    pdu::AttributeRecordCursor cursor(count, set.subspan(pdu::kAttributeSetHeaderSize));
    std::size_t record_number = 1;
    for (pdu::AttributeRecord record; cursor.next(record);) ++record_number;
    const std::span<const std::byte> rest = cursor.rest();
    std::string says = "needs 6 octets at least";
    if (rest.size() >= pdu::kAttributeRecordHeaderSize)
      says = fmt::format("says {} octets", pdu::load_big_endian<std::uint16_t>(rest.data() + 4));
    fail(cursor.error(), offset_of(rest),
         fmt::format("record {} of {} in attribute record set {} {}, {} remain", record_number,
                     count, number, says, rest.size()));
  }
  [[nodiscard]] bool take(std::size_t size) {
    if (failed()) return false;
    if (size > left()) {
      fail(DecodeError::truncated, octets_.size(), fmt::format("ends inside {}", path_));
      return false;
    }
    at_ += size;
    return true;
  }
  template <typename T>
  void scalar(T& value) {
    if (!take(sizeof(T))) return;
    value = pdu::load_big_endian<T>(octets_.data() + at_ - sizeof(T));
    if constexpr (std::floating_point<T>) {
      if (search_ == Search::any && !std::isfinite(value))
        fail(DecodeError::not_finite, at_ - sizeof(T),
             fmt::format("{} is {}", path_, std::isnan(value) ? "NaN" : "infinite"));
    }
  }
  void fail(DecodeError error, std::size_t offset, std::string reason) {
    if (!failed()) fault_ = {error, offset, std::move(reason)};
  }

  std::span<const std::byte> octets_;
  Search search_;
  std::size_t at_ = 0;
  std::string path_;
  std::vector<Counted> counts_;  // counts of the blocks after the fixed part
  PduFault fault_;
};

/// Runs the finder over the octets as the type in the header.
template <typename... T>
PduFault find_fault(std::span<const std::byte> octets, pdu::PduType type,
                    FaultFinder::Search search, pdu::TypeList<T...>) {
  FaultFinder finder(octets, search);
  const auto attempt = [&]<typename Candidate>(std::type_identity<Candidate>) {
    if (Candidate::kPduType != type) return false;
    Candidate pdu;
    fields(finder, pdu);
    return true;
  };
  (void)(attempt(std::type_identity<T>{}) || ...);
  return finder.fault();
}

PduFault find_fault(std::span<const std::byte> octets, pdu::PduType type,
                    FaultFinder::Search search = FaultFinder::Search::any) {
  return find_fault(octets, type, search, pdu::PduTypes{});
}

template <typename... T>
std::size_t least_length(pdu::PduType type, pdu::TypeList<T...>) {
  std::size_t size = pdu::kHeaderSize;
  (void)((T::kPduType == type && (size = pdu::kFixedSize<T>, true)) || ...);
  return size;
}

std::size_t exchanged(std::uint16_t length) {
  return static_cast<std::size_t>((length & 0xFF) << 8 | length >> 8);
}

/// "; 36864 is 144 with its octets exchanged".
std::string exchanged_text(std::uint16_t length) {
  return fmt::format("; {} is {} with its octets swapped", length, exchanged(length));
}

PduFault truncated(std::span<const std::byte> octets, const pdu::PduHeader& header) {
  if (octets.size() < pdu::kHeaderSize)
    return {DecodeError::truncated, 0,
            fmt::format("a header needs 12 octets, {} remain", octets.size())};
  const PduFault inside = find_fault(octets, header.pdu_type, FaultFinder::Search::end);
  std::string reason =
      fmt::format("length field: {} octets, {} remain", header.length, octets.size());
  if (has_exchanged_length(octets, header, DecodeError::truncated))
    return {DecodeError::truncated, kLengthFieldAt, reason + exchanged_text(header.length)};
  const bool named = inside.error == DecodeError::truncated;
  if (named) reason += "; " + inside.reason;
  return {DecodeError::truncated, named ? octets.size() : kLengthFieldAt, std::move(reason)};
}

/// "record_r needs at least 40".
std::string need_text(pdu::PduType type) {
  return fmt::format("{} needs at least {}", pdu::snake_name(type),
                     least_length(type, pdu::PduTypes{}));
}

PduFault length_fault(std::span<const std::byte> octets, const pdu::PduHeader& header) {
  std::string reason = fmt::format("length field: {} octets, ", header.length);
  if (header.length == 0) reason += fmt::format("{} available, ", octets.size());
  reason += need_text(header.pdu_type);
  if (has_exchanged_length(octets, header, DecodeError::length))
    reason += exchanged_text(header.length);
  return {DecodeError::length, kLengthFieldAt, std::move(reason)};
}

}  // namespace

PduFault explain_shortness(std::span<const std::byte> octets, const pdu::PduHeader& header) {
  return {DecodeError::length, kLengthFieldAt,
          fmt::format("{} octets available, {}", octets.size(), need_text(header.pdu_type))};
}

bool has_exchanged_length(std::span<const std::byte> octets, const pdu::PduHeader& header,
                          DecodeError error) {
  const bool leads_nowhere = error == DecodeError::truncated || error == DecodeError::length;
  const std::size_t length = exchanged(header.length);
  if (!leads_nowhere || octets.size() < pdu::kHeaderSize || length > octets.size() ||
      length < least_length(header.pdu_type, pdu::PduTypes{}))
    return false;
  // With the exchanged length, the end of the datagram follows, or a PDU of the same version and
  // exercise.
  const auto next = octets.subspan(length);
  return next.empty() ||
         (next.size() >= pdu::kHeaderSize && next[0] == octets[0] && next[1] == octets[1]);
}

PduFault explain_fault(std::span<const std::byte> octets, const pdu::PduHeader& header,
                       DecodeError error) {
  switch (error) {
    case DecodeError::truncated:
      return truncated(octets, header);
    case DecodeError::length:
      return length_fault(octets, header);
    case DecodeError::version:
      return {
          error, 0,
          fmt::format("protocol version {}, but {} to {} are supported", header.protocol_version,
                      pdu::kOldestProtocolVersion, pdu::kProtocolVersion)};
    case DecodeError::stray:
      return {error, 0, fmt::format("{} octets after the last PDU", octets.size())};
    case DecodeError::unknown_type:
      return {error, 2,
              fmt::format("{} octets kept unchanged: no field table for PDU type {}", header.length,
                          static_cast<unsigned>(header.pdu_type))};
    default:
      break;
  }
  PduFault fault = find_fault(octets.first(std::min<std::size_t>(octets.size(), header.length)),
                              header.pdu_type);
  if (fault.error != error) fault = {error, 0, std::string(pdu::sentence(error))};
  return fault;
}

PduFault explain_not_finite(std::span<const std::byte> octets, const pdu::PduHeader& header,
                            std::string_view field) {
  PduFault fault = find_fault(octets, header.pdu_type);
  if (fault.error == DecodeError::none)  // the fault is in a record after the fixed fields
    fault = {DecodeError::not_finite, 0, fmt::format("NaN or infinity in {}", field)};
  return fault;
}

PduFault examine_records(std::span<const std::byte> octets, const pdu::Attribute& attribute) {
  for (const pdu::AttributeSet& set : pdu::AttributeReader(attribute)) {
    for (const pdu::AttributeRecord& record : set.records()) {
      const DecodeError error = pdu::visit_attribute_record(record, [](const auto&) {});
      if (error == DecodeError::none || error == DecodeError::unknown_type) continue;
      return {error, static_cast<std::size_t>(record.bytes.data() - octets.data()),
              fmt::format("attribute record {:#x} of {} octets: {}", record.type, record.length,
                          pdu::sentence(error))};
    }
  }
  return {};
}

}  // namespace reckon::tools
