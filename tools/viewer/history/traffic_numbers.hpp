// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Statistics of the traffic, four times a second: rates, delay, loss and prediction errors; kept as
// long as the history.
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "reckon/pdu/reckon/datagram_trailer.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/tools/datagrams/trailer_loss.hpp"
#include "reckon/tools/viewer/history/received_world.hpp"

namespace reckon::tools {

/// Over the second before `time`. Absent values are unknown.
struct NumbersSample {
  std::chrono::nanoseconds time{};
  double pdu_per_s = 0, bit_per_s = 0;            ///< UDP payloads
  std::optional<double> lost_share;               ///< by the sequence numbers of trailers
  std::optional<double> delay_median, delay_p95;  ///< [s], one way, including the offset of the
                                                  ///< clocks
  std::optional<double> error_mean, error_worst;  ///< [m], of predictions at updates
};

/// One thread. Holds at most kMostSamples; older ones are dropped.
class TrafficNumbers {
 public:
  static constexpr std::chrono::nanoseconds kEvery = std::chrono::milliseconds(250);
  static constexpr std::size_t kMostSamples = 1 << 16;

  /// Counts a PDU of the present datagram.
  void pdu(const PduRow& row, const peer::SourceDatagram& datagram) {
    Part& part = parts_[part_];
    ++part.pdus;
    loss_.pdu(row);
    if (!row.decoded || row.header.pdu_type != pdu::PduType::datagram_trailer) return;
    pdu::DatagramTrailer trailer;
    if (decode(row.bytes, trailer) != pdu::DecodeError::none) return;
    ++part.received;
    if (part.delays.size() < kMostDelays)
      part.delays.push_back(pdu::to_seconds(pdu::trailer_age(trailer.send_time, datagram.time)));
  }
  /// Ends the present datagram.
  void datagram(const peer::SourceDatagram& datagram, const UpdateJumps& jumps) {
    Part& part = parts_[part_];
    part.octets += datagram.bytes.size();
    part.lost += loss_.datagram(datagram);
    part.jumps.count += jumps.count;
    part.jumps.sum += jumps.sum;
    part.jumps.worst = std::max(part.jumps.worst, jumps.worst);
  }
  /// Advances the time to `now`: adds a sample if one is due.
  void pass(std::chrono::nanoseconds now) {
    if (!next_) next_ = now + kEvery;
    if (now < *next_) return;
    samples_.push_back(sample(now));
    if (samples_.size() > kMostSamples) samples_.pop_front();
    // After a silence, several parts end at once.
    for (std::size_t i = 0; i < kParts && now >= *next_; ++i) {
      part_ = (part_ + 1) % kParts;
      parts_[part_] = {};
      *next_ += kEvery;
    }
    if (now >= *next_) next_ = now + kEvery;
  }
  void forget_before(std::chrono::nanoseconds time) {
    while (samples_.size() > 1 && samples_.front().time < time) samples_.pop_front();
  }

  /// The newest sample at `time`; null before the first.
  [[nodiscard]] const NumbersSample* at(std::chrono::nanoseconds time) const {
    const auto after = std::upper_bound(
        samples_.begin(), samples_.end(), time,
        [](std::chrono::nanoseconds at, const NumbersSample& sample) { return at < sample.time; });
    return after == samples_.begin() ? nullptr : &*std::prev(after);
  }

 private:
  struct Part {
    std::uint64_t pdus = 0, octets = 0, received = 0;
    std::int64_t lost = 0;
    UpdateJumps jumps;
    std::vector<double> delays;  // [s], at most kMostDelays
  };
  static constexpr std::size_t kParts = 4;
  static constexpr std::size_t kMostDelays = 512;

  [[nodiscard]] NumbersSample sample(std::chrono::nanoseconds now) const {
    Part all;
    for (const Part& part : parts_) {
      all.pdus += part.pdus;
      all.octets += part.octets;
      all.received += part.received;
      all.lost += part.lost;
      all.jumps.count += part.jumps.count;
      all.jumps.sum += part.jumps.sum;
      all.jumps.worst = std::max(all.jumps.worst, part.jumps.worst);
      all.delays.insert(all.delays.end(), part.delays.begin(), part.delays.end());
    }
    constexpr double kSpan = pdu::to_seconds(kEvery) * kParts;
    NumbersSample out;
    out.time = now;
    out.pdu_per_s = static_cast<double>(all.pdus) / kSpan;
    out.bit_per_s = 8.0 * static_cast<double>(all.octets) / kSpan;
    if (all.received > 0) {
      // A late datagram lowers the count.
      const double lost = std::max(0.0, static_cast<double>(all.lost));
      out.lost_share = lost / (lost + static_cast<double>(all.received));
      std::sort(all.delays.begin(), all.delays.end());
      out.delay_median = all.delays[all.delays.size() / 2];
      out.delay_p95 = all.delays[all.delays.size() * 19 / 20];
    }
    if (all.jumps.count > 0) {
      out.error_mean = all.jumps.sum / static_cast<double>(all.jumps.count);
      out.error_worst = all.jumps.worst;
    }
    return out;
  }

  TrailerLoss loss_;
  std::array<Part, kParts> parts_;
  std::size_t part_ = 0;
  std::optional<std::chrono::nanoseconds> next_;
  std::deque<NumbersSample> samples_;
};

}  // namespace reckon::tools
