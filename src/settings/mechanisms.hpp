// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// THE list of the conditions that the mechanisms of a peer need, remove and provide for one
// another.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/peer/settings/aoim_config.hpp"
#include "reckon/peer/settings/network_config.hpp"

namespace reckon::peer {

/// The settings that switch mechanisms on.
struct Switches {
  const AoimConfig& aoim;
  const NetworkConfig& network;
};

/// A condition that a mechanism may need. The first conditions hold unless a mechanism removes
/// them; the last ones hold if a mechanism provides them.
enum class Condition : unsigned char {
  own_datagrams,  ///< PDUs unknown to plain DIS may be sent
  many_groups,    ///< there are groups after the base group
  fixed_groups,   ///< the groups of a cell never change
  plain_states,   ///< Entity States are sent as defined by DIS
  whole_states,   ///< no part of an Entity State is omitted
  one_stream,     ///< all receivers of a cell receive the same
  leaders,        ///< cells have leaders
  group_map,      ///< a map assigns groups to cells
};

/// A mechanism that a scene file can switch on.
struct Mechanism {
  std::string_view table, key;  ///< the key that switches it on
  bool (*is_on)(const Switches& settings);
  std::vector<Condition> needs, takes, gives;
  std::string_view value =
      {};  ///< its value with which the key switches it on, if others use the key too
  /// Index from 0 of the table under the key that switches it on; null if the key has no tables.
  std::size_t (*row)(const Switches& settings) = nullptr;
};

/// Each mechanism once.
[[nodiscard]] std::span<const Mechanism> mechanisms();

/// A condition that an active mechanism lacks.
struct UnmetCondition {
  std::string path;      ///< of the mechanism's key in a scene file, such as "aoim.tier[1]"
  std::string sentence;  ///< with the remedy
};

/// The conditions that active mechanisms lack, in the order of the list.
[[nodiscard]] std::vector<UnmetCondition> unmet_conditions(const Switches& settings);

}  // namespace reckon::peer
