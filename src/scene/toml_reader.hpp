// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Reads one TOML table against the list of scene keys and collects what is wrong with it. Private
// to the scene reader: nothing else sees toml++.
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

#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/peer/scene/scene_keys.hpp"
#include "reckon/peer/scene/scene_words.hpp"
#include "reckon/peer/scene/units.hpp"

namespace reckon::peer {

/// A view of one table of a file. Constructing it refuses the keys that are unknown or renamed;
/// each read leaves its target as it is when the key is absent or bad, and a bad one becomes a
/// problem.
class TomlReader {
 public:
  /// `table` and `problems` outlive the reader; `section` as in scene_keys().
  TomlReader(const toml::table& table, std::string section, std::filesystem::path folder,
             std::vector<SceneProblem>& problems);

  [[nodiscard]] bool has(std::string_view key) const { return table_->contains(key); }

  void number(std::string_view key, double& target);
  void read(std::string_view key, double& target) { number(key, target); }
  void read(std::string_view key, std::chrono::nanoseconds& target);
  void read(std::string_view key, bool& target);
  void read(std::string_view key, std::string& target);
  /// The same for what has no value while the key is absent or bad.
  template <class T>
  requires std::same_as<T, bool> || std::same_as<T, std::string>
  void read(std::string_view key, std::optional<T>& target) {
    T value{};
    const std::size_t before = problems_->size();
    read(key, value);
    if (has(key) && problems_->size() == before) target = value;
  }
  void read(std::string_view key, Eigen::Vector3d& target);
  /// A file that can be opened; a name that is not absolute starts at the folder of the scene.
  void read(std::string_view key, std::filesystem::path& target);

  /// A key that may have a unit takes a quantity, cut to whole ones.
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

  /// Gives each text of the list under `key` to `take`; one for which that throws
  /// std::invalid_argument becomes a problem where it stands.
  void each_text(std::string_view key, const std::function<void(const std::string&)>& take);

  /// The same where a text may stand without a list around it.
  void texts(std::string_view key, const std::function<void(const std::string&)>& take);

  /// The table under `key`, nothing when absent or no table (a problem).
  [[nodiscard]] std::optional<TomlReader> table(std::string_view key);
  /// The tables under `key`: [[key]] or [{..}, {..}].
  [[nodiscard]] std::vector<TomlReader> tables(std::string_view key);

  /// Adds a problem when `key` is absent.
  void require(std::string_view key);
  /// Adds a problem at `key`, or at the table when `key` is absent.
  void problem(std::string_view key, std::string sentence);
  /// The same at the end of a path such as "aoim.tier[1].kept", or at as much of it as there is.
  void problem_at(std::string_view path, std::string sentence);

 private:
  [[nodiscard]] const SceneKey& spec(std::string_view key) const;
  [[nodiscard]] std::optional<std::int64_t> whole_number(std::string_view key);
  /// Whether the key has words, takes numbers too, and the file gives one.
  [[nodiscard]] bool takes_number(std::string_view key) const;
  /// The text of a key; null when absent or not one.
  [[nodiscard]] const std::string* text(std::string_view key);
  /// One of the words of the key's list.
  [[nodiscard]] std::optional<std::string_view> choice(std::string_view key);
  [[nodiscard]] TomlReader inside(const toml::table& table, std::string_view key);
  [[nodiscard]] std::optional<double> quantity(const toml::node& node, const SceneKey& spec);
  /// What the text of a number says.
  [[nodiscard]] Quantity parse(const std::string& text, const SceneKey& spec) const;
  [[nodiscard]] std::optional<double> in_range(double value, const toml::node& node,
                                               const SceneKey& spec);
  void wrong_type(const toml::node& node, const SceneKey& spec);
  void refuse_unknown_keys();
  void add(const toml::source_region& where, std::string sentence);

  const toml::table* table_;
  std::string section_;
  std::filesystem::path folder_;
  std::vector<SceneProblem>* problems_;
};

}  // namespace reckon::peer
