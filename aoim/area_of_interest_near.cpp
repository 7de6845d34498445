// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The manager's near groups: for each near row of the channels one more group of each cell. Its
// number is that of the cell's group and as many pools as there are rows before it, and one.
#include <algorithm>
#include <array>

#include "reckon/aoim/area_of_interest_manager.hpp"

namespace reckon::aoim {
namespace {

using std::chrono::nanoseconds;

constexpr std::size_t kCellSize = pdu::kFixedSize<pdu::CellIndex>;

}  // namespace

AddResult AreaOfInterestManager::send_near(std::size_t row, const pdu::EntityState& state,
                                           const Position& position,
                                           std::span<const std::byte> records,
                                           const BundleTerms& terms) {
  return aggregator_.add(near_group(row, cells_.group(position)), state, records, terms);
}

AddResult AreaOfInterestManager::send_near_compressed(std::size_t row, const pdu::EntityId& entity,
                                                      pdu::CompressedForm form,
                                                      std::span<const std::byte> state,
                                                      const Position& position,
                                                      const BundleTerms& terms) {
  return aggregator_.add_compressed(near_group(row, cells_.group(position)), entity, form, state, {},
                                    terms);
}

bool AreaOfInterestManager::must_send_near(std::size_t row, const pdu::EntityId& entity,
                                           const Position& position, nanoseconds last_told,
                                           nanoseconds now) const noexcept {
  return introduction_.is_pending() &&
         introduction_.is_due(entity, near_group(row, cells_.group(position)), last_told, now);
}

std::size_t AreaOfInterestManager::row_of(GroupIndex group) const noexcept {
  if (is_contact_group(group)) return 0;
  return is_near_group(group) ? pools_before(group) - 1 : nears_.size();
}

bool AreaOfInterestManager::is_near_group(GroupIndex group) const noexcept {
  const std::size_t pool = pools_before(group);
  return pool >= 1 && pool <= nears_.size();
}

SubscriptionChange AreaOfInterestManager::set_near_foci(std::span<const Focus> foci, double radius,
                                                        nanoseconds now) {
  join_.clear();
  leave_.clear();
  for (std::size_t row = 0; row < nears_.size(); ++row) {
    near_foci_.clear();
    for (const Focus& focus : foci) {
      near_foci_.push_back(near_focus(channels_->table(), row, focus, radius, stretch_));
    }
    const SubscriptionChange change = nears_[row].update(near_foci_, now);
    for (const GroupIndex cell : change.join) {
      join_.push_back(near_group(row, cell));
      if (started_) ask_near(row, nears_[row].cell(cell));
    }
    for (const GroupIndex cell : change.leave) leave_.push_back(near_group(row, cell));
  }
  for (const GroupIndex group : join_) sequences_.forget(group);
  for (const GroupIndex group : leave_) sequences_.forget(group);
  return {join_, leave_, 0, 1.0};
}

void AreaOfInterestManager::ask_near(std::size_t row, CellId cell) {
  std::array<std::byte, kCellSize> octets;
  if (pdu::store_record(pdu::CellIndex{cell.q, cell.r}, octets) == 0) return;
  joined_near_[row].insert(joined_near_[row].end(), octets.begin(), octets.end());
}

// Who begins to listen to a near group knows what the rows behind it were told alone.
void AreaOfInterestManager::note_near(const pdu::CellMembership& membership, nanoseconds now) {
  if (membership.near_row >= nears_.size()) return;
  const nanoseconds heard_for = presence_.heard_for(membership.epoch);
  for (const pdu::CellIndex& cell : pdu::records_of<pdu::CellIndex>(membership.cells)) {
    introduce_to(near_group(membership.near_row, cells_.group(CellId{cell.column, cell.row})),
                 heard_for, now);
  }
}

}  // namespace reckon::aoim
