// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Which PDU of one capture is which of another: both in order, with a look ahead of bounded length
// where they part.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>

#include "reckon/tools/datagrams/pdu_stream.hpp"

namespace reckon::tools {

/// One step of two captures side by side.
struct AlignedPdus {
  enum class Kind : std::uint8_t {
    same,     ///< octet for octet, in what counts
    changed,  ///< of one type and entity, in one place, with other octets
    only_a,   ///< not in B here; it may come at another place
    only_b
  };
  Kind kind = Kind::same;
  HeldPdu a;  ///< not filled for only_b
  HeldPdu b;  ///< not filled for only_a
};

/// Steps through two captures. Where they differ it seeks the nearest PDUs that are the same in the
/// next kWindow of both; what lies before is changed where type and entity agree in order, else in
/// one of them only. Memory: 2 x kWindow PDUs. One thread.
class PduAlignment {
 public:
  static constexpr std::size_t kWindow = 512;
  /// PDUs that are paired by type and entity at once where nothing in the window is the same.
  static constexpr std::size_t kBlindBlock = 64;

  /// Both streams outlive this.
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
  /// PDUs in front of the next that are the same.
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
