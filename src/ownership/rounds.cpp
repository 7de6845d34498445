// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/ownership/rounds.hpp"

#include <algorithm>

namespace reckon::peer {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr nanoseconds kSlowRound = milliseconds(500);
constexpr nanoseconds kActive = milliseconds(1000);      // after the last active round
constexpr nanoseconds kQuietVoter = milliseconds(1200);  // then rounds are fast
constexpr nanoseconds kShortLease = milliseconds(1300);  // likewise
constexpr nanoseconds kDecidedGap = milliseconds(30);
constexpr nanoseconds kTableGap = milliseconds(150), kDiffers = milliseconds(100);

}  // namespace

void Rounds::receive(const Round& round, std::uint32_t from, nanoseconds now) {
  core_.leases.receive(from, round.round, now);
  if (round.is_active) active_at_ = now;
  if (round.yields_to != 0) chair_.note_leaving(from, round.yields_to, now);
  const std::size_t place = core_.acts.decided().roll.index_of(from);
  if (place != Roll::kNone) tables_[place] = round.table;
  note_round(round, from, now);
  compare_tables(round, from, now);
}

void Rounds::note_round(const Round& round, std::uint32_t from, nanoseconds now) {
  const ActBook& acts = core_.acts;
  if (round.act < acts.decided().number ||
      (round.act == acts.decided().number && !round.is_decided))
    return send_decided(from, now);
  if (acts.decided().roll.contains(from)) is_act_known_ = true;
  const bool is_same = round.act == acts.newest().number && round.hash == acts.hash();
  const std::size_t place = acts.newest().roll.index_of(core_.config.epoch);
  if (is_same && place != Roll::kNone) core_.leases.confirm(from, round.heard[place], now);
  const bool is_new = !acts.decided().roll.contains(from) && !round.follows;
  if (is_new && round.act == acts.decided().number) chair_.note_newcomer(from, {~0U, from}, now);
}

// Tables that differ for some time are sent; soon only by the more senior of two peers.
void Rounds::compare_tables(const Round& round, std::uint32_t from, nanoseconds now) {
  if (!core_.acts.exists() || round.table == core_.table.hash()) return;
  if (now - differed_ > 2 * kSlowRound) differs_since_ = now;
  differed_ = now;
  if (!core_.config.votes) return;
  const Roll& roll = core_.acts.decided().roll;
  const bool is_senior = roll.index_of(core_.config.epoch) < roll.index_of(from);
  const bool is_due =
      now - differs_since_ >= (is_senior ? kDiffers : 3 * kDiffers) || round.table == 0;
  if (is_due) send_table(kTableGap, now);
}

void Rounds::send_table(nanoseconds gap, nanoseconds now) {
  if (now - table_sent_ < gap) return;
  table_sent_ = now;
  TableExtract extract;
  extract.act = core_.is_informed() ? core_.acts.decided().number : 0;
  for (std::size_t i = 0; i < core_.table.size(); ++i) {
    extract.holdings.add(i, core_.table[i]);
    if (extract.holdings.count < kMostHoldings) continue;
    core_.send(0, extract);
    extract.holdings = {};
  }
  if (extract.holdings.count > 0) core_.send(0, extract);
}

void Rounds::send_decided(std::uint32_t to, nanoseconds now) {
  if (now - decided_sent_ < kDecidedGap) return;
  decided_sent_ = now;
  Proposal decided;
  decided.act = core_.acts.decided();
  decided.phase = DecisionPhase::decided;
  core_.send(to, decided);
}

// This peer agrees to be removed once a majority knows to whom it has given objects.
std::uint32_t Rounds::yields_to(std::uint32_t complied, nanoseconds now) noexcept {
  const bool yields = core_.is_closing || complied != 0;
  granting_.close(yields);
  if (!yields) return 0;
  const std::uint32_t table = core_.table.hash();
  const Roll& roll = core_.acts.decided().roll;
  const bool is_known = roll.is_majority([&](const Voter& voter) {
    return voter.epoch == core_.config.epoch || tables_[roll.index_of(voter.epoch)] == table;
  });
  if (granting_.has_granted(now) && (!is_known || rows_.is_granting())) return 0;
  return core_.is_closing ? kAnyAct : complied;
}

bool Rounds::is_active(nanoseconds now) const {
  if (core_.user.is_any_awake() || rows_.is_busy()) return true;
  if (core_.acts.pending() != nullptr || core_.is_leaving) return true;
  if (rows_.held().any() && core_.lease_end(now) - now < kShortLease) return true;
  return std::ranges::any_of(core_.acts.decided().roll.voters(), [&](const Voter& voter) {
    return voter.epoch != core_.config.epoch &&
           now - core_.leases.silent_since(voter.epoch) > kQuietVoter;
  });
}

// Asks for the act and the table of the voters while ours differ.
void Rounds::follow(nanoseconds now) {
  const bool lacks_act = core_.world.exists() && !core_.acts.exists();
  if (!lacks_act && now - differed_ > kSlowRound) return;
  if (now - round_at_ < kTableGap) return;
  round_at_ = now;
  Round round;
  round.follows = true;
  round.act = core_.acts.decided().number;
  round.hash = core_.acts.hash();
  round.table = core_.table.hash();
  round.round = core_.leases.round(now);
  round.is_decided = true;
  core_.send(0, round);
}

void Rounds::step(std::uint32_t complied, nanoseconds now) {
  const bool is_voter = core_.acts.decided().roll.contains(core_.config.epoch);
  const bool has_left = core_.is_closing && core_.acts.exists() && !is_voter;
  if (!core_.config.votes || has_left) return follow(now);
  const bool is_active_here = is_active(now);
  const bool is_fast = is_active_here || now - active_at_ < kActive || !is_voter;
  if (now - round_at_ < (is_fast ? LeaseBook::kRound : kSlowRound)) return;
  round_at_ = now;
  const Act& act = core_.acts.newest();
  Round round;
  round.act = core_.acts.exists() ? act.number : 0;
  round.hash = core_.acts.hash();
  round.table = core_.is_informed() ? core_.table.hash() : 0;
  round.round = core_.leases.round(now);
  round.is_decided = core_.acts.pending() == nullptr;
  round.is_active = is_active_here;
  round.has_lease = core_.is_informed() && core_.has_lease(now);
  round.yields_to = yields_to(complied, now);
  agrees_ = round.yields_to != 0;
  const auto voters = act.roll.voters();
  for (std::size_t i = 0; i < voters.size(); ++i)
    round.heard[i] = core_.leases.round_of(voters[i].epoch, now);
  core_.send(0, round);
  if (core_.acts.exists()) return;
  std::get<Round>(core_.out.back().message).world = core_.to_found;
}

}  // namespace reckon::peer
