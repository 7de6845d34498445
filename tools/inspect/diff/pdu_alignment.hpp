// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Alignment of the PDUs of two captures: both in order, with a bounded look-ahead where they
// differ.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>

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

  [[nodiscard]] bool next(AlignedPdus& out);

 private:
  struct Side {
    PduStream& stream;
    std::deque<HeldPdu> window;

    void fill();
    [[nodiscard]] HeldPdu pop();
  };
  /// PDUs before the next equal ones.
  struct Gap {
    std::size_t a = 0;
    std::size_t b = 0;
  };

  [[nodiscard]] Gap find_gap() const;
  void pair_up(Gap gap);

  Side a_;
  Side b_;
  bool ignore_time_;
  std::deque<AlignedPdus> planned_;
};

}  // namespace reckon::tools
