// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/world/audiences.hpp"

#include <algorithm>
#include <numbers>

namespace reckon::peer {
namespace {

// For all peers, if rows have no tiers of their own.
constexpr aoim::Channel kOneRow{0.0, aoim::Body::full, 0.0, 0.0, 1.0, false, 1.0};

deadreckon::Thresholds coarser(deadreckon::Thresholds thresholds, double times) {
  thresholds.position *= times;
  thresholds.angle = std::min(times * thresholds.angle, std::numbers::pi);
  return thresholds;
}

}  // namespace

Audiences::Audiences(std::size_t urgent, std::span<const aoim::Channel> rows,
                     const deadreckon::UpdatePolicy& inmost, const deadreckon::SendRule& rule,
                     double first_repeat)
    : urgent_(urgent) {
  if (rows.empty()) rows = std::span(&kOneRow, 1);
  for (std::size_t audience = 1; audience < urgent + rows.size(); ++audience) {
    const aoim::Channel& row = rows[std::max(audience, urgent) - urgent];
    const double times = row.coarser;
    const double behind = audience <= urgent ? SeenSide::kBehind : SeenSide::kNever;
    deadreckon::UpdatePolicy policy(coarser(inmost.thresholds(), times), inmost.heartbeat(),
                                    times * first_repeat, rule, deadreckon::kEventRepeat);
    policy.align_heartbeats(inmost.step(), inmost.phase());
    sides_.emplace_back(policy, behind);
    slack_ = times * inmost.thresholds().position;
    if (row.body != aoim::Body::rigid) receive_parts_ = sides_.size();
  }
}

void Audiences::event(std::size_t outmost) noexcept {
  for (std::size_t i = 0; i < std::min(outmost, sides_.size()); ++i) sides_[i].event();
}

void Audiences::note_sent(std::size_t audience, const deadreckon::KinematicState& as_received,
                          double now, deadreckon::SendReason reason, bool whole) noexcept {
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    const bool is_in_step = i < urgent_;
    i < audience ? sides_[i].note_sent_to_all(as_received, now, reason, whole || is_in_step)
                 : sides_[i].note_sent_to_inner();
  }
}

double Audiences::next(std::size_t audience) const noexcept {
  double next = SeenSide::kNever;
  for (std::size_t i = std::max<std::size_t>(audience, 1); i <= sides_.size(); ++i) {
    next = std::min(next, sides_[i - 1].next());
  }
  return next;
}

bool is_shown_moving(const deadreckon::UpdatePolicy& inmost, const Audiences* audiences,
                     std::size_t audience, double now) noexcept {
  constexpr double kSoon = 0.1;  // [s]
  const auto predicted = [&](double time) {
    return audience == 0 || audiences == nullptr ? inmost.predicted(time)
                                                 : audiences->predicted(audience, time);
  };
  const deadreckon::Pose here = predicted(now), soon = predicted(now + kSoon);
  return soon.position != here.position || soon.orientation.coeffs() != here.orientation.coeffs();
}

}  // namespace reckon::peer
