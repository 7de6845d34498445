// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Distances between the entities of two captures, and differences of their contact forces; both are
// dead reckoned to common times.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <map>
#include <span>

#include "reckon/peer/counters/error_histogram.hpp"
#include "reckon/tools/datagrams/pdu_stream.hpp"
#include "reckon/tools/inspect/diff/capture_difference.hpp"
#include "reckon/tools/inspect/diff/pdu_alignment.hpp"
#include "reckon/tools/listener/contact_forces.hpp"
#include "reckon/tools/listener/listener.hpp"

namespace reckon::tools {

/// A distribution with its exact maximum and the time of the maximum.
struct TimedSpread {
  peer::ErrorHistogram histogram;
  double max = 0;
  std::chrono::nanoseconds max_at{};  ///< since the first PDU of A

  void add(double value, std::chrono::nanoseconds at) {
    histogram.add(value);
    if (!(value > max)) return;
    max = value;
    max_at = at;
  }
};

struct PoseDifference {
  TimedSpread metres;
  TimedSpread degrees;
};

/// Two models of one capture: poses of all entities, and forces of the haptic ones.
class ReckonedCapture {
 public:
  /// Takes one PDU in order of arrival. Intervals between updates of an entity follow the
  /// timestamps if they advance, else the arrivals.
  void take_pdu(const HeldPdu& pdu);
  void forget_silent(std::chrono::nanoseconds now) { poses_.forget_silent(now); }
  [[nodiscard]] const Listener& poses() const { return poses_; }
  /// The forces at `time`; removes the haptic entities that have timed out.
  [[nodiscard]] std::span<const ContactForce> forces_at(std::chrono::nanoseconds time);

 private:
  Listener poses_{kCaptureRules};
  Listener haptic_{kPeerRules};  // its frame is near the capture's entities
  ContactForces forces_;
};

/// The comparison. One thread; run() or run_paired() once.
class MotionDifference {
 public:
  /// Greatest number of entities and pairs with a row; the first ones are used.
  static constexpr std::size_t kMostRows = 1024;
  using EntityKey = std::array<std::uint16_t, 3>;
  using PairKey = std::array<std::uint16_t, 6>;  // on, by

  /// @param shift of B's arrivals against A's, is subtracted  @param step > 0, time step
  MotionDifference(std::chrono::nanoseconds shift, std::chrono::nanoseconds step)
      : shift_(shift), step_(step) {}

  /// Reads both to their ends, or until `stopped()` is true.
  void run(PduStream& a, PduStream& b, auto&& stopped) {
    begin(a, b);
    while (advance() && !stopped()) {
    }
  }

  /// For a B of another rate: uses A's arrivals and timestamps for PDUs in both, and times between
  /// them for PDUs in B only.
  void run_paired(PduAlignment& alignment, const PairedTimes& times, auto&& stopped) {
    pairs_ = times;
    for (AlignedPdus step; !stopped() && alignment.next(step);) take_step(step);
    compare_to_end();
  }

  [[nodiscard]] const std::map<EntityKey, PoseDifference>& poses() const { return poses_; }
  [[nodiscard]] const std::map<PairKey, TimedSpread>& forces() const { return forces_; }

 private:
  struct Side {
    PduStream* stream = nullptr;
    std::chrono::nanoseconds shift{};
    HeldPdu next;
    bool has_next = false;
    ReckonedCapture capture;

    [[nodiscard]] std::chrono::nanoseconds due() const { return next.time - shift; }
    void feed(std::chrono::nanoseconds until);
  };

  void begin(PduStream& a, PduStream& b);
  /// One time step; false after the end of both captures.
  [[nodiscard]] bool advance();
  void take_step(AlignedPdus& step);
  void compare_to_end();
  void compare_now();
  /// Advances to the next instant; without entities to compare, to the one at `arrival`.
  void step_on(std::chrono::nanoseconds arrival);
  void compare_poses();
  void compare_forces();

  std::chrono::nanoseconds shift_;
  std::chrono::nanoseconds step_;
  std::chrono::nanoseconds start_{};
  std::chrono::nanoseconds now_{};
  PairedTimes pairs_;  // of the last pair
  bool has_begun_ = false;
  Side a_;
  Side b_;
  std::map<EntityKey, PoseDifference> poses_;
  std::map<PairKey, TimedSpread> forces_;
};

}  // namespace reckon::tools
