// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/viewer/history/group_tiers.hpp"

namespace reckon::tools {

GroupTiers::GroupTiers(const peer::NetworkConfig& network, const peer::AoimConfig& aoim) {
  if (network.interop || aoim.all_groups() <= aoim.pool) return;
  groups_.emplace(network.group, aoim.all_groups());
  cells_ = aoim.pool;
  contact_ = peer::has_touch_tier(aoim.tiers) ? aoim.pool : 0;
}

TieredGroup GroupTiers::of(peer::GroupAddress group) const noexcept {
  if (!groups_) return {};
  group.port = groups_->base().port;
  const auto index = groups_->index(group);
  if (!index || *index < cells_) return {};
  const bool is_contact = *index >= groups_->size() - contact_;
  return {is_contact ? GroupTier::contact : GroupTier::near,
          static_cast<std::uint16_t>(*index + 1)};
}

}  // namespace reckon::tools
