// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// THE list of what the mechanisms of a peer need of one another, and what they take from one
// another. Private to the scene reader.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "reckon/peer/scene/scene_file.hpp"

namespace reckon::peer {

class TomlReader;

/// What a mechanism counts on. The first ones are there unless a mechanism takes them away, the
/// last ones where a mechanism gives them.
enum class Condition : unsigned char {
  own_datagrams,  ///< what plain DIS does not know may be sent
  many_groups,    ///< there are groups behind the base group
  fixed_groups,   ///< each cell has the same groups for ever
  plain_states,   ///< Entity States go out as DIS has them
  whole_states,   ///< nothing is left out of an Entity State
  one_stream,     ///< all who listen to a cell receive the same
  leaders,        ///< cells have leaders
  group_map,      ///< a map says which cell has which group
};

/// A mechanism that a scene file can switch on.
struct Mechanism {
  std::string_view table, key;  ///< where it is switched on
  bool (*is_on)(const SceneFile& scene);
  std::vector<Condition> needs, takes, gives;
  std::string_view value =
      {};  ///< with which the key switches it on, where others have the key too
  /// Which of the tables under the key switches it on, from 0; null where the key has none.
  std::size_t (*row)(const SceneFile& scene) = nullptr;
};

/// Each mechanism once.
[[nodiscard]] std::span<const Mechanism> mechanisms();

/// Reports, at the key of each mechanism that is on, what it needs and does not have, with the
/// remedy.
void check_mechanisms(TomlReader& file, const SceneFile& scene);

}  // namespace reckon::peer
