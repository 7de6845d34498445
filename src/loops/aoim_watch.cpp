// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/aoim_watch.hpp"

#include <algorithm>
#include <cstddef>

#include "reckon/peer/loops/notice_text.hpp"

namespace reckon::peer {
namespace {

using std::chrono::nanoseconds;
using std::chrono::seconds;
using Turn = NoticeCondition::Turn;

constexpr nanoseconds kFirstWindow = seconds(10), kWindow = seconds(60);

}  // namespace

AoimWatch::AoimWatch(const SceneFile& scene, Counters& counters)
    : scene_(scene),
      updates_refused_(counters.make(
          "updates_refused", "own PDUs that could not be queued: too long, broken, or no room")),
      peers_not_joined_(
          counters.make("peers_not_joined", "announcements of peers beyond the table's size")),
      entities_outside_(counters.make("entities_outside",
                                      "updates of entities outside the radius of interest")) {}

void AoimWatch::look(aoim::AreaOfInterestManager& aoim, const aoim::SubscriptionChange& change,
                     nanoseconds now, haptics::SpscRing<Notice>& out) noexcept {
  now_ = now;
  out_ = &out;
  report_cap(change);
  report_full(aoim.presence());
  report_given_up(aoim.sequences());
  updates_refused_.set(aoim.aggregator().counts().refused);
  entities_outside_.set(aoim.sight().interest().counts().outside);
  report_outside(aoim);
  out_ = nullptr;
}

void AoimWatch::report_cap(const aoim::SubscriptionChange& change) noexcept {
  const Turn turn = capped_.turn(change.uncovered > 0, now_);
  if (turn == Turn::begins) {
    report(NoticeKind::groups_capped,
           "{} groups within the radius are not joined, because [aoim] groups = {} is reached: "
           "reception is complete only within {:.3g} m of {:.3g} m",
           change.uncovered, scene_.aoim.groups, change.covered_share * scene_.aoim.radius,
           scene_.aoim.radius);
  }
  if (turn == Turn::ends)
    end(NoticeKind::groups_capped, "all groups within the radius are joined again");
}

void AoimWatch::report_full(const aoim::Presence& presence) noexcept {
  const std::uint64_t count = presence.counts().table_full;
  const Turn turn = full_.turn(count > peers_not_joined_.value(), now_);
  peers_not_joined_.set(count);
  if (turn == Turn::begins) {
    report(NoticeKind::peers_full,
           "the table of peers is full with {}: further peers are not joined",
           presence.peers().size());
  }
  if (turn == Turn::ends) end(NoticeKind::peers_full, "the table of peers has room again");
}

void AoimWatch::report_given_up(const aoim::SequenceTracker& sequences) noexcept {
  const std::uint64_t count = sequences.counts().given_up;
  const Turn turn = given_up_.turn(count > given_up_before_, now_);
  given_up_before_ = count;
  if (turn == Turn::begins) {
    report(NoticeKind::numberings_full,
           "more than {} senders in groups are received: lost datagrams are not all counted",
           sequences.size());
  }
  if (turn == Turn::ends) end(NoticeKind::numberings_full, "all lost datagrams are counted again");
}

// If plain DIS uses one group, only the radius excludes an entity from view. Else entities outside
// are not received, and their distance is unknown.
void AoimWatch::report_outside(aoim::AreaOfInterestManager& aoim) noexcept {
  if (!begun_) window_end_ = now_ + kFirstWindow;
  begun_ = true;
  if (now_ < window_end_) return;
  window_end_ = now_ + kWindow;
  const aoim::InterestCounts counts = aoim.sight().interest().counts();
  const std::size_t peers = aoim.presence().peers().size();
  const double nearest = aoim.sight().take_nearest_outside();
  const bool inside =
      counts.accepted > at_begin_.accepted || counts.lingering > at_begin_.lingering;
  // Entities at rest are received once a minute or less: report only if none was ever shown.
  const bool has_shown = counts.accepted + counts.lingering > 0;
  const bool outside = scene_.network.interop ? counts.outside > at_begin_.outside
                                              : !has_shown && std::min(peers, peers_at_begin_) > 0;
  at_begin_ = counts;
  peers_at_begin_ = peers;
  if (inside) all_outside_reported_ = false;
  if (inside || !outside || all_outside_reported_) return;
  all_outside_reported_ = true;
  if (scene_.network.interop) {
    report(NoticeKind::nothing_near,
           "entities are received but none is shown: the nearest is {:.4g} m away and [aoim] "
           "radius is {:.4g} m; raise it to show them",
           nearest, scene_.aoim.radius);
  } else {
    report(
        NoticeKind::nothing_near,
        "{} other peers have no entity within [aoim] radius = {:.4g} m; raise it to receive more",
        peers, scene_.aoim.radius);
  }
}

template <typename... Arguments>
void AoimWatch::report(NoticeKind kind, const char* format,
                       const Arguments&... arguments) noexcept {
  static_cast<void>(out_->push(make_notice(kind, format, arguments...)));
}

template <typename... Arguments>
void AoimWatch::end(NoticeKind kind, const char* format, const Arguments&... arguments) noexcept {
  static_cast<void>(out_->push(make_end(kind, format, arguments...)));
}

}  // namespace reckon::peer
