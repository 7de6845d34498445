// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The manager's contact groups: one more group of each cell, for what is felt in it. Their pool is
// the last one.
#include "reckon/aoim/area_of_interest_manager.hpp"

namespace reckon::aoim {

AddResult AreaOfInterestManager::send_felt(const pdu::EntityState& state, const Position& position,
                                           std::span<const std::byte> records,
                                           const BundleTerms& terms) {
  return aggregator_.add(contact_group(cells_.group(position)), state, records, terms);
}

SubscriptionChange AreaOfInterestManager::set_contact_foci(std::span<const Focus> foci,
                                                           std::chrono::nanoseconds now) {
  if (!contacts_) return {};
  const SubscriptionChange change = contacts_->update(foci, now);
  join_.clear();
  leave_.clear();
  for (const GroupIndex cell : change.join) join_.push_back(contact_group(cell));
  for (const GroupIndex cell : change.leave) leave_.push_back(contact_group(cell));
  for (const GroupIndex group : join_) sequences_.forget(group);
  for (const GroupIndex group : leave_) sequences_.forget(group);
  return {join_, leave_, change.uncovered, change.covered_share};
}

}  // namespace reckon::aoim
