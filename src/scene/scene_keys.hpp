// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// THE list of the keys of a scene file. The reader refuses other keys, takes units and ranges from
// it, and docs/scene_files.md is checked against it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace reckon::peer {

/// Form of a key's value.
enum class KeyKind : std::uint8_t {
  number,   ///< 0.5 or "500 mm"
  integer,  ///< 256
  boolean,  ///< true
  text,     ///< "239.192.1.0"
  texts,    ///< ["10.0.0.7", "host-b"], any number
  choice,   ///< one of the words in `words`; with a range, or a whole number
  point,    ///< three numbers: [0, 0, 0.1], ["0 m", "0 m", "10 cm"] or "0 0 10 cm"
  table,    ///< { key = value } or [section.key]
  tables,   ///< [[key]], any number
};

/// One key of a section; names in a file are `section` and `key`.
struct SceneKey {
  std::string section;  ///< "" is the file itself; "scene.origin" is [scene] origin = {..}
  std::string key;
  KeyKind kind = KeyKind::number;
  std::string unit;                          ///< SI, as in units.hpp; empty for plain numbers
  double least = 0.0;                        ///< [unit], inclusive
  double most = 0.0;                         ///< [unit], inclusive
  std::string standard;                      ///< default as written in a file; may be empty
  std::string sentence;                      ///< meaning
  std::vector<std::string_view> words = {};  ///< choice: one of them
  /// Another key of the section, a time; this key may be a share of it: "40 %". Empty: none.
  std::string_view share_of = {};
};

/// The list, including the parameters of all effects; made once.
[[nodiscard]] const std::vector<SceneKey>& scene_keys();

/// A section for the user: "[hand]", "[[object]]" or "the file".
[[nodiscard]] std::string section_name(std::string_view section);

/// "number [m]", "text", "one of square, hexagonal"...
[[nodiscard]] std::string describe_kind(const SceneKey& key);

/// A list of keys as Markdown tables, one per section; the keys of the file itself come first.
[[nodiscard]] std::string keys_markdown(const std::vector<SceneKey>& keys);
/// The list as the tables of docs/scene_files.md.
[[nodiscard]] std::string scene_keys_markdown();

}  // namespace reckon::peer
