// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// One row for each key of a section: its name, the member that it fills, unit, range and sentence.
// The default is the struct's initial value. Templates only bind a member to its row; the rest of
// the code handles values by address. Private to the scene reader.
#pragma once

#include <array>
#include <chrono>
#include <concepts>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "reckon/peer/scene/scene_words.hpp"
#include "reckon/peer/scene/toml_reader.hpp"

namespace reckon::peer {

/// A value as written in a file.
struct Written {
  KeyKind kind;
  std::string text;
};

[[nodiscard]] Written written(double value, std::string_view unit);
[[nodiscard]] Written written(std::chrono::nanoseconds value, std::string_view unit);
/// A whole number with a unit is a quantity.
[[nodiscard]] Written written_whole(double value, const std::string& digits, std::string_view unit);
[[nodiscard]] Written written(bool value, std::string_view unit);
/// None: the sentence states the effect of absence.
[[nodiscard]] Written written(const std::optional<bool>& value, std::string_view unit);
[[nodiscard]] Written written(const std::string& value, std::string_view unit);
/// None is the only possible default.
[[nodiscard]] Written written(const std::vector<std::string>& value, std::string_view unit);
[[nodiscard]] Written written(const std::filesystem::path& value, std::string_view unit);
[[nodiscard]] Written written(const Eigen::Vector3d& value, std::string_view unit);

template <std::integral T>
requires(!std::same_as<T, bool>) Written written(T value, std::string_view unit) {
  return written_whole(static_cast<double>(value), std::to_string(value), unit);
}

Written written(const HasWords auto& value, std::string_view) {
  return {KeyKind::choice, std::string(word_of(value))};
}

/// How values of one type are read from a file and written to one.
struct ValueType {
  std::size_t size, alignment;  ///< [octets]
  Written (*write)(const void* value, std::string_view unit);
  void (*read)(TomlReader& table, std::string_view key, void* value);  ///< null: not from one key
  std::vector<std::string_view> (*words)();                            ///< null: it has none
};

template <class T>
constexpr ValueType value_type() {
  ValueType type{sizeof(T), alignof(T),
                 [](const void* value, std::string_view unit) {
                   return written(*static_cast<const T*>(value), unit);
                 },
                 nullptr, nullptr};
  if constexpr (requires(TomlReader & table, T & value) { table.read("", value); })
    type.read = [](TomlReader& table, std::string_view key, void* value) {
      table.read(key, *static_cast<T*>(value));
    };
  if constexpr (HasWords<T>) type.words = words_of<T>;
  return type;
}

template <class T>
inline constexpr ValueType kValueType = value_type<T>();

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

/// The value of `whole` at a pointer to a member, or by a function.
template <class Get, class S>
constexpr decltype(auto) value_in(const Get& get, S& whole) {
  if constexpr (std::is_member_object_pointer_v<Get>)
    return (whole.*get);
  else
    return get(whole);
}

/// A member of a member.
template <class Outer, class Inner>
struct MemberPath {
  Outer outer;
  Inner inner;
  constexpr auto& operator()(auto& of) const { return value_in(inner, value_in(outer, of)); }
};

template <class Outer, class Inner>
constexpr MemberPath<Outer, Inner> in(Outer outer, Inner inner) {
  return {outer, inner};
}

/// Whether a `get` finds its value at the same place in each struct.
template <class Get>
inline constexpr bool kIsFixed = std::is_member_object_pointer_v<Get>;
template <class Outer, class Inner>
inline constexpr bool kIsFixed<MemberPath<Outer, Inner>> = kIsFixed<Outer>&& kIsFixed<Inner>;

/// Offset of a member in its struct [octets].
struct MemberPlace {
  std::size_t offset, size, alignment;
};

/// Result of `get` for an S: a reference is filled, a value is not.
template <class S, class Get>
using Got = decltype(value_in(std::declval<const Get&>(), std::declval<S&>()));
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

/// An S with its initial values.
template <class S>
const S& initial() {
  static const S whole{};
  return whole;
}

/// Finds a value in its struct: at an offset, or by a small function object.
class Finder {
 public:
  /// Finds nothing.
  Finder() = default;
  Finder(const void* whole, const void* value)
      : Finder(static_cast<std::size_t>(static_cast<const std::byte*>(value) -
                                        static_cast<const std::byte*>(whole)),
               [](const std::byte* offset, void* in) -> void* {
                 return static_cast<std::byte*>(in) +
                        *std::launder(reinterpret_cast<const std::size_t*>(offset));
               }) {}
  /// @param find calls the copy of `get` that it receives
  template <class Get>
  Finder(const Get& get, void* (*find)(const std::byte* get, void* whole)) : find_(find) {
    static_assert(sizeof(Get) <= kRoom && std::is_trivially_copyable_v<Get>);
    ::new (get_.data()) Get(get);
  }

  [[nodiscard]] explicit operator bool() const { return find_ != nullptr; }
  [[nodiscard]] void* operator()(void* whole) const { return find_(get_.data(), whole); }

 private:
  static constexpr std::size_t kRoom = 16;
  alignas(std::max_align_t) std::array<std::byte, kRoom> get_{};
  void* (*find_)(const std::byte* get, void* whole) = nullptr;
};

class KeySection;
template <class S>
class Section;

/// A key of a section, for a struct whose type only Row<S> knows.
class KeyRow {
 public:
  KeyRow(const KeyRow&);
  KeyRow(KeyRow&&) noexcept;
  KeyRow& operator=(const KeyRow&);
  KeyRow& operator=(KeyRow&&) noexcept;
  ~KeyRow();

  /// The same key without a default, if its sentence or its section states the effect of absence.
  [[nodiscard]] KeyRow without_default() const;

  /// Leaves `whole` unchanged if the key is absent or invalid; an invalid one becomes a problem.
  void read(TomlReader& table, void* whole) const;

  [[nodiscard]] const SceneKey& key() const { return key_; }
  /// The keys of its table; their section names begin with this key.
  [[nodiscard]] std::vector<SceneKey> inside() const;
  /// The members of the struct that the key, or the keys of its table, fill.
  [[nodiscard]] std::vector<MemberPlace> places() const;

 protected:
  KeyRow(std::string_view key, std::string_view sentence);
  KeyRow(SceneKey key, std::function<void(TomlReader& table, void* whole)> read);
  /// @param standard the default, a value of `type`
  void define(const ValueType& type, const Range& range, const void* standard);
  /// @param append adds an element to a vector of tables; null: the value is a table itself
  void define(const KeySection& inside, bool many, void* (*append)(void* many));
  /// Fills the value that `finder` finds; `value` is that of `whole`.
  void fill(const Finder& finder, const void* whole, const void* value, std::size_t size,
            std::size_t alignment);
  void share_of(std::string_view key) { key_.share_of = key; }

 private:
  SceneKey key_;
  const ValueType* type_ = nullptr;
  std::shared_ptr<const KeySection> inside_;
  void* (*append_)(void* many) = nullptr;
  Finder finder_;
  MemberPlace place_{};
  std::function<void(TomlReader& table, void* whole)> read_;  // null: by the members above
};

/// A key of a section whose values fill an S. `get` is a pointer to a member, or a function of an
/// S& that returns a reference to the value to fill. If it returns a value, this only defines type
/// and default: the section's check reads such a key, because it depends on others.
template <class S>
class Row : public KeyRow {
 public:
  /// A number, a point, or one of the words of its type or a whole number for a value without one.
  template <class Get>
  Row(std::string_view key, const Get& get, const Range& range, std::string_view sentence)
      : KeyRow(key, sentence) {
    static_assert(Measured<ValueOf<S, Get>> || HasWords<ValueOf<S, Get>>);
    bind(get, range);
  }

  /// A text, a boolean, or one of the words of its type.
  template <class Get>
  Row(std::string_view key, const Get& get, std::string_view sentence) : KeyRow(key, sentence) {
    static_assert(!Measured<ValueOf<S, Get>>, "a number needs a range");
    bind(get, within("", 0, 0));
  }

  /// A table with the keys `inside`; if `get` gives a vector, any number of tables.
  template <class Get, class Inner>
  Row(std::string_view key, const Get& get, const Section<Inner>& inside, std::string_view sentence)
      : KeyRow(key, sentence) {
    using Value = ValueOf<S, Get>;
    if constexpr (kIsVector<Value>)
      define(inside, true, [](void* many) -> void* {
        return &static_cast<std::vector<Inner>*>(many)->emplace_back();
      });
    else
      define(inside, false, nullptr);
    if constexpr (kFills<Get>) fill_by(get, [](const void*) {});
  }

  /// A key that `read` reads, because its value is no member of an S.
  Row(SceneKey key, std::function<void(TomlReader&, S&)> read)
      : KeyRow(std::move(key), [read = std::move(read)](TomlReader& table, void* whole) {
          read(table, *static_cast<S*>(whole));
        }) {}

  /// The same key, which also accepts a percentage of another one, a time of the same section.
  [[nodiscard]] Row or_share_of(std::string_view key) const {
    Row row = *this;
    row.share_of(key);
    return row;
  }

 private:
  template <class Get>
  static constexpr bool kFills = std::is_lvalue_reference_v<Got<S, Get>>;

  template <class Get>
  void bind(const Get& get, const Range& range) {
    using Value = ValueOf<S, Get>;
    const auto define_by = [&](const void* standard) {
      define(kValueType<Value>, range, standard);
    };
    if constexpr (kFills<Get>) {
      fill_by(get, define_by);
    } else {
      const Value standard = get(initial<S>());
      define_by(&standard);
    }
  }

  /// @param use receives the default value
  template <class Get, class Use>
  void fill_by(const Get& get, const Use& use) {
    using Value = ValueOf<S, Get>;
    if constexpr (kIsFixed<Get>) {
      const S& whole = initial<S>();
      const void* const value = &value_in(get, whole);
      fill(Finder(&whole, value), &whole, value, sizeof(Value), alignof(Value));
      use(value);
    } else {
      S whole{};  // `get` may change it, as one that selects a shape does
      const void* const value = &get(whole);
      const auto find = [](const std::byte* octets, void* of) -> void* {
        return &(*std::launder(reinterpret_cast<const Get*>(octets)))(*static_cast<S*>(of));
      };
      fill(Finder(get, find), &whole, value, sizeof(Value), alignof(Value));
      use(value);
    }
  }
};

/// The keys of one kind of table, for a struct whose type only Section<S> knows.
class KeySection {
 public:
  std::vector<KeyRow> rows;

  /// Reads the keys, then calls the check.
  void read(TomlReader& table, void* whole) const;
  /// The keys of the section `name`, then the keys of its tables.
  [[nodiscard]] std::vector<SceneKey> keys(const std::string& name) const;
  /// The members of the struct that its keys fill, between entries of size 0 for the begin and the
  /// end of the struct.
  [[nodiscard]] std::vector<MemberPlace> places() const;

 protected:
  using Check = void (*)();  ///< of the type that `call` knows
  using AddMore = void (*)(std::vector<SceneKey>& keys);
  KeySection(std::size_t size, std::size_t alignment, Check check,
             void (*call)(Check, TomlReader&, void*), AddMore add_more)
      : size_(size), alignment_(alignment), check_(check), call_(call), add_more_(add_more) {}

 private:
  std::size_t size_, alignment_;  // [octets] of the struct
  Check check_;
  void (*call_)(Check check, TomlReader& table, void* whole);
  AddMore add_more_;
};

/// The keys of one kind of table.
template <class S>
class Section : public KeySection {
 public:
  /// @param check beyond single rows, called after all were read; may be null
  /// @param add_more adds keys of a separate list; may be null
  Section(std::initializer_list<Row<S>> list, void (*check)(TomlReader& table, S& out) = nullptr,
          AddMore add_more = nullptr)
      : KeySection(
            sizeof(S), alignof(S), reinterpret_cast<Check>(check),
            [](Check erased, TomlReader& table, void* whole) {
              reinterpret_cast<void (*)(TomlReader&, S&)>(erased)(table, *static_cast<S*>(whole));
            },
            add_more) {
    add(list);
  }

  /// Adds rows behind its own.
  template <class Rows = std::initializer_list<Row<S>>>
  Section& add(const Rows& more) {
    for (const Row<S>& row : more) rows.push_back(row);
    return *this;
  }

  void read(TomlReader& table, S& out) const { KeySection::read(table, &out); }
};

}  // namespace reckon::peer
