// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// THE list of keys that scene files had once, and what stands for them now. Private to the scene
// reader.
#pragma once

#include <toml++/toml.h>

#include <span>
#include <string>
#include <string_view>

namespace reckon::peer {

/// A key that is refused with what to write in its place.
struct RenamedKey {
  std::string_view section, key;  ///< as in scene_keys()
  /// @param table the one that has the key
  std::string (*sentence)(const toml::table& table);
};

[[nodiscard]] std::span<const RenamedKey> renamed_keys();

}  // namespace reckon::peer
