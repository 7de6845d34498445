// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// THE list of former keys of scene files with their replacements. Private to the scene reader.
#pragma once

#include <toml++/toml.h>

#include <span>
#include <string>
#include <string_view>

namespace reckon::peer {

/// A key that is refused, with its replacement.
struct RenamedKey {
  std::string_view section, key;  ///< as in scene_keys()
  /// @param table the table that has the key
  std::string (*sentence)(const toml::table& table);
};

[[nodiscard]] std::span<const RenamedKey> renamed_keys();

}  // namespace reckon::peer
