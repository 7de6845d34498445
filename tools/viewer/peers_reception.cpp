// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/viewer/peers_reception.hpp"

#include <algorithm>
#include <numeric>

namespace reckon::tools {
namespace {

using peer::TransitTimes;

/// [s]
double percentile(const TransitTimes::Counts& counts, std::uint64_t all, double share) {
  const std::size_t bucket = peer::bucket_of_share(
      counts.size(), all, share, [&counts](std::size_t place) { return counts[place]; });
  const std::size_t last = std::min(bucket, counts.size() - 1);
  return 1e-6 * static_cast<double>(TransitTimes::Buckets::end_of(last) - 1);
}

}  // namespace

PeersReception::Look PeersReception::sum() const {
  Look look;
  for (const peer::Peer* peer : peers_) {
    const TransitTimes::Counts counts = peer->model().time().transits().counts();
    std::transform(counts.begin(), counts.end(), look.came.begin(), look.came.begin(),
                   std::plus<>());
    if (const peer::Counter* lost = peer->counters().find("datagrams_lost"))
      look.lost += static_cast<std::int64_t>(lost->value());
  }
  return look;
}

std::optional<ReceptionSample> PeersReception::look(std::chrono::nanoseconds now) {
  if (peers_.empty() || (next_ && now < *next_)) return std::nullopt;
  next_ = now + kEvery;
  looks_.push_back(sum());
  if (looks_.size() <= kParts) return std::nullopt;
  TransitTimes::Counts came{};
  std::transform(looks_.back().came.begin(), looks_.back().came.end(), looks_.front().came.begin(),
                 came.begin(), std::minus<>());
  // A late datagram lowers the count.
  const auto lost = std::max<std::int64_t>(looks_.back().lost - looks_.front().lost, 0);
  looks_.pop_front();
  const auto all = std::accumulate(came.begin(), came.end(), std::uint64_t{0});
  ReceptionSample sample{now, {}, {}, {}};
  if (all == 0) return sample;
  sample.lost_share =
      static_cast<double>(lost) / static_cast<double>(lost + static_cast<std::int64_t>(all));
  sample.delay_median = percentile(came, all, 0.5);
  sample.delay_p95 = percentile(came, all, 0.95);
  return sample;
}

}  // namespace reckon::tools
