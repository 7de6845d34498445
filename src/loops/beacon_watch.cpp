// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/beacon_watch.hpp"

#include <algorithm>

#include "reckon/peer/loops/notice_text.hpp"
#include "reckon/peer/notation/beacon_names.hpp"

namespace reckon::peer {

using std::chrono::nanoseconds;

BeaconWatch::BeaconWatch(std::string_view follow) {
  for (std::string& name : beacon_names(follow)) followed_.push_back({std::move(name), false, {}});
}

void BeaconWatch::add(EntityNumber number, std::string_view name) {
  carried_.push_back({number, aoim::beacon_tag(name), std::string(name), {}, false});
}

void BeaconWatch::remove(EntityNumber number) noexcept {
  std::erase_if(carried_, [number](const Carried& one) { return one.number == number; });
}

void BeaconWatch::look(const aoim::AreaOfInterestManager& aoim, nanoseconds now,
                       haptics::SpscRing<Notice>& out, LeadersView& view) noexcept {
  view.followed_count = 0;
  const auto followed = aoim.sight().followed();
  for (std::size_t i = 0; i < std::min(followed.size(), followed_.size()); ++i) {
    const aoim::FollowedBeacon& one = followed[i];
    report_followed(one, followed_[i], out);
    LeadersView::Followed& row = view.followed[view.followed_count++];
    row = {{}, one.found, one.cell.q, one.cell.r, one.group.value};
    std::copy_n(followed_[i].name.begin(), std::min(followed_[i].name.size(), row.name.size() - 1),
                row.name.begin());
  }
  if (aoim.leading() != nullptr) look_at_ours(aoim, now, out);
}

void BeaconWatch::report_followed(const aoim::FollowedBeacon& now, Followed& before,
                                  haptics::SpscRing<Notice>& out) noexcept {
  const bool listens = now.number.value > 0;
  if (now.found && (!before.reported || before.cell != now.cell)) {
    before.reported = true;
    before.cell = now.cell;
    static_cast<void>(out.push(make_notice(NoticeKind::beacon, "beacon {} is in cell {},{}",
                                           before.name, now.cell.q, now.cell.r)));
  } else if (!listens && before.reported) {
    before.reported = false;
    static_cast<void>(
        out.push(make_notice(NoticeKind::beacon, "beacon {} is in no cell", before.name)));
  }
}

// If two peers have beacons with one tag, followers use the one that the scene's leader received
// first.
void BeaconWatch::look_at_ours(const aoim::AreaOfInterestManager& aoim, nanoseconds now,
                               haptics::SpscRing<Notice>& out) noexcept {
  for (Carried& one : carried_) {
    const auto row = aoim.leading()->role().directory().find_beacon(one.tag, now);
    const auto cell = aoim.leading()->carried_in(one.tag);
    if (!row || !cell || *cell == aoim::CellId{row->column, row->row}) {
      one.ours = now;
      one.reported = false;
    } else if (now - one.ours >= kDisputed && !one.reported) {
      one.reported = true;
      static_cast<void>(out.push(make_notice(NoticeKind::beacon_disputed,
                                             "another peer carries beacon {}, in cell {},{}, and "
                                             "followers join that cell: rename one of the two",
                                             one.name, row->column, row->row)));
    }
  }
}

}  // namespace reckon::peer
