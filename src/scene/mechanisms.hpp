// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// THE list of the conditions that the mechanisms of a peer need, remove and provide for one
// another. Private to the scene reader.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "reckon/peer/scene/scene_file.hpp"

namespace reckon::peer {

class TomlReader;

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
  bool (*is_on)(const SceneFile& scene);
  std::vector<Condition> needs, takes, gives;
  std::string_view value =
      {};  ///< its value with which the key switches it on, if others use the key too
  /// Index from 0 of the table under the key that switches it on; null if the key has no tables.
  std::size_t (*row)(const SceneFile& scene) = nullptr;
};

/// Each mechanism once.
[[nodiscard]] std::span<const Mechanism> mechanisms();

/// Reports, at the key of each active mechanism, its unsatisfied conditions with the remedy.
void check_mechanisms(TomlReader& file, const SceneFile& scene);

}  // namespace reckon::peer
