// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/scene/toml_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <utility>

#include "reckon/peer/scene/nearest_word.hpp"
#include "reckon/peer/scene/units.hpp"

namespace reckon::peer {
namespace {

/// "[hand]", "[[object]]" or "the file", as a person would name the place.
std::string name_of(std::string_view section) {
  if (section.empty()) return "the file";
  const bool repeated = std::ranges::any_of(scene_keys(), [&](const SceneKey& row) {
    return row.kind == KeyKind::tables &&
           (row.section.empty() ? row.key : row.section + '.' + row.key) == section;
  });
  return fmt::format(fmt::runtime(repeated ? "[[{}]]" : "[{}]"), section);
}

std::string_view type_name(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return "an array";
    case toml::node_type::string:
      return "a text";
    case toml::node_type::boolean:
      return "true or false";
    case toml::node_type::integer:
    case toml::node_type::floating_point:
      return "a number";
    default:
      return "a date or time";
  }
}

std::string range_text(const SceneKey& spec) {
  const auto shown = [&](double value) { return format_quantity(value, spec.unit); };
  return fmt::format("{} to {}", shown(spec.least), shown(spec.most));
}

/// The words of a choice, one by one.
std::vector<std::string_view> words_of(const SceneKey& spec) {
  std::vector<std::string_view> words;
  for (std::string_view rest = spec.words; !rest.empty();) {
    const auto end = std::min(rest.find(' '), rest.size());
    words.push_back(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return words;
}

/// The three texts of "0 0 10 cm", each with the unit; empty when there are not three numbers.
std::vector<std::string> split_point(std::string_view text) {
  std::vector<std::string> words;
  while (words.size() < 3) {
    const auto begin = text.find_first_not_of(" \t");
    if (begin == std::string_view::npos) return {};
    text.remove_prefix(begin);
    if (text.find_first_of("+-.0123456789") != 0) return {};
    const auto end = std::min(text.find_first_of(" \t"), text.size());
    words.emplace_back(text.substr(0, end));
    text.remove_prefix(end);
  }
  for (std::string& word : words) word += text;
  return words;
}

}  // namespace

TomlReader::TomlReader(const toml::table& table, std::string section,
                       std::vector<SceneProblem>& problems)
    : table_(&table), section_(std::move(section)), problems_(&problems) {
  refuse_unknown_keys();
}

void TomlReader::refuse_unknown_keys() {
  std::vector<std::string_view> known;
  for (const SceneKey& row : scene_keys()) {
    if (row.section == section_) known.push_back(row.key);
  }
  for (const auto& [key, node] : *table_) {
    if (std::ranges::find(known, key.str()) != known.end()) continue;
    const auto nearest = nearest_word(key.str(), known);
    add(key.source(),
        nearest.empty() ? fmt::format("unknown key '{}': {} takes {}", key.str(), name_of(section_),
                                      fmt::join(known, ", "))
                        : fmt::format("unknown key '{}' (did you mean '{}'?)", key.str(), nearest));
  }
}

void TomlReader::add(const toml::source_region& where, std::string sentence) {
  problems_->push_back({where.begin.line, where.begin.column, std::move(sentence)});
}

void TomlReader::problem(std::string_view key, std::string sentence) {
  const auto found = table_->find(key);
  add(found != table_->end() ? found->second.source() : table_->source(), std::move(sentence));
}

void TomlReader::require(std::string_view key) {
  if (has(key)) return;
  const bool misspelt = std::ranges::any_of(*table_, [&](const auto& entry) {
    return !nearest_word(entry.first.str(), std::array{key}).empty();
  });
  if (misspelt) return;  // already told
  problem(key, fmt::format("{} needs '{}': {}", name_of(section_), key, spec(key).sentence));
}

const SceneKey& TomlReader::spec(std::string_view key) const {
  const auto& keys = scene_keys();
  const auto found = std::ranges::find_if(
      keys, [&](const SceneKey& row) { return row.section == section_ && row.key == key; });
  assert(found != keys.end());
  return *found;
}

void TomlReader::wrong_type(const toml::node& node, const SceneKey& spec) {
  add(node.source(),
      fmt::format("'{}' is {}; it wants {}", spec.key, type_name(node), describe_kind(spec)));
}

std::optional<double> TomlReader::in_range(double value, const toml::node& node,
                                           const SceneKey& spec) {
  if (value >= spec.least && value <= spec.most) return value;
  add(node.source(), fmt::format("'{}' is {}; it must be {}", spec.key,
                                 format_quantity(value, spec.unit), range_text(spec)));
  return std::nullopt;
}

std::optional<double> TomlReader::quantity(const toml::node& node, const SceneKey& spec) {
  if (const auto* text = node.as_string()) {
    const Quantity parsed = parse_quantity(text->get(), spec.unit);
    if (parsed.good()) return in_range(parsed.value, node, spec);
    add(node.source(), fmt::format("'{}': {}", spec.key, parsed.error));
    return std::nullopt;
  }
  // Not value<double>(): it has none for a whole number that a double must round.
  if (const auto* whole = node.as_integer())
    return in_range(static_cast<double>(whole->get()), node, spec);
  if (const auto* number = node.as_floating_point()) return in_range(number->get(), node, spec);
  wrong_type(node, spec);
  return std::nullopt;
}

void TomlReader::number(std::string_view key, double& target) {
  const toml::node* node = table_->get(key);
  if (node == nullptr) return;
  if (const auto value = quantity(*node, spec(key))) target = *value;
}

void TomlReader::duration(std::string_view key, std::chrono::nanoseconds& target) {
  const toml::node* node = table_->get(key);
  if (node == nullptr) return;
  if (const auto value = quantity(*node, spec(key))) target = to_nanoseconds(*value);
}

void TomlReader::boolean(std::string_view key, bool& target) {
  const toml::node* node = table_->get(key);
  if (node == nullptr) return;
  if (!node->is_boolean()) return wrong_type(*node, spec(key));
  target = node->as_boolean()->get();
}

bool TomlReader::text(std::string_view key, std::string& target) {
  const toml::node* node = table_->get(key);
  if (node == nullptr) return false;
  if (!node->is_string()) {
    wrong_type(*node, spec(key));
    return false;
  }
  target = node->as_string()->get();
  return true;
}

std::optional<std::int64_t> TomlReader::whole_number(std::string_view key) {
  const toml::node* node = table_->get(key);
  if (node == nullptr) return std::nullopt;
  const SceneKey& row = spec(key);
  if (!node->is_integer()) {
    wrong_type(*node, row);
    return std::nullopt;
  }
  const std::int64_t value = node->as_integer()->get();
  if (!in_range(static_cast<double>(value), *node, row)) return std::nullopt;
  return value;
}

void TomlReader::point(std::string_view key, Eigen::Vector3d& target) {
  const toml::node* node = table_->get(key);
  if (node == nullptr) return;
  const SceneKey& row = spec(key);
  Eigen::Vector3d point = target;
  if (const auto* array = node->as_array(); array != nullptr && array->size() == 3) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto value = quantity(*array->get(i), row);
      if (!value) return;
      point[static_cast<Eigen::Index>(i)] = *value;
    }
    target = point;
    return;
  }
  if (!node->is_string()) return wrong_type(*node, row);
  const auto words = split_point(node->as_string()->get());
  if (words.empty()) return wrong_type(*node, row);
  for (std::size_t i = 0; i < 3; ++i) {
    const Quantity parsed = parse_quantity(words[i], row.unit);
    if (!parsed.good()) return add(node->source(), fmt::format("'{}': {}", key, parsed.error));
    const auto value = in_range(parsed.value, *node, row);
    if (!value) return;
    point[static_cast<Eigen::Index>(i)] = *value;
  }
  target = point;
}

std::optional<std::string> TomlReader::choice(std::string_view key) {
  const toml::node* node = table_->get(key);
  if (node == nullptr) return std::nullopt;
  const SceneKey& row = spec(key);
  if (!node->is_string()) {
    wrong_type(*node, row);
    return std::nullopt;
  }
  const std::string& word = node->as_string()->get();
  if (!word.empty() && (' ' + row.words + ' ').find(' ' + word + ' ') != std::string::npos) {
    return word;
  }
  const auto nearest = nearest_word(word, words_of(row));
  const std::string hint =
      nearest.empty() ? std::string() : fmt::format(" (did you mean \"{}\"?)", nearest);
  add(node->source(),
      fmt::format("'{}' is \"{}\"{}; it wants {}", key, word, hint, describe_kind(row)));
  return std::nullopt;
}

std::optional<TomlReader> TomlReader::table(std::string_view key) {
  const toml::node* node = table_->get(key);
  if (node == nullptr) return std::nullopt;
  if (!node->is_table()) {
    wrong_type(*node, spec(key));
    return std::nullopt;
  }
  const std::string path =
      section_.empty() ? std::string(key) : fmt::format("{}.{}", section_, key);
  return TomlReader(*node->as_table(), path, *problems_);
}

std::vector<TomlReader> TomlReader::tables(std::string_view key) {
  std::vector<TomlReader> found;
  const toml::node* node = table_->get(key);
  if (node == nullptr) return found;
  const auto* array = node->as_array();
  if (array == nullptr ||
      !std::ranges::all_of(*array, [](const auto& e) { return e.is_table(); })) {
    wrong_type(*node, spec(key));
    return found;
  }
  const std::string path =
      section_.empty() ? std::string(key) : fmt::format("{}.{}", section_, key);
  for (const toml::node& element : *array) {
    found.emplace_back(*element.as_table(), path, *problems_);
  }
  return found;
}

}  // namespace reckon::peer
