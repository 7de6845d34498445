// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The view `check`: every finding of every rule, then the number of violations of each rule.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>

#include "reckon/tools/datagrams/pdu_row.hpp"
#include "reckon/tools/inspect/check/copy_search.hpp"
#include "reckon/tools/inspect/check/jump_search.hpp"
#include "reckon/tools/inspect/check/rules.hpp"
#include "reckon/tools/inspect/output/format.hpp"
#include "reckon/tools/inspect/output/view.hpp"

namespace reckon::tools {

/// Prints THE rules: a table, JSON Lines or CSV.
void append_check_rules(Format format, std::string& out);

/// Runs the rules over datagrams; one thread. Keeps at most `most_entities` entities, some 1.4 kB
/// each. PDUs of further entities are checked individually, which is reported.
class CheckView final : public View {
 public:
  static constexpr std::size_t kMostEntities = std::size_t{1} << 16;

  explicit CheckView(Format format, bool colour = false, std::size_t most_entities = kMostEntities)
      : format_(format), colour_(colour), most_entities_(most_entities), jumps_(most_entities) {}

  /// Titles, if the format has them.
  void begin(std::string& out) override;
  /// Called before the PDUs of a datagram: finds related PDUs.
  void expect(const peer::SourceDatagram& datagram) override;
  void pdu(const peer::SourceDatagram& datagram, const PduRow& row, std::chrono::nanoseconds start,
           std::string& out) override;
  void datagram(const peer::SourceDatagram& datagram, std::chrono::nanoseconds start,
                std::string& out) override;
  /// At the end of the source: writes findings that need the end, and the counts.
  void finish(const InspectTally& tally, std::string& out) override;

  /// Findings of this status.
  [[nodiscard]] std::uint64_t count(PduStatus status) const;
  [[nodiscard]] std::optional<bool> found_faults() const override {
    return count(PduStatus::error) > 0 || count(PduStatus::warning) > 0;
  }

 private:
  struct Finding {
    const CheckRule& rule;
    std::uint64_t frame;
    std::size_t pdu;
    std::size_t offset;  // of the PDU
    std::size_t at;      // of the faulty field, in the datagram
    std::chrono::nanoseconds time;
    std::optional<pdu::EntityId> id;
    std::string_view reason;
    std::optional<double> metres = {};   // of the orientation jump
    std::optional<double> degrees = {};  // of the orientation jump
  };

  [[nodiscard]] EntityMemory* memory_of(const PduRow& row, const pdu::EntityState& pdu);
  /// True for an unknown type after its first PDU, and for foreign datagrams after the first, so
  /// that each is reported once.
  [[nodiscard]] bool is_reported_type(const PduRow& row);
  void check_pdu(const CheckedPdu& checked, std::string& out);
  void check_stamp(EntityMemory& memory, const PduRow& row, std::string& out);
  void look_at_attribute(const PduRow& row);
  void tell_jump(const Jump& jump, std::string& out);
  void tell(const Finding& finding, std::string& out);
  void text(const Finding& finding, std::string& out) const;
  void json(const Finding& finding, std::string& out) const;
  void csv(const Finding& finding, std::string& out) const;
  /// Reports a finding about the last Entity State of an entity.
  void tell_last(const EntityMemory& memory, std::string_view code, std::size_t field,
                 std::string_view reason, std::string& out);
  void report_entities(std::string& out);
  void report_copies(std::string& out);
  void summary(const InspectTally& tally, std::string& out) const;

  Format format_;
  bool colour_;
  std::size_t most_entities_;
  DatagramSurvey survey_;
  std::uint8_t highest_rank_ = 0;
  std::optional<std::chrono::nanoseconds> first_time_;
  std::chrono::nanoseconds last_time_{};
  std::unordered_map<std::uint64_t, EntityMemory> entities_;
  JumpSearch jumps_;
  CopySearch copies_;
  bool reported_limit_ = false;
  bool reported_foreign_ = false;
  std::array<bool, 256> reported_types_{};
  std::map<std::string_view, std::uint64_t> counts_;  // by code
};

}  // namespace reckon::tools
