// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Differences of two captures, gathered from their aligned PDUs: counts, fields, order, times.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "reckon/pdu/entity/entity_state.hpp"
#include "reckon/peer/counters/error_histogram.hpp"
#include "reckon/tools/inspect/diff/pdu_alignment.hpp"
#include "reckon/tools/inspect/diff/pdu_difference.hpp"

namespace reckon::tools {

/// Share of a type or an entity in one capture.
struct CaptureShare {
  std::uint64_t pdus = 0;
  std::uint64_t octets = 0;
};

/// Properties of an entity in its PDUs.
struct EntityTraits {
  CaptureShare share;
  std::string marking;           ///< the last one sent
  std::uint8_t force = 0;        ///< the last one sent
  std::uint32_t algorithms = 0;  ///< bit n: DRM n was sent; bit 31: one above 30
  bool has_state = false;
};

/// One capture as a whole.
struct CaptureSurvey {
  CaptureShare all;
  std::uint64_t datagrams = 0;
  std::chrono::nanoseconds first{};
  std::chrono::nanoseconds last{};
  std::map<std::string_view, CaptureShare> types;
  std::map<std::array<std::uint16_t, 3>, EntityTraits> entities;

  /// Greatest number of stored entities; further ones count only in the sums.
  static constexpr std::size_t kMostEntities = 65536;

  void add(const HeldPdu& pdu);
  /// Time from the first to the last PDU [s].
  [[nodiscard]] double seconds() const;
};

/// Place of a PDU in its capture.
struct PduPlace {
  std::uint64_t order = 0;  ///< number of the step that found it, from 0
  std::uint64_t frame = 0;
  std::size_t pdu = 0;
  std::size_t offset = 0;
  std::chrono::nanoseconds time{};
  std::string_view type;
  std::optional<pdu::EntityId> id;
};

/// A PDU in both captures with other octets or at another place.
struct PduPair {
  PduPlace a;
  PduPlace b;
  std::vector<FieldDifference> fields;  ///< empty if it only moved
};

/// A field and its number of differences.
struct ChangedField {
  std::uint64_t pdus = 0;
  PduPlace a;  ///< the first PDU with a difference
  PduPlace b;
  FieldDifference first;
};

/// Linear map from times of B to times of A, for a B that was played at another rate.
struct PairedTimes {
  std::chrono::nanoseconds a{};  ///< time of the first PDU in both
  std::chrono::nanoseconds b{};
  double rate = 1;  ///< of B; 2: twice as fast as A

  /// The time in A for an arrival in B.
  [[nodiscard]] std::chrono::nanoseconds in_a(std::chrono::nanoseconds time_b) const;
};

class CaptureDifference {
 public:
  /// Limit of PDUs of each capture that are pending until their counterpart is found. Moves of
  /// further ones are not detected.
  static constexpr std::size_t kMostPending = 65536;
  /// Greatest number of fields with a row.
  static constexpr std::size_t kMostFields = 1024;

  /// @param shift subtracted from B's times; no value: the shift of the first PDU in both
  /// @param times corrects for another rate
  explicit CaptureDifference(std::optional<std::chrono::nanoseconds> shift,
                             std::optional<PairedTimes> times = std::nullopt)
      : shift_(shift), paired_(times) {}

  void add(const AlignedPdus& step);

  [[nodiscard]] const CaptureSurvey& a() const { return a_; }
  [[nodiscard]] const CaptureSurvey& b() const { return b_; }
  [[nodiscard]] std::uint64_t same() const { return same_; }
  [[nodiscard]] std::uint64_t changed() const { return changed_; }
  [[nodiscard]] std::uint64_t moved() const { return moved_; }
  [[nodiscard]] std::uint64_t count_only_a() const { return only_a_.size() + beyond_a_; }
  [[nodiscard]] std::uint64_t count_only_b() const { return only_b_.size() + beyond_b_; }
  /// PDUs of one capture only, in order, at most kMostPending.
  [[nodiscard]] std::vector<PduPlace> only_a() const { return in_order(only_a_); }
  [[nodiscard]] std::vector<PduPlace> only_b() const { return in_order(only_b_); }
  [[nodiscard]] const std::optional<PduPair>& first_changed() const { return first_changed_; }
  [[nodiscard]] const std::optional<PduPair>& first_moved() const { return first_moved_; }
  [[nodiscard]] const std::map<std::string, ChangedField>& fields() const { return fields_; }

  /// Shift of B's times against A's; no value if no PDU is in both.
  [[nodiscard]] const std::optional<std::chrono::nanoseconds>& shift() const { return shift_; }
  /// The map of times if B has at least half of the PDUs and its duration differs by more than 1 %
  /// and 50 ms; no value: it was played at the rate of A.
  [[nodiscard]] std::optional<PairedTimes> other_rate() const;
  /// The rate for which times are corrected; 1: none.
  [[nodiscard]] double rate() const { return paired_.has_value() ? paired_->rate : 1; }
  /// Differences between the arrivals of the same PDU, corrected by shift and rate [s].
  [[nodiscard]] const peer::ErrorHistogram& times() const { return times_; }
  [[nodiscard]] double greatest_time() const { return greatest_time_; }
  /// Whether all PDUs are the same and in the same order.
  [[nodiscard]] bool is_same() const {
    return changed_ + moved_ + count_only_a() + count_only_b() == 0;
  }

 private:
  using Pending = std::unordered_multimap<std::uint64_t, PduPlace>;

  void compare_times(const HeldPdu& a, const HeldPdu& b);
  void take_changed(const HeldPdu& a, const HeldPdu& b);
  void take_alone(const HeldPdu& pdu, bool is_a);
  [[nodiscard]] PduPlace place_of(const HeldPdu& pdu) const;
  [[nodiscard]] static std::vector<PduPlace> in_order(const Pending& pending);

  CaptureSurvey a_;
  CaptureSurvey b_;
  std::optional<std::chrono::nanoseconds> shift_;
  std::optional<PairedTimes> paired_;
  std::optional<PairedTimes> first_pair_;
  std::optional<PairedTimes> last_pair_;
  std::uint64_t order_ = 0;
  std::uint64_t same_ = 0;
  std::uint64_t changed_ = 0;
  std::uint64_t moved_ = 0;
  Pending only_a_;  // by hash
  Pending only_b_;
  std::uint64_t beyond_a_ = 0;
  std::uint64_t beyond_b_ = 0;
  std::optional<PduPair> first_changed_;
  std::optional<PduPair> first_moved_;
  std::map<std::string, ChangedField> fields_;
  peer::ErrorHistogram times_;
  double greatest_time_ = 0;
};

}  // namespace reckon::tools
