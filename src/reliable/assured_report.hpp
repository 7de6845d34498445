// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What became of an assured record at one addressee.
#pragma once

#include <cstdint>

#include "reckon/pdu/codec/enumerations.hpp"

namespace reckon::peer {

/// The end of a record for one addressee.
enum class AssuredOutcome : std::uint8_t {
  accepted,  ///< received and accepted
  refused,   ///< received, and refused by the receiver
  gave_up,   ///< not acknowledged for AcknowledgedSet::kGiveUp
  left,      ///< the peer left or fell silent
};

/// One addressee of one record.
struct AssuredReport {
  std::uint32_t sequence = 0;
  pdu::AssuredKind kind = pdu::AssuredKind::record;
  std::uint64_t tag = 0;   ///< as given to AcknowledgedSet::add
  std::uint32_t peer = 0;  ///< epoch of the addressee
  AssuredOutcome outcome = AssuredOutcome::accepted;
  bool is_last = false;  ///< no addressee is left: the record is done
};

/// Receives each report, during the call that causes it.
class AssuredReports {
 public:
  virtual ~AssuredReports() = default;
  /// Must not call the set that reports.
  virtual void settle(const AssuredReport& report) noexcept = 0;
};

}  // namespace reckon::peer
