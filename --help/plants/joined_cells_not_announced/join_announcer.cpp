// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/tiers/join_announcer.hpp"

#include <algorithm>
#include <array>

namespace reckon::aoim {
namespace {

using std::chrono::nanoseconds;

constexpr std::size_t kCellSize = pdu::kFixedSize<pdu::CellIndex>;

void state_tier(std::size_t tier, const TierTable& tiers, pdu::CellMembership& membership) {
  membership.action = pdu::MembershipAction::join;
  if (tier == kCellTier) return;
  membership.action = pdu::MembershipAction::join_near;
  membership.near_row = static_cast<std::uint8_t>(tiers.row_of(tier));
}

void send_membership(pdu::CellMembership membership, const ControlStamp& stamp,
                     const JoinAnnouncer::Send& send) {
  stamp.put(membership);
  std::array<std::byte, 32 + JoinAsks::kMostCells * kCellSize> octets;
  send(std::span(octets).first(pdu::encode(membership, octets)));
}

}  // namespace

std::optional<std::size_t> joined_tier(const pdu::CellMembership& membership,
                                       const TierTable& tiers) noexcept {
  if (membership.action == pdu::MembershipAction::join) return kCellTier;
  const bool is_inner = membership.action == pdu::MembershipAction::join_near;
  if (!is_inner || membership.near_row >= tiers.last_row()) return {};
  return tiers.of_row(membership.near_row);
}

JoinAnnouncer::JoinAnnouncer(const TierTable& tiers, std::size_t cells)
    : tiers_(tiers), asks_(cells), once_(tiers.count()) {
  once_.front().reserve(cells * kCellSize);
}

void JoinAnnouncer::ask_once(std::size_t tier, CellId cell) {
  std::array<std::byte, kCellSize> octets;
  if (pdu::store_record(pdu::CellIndex{cell.q, cell.r}, octets) == 0) return;
  once_[tier].insert(once_[tier].end(), octets.begin(), octets.end());
}

bool JoinAnnouncer::is_pending() const noexcept {
  return asks_.has_new() ||
         std::ranges::any_of(once_, [](const auto& cells) { return !cells.empty(); });
}

void JoinAnnouncer::step(nanoseconds now, const ControlStamp& stamp, const Send& send) {
  if (asks_.has_new()) send_asks(false, now, stamp, send);
  for (std::size_t tier = 0; tier < once_.size(); ++tier) send_once(tier, stamp, send);
}

void JoinAnnouncer::repeat(nanoseconds now, const ControlStamp& stamp, const Send& send) {
  send_asks(true, now, stamp, send);
}

void JoinAnnouncer::send_asks(bool announcing, nanoseconds now, const ControlStamp& stamp,
                              const Send& send) {
  const auto utc = static_cast<std::uint64_t>(stamp.utc.count());
  std::span<const JoinAsks::Question> rest = asks_.take_due(now, utc, announcing);
  while (!rest.empty()) {
    const auto other = std::ranges::find_if(
        rest, [&](const JoinAsks::Question& one) { return one.since != rest.front().since; });
    const auto count =
        std::min<std::size_t>(static_cast<std::size_t>(other - rest.begin()), JoinAsks::kMostCells);
    std::array<std::byte, JoinAsks::kMostCells * kCellSize> cells;
    for (std::size_t i = 0; i < count; ++i) {
      const CellId cell = rest[i].cell;
      static_cast<void>(pdu::store_record(pdu::CellIndex{cell.q, cell.r},
                                          std::span(cells).subspan(i * kCellSize, kCellSize)));
    }
    pdu::CellMembership membership;
    membership.action = pdu::MembershipAction::join;
    membership.since = rest.front().since;
    membership.cells = std::span(cells).first(count * kCellSize);
    rest = rest.subspan(count);
  }
}

// Membership PDUs with joined cells and no left ones.
void JoinAnnouncer::send_once(std::size_t tier, const ControlStamp& stamp, const Send& send) {
  std::span<const std::byte> rest(once_[tier]);
  while (!rest.empty()) {
    const auto cells = rest.first(std::min(rest.size(), JoinAsks::kMostCells * kCellSize));
    rest = rest.subspan(cells.size());
    pdu::CellMembership membership;
    state_tier(tier, tiers_, membership);
    membership.since = asks_.take_time(static_cast<std::uint64_t>(stamp.utc.count()));
    membership.cells = cells;
    send_membership(membership, stamp, send);
  }
  once_[tier].clear();
}

}  // namespace reckon::aoim
