// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Recipient tiers of a scene in one line of [aoim], between its other keys.
#pragma once

#include <string>

namespace reckon::test {

/// A tier for peers that can touch, then one for all.
inline const std::string kTouchTier = "tier = [{to = \"touch\"}]\n";

/// The rows of aoim::default_channels().
/// @param touch behind a tier for peers that can touch @param own with groups of their own
inline std::string usual_tiers(bool touch, bool own) {
  const std::string own_group = own ? ", own_group = true" : "";
  return std::string("tier = [") + (touch ? "{to = \"touch\"}, " : "") +
         "{farthest = \"1 m\", active = \"1 kHz\", passive = \"1 kHz\", octets = 232, kept = "
         "true}, "
         "{farthest = \"50 m\", active = 30, passive = 0.2, octets = 232" +
         own_group +
         "}, {farthest = \"200 m\", body = \"approximate\", active = 10, passive = 0.2, "
         "octets = 176, coarser = 4" +
         own_group +
         "}, {body = \"rigid\", active = 1, passive = 0.2, octets = 144, coarser = 16}]\n";
}

/// Tiers by distance, with one stream for all.
inline const std::string kDistanceTiers = usual_tiers(false, false);
/// Tiers by distance, with groups of their own.
inline const std::string kOwnTiers = usual_tiers(false, true);
/// The same, after a tier for peers that can touch.
inline const std::string kAllTiers = usual_tiers(true, true);

}  // namespace reckon::test
