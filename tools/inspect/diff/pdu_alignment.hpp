// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Alignment of the PDUs of two captures: both in order, with a bounded look-ahead where they
// differ.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <unordered_map>
#include <utility>

#include "reckon/tools/datagrams/pdu_stream.hpp"

namespace reckon::tools {

/// One step through two captures.
struct AlignedPdus {
  enum class Kind : std::uint8_t {
    same,     ///< octet for octet, except ignored fields
    changed,  ///< the same type, entity and place, with other octets
    only_a,   ///< not in B at this position; it may be at another one
    only_b
  };
  Kind kind = Kind::same;
  HeldPdu a;  ///< not filled for only_b
  HeldPdu b;  ///< not filled for only_a
};

/// Steps through two captures. At a difference it searches the next kWindow PDUs of both for the
/// nearest equal ones. PDUs before them count as changed if type and entity agree in order, else as
/// in one capture only. Memory: 2 x kWindow PDUs. One thread.
class PduAlignment {
 public:
  static constexpr std::size_t kWindow = 512;
  /// Number of PDUs paired at once by type and entity if nothing in the window is equal.
  static constexpr std::size_t kBlindBlock = 64;

  /// Both streams outlive this object.
  PduAlignment(PduStream& a, PduStream& b, bool ignore_time)
      : a_{a, {}}, b_{b, {}}, ignore_time_(ignore_time) {}

  [[nodiscard]] bool next(AlignedPdus& out) {
    if (planned_.empty()) {
      if (a_.window.empty()) a_.fill();
      if (b_.window.empty()) b_.fill();
      if (a_.window.empty() && b_.window.empty()) return false;
      const bool both = !a_.window.empty() && !b_.window.empty();
      if (both && same_octets(a_.window.front(), b_.window.front(), ignore_time_)) {
        out = {AlignedPdus::Kind::same, a_.pop(), b_.pop()};
        return true;
      }
      a_.fill();
      b_.fill();
      pair_up(find_gap());
    }
    out = std::move(planned_.front());
    planned_.pop_front();
    return true;
  }

 private:
  /// Whether one PDU can be a changed version of the other.
  static bool same_role(const HeldPdu& a, const HeldPdu& b) {
    return a.has_header == b.has_header && a.header.pdu_type == b.header.pdu_type && a.id == b.id;
  }

  struct Side {
    PduStream& stream;
    std::deque<HeldPdu> window;

    void fill() {
      HeldPdu held;
      while (window.size() < kWindow && stream.next(held)) window.push_back(std::move(held));
    }
    [[nodiscard]] HeldPdu pop() {
      HeldPdu held = std::move(window.front());
      window.pop_front();
      return held;
    }
  };
  /// PDUs before the next equal ones.
  struct Gap {
    std::size_t a = 0;
    std::size_t b = 0;
  };

  [[nodiscard]] Gap find_gap() const {
    std::unordered_map<std::uint64_t, std::size_t> first_in_b;
    for (std::size_t i = 0; i < b_.window.size(); ++i) first_in_b.try_emplace(b_.window[i].hash, i);
    Gap best{std::min(a_.window.size(), kBlindBlock), std::min(b_.window.size(), kBlindBlock)};
    std::size_t least = SIZE_MAX;
    for (std::size_t i = 0; i < a_.window.size() && i < least; ++i) {
      const auto found = first_in_b.find(a_.window[i].hash);
      if (found == first_in_b.end() || i + found->second >= least) continue;
      if (!same_octets(a_.window[i], b_.window[found->second], ignore_time_)) continue;
      best = {i, found->second};
      least = i + found->second;
    }
    return best;
  }
  void pair_up(Gap gap) {
    using Kind = AlignedPdus::Kind;
    // One for one: its ID may have changed.
    const bool one_for_one =
        gap.a == 1 && gap.b == 1 && a_.window.front().type() == b_.window.front().type();
    if (one_for_one) return planned_.push_back({Kind::changed, a_.pop(), b_.pop()});
    for (; gap.a > 0; --gap.a) {
      HeldPdu a = a_.pop();
      std::size_t before = 0;
      while (before < gap.b && !same_role(a, b_.window[before])) ++before;
      if (before == gap.b) {
        planned_.push_back({Kind::only_a, std::move(a), {}});
        continue;
      }
      for (; before > 0; --before, --gap.b) planned_.push_back({Kind::only_b, {}, b_.pop()});
      planned_.push_back({Kind::changed, std::move(a), b_.pop()});
      --gap.b;
    }
    for (; gap.b > 0; --gap.b) planned_.push_back({Kind::only_b, {}, b_.pop()});
  }

  Side a_;
  Side b_;
  bool ignore_time_;
  std::deque<AlignedPdus> planned_;
};

}  // namespace reckon::tools
