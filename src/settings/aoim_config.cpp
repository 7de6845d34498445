// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/settings/aoim_config.hpp"

#include "reckon/peer/settings/type_pattern.hpp"

namespace reckon::peer {

double nimbus_of(const std::vector<NimbusClass>& classes, const pdu::EntityType& type) noexcept {
  for (const NimbusClass& one : classes) {
    if (is_of(type, one.type)) return one.nimbus;
  }
  return 0.0;
}

}  // namespace reckon::peer
