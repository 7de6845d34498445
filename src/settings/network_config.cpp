// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/settings/network_config.hpp"

#include "reckon/peer/settings/type_pattern.hpp"

namespace reckon::peer {

const BundlePolicy& bundle_policy_of(const NetworkConfig& network,
                                     const pdu::EntityType& type) noexcept {
  for (const BundleClass& one : network.bundle_classes) {
    if (is_of(type, one.type)) return one.policy;
  }
  return network.bundle;
}

}  // namespace reckon::peer
