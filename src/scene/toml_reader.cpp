// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/scene/toml_reader.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <stdexcept>
#include <system_error>
#include <tuple>
#include <utility>

#include "reckon/haptics/input_files/input_file.hpp"
#include "reckon/haptics/input_files/load_progress.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/notation/jitter_text.hpp"
#include "reckon/peer/notation/nearest_word.hpp"
#include "reckon/peer/scene/renamed_keys.hpp"
#include "reckon/peer/scene/toml_bounds.hpp"

namespace reckon::peer {
namespace {

namespace fs = std::filesystem;

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

/// The three parts of "0 0 10 cm", each with the unit; empty if there are not three numbers.
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

toml::table parse_toml(std::string_view text, const std::string& file) {
  check_text_bounds(text, file);
  try {
    return toml::parse(text, file);
  } catch (const toml::parse_error& error) {
    const auto& where = error.source().begin;
    throw SceneFileError(file, {{where.line, where.column, std::string(error.description())}});
  }
}

void throw_problems(const std::string& file, std::vector<SceneProblem> problems) {
  if (problems.empty()) return;
  std::ranges::stable_sort(problems, {}, [](const SceneProblem& problem) {
    return std::tuple(problem.line, problem.column);
  });
  if (problems.size() == kMostProblems)
    problems.push_back({problems.back().line, problems.back().column,
                        "fix these first; further problems were not checked"});
  throw SceneFileError(file, std::move(problems));
}

bool is_within(const fs::path& file, const fs::path& folder) {
  const fs::path way = file.lexically_relative(fs::absolute(folder).lexically_normal());
  return !way.empty() && way.is_relative() && *way.begin() != ".." && way != ".";
}

std::string read_bytes(const fs::path& path, std::size_t most_octets) {
  try {
    return haptics::read_input_file(path, most_octets);
  } catch (const std::invalid_argument& error) {
    throw SceneFileError(path.string(), {{0, 0, error.what()}});
  }
}

TomlReader::TomlReader(const toml::table& table, std::string section, fs::path folder,
                       const SceneVocabulary& vocabulary, std::vector<SceneProblem>& problems)
    : table_(&table),
      section_(std::move(section)),
      folder_(std::move(folder)),
      vocabulary_(&vocabulary),
      problems_(&problems) {
  haptics::LoadProgress::look();
  refuse_unknown_keys();
}

void TomlReader::refuse_unknown_keys() {
  std::vector<std::string_view> known;
  for (const SceneKey& row : vocabulary_->keys) {
    if (row.section == section_) known.push_back(row.key);
  }
  for (const auto& [key, node] : *table_) {
    if (std::ranges::find(known, key.str()) != known.end()) continue;
    if (problems_->size() >= kMostProblems) return;
    const auto renamed = std::ranges::find_if(renamed_keys(), [&, name = key.str()](auto& one) {
      return one.section == section_ && one.key == name;
    });
    if (renamed != renamed_keys().end()) {
      add(key.source(), renamed->sentence(*table_));
      continue;
    }
    const auto nearest = nearest_word(key.str(), known);
    std::string sentence =
        nearest.empty() ? fmt::format("unknown key '{}': {} takes {}", key.str(),
                                      section_name(section_), fmt::join(known, ", "))
                        : fmt::format("unknown key '{}' (did you mean '{}'?)", key.str(), nearest);
    if (section_ == "object" && node.is_table())
      sentence += "; a custom effect exists only in its own program";
    add(key.source(), std::move(sentence));
  }
}

void TomlReader::add(const toml::source_region& where, std::string sentence) {
  if (problems_->size() >= kMostProblems) return;
  problems_->push_back({where.begin.line, where.begin.column, std::move(sentence)});
}

void TomlReader::problem(std::string_view key, std::string sentence) {
  const auto found = table_->find(key);
  add(found != table_->end() ? found->second.source() : table_->source(), std::move(sentence));
}

void TomlReader::problem_at(std::string_view path, std::string sentence) {
  const toml::node* found = nullptr;
  for (std::size_t end = path.size(); found == nullptr && end != std::string_view::npos;
       end = path.substr(0, end).find_last_of(".["))
    found = table_->at_path(path.substr(0, end)).node();
  add(found != nullptr ? found->source() : table_->source(), std::move(sentence));
}

void TomlReader::require(std::string_view key) {
  if (has(key)) return;
  const auto is_known = [&](std::string_view name) {
    return std::ranges::any_of(vocabulary_->keys, [&](const SceneKey& row) {
      return row.section == section_ && row.key == name;
    });
  };
  const bool misspelt = std::ranges::any_of(*table_, [&](const auto& entry) {
    return !is_known(entry.first.str()) &&
           !nearest_word(entry.first.str(), std::array{key}).empty();
  });
  if (misspelt) return;  // already reported
  problem(key, fmt::format("{} needs '{}': {}", section_name(section_), key, spec(key).sentence));
}

const SceneKey& TomlReader::spec(std::string_view key) const {
  const auto& keys = vocabulary_->keys;
  const auto found = std::ranges::find_if(
      keys, [&](const SceneKey& row) { return row.section == section_ && row.key == key; });
  assert(found != keys.end());
  return *found;
}

void TomlReader::wrong_type(const toml::node& node, const SceneKey& spec) {
  add(node.source(),
      fmt::format("'{}' is {}; it needs {}", spec.key, type_name(node), describe_kind(spec)));
}

std::optional<double> TomlReader::in_range(double value, const toml::node& node,
                                           const SceneKey& spec) {
  if (value >= spec.least && value <= spec.most) return value;
  add(node.source(), fmt::format("'{}' is {}; it must be {}", spec.key,
                                 format_quantity(value, spec.unit), range_text(spec)));
  return std::nullopt;
}

Quantity TomlReader::parse(const std::string& text, const SceneKey& spec) const {
  if (spec.share_of.empty()) return parse_quantity(text, spec.unit);
  // An invalid value of the other key is reported where that key is read.
  std::vector<SceneProblem> reported;
  std::chrono::nanoseconds whole{0};
  TomlReader(*table_, section_, folder_, *vocabulary_, reported).read(spec.share_of, whole);
  if (!reported.empty()) return {};
  const JitterText jitter = read_jitter(text, whole, fmt::format("{} = \"80 ms\"", spec.share_of));
  return {pdu::to_seconds(jitter.jitter), jitter.error};
}

std::optional<double> TomlReader::quantity(const toml::node& node, const SceneKey& spec) {
  if (const auto* text = node.as_string()) {
    const Quantity parsed = parse(text->get(), spec);
    if (parsed.good()) return in_range(parsed.value, node, spec);
    add(node.source(), fmt::format("'{}': {}", spec.key, parsed.error));
    return std::nullopt;
  }
  // Not value<double>(): it fails for a whole number without an exact double.
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

void TomlReader::read(std::string_view key, std::chrono::nanoseconds& target) {
  const toml::node* node = table_->get(key);
  if (node == nullptr) return;
  if (const auto value = quantity(*node, spec(key))) target = to_nanoseconds(*value);
}

void TomlReader::read(std::string_view key, bool& target) {
  const toml::node* node = table_->get(key);
  if (node == nullptr) return;
  if (!node->is_boolean()) return wrong_type(*node, spec(key));
  target = node->as_boolean()->get();
}

bool TomlReader::takes_number(std::string_view key) const {
  const toml::node* node = table_->get(key);
  return node != nullptr && node->is_integer() && spec(key).most > 0;
}

const std::string* TomlReader::text(std::string_view key) {
  const toml::node* node = table_->get(key);
  if (node == nullptr) return nullptr;
  if (!node->is_string()) wrong_type(*node, spec(key));
  return node->is_string() ? &node->as_string()->get() : nullptr;
}

void TomlReader::read(std::string_view key, std::string& target) {
  if (const std::string* said = text(key)) target = *said;
}

void TomlReader::texts(std::string_view key, const std::function<void(const std::string&)>& take) {
  const toml::node* node = table_->get(key);
  if (node != nullptr && node->is_string()) return take(node->as_string()->get());
  each_text(key, take);
}

void TomlReader::each_text(std::string_view key,
                           const std::function<void(const std::string&)>& take) {
  const toml::node* node = table_->get(key);
  if (node == nullptr) return;
  const auto* array = node->as_array();
  const bool all_texts = array != nullptr && std::ranges::all_of(*array, [](const auto& element) {
                           return element.is_string();
                         });
  if (!all_texts) return wrong_type(*node, spec(key));
  for (const toml::node& element : *array) {
    try {
      take(element.as_string()->get());
    } catch (const std::invalid_argument& error) {
      add(element.source(), fmt::format("'{}': {}", key, error.what()));
    }
  }
}

// A file that cannot be opened is a problem; so is a device file, which may be endless.
void TomlReader::read(std::string_view key, fs::path& target) {
  const std::string* said = text(key);
  if (said == nullptr || (vocabulary_->is_confined && is_secret(key))) return;
  if (said->empty()) {
    return problem(key, fmt::format("'{}' is empty; write a file name", key));
  }
  const fs::path path = fs::absolute(folder_ / *said).lexically_normal();
  if (vocabulary_->is_confined && !is_within(path, folder_))
    return problem(key, fmt::format("'{}': {} is outside the folder of the scene, which a received "
                                    "scene may not read",
                                    key, *said));
  std::error_code error;
  if (!fs::is_regular_file(path, error) || ::access(path.c_str(), R_OK) != 0) {
    return problem(key, fmt::format("'{}': cannot read {}; relative names start at the folder of "
                                    "the scene file",
                                    key, path.string()));
  }
  if (vocabulary_->files != nullptr && !is_secret(key)) vocabulary_->files->push_back(path);
  target = path;
}

std::optional<std::int64_t> TomlReader::whole_number(std::string_view key) {
  const toml::node* node = table_->get(key);
  if (node == nullptr) return std::nullopt;
  const SceneKey& row = spec(key);
  if (row.kind == KeyKind::number) {
    const auto value = quantity(*node, row);
    return value ? std::optional(static_cast<std::int64_t>(*value)) : std::nullopt;
  }
  if (!node->is_integer()) {
    wrong_type(*node, row);
    return std::nullopt;
  }
  const std::int64_t value = node->as_integer()->get();
  if (!in_range(static_cast<double>(value), *node, row)) return std::nullopt;
  return value;
}

void TomlReader::read(std::string_view key, Eigen::Vector3d& target) {
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

std::optional<std::string_view> TomlReader::choice(std::string_view key) {
  const std::string* word = text(key);
  if (word == nullptr) return std::nullopt;
  const SceneKey& row = spec(key);
  if (std::ranges::find(row.words, *word) != row.words.end()) return *word;
  const auto nearest = nearest_word(*word, row.words);
  const std::string hint =
      nearest.empty() ? std::string() : fmt::format(" (did you mean \"{}\"?)", nearest);
  problem(key, fmt::format("'{}' is \"{}\"{}; it needs {}", key, *word, hint, describe_kind(row)));
  return std::nullopt;
}

TomlReader TomlReader::inside(const toml::table& table, std::string_view key) {
  return {table, fmt::format("{}{}{}", section_, section_.empty() ? "" : ".", key), folder_,
          *vocabulary_, *problems_};
}

std::optional<TomlReader> TomlReader::table(std::string_view key) {
  const toml::node* node = table_->get(key);
  if (node == nullptr) return std::nullopt;
  if (!node->is_table()) {
    wrong_type(*node, spec(key));
    return std::nullopt;
  }
  return inside(*node->as_table(), key);
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
  if (array->size() > kMostTables) {
    problem(key, fmt::format("{} tables '{}'; write {} at most", array->size(), key, kMostTables));
    return found;
  }
  for (const toml::node& element : *array) found.push_back(inside(*element.as_table(), key));
  return found;
}

}  // namespace reckon::peer
