// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/loss_watch.hpp"

#include <cmath>

#include "reckon/peer/loops/notice_text.hpp"

namespace reckon::peer {

void LossWatch::look(const aoim::SequenceCounts& counts, Nanoseconds now,
                     haptics::SpscRing<Notice>& out) noexcept {
  if (window_ >= Nanoseconds(0) && now - window_ < kWindow) return;
  // `lost` decreases when a late datagram arrives.
  const std::uint64_t lost = counts.lost > lost_ ? counts.lost - lost_ : 0;
  const std::uint64_t sent = counts.received - received_ + lost;
  const bool first = window_ < Nanoseconds(0);
  window_ = now;
  received_ = counts.received;
  lost_ = counts.lost;
  const double share = sent > 0 ? static_cast<double>(lost) / static_cast<double>(sent) : 0.0;
  if (first || lost < kLeast || share < kShare || now - reported_ < kQuiet) return;
  reported_ = now;
  static_cast<void>(out.push(make_notice(
      NoticeKind::lost,
      "{} of {} datagrams of the other peers ({} %) were lost in 10 s: see kernel_drops for this "
      "host, and the network otherwise",
      lost, sent, std::lround(100.0 * share))));
}

}  // namespace reckon::peer
