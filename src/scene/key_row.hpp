// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// One row for each key of a section: its name, the member that it fills, unit, range and sentence.
// The default is the struct's initial value. Private to the scene reader.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <concepts>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/scene/scene_words.hpp"
#include "reckon/peer/scene/toml_reader.hpp"
#include "reckon/peer/scene/units.hpp"

namespace reckon::peer {

/// A value as written in a file.
struct Written {
  KeyKind kind;
  std::string text;
};

inline Written written(double value, std::string_view unit) {
  return {KeyKind::number, format_quantity(value, unit)};
}

inline Written written(std::chrono::nanoseconds value, std::string_view unit) {
  return written(pdu::to_seconds(value), unit);
}

/// A whole number with a unit is a quantity.
template <std::integral T>
Written written(T value, std::string_view unit) {
  if (!unit.empty()) return written(static_cast<double>(value), unit);
  return {KeyKind::integer, fmt::format("{}", value)};
}

inline Written written(bool value, std::string_view) {
  return {KeyKind::boolean, value ? "true" : "false"};
}

/// None: the sentence states the effect of absence.
inline Written written(const std::optional<bool>& value, std::string_view) {
  return {KeyKind::boolean, !value ? "" : *value ? "true" : "false"};
}

inline Written written(const std::string& value, std::string_view) {
  return {KeyKind::text, value};
}

/// None is the only possible default.
inline Written written(const std::vector<std::string>&, std::string_view) {
  return {KeyKind::texts, ""};
}

inline Written written(const std::filesystem::path& value, std::string_view) {
  return {KeyKind::text, value.string()};
}

inline Written written(const Eigen::Vector3d& value, std::string_view) {
  const Eigen::Vector3d v = value + Eigen::Vector3d::Zero();  // -0 is 0
  return {KeyKind::point, fmt::format("[{:.9g}, {:.9g}, {:.9g}]", v.x(), v.y(), v.z())};
}

template <HasWords T>
Written written(const T& value, std::string_view) {
  return {KeyKind::choice, std::string(word_of(value))};
}

/// Range of a number.
struct Range {
  std::string_view unit;
  double least, most;  ///< [unit], inclusive
  bool has_default;
};

/// From `least` to `most` [unit].
constexpr Range within(std::string_view unit, double least, double most) {
  return {unit, least, most, true};
}

/// The same for a key that declares a measured value, and therefore has no default.
constexpr Range declared(std::string_view unit, double least, double most) {
  return {unit, least, most, false};
}

/// A member of a member.
template <class Outer, class Inner>
constexpr auto in(Outer outer, Inner inner) {
  return [=](auto& of) -> auto& { return std::invoke(inner, std::invoke(outer, of)); };
}

/// Offset of a member in its struct [octets].
struct MemberPlace {
  std::size_t offset, size, alignment;
};

/// Result of `get` for an S: a reference is filled, a value is not.
template <class S, class Get>
using Got = std::invoke_result_t<const Get&, S&>;
template <class S, class Get>
using ValueOf = std::remove_cvref_t<Got<S, Get>>;

/// Types that must have a range.
template <class T>
concept Measured = std::same_as<T, double> || std::same_as<T, std::chrono::nanoseconds> ||
    std::same_as<T, Eigen::Vector3d> ||(std::integral<T> && !std::same_as<T, bool>);

template <class T>
inline constexpr bool kIsVector = false;
template <class T>
inline constexpr bool kIsVector<std::vector<T>> = true;

template <class S>
struct Section;

/// A key of a section whose values fill an S. `get` is a pointer to a member, or a function of an
/// S& that returns a reference to the value to fill. If it returns a value, this only defines type
/// and default: the section's check reads such a key, because it depends on others.
template <class S>
class Row {
 public:
  /// A number or a point.
  template <class Get>
  requires Measured<ValueOf<S, Get>> Row(std::string_view key, Get get, const Range& range,
                                         std::string_view sentence) {
    set(key, get, range, sentence);
  }

  /// A text, a boolean, or one of the words of its type.
  template <class Get>
  requires(!Measured<ValueOf<S, Get>>)
      Row(std::string_view key, Get get, std::string_view sentence) {
    set(key, get, within("", 0, 0), sentence);
    if constexpr (HasWords<ValueOf<S, Get>>) key_.words = words_of<ValueOf<S, Get>>();
  }

  /// One of the words of its type, or a whole number for a value without a word.
  template <class Get>
  requires HasWords<ValueOf<S, Get>> Row(std::string_view key, Get get, const Range& range,
                                         std::string_view sentence) {
    set(key, get, range, sentence);
    key_.words = words_of<ValueOf<S, Get>>();
  }

  /// A table with the keys `inside`; if `get` gives a vector, any number of tables.
  template <class Get, class Inner>
  Row(std::string_view key, Get get, const Section<Inner>& inside, std::string_view sentence)
      : inside_(inside.keys(std::string(key))) {
    constexpr bool kMany = kIsVector<ValueOf<S, Get>>;
    key_.key = key;
    key_.kind = kMany ? KeyKind::tables : KeyKind::table;
    key_.sentence = sentence;
    if constexpr (kFills<Get> && kMany) {
      S whole{};
      places_ = {place(std::invoke(get, whole), whole)};
      read_ = [key = key_.key, get, inside](TomlReader& table, S& out) {
        for (TomlReader& one : table.tables(key)) {
          inside.read(one, std::invoke(get, out).emplace_back());
        }
      };
    } else if constexpr (kFills<Get>) {
      S whole{};
      const std::size_t offset = place(std::invoke(get, whole), whole).offset;
      places_ = inside.places();
      for (MemberPlace& member : places_) member.offset += offset;
      read_ = [key = key_.key, get, inside](TomlReader& table, S& out) {
        if (auto one = table.table(key)) inside.read(*one, std::invoke(get, out));
      };
    }
  }

  /// The same key without a default, if its sentence or its section states the effect of absence.
  [[nodiscard]] Row without_default() const {
    Row row = *this;
    row.key_.standard.clear();
    return row;
  }

  /// The same key, which also accepts a percentage of another one, a time of the same section.
  [[nodiscard]] Row or_share_of(std::string_view key) const {
    Row row = *this;
    row.key_.share_of = key;
    return row;
  }

  /// Leaves `out` unchanged if the key is absent or invalid; an invalid one becomes a problem.
  void read(TomlReader& table, S& out) const {
    if (read_ && table.has(key_.key)) read_(table, out);
  }

  [[nodiscard]] const SceneKey& key() const { return key_; }
  /// The keys of its table; their section names begin with this key.
  [[nodiscard]] const std::vector<SceneKey>& inside() const { return inside_; }
  /// The members of an S that the key, or the keys of its table, fill.
  [[nodiscard]] const std::vector<MemberPlace>& places() const { return places_; }

 private:
  template <class Get>
  static constexpr bool kFills = std::is_lvalue_reference_v<Got<S, Get>>;

  template <class Get>
  void set(std::string_view key, Get get, const Range& range, std::string_view sentence) {
    S silent{};
    const Written standard = written(ValueOf<S, Get>(std::invoke(get, silent)), range.unit);
    key_.key = key;
    key_.kind = standard.kind;
    key_.unit = range.unit;
    key_.least = range.least;
    key_.most = range.most;
    if (range.has_default) key_.standard = standard.text;
    key_.sentence = sentence;
    if constexpr (kFills<Get>) {
      places_ = {place(std::invoke(get, silent), silent)};
      read_ = [key = key_.key, get](TomlReader& table, S& out) {
        table.read(key, std::invoke(get, out));
      };
    }
  }

  template <class T>
  static MemberPlace place(const T& member, const S& whole) {
    const auto* begin = reinterpret_cast<const std::byte*>(&whole);
    const auto* at = reinterpret_cast<const std::byte*>(&member);
    return {static_cast<std::size_t>(at - begin), sizeof(T), alignof(T)};
  }

  SceneKey key_;
  std::vector<SceneKey> inside_;
  std::vector<MemberPlace> places_;
  std::function<void(TomlReader&, S&)> read_;
};

/// The keys of one kind of table.
template <class S>
struct Section {
  std::vector<Row<S>> rows;
  /// Checks beyond single rows, called after all were read; may be null.
  void (*check)(TomlReader& table, S& out) = nullptr;
  /// Adds keys of a separate list; may be null.
  void (*add_more)(std::vector<SceneKey>& keys) = nullptr;

  void read(TomlReader& table, S& out) const {
    for (const Row<S>& row : rows) row.read(table, out);
    if (check != nullptr) check(table, out);
  }

  /// The keys of the section `name`, then the keys of its tables.
  [[nodiscard]] std::vector<SceneKey> keys(const std::string& name) const {
    std::vector<SceneKey> keys;
    const auto add = [&](SceneKey key) {
      key.section = name + (name.empty() || key.section.empty() ? "" : ".") + key.section;
      keys.push_back(std::move(key));
    };
    for (const Row<S>& row : rows) add(row.key());
    if (add_more != nullptr) add_more(keys);
    for (const Row<S>& row : rows) std::ranges::for_each(row.inside(), add);
    return keys;
  }

  /// The members of an S that its keys fill, between entries of size 0 for the begin and the end of
  /// S.
  [[nodiscard]] std::vector<MemberPlace> places() const {
    std::vector<MemberPlace> places = {{0, 0, alignof(S)}, {sizeof(S), 0, alignof(S)}};
    for (const Row<S>& row : rows) {
      places.insert(places.end(), row.places().begin(), row.places().end());
    }
    return places;
  }
};

}  // namespace reckon::peer
