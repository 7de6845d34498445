// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/leader/cell_leadership.hpp"

#include <algorithm>
#include <tuple>

namespace reckon::aoim {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr int kLeaveRepeats = 3;
constexpr milliseconds kLeaveGap{50};
// A challenged leader repeats its claim, but not more often than this.
constexpr milliseconds kLeastGap{100};
// Limit of the candidates before us for which we wait.
constexpr std::int64_t kMostAwaited = 10;

// Ranks by time of entry, then by the lower epoch. A total order, the same for all peers.
bool precedes(std::uint64_t entered, std::uint32_t epoch, std::uint64_t other_entered,
              std::uint32_t other) noexcept {
  return std::tie(entered, epoch) < std::tie(other_entered, other);
}

}  // namespace

CellLeadership::CellLeadership(const LeaderConfig& config, std::uint32_t epoch)
    : config_(config), epoch_(epoch) {}

CellLeadership::Cell* CellLeadership::find(CellId id) noexcept {
  const auto found = std::find_if(cells_.begin(), cells_.end(), [id](const Cell& cell) {
    return cell.id == id && cell.leave_repeats == 0;
  });
  return found == cells_.end() ? nullptr : &*found;
}

const CellLeadership::Cell* CellLeadership::find(CellId id) const noexcept {
  return const_cast<CellLeadership*>(this)->find(id);
}

bool CellLeadership::enter(CellId id, nanoseconds utc, nanoseconds now) {
  if (find(id) != nullptr) return true;
  std::erase_if(cells_, [id](const Cell& cell) { return cell.id == id; });  // it was leaving
  if (cells_.size() >= config_.most_cells) return false;
  Cell cell;
  cell.id = id;
  cell.entered = static_cast<std::uint64_t>(utc.count());
  cell.since = cell.next_send = now;
  cell.said = now - config_.heartbeat;
  cells_.push_back(cell);
  return true;
}

void CellLeadership::leave(CellId id, nanoseconds now) {
  Cell* cell = find(id);
  if (cell == nullptr) return;
  cell->leader.successor = successor_of(*cell, now);
  cell->leave_repeats = kLeaveRepeats;
  cell->next_send = now;
}

void CellLeadership::receive(const pdu::CellRole& role, std::uint32_t sender, nanoseconds now) {
  Cell* cell = find({role.column, role.row});
  if (cell == nullptr || sender == epoch_ || sender == 0) return;
  const bool leads = (role.flags & pdu::kRoleLeads) != 0;
  if ((role.flags & pdu::kRoleLeaves) != 0) {
    cell->other_led |= leads;
    // A leader may leave as we enter. Its leave message can then arrive before we have received its
    // claim.
    const bool led = cell->leader.epoch == sender || (leads && cell->leader.epoch == 0);
    return receive_leave(*cell, sender, led, role.successor, now);
  }
  note_member(*cell, role, sender, now);
  if (leads) receive_claim(*cell, role, sender, now);
}

void CellLeadership::note_member(Cell& cell, const pdu::CellRole& role, std::uint32_t sender,
                                 nanoseconds now) {
  const auto known = std::find_if(cell.members.begin(), cell.members.end(),
                                  [sender](const Member& m) { return m.epoch == sender; });
  if (known != cell.members.end()) {
    known->entered = role.entered;
    known->heard = now;
  } else if (cell.members.size() < config_.most_members) {
    cell.members.push_back({sender, role.entered, now, now});
  }
}

void CellLeadership::receive_claim(Cell& cell, const pdu::CellRole& role, std::uint32_t sender,
                                   nanoseconds now) {
  const Leader claimed{sender, role.successor, role.entered, now};
  Leader& leader = cell.leader;
  const bool older = precedes(role.entered, sender, leader.entered, leader.epoch);
  if (leader.epoch == epoch_) {
    if (older) return follow(cell, claimed, now);
    cell.next_send = std::min(cell.next_send, std::max(now, cell.said + kLeastGap));
    return;
  }
  const bool lost = leader.epoch == 0 || now - leader.heard >= patience();
  if (lost || older || sender == leader.epoch) follow(cell, claimed, now);
}

void CellLeadership::follow(Cell& cell, const Leader& leader, nanoseconds now) {
  const bool is_new = cell.leader.epoch != leader.epoch, led = cell.leader.epoch == epoch_;
  cell.leader = leader;
  cell.other_led = true;
  if (!cell.ranked) {
    cell.ranked = true;
    cell.entered = std::max(cell.entered, leader.entered + 1);
    cell.next_send = now;
  }
  if (led) cell.next_send = now;  // it may not have received our role and rank
  if (is_new) tell(cell, led);
}

// The successor leads at once. The others wait for its claim as long as for the claim of a leader
// that was just received.
void CellLeadership::receive_leave(Cell& cell, std::uint32_t sender, bool led,
                                   std::uint32_t successor, nanoseconds now) {
  std::erase_if(cell.members, [sender](const Member& m) { return m.epoch == sender; });
  if (!led) return;
  if (successor == epoch_) return take_lead(cell, now);
  const auto next = std::find_if(cell.members.begin(), cell.members.end(),
                                 [successor](const Member& m) { return m.epoch == successor; });
  cell.leader = {};
  // The named successor is expected soon, even if we have not received it in the cell yet.
  cell.since = successor == 0 ? now - config_.listen : now;
  if (next != cell.members.end()) cell.leader = {successor, 0, next->entered, now};
  tell(cell, false);
}

void CellLeadership::forget(std::uint32_t epoch, nanoseconds now) {
  for (Cell& cell : cells_) {
    const bool led = cell.leader.epoch == epoch;
    if (cell.leave_repeats == 0) receive_leave(cell, epoch, led, cell.leader.successor, now);
  }
}

void CellLeadership::take_lead(Cell& cell, nanoseconds now) {
  const std::uint32_t lost = cell.leader.epoch;
  std::erase_if(cell.members, [lost](const Member& m) { return m.epoch == lost; });
  cell.leader = {epoch_, 0, cell.entered, now};
  cell.ranked = true;
  cell.next_send = now;
  tell(cell, false);
}

void CellLeadership::tell(const Cell& cell, bool lost) {
  events_.push_back({cell.id, cell.leader.epoch, cell.leader.epoch == epoch_, lost});
}

// The time at which we lead unless another peer does. Peers that entered earlier by their clocks go
// first, even if we have listened for longer.
nanoseconds CellLeadership::leads_at(const Cell& cell) const noexcept {
  const bool led = cell.leader.epoch != 0;
  nanoseconds silent = led ? cell.leader.heard + patience() : cell.since + config_.listen;
  if (led && cell.leader.successor == epoch_) return silent;
  const nanoseconds latest = cell.since + 2 * config_.listen;
  std::int64_t awaited = led ? 1 : 0;
  for (const Member& member : cell.members) {
    const bool first = member.epoch != cell.leader.epoch &&
                       precedes(member.entered, member.epoch, cell.entered, epoch_);
    if (!first) continue;
    ++awaited;
    if (!led) silent = std::max(silent, std::min(member.since + config_.listen, latest));
  }
  return silent + std::min(awaited, kMostAwaited) * config_.stagger;
}

std::uint32_t CellLeadership::successor_of(const Cell& cell, nanoseconds now) const noexcept {
  const Member* oldest = nullptr;
  for (const Member& member : cell.members) {
    if (now - member.heard > 5 * config_.member_beat / 2) continue;
    const bool first =
        oldest == nullptr || precedes(member.entered, member.epoch, oldest->entered, oldest->epoch);
    if (first) oldest = &member;
  }
  return oldest == nullptr ? 0 : oldest->epoch;
}

// After a pause of this peer that was this long, another one leads: it listens before it claims the
// lead.
void CellLeadership::wake(nanoseconds now) {
  for (Cell& cell : cells_) {
    const bool led = cell.leader.epoch == epoch_;
    for (Member& member : cell.members) member.heard = now;
    cell.leader.heard = cell.since = now;
    if (!led) continue;
    cell.leader = {};
    tell(cell, true);
  }
}

void CellLeadership::step(nanoseconds now) {
  if (stepped_ != nanoseconds::min() && now - stepped_ >= patience()) wake(now);
  stepped_ = now;
  for (Cell& cell : cells_) {
    if (cell.leave_repeats > 0) continue;
    std::erase_if(cell.members, [&](const Member& member) {
      return now - member.heard > 7 * config_.member_beat / 2;
    });
    if (cell.leader.epoch != epoch_ && now >= leads_at(cell)) take_lead(cell, now);
  }
}

bool CellLeadership::take_role(nanoseconds now, pdu::CellRole& role) {
  const auto due = std::find_if(cells_.begin(), cells_.end(),
                                [now](const Cell& cell) { return cell.next_send <= now; });
  if (due == cells_.end()) return false;
  Cell& cell = *due;
  const bool leads = cell.leader.epoch == epoch_;
  const std::uint32_t successor =
      cell.leave_repeats > 0 ? cell.leader.successor : successor_of(cell, now);
  role = {};
  role.column = cell.id.q;
  role.row = cell.id.r;
  role.entered = cell.entered;
  role.successor = leads ? successor : 0;
  role.flags = leads ? pdu::kRoleLeads : 0;
  cell.said = now;
  cell.next_send = now + (leads ? config_.heartbeat : config_.member_beat);
  if (cell.leave_repeats == 0) return true;
  role.flags |= pdu::kRoleLeaves;
  cell.next_send = now + kLeaveGap;
  if (--cell.leave_repeats == 0) cells_.erase(due);
  return true;
}

void CellLeadership::say_soon(CellId id, nanoseconds now) noexcept {
  if (Cell* cell = find(id)) cell->next_send = std::min(cell->next_send, now);
}

nanoseconds CellLeadership::next_step() const noexcept {
  nanoseconds next = nanoseconds::max();
  for (const Cell& cell : cells_) {
    next = std::min(next, cell.next_send);
    if (cell.leave_repeats == 0 && cell.leader.epoch != epoch_)
      next = std::min(next, leads_at(cell));
  }
  return next;
}

std::uint32_t CellLeadership::leader(CellId id) const noexcept {
  const Cell* cell = find(id);
  return cell == nullptr ? 0 : cell->leader.epoch;
}

bool CellLeadership::came_later(CellId id, std::uint32_t epoch) const noexcept {
  const Cell* cell = find(id);
  if (cell == nullptr) return false;
  return std::any_of(cell->members.begin(), cell->members.end(), [&](const Member& member) {
    return member.epoch == epoch && precedes(cell->entered, epoch_, member.entered, epoch);
  });
}

bool CellLeadership::is_led(CellId id, nanoseconds now) const noexcept {
  const Cell* cell = find(id);
  if (cell == nullptr || cell->leader.epoch == 0) return false;
  return cell->leader.epoch == epoch_ || now - cell->leader.heard < patience();
}

bool CellLeadership::had_other_leader(CellId id) const noexcept {
  const Cell* cell = find(id);
  return cell != nullptr && cell->other_led;
}

std::size_t CellLeadership::members(CellId id) const noexcept {
  const Cell* cell = find(id);
  return cell == nullptr ? 0 : cell->members.size();
}

std::span<const LeaderEvent> CellLeadership::take_events() {
  taken_.clear();
  std::swap(taken_, events_);
  return taken_;
}

}  // namespace reckon::aoim
