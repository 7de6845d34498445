// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Reads one TOML table by the list of scene keys and collects the problems. Private to the scene
// reader: no other room uses toml++.
#pragma once

#include <toml++/toml.h>

#include <Eigen/Core>
#include <chrono>
#include <concepts>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "reckon/peer/notation/units.hpp"
#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/peer/scene/scene_keys.hpp"
#include "reckon/peer/scene/scene_words.hpp"

namespace reckon::peer {

/// The keys that a file may use.
struct SceneVocabulary {
  std::vector<SceneKey> keys;      ///< scene_keys(), and the keys of `effects`
  haptics::CustomEffects effects;  ///< of the program, in the order of their keys
  /// Receives each file that the scene names, but its key; null: none does.
  std::vector<std::filesystem::path>* files = nullptr;
  bool is_confined = false;  ///< a file outside the folder of the scene is a problem
};

/// @throws SceneFileError at the place where `text` is invalid TOML, or exceeds check_text_bounds()
[[nodiscard]] toml::table parse_toml(std::string_view text, const std::string& file);
/// @throws SceneFileError with the problems in the order of their places, if there are any
void throw_problems(const std::string& file, std::vector<SceneProblem> problems);
/// @throws SceneFileError if the file cannot be read, is no regular file, or is larger
[[nodiscard]] std::string read_bytes(const std::filesystem::path& path, std::size_t most_octets);

/// Limit of reported problems per file; the search then ends.
inline constexpr std::size_t kMostProblems = 100;
/// Limit of tables under one key, such as [[entity]].
inline constexpr std::size_t kMostTables = 100'000;

/// A view of one table of a file. The constructor refuses unknown and renamed keys. A read leaves
/// its target unchanged if the key is absent or invalid; an invalid one becomes a problem.
class TomlReader {
 public:
  /// All except the folder outlive the reader; `section` as in scene_keys().
  TomlReader(const toml::table& table, std::string section, std::filesystem::path folder,
             const SceneVocabulary& vocabulary, std::vector<SceneProblem>& problems);

  [[nodiscard]] const haptics::CustomEffects& custom_effects() const {
    return vocabulary_->effects;
  }
  [[nodiscard]] bool has(std::string_view key) const { return table_->contains(key); }
  /// The folder of relative file names.
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  /// Whether there is a table under `key` that contains `inner`.
  [[nodiscard]] bool has(std::string_view key, std::string_view inner) const {
    const toml::node* const node = table_->get(key);
    return node != nullptr && node->is_table() && node->as_table()->contains(inner);
  }

  void number(std::string_view key, double& target);
  void read(std::string_view key, double& target) { number(key, target); }
  void read(std::string_view key, std::chrono::nanoseconds& target);
  void read(std::string_view key, bool& target);
  void read(std::string_view key, std::string& target);
  /// The same for a target without a value while the key is absent or invalid.
  template <class T>
  requires std::same_as<T, bool> || std::same_as<T, std::string>
  void read(std::string_view key, std::optional<T>& target) {
    T value{};
    const std::size_t before = problems_->size();
    read(key, value);
    if (has(key) && problems_->size() == before) target = value;
  }
  void read(std::string_view key, Eigen::Vector3d& target);
  /// A file that can be opened; a relative name starts at the folder of the scene.
  void read(std::string_view key, std::filesystem::path& target);

  /// A key with a unit accepts a quantity, truncated to a whole number.
  template <std::integral T>
  void read(std::string_view key, T& target) {
    if (const auto value = whole_number(key)) target = static_cast<T>(*value);
  }

  template <HasWords T>
  void read(std::string_view key, T& target) {
    if constexpr (std::is_enum_v<T>) {
      if (takes_number(key)) {
        if (const auto value = whole_number(key)) target = static_cast<T>(*value);
        return;
      }
    }
    if (const auto word = choice(key)) target = *value_of<T>(*word);
  }

  /// One of the words of the key's list; nothing if it is absent or another (a problem).
  [[nodiscard]] std::optional<std::string_view> choice(std::string_view key);

  /// Passes each text of the list under `key` to `take`; if that throws std::invalid_argument, the
  /// text becomes a problem at its place.
  void each_text(std::string_view key, const std::function<void(const std::string&)>& take);

  /// The same, also for a single text without a list.
  void texts(std::string_view key, const std::function<void(const std::string&)>& take);

  /// The table under `key`, nothing if it is absent or no table (a problem).
  [[nodiscard]] std::optional<TomlReader> table(std::string_view key);
  /// The tables under `key`: [[key]] or [{..}, {..}].
  [[nodiscard]] std::vector<TomlReader> tables(std::string_view key);

  /// Adds a problem if `key` is absent.
  void require(std::string_view key);
  /// Adds a problem at `key`, or at the table if `key` is absent.
  void problem(std::string_view key, std::string sentence);
  /// The same at the end of a path such as "aoim.tier[1].kept", or at the existing part of it.
  void problem_at(std::string_view path, std::string sentence);

 private:
  [[nodiscard]] const SceneKey& spec(std::string_view key) const;
  [[nodiscard]] std::optional<std::int64_t> whole_number(std::string_view key);
  /// Whether the key has words, also accepts numbers, and the file gives a number.
  [[nodiscard]] bool takes_number(std::string_view key) const;
  /// The text of a key; null if it is absent or no text.
  [[nodiscard]] const std::string* text(std::string_view key);
  [[nodiscard]] TomlReader inside(const toml::table& table, std::string_view key);
  [[nodiscard]] std::optional<double> quantity(const toml::node& node, const SceneKey& spec);
  /// The value of a number given as text.
  [[nodiscard]] Quantity parse(const std::string& text, const SceneKey& spec) const;
  [[nodiscard]] std::optional<double> in_range(double value, const toml::node& node,
                                               const SceneKey& spec);
  [[nodiscard]] bool is_secret(std::string_view key) const {
    return section_ == "network" && key == "key";
  }
  void wrong_type(const toml::node& node, const SceneKey& spec);
  void refuse_unknown_keys();
  void add(const toml::source_region& where, std::string sentence);

  const toml::table* table_;
  std::string section_;
  std::filesystem::path folder_;
  const SceneVocabulary* vocabulary_;
  std::vector<SceneProblem>* problems_;
};

}  // namespace reckon::peer
