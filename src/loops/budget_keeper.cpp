// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/budget_keeper.hpp"

#include <algorithm>

#include "reckon/peer/loops/notice_text.hpp"
#include "reckon/peer/scene/scene_cells.hpp"
#include "reckon/peer/world/scene_position.hpp"

namespace reckon::peer {
namespace {

aoim::ReachLimitConfig limit_of(const SceneFile& scene) {
  return {scene.aoim.awareness.budget, scene.aoim.radius, cells_of(scene.aoim).finest()};
}

}  // namespace

BudgetKeeper::BudgetKeeper(const SceneFile& scene)
    : budget_(scene.aoim.awareness.budget), limit_(limit_of(scene)) {}

void BudgetKeeper::look(const RemoteEntities& remote, aoim::AreaOfInterestManager& aoim,
                        Nanoseconds now, haptics::SpscRing<Notice>& out) noexcept {
  if (aoim.receivers() != nullptr && now >= next_ask_) {
    next_ask_ = now + std::chrono::seconds(1);
    ask_for_less(remote, aoim, now, out);
  }
  limit_.note(heard_, now);
  aoim.sight().set_cut(limit_.cut());
  report_reach(now, out);
}

// A sender's rate follows its nearest receiver. If that is another peer, we may receive more than
// requested.
void BudgetKeeper::ask_for_less(const RemoteEntities& remote, aoim::AreaOfInterestManager& aoim,
                                Nanoseconds now, haptics::SpscRing<Notice>& out) {
  clients_.clear();
  for (const RemoteEntity& row : remote.rows()) {
    const RemoteEntity::Motion motion = row.motion(now);
    clients_.push_back({aoim.sight().interest().distance_to_focus(to_position(motion.position)),
                        !motion.velocity.isZero(0)});
  }
  const aoim::ChannelBudget budget = aoim.receivers()->fit(clients_, budget_);
  aoim.set_stretch(budget.stretch);
  const NoticeCondition::Turn turn = stretched_.turn(budget.stretch > 1.0, now);
  if (turn == NoticeCondition::Turn::begins) {
    static_cast<void>(out.push(make_notice(NoticeKind::stretched,
                                           "entities in range would send more than {:.4g} B/s: "
                                           "distances are multiplied by {:.3g} ([aoim] budget)",
                                           budget_, budget.stretch)));
  } else if (turn == NoticeCondition::Turn::ends) {
    static_cast<void>(
        out.push(make_end(NoticeKind::stretched, "all entities in range fit the budget again")));
  }
}

// While the limit is still being reduced there is no result to report.
void BudgetKeeper::report_reach(Nanoseconds now, haptics::SpscRing<Notice>& out) {
  most_heard_ = limit_.is_cut() ? std::max(most_heard_, limit_.heard()) : limit_.heard();
  if (unmet_.turn(limit_.is_unmet(), now) == NoticeCondition::Turn::begins) {
    static_cast<void>(out.push(
        make_notice(NoticeKind::budget_unmet,
                    "[aoim] budget of {:.4g} B/s cannot be met: the cells of our own entities and "
                    "those that our hands can reach send {:.4g} B/s; all others were left",
                    budget_, limit_.heard())));
  }
  const bool settled = limit_.is_cut() ? limit_.is_met() : true;
  if (!settled) return;
  const NoticeCondition::Turn turn = cut_.turn(limit_.is_cut(), now);
  if (turn == NoticeCondition::Turn::begins) {
    static_cast<void>(out.push(make_notice(NoticeKind::budget_cut,
                                           "left cells farther than {:.3g} m: received {:.4g} B/s "
                                           "before, {:.4g} B/s now ([aoim] budget of {:.4g} B/s)",
                                           limit_.cut(), most_heard_, limit_.heard(), budget_)));
  } else if (turn == NoticeCondition::Turn::ends) {
    static_cast<void>(
        out.push(make_end(NoticeKind::budget_cut, "all cells in range fit the budget again")));
  }
}

}  // namespace reckon::peer
