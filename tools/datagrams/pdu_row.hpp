// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Input of the inspector's views: one row for each PDU of each datagram, good or bad, without
// omissions.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/pdu/bundle.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/pdu/entity/entity_state.hpp"
#include "reckon/peer/capture/datagram_source.hpp"
#include "reckon/tools/datagrams/fault.hpp"
#include "reckon/tools/datagrams/foreign.hpp"

namespace reckon::tools {

/// Quality of a PDU, as in the first letter of its rule.
enum class PduStatus : std::uint8_t { ok, note, warning, error };
[[nodiscard]] std::string_view name(PduStatus status) noexcept;
/// Status from the rule's letter: E-, W-, I-; ok without a rule.
[[nodiscard]] PduStatus status_of(std::string_view rule) noexcept;

struct RestoredState;
class RestoredStates;

/// One PDU in a datagram.
struct PduRow {
  std::uint64_t frame = 0;           ///< of the datagram in its source, from 1
  std::chrono::nanoseconds time{};   ///< since 1970-01-01 UTC
  std::chrono::nanoseconds start{};  ///< time of the source's first datagram
  std::size_t pdu = 0;               ///< place in the datagram, from 1
  std::size_t offset = 0;            ///< of its first octet in the datagram
  pdu::PduHeader header;             ///< as far as it was readable
  std::span<const std::byte> bytes;
  bool has_header = false;  ///< 12 octets were present
  bool decoded = false;     ///< the body can be read with pdu::visit
  PduStatus status = PduStatus::ok;
  std::string_view rule;         ///< empty when ok
  std::string reason;            ///< empty when ok
  std::size_t fault_offset = 0;  ///< octet of the datagram to which the reason refers
  std::optional<pdu::EntityId> id;
  std::string_view interface;  ///< over which the datagram came; empty if the source has none
  /// The body of a decoded Entity State, cached because most PDUs are one and every view reads it;
  /// null for other PDUs. Valid as long as the row.
  const pdu::EntityState* entity_state = nullptr;
  /// The states of decoded Compressed States; null for other PDUs. Valid as long as the row.
  const std::vector<RestoredState>* restored = nullptr;

  /// IEEE name in snake case; "unknown_200" without a name; "foreign" for a datagram of another
  /// protocol; "trailing" for octets that a lenient reader accepts; "unreadable" without a header.
  [[nodiscard]] std::string_view type() const noexcept;
};

/// Counts of one run.
struct InspectTally {
  std::uint64_t datagrams = 0;
  std::uint64_t fragments = 0;
  std::uint64_t foreign = 0;            ///< datagrams of other protocols; each is a note in `pdus`
  std::array<std::uint64_t, 4> pdus{};  ///< by PduStatus

  [[nodiscard]] std::uint64_t all_pdus() const { return pdus[0] + pdus[1] + pdus[2] + pdus[3]; }
  [[nodiscard]] std::uint64_t of(PduStatus status) const {
    return pdus[static_cast<std::size_t>(status)];
  }
};

/// Rules that only a lenient reader notes.
inline constexpr std::string_view kNoLengthRule = "I-NO-LENGTH";
inline constexpr std::string_view kTrailingRule = "I-TRAILING";
/// Octets after the last field of a PDU, if the reader is not lenient.
inline constexpr std::string_view kTrailingWarning = "W-TRAILING";
/// A length field in little-endian order.
inline constexpr std::string_view kByteOrderRule = "E-BYTE-ORDER";

/// Iterates over the PDUs of one datagram and decodes each once. The row is reused, and valid until
/// the next PDU. A good PDU needs no heap, except for the keys of compressed states.
class DatagramInspector {
 public:
  /// @param lenient takes a length field of 0 as the rest of the datagram, and accepts octets after
  /// the last PDU or after its last field: each is a note instead of an error or a warning
  explicit DatagramInspector(bool lenient = false) : lenient_(lenient) {}

  /// Calls `show(const PduRow&)` for each PDU until it returns false; counts all shown PDUs.
  bool inspect(const peer::SourceDatagram& datagram, auto&& show) {
    begin(datagram);
    if (peer::is_headless(datagram.portion)) {
      fill_fragment(datagram);
      return count_and(show);
    }
    for (const pdu::BundledPdu& bundled : pdu::BundleReader(bytes_)) {
      if (bundled.index == 0 && is_foreign(datagram, bundled)) {
        fill_foreign(datagram);
        return count_and(show);
      }
      fill(datagram, bundled);
      if (!count_and(show)) return false;
    }
    return true;
  }
  [[nodiscard]] const InspectTally& tally() const { return tally_; }
  /// Sets the time of the source's first datagram, if the inspector does not get that one.
  void start_at(std::chrono::nanoseconds start) { start_ = start; }

 private:
  void begin(const peer::SourceDatagram& datagram);
  void fill(const peer::SourceDatagram& datagram, const pdu::BundledPdu& bundled);
  /// Decodes, and searches for values that receivers reject; `fault` gets their place.
  /// @param behind set to the octets after the last field
  [[nodiscard]] pdu::DecodeError decode_body(const pdu::BundledPdu& bundled, PduFault& fault,
                                             std::size_t& behind);
  /// Replaces a fault of the present PDU by a note, as a lenient reader does. @param behind octets
  /// after its last field
  void excuse(const pdu::BundledPdu& bundled, std::size_t behind);
  void fill_fragment(const peer::SourceDatagram& datagram);
  void fill_foreign(const peer::SourceDatagram& datagram);
  /// The whole datagram as one row without a header.
  void fill_whole(const peer::SourceDatagram& datagram);
  bool count_and(auto&& show) {
    ++tally_.pdus[static_cast<std::size_t>(row_.status)];
    return show(static_cast<const PduRow&>(row_));
  }

  bool lenient_;
  std::span<const std::byte> bytes_;           // of the datagram, or mended_
  std::vector<std::byte> mended_;              // the datagram with a length in place of 0
  std::optional<std::size_t> without_length_;  // offset of the PDU with a length of 0
  PduRow row_;
  pdu::EntityState entity_state_;             // referenced by row_
  std::shared_ptr<RestoredStates> restored_;  // from the first Compressed States on, referenced by
                                              // row_
  InspectTally tally_;
  std::optional<std::chrono::nanoseconds> start_;
};

}  // namespace reckon::tools
