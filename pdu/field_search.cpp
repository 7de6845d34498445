// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/pdu/field_search.hpp"

#include <algorithm>
#include <charconv>
#include <type_traits>

#include "reckon/pdu/field_list.hpp"

namespace reckon::pdu {
namespace {

using Part = FieldPath::Part;
using Target = FieldPath::Target;

/// Stored for a part of a path without an index.
constexpr std::uint32_t kAnyIndex = static_cast<std::uint32_t>(-1);

FieldValue value_of(const OneId auto& id) {
  FieldValue value;
  value.kind = FieldValue::Kind::id;
  value.id = {id.site, id.application};
  value.id_parts = 2;
  if constexpr (requires { id.entity; }) value.id[value.id_parts++] = id.entity;
  if constexpr (requires { id.event; }) value.id[value.id_parts++] = id.event;
  return value;
}

template <Scalar T>
FieldValue value_of(T value, const FieldMeaning& meaning) {
  FieldValue found;
  if constexpr (std::is_enum_v<T>)
    found.number = static_cast<unsigned>(value);
  else
    found.number = static_cast<long double>(value);
  if constexpr (std::same_as<T, float>) found.kind = FieldValue::Kind::single;
  if constexpr (std::same_as<T, double>) found.kind = FieldValue::Kind::real;
  if constexpr (kMayHaveNames<T>) {
    if (meaning.bits == SisoBits::none) found.name = name_in(meaning, value);
    if (meaning.values == SisoTable::country)
      found.code = siso_name(SisoTable::country_code, static_cast<std::uint32_t>(value));
  }
  return found;
}

template <typename T, std::size_t n>
FieldValue value_of(const std::array<T, n>& array) {
  FieldValue value;
  if constexpr (std::same_as<T, char>) {
    const std::string_view all(array.data(), n);
    value.kind = FieldValue::Kind::text;
    value.text = all.substr(0, all.find('\0'));
  } else {
    value.kind = FieldValue::Kind::octets;
    value.octets = std::as_bytes(std::span(array));
  }
  return value;
}

/// Handler of a walk: applies the test to each value at the goal until it holds.
class Search {
 public:
  static constexpr bool kExamples = false;
  Search(const FieldGoal& goal, Target target, std::string_view bit, FieldTest test)
      : goal_(goal), target_(target), bit_(bit), test_(test) {}

  template <typename Record>
  bool enter(std::string_view name, std::size_t index, const Record& record) {
    const Part here{name, index};
    if constexpr (OneId<Record>) {
      if (target_ == Target::field && goal_.is_at(place_, here)) ask(value_of(record));
    }
    if (holds_ || place_.is_full() || !goal_.may_be_in(place_, here)) return false;
    place_.enter(name, index);
    return true;
  }
  void leave() { place_.leave(); }
  template <typename T>
  void leaf(std::string_view name, const T& value, const FieldMeanings& meanings) {
    if (holds_ || !goal_.is_at(place_, {name, kNoIndex})) return;
    if constexpr (!Scalar<T>) {
      if (target_ == Target::field) ask(value_of(value));
    } else if (target_ == Target::bit) {
      if constexpr (kMayHaveNames<T>)
        ask_bits(meanings.of(name).bits, static_cast<std::uint32_t>(value));
    } else {
      FieldValue found = value_of(value, meanings.of(name));
      if (target_ == Target::name) {
        if (found.name.empty()) return;
        found.kind = FieldValue::Kind::text;
        found.text = found.name;
      }
      ask(found);
    }
  }
  void octets(std::string_view name, std::span<const std::byte> octets) {
    if (holds_ || target_ != Target::field || !goal_.is_at(place_, {name, kNoIndex})) return;
    FieldValue value;
    value.kind = FieldValue::Kind::octets;
    value.octets = octets;
    ask(value);
  }

  [[nodiscard]] bool holds() const { return holds_; }

 private:
  void ask(const FieldValue& value) { holds_ = holds_ || test_.holds(test_.context, value); }
  void ask_bits(SisoBits set, std::uint32_t word) {
    for (std::size_t i = 0; i < siso_size(set); ++i) {
      const SisoBitField field = siso_bit_field(set, i);
      if (field.name == bit_) ask(value_of(field.of(word), {field.values, SisoBits::none}));
    }
  }

  FieldGoal goal_;
  Target target_;
  std::string_view bit_;
  FieldTest test_;
  FieldPlace place_;
  bool holds_ = false;
};

bool is_bit_field(std::string_view name) {
  for (unsigned set = 1; set < static_cast<unsigned>(SisoBits::end_); ++set) {
    for (std::size_t i = 0; i < siso_size(static_cast<SisoBits>(set)); ++i)
      if (siso_bit_field(static_cast<SisoBits>(set), i).name == name) return true;
  }
  return false;
}

}  // namespace

/// The parts of a path as text. They point into the path, which must not move meanwhile.
class FieldPathParts {
 public:
  explicit FieldPathParts(const FieldPath& path, FieldPath::Target target)
      : target_(target), count_(path.count_) {
    for (std::size_t i = 0; i < count_; ++i) {
      const FieldPath::StoredPart& part = path.parts_[i];
      parts_[i] = {std::string_view(path.text_).substr(part.begin, part.size),
                   part.index == kAnyIndex ? kNoIndex : part.index};
    }
    if (target == FieldPath::Target::name) drop_ending(parts_[count_ - 1].name, "_name");
    if (target != FieldPath::Target::bit) return;
    bit_ = parts_[--count_].name;
    if (count_ > 0) drop_ending(parts_[count_ - 1].name, "_bits");
  }
  [[nodiscard]] FieldGoal goal(bool whole) const {
    return {std::span(parts_).first(count_), whole};
  }
  [[nodiscard]] std::string_view bit() const { return bit_; }
  /// Whether the path has the ending that this target needs.
  [[nodiscard]] bool may_be() const {
    return (target_ != FieldPath::Target::name || dropped_) &&
           (target_ != FieldPath::Target::bit || is_bit_field(bit_));
  }

 private:
  void drop_ending(std::string_view& name, std::string_view ending) {
    dropped_ = name.size() > ending.size() && name.ends_with(ending);
    if (dropped_) name.remove_suffix(ending.size());
  }

  FieldPath::Target target_;
  std::array<Part, FieldPath::kDeepest> parts_{};
  std::size_t count_;
  std::string_view bit_;
  bool dropped_ = false;
};

bool FieldPath::look_for(Target target) {
  const FieldPathParts parts(*this, target);
  if (!parts.may_be()) return false;
  struct Look {
    FieldPath& path;
    FieldGoal goal;
    Target target;
    bool found = false;
  } look{*this, parts.goal(begins_at_pdu_), target};
  const auto report = [](void* context, const FieldPlace& place, const FieldList::Field& field) {
    Look& at = *static_cast<Look*>(context);
    if (at.target != Target::field && field.value != FieldValueClass::named_number) return;
    if (!at.goal.is_at(place, field.part)) return;
    at.found = true;
    const bool whole = field.around.size() + 1 == at.goal.parts.size();
    (whole ? at.path.whole_ : at.path.end_).add(field.type);
    const bool is_number = field.value != FieldValueClass::other && at.target != Target::name;
    at.path.has_numbers_ |= is_number;
    at.path.has_names_ |= is_number && field.value == FieldValueClass::named_number;
    at.path.has_others_ |= !is_number;
  };
  FieldList list(&look, report);
  list_fields(list, std::nullopt);
  target_ = target;
  return look.found;
}

std::optional<FieldPath> FieldPath::find(std::string_view text, bool whole) {
  FieldPath path;
  path.text_ = text;
  path.begins_at_pdu_ = whole;
  for (std::size_t at = 0; at <= text.size();) {
    if (path.count_ == kDeepest || text.size() > 0xFFFF) return std::nullopt;
    const std::size_t end = std::min(text.find('.', at), text.size());
    std::string_view name = text.substr(at, end - at);
    StoredPart& part = path.parts_[path.count_++];
    part = {static_cast<std::uint16_t>(at), static_cast<std::uint16_t>(name.size()), kAnyIndex};
    at = end + 1;
    const std::size_t bracket = name.find('[');
    if (bracket != std::string_view::npos) {
      const char* last = name.data() + name.size();
      const auto read = std::from_chars(name.data() + bracket + 1, last, part.index);
      if (read.ec != std::errc{} || read.ptr + 1 != last || *read.ptr != ']') return std::nullopt;
      part.size = static_cast<std::uint16_t>(bracket);
    }
    if (part.size == 0) return std::nullopt;
  }
  if (path.look_for(Target::field) || path.look_for(Target::name) || path.look_for(Target::bit))
    return path;
  return std::nullopt;
}

namespace {

using Names = const std::function<void(std::string_view)>&;

void each_name_in(SisoTable table, Names f) {
  for (std::size_t i = 0; i < siso_size(table); ++i) f(siso_entry(table, i).name);
}

/// Calls `f` with the names of the values of a bit field, in any word that has a field of this
/// name.
void each_bit_name(std::string_view bit, Names f) {
  for (unsigned set = 1; set < static_cast<unsigned>(SisoBits::end_); ++set) {
    for (std::size_t i = 0; i < siso_size(static_cast<SisoBits>(set)); ++i) {
      const SisoBitField field = siso_bit_field(static_cast<SisoBits>(set), i);
      if (field.name == bit) each_name_in(field.values, f);
    }
  }
}

/// For a field whose table depends on its record: calls `f` with the names of every table that it
/// may have.
void each_dependent_name(std::string_view field, Names f) {
  constexpr unsigned kKinds = 10, kDomains = 6;
  for (auto detail = static_cast<unsigned>(SisoTable::amplitude_detail);
       field == "detail" && detail <= static_cast<unsigned>(SisoTable::satcom_detail); ++detail)
    each_name_in(static_cast<SisoTable>(detail), f);
  for (unsigned number = 0; number < kKinds; ++number) {
    const auto kind = static_cast<EntityKind>(number);
    if (field == "domain") each_name_in(domain_table(kind), f);
    for (unsigned domain = 0; field == "category" && domain < kDomains; ++domain)
      each_name_in(category_table(kind, static_cast<EntityDomain>(domain)), f);
  }
}

void each_field_name(const FieldList::Field& field, Names f) {
  each_name_in(field.meaning.values, f);
  if (field.meaning.values == SisoTable::country) each_name_in(SisoTable::country_code, f);
  each_dependent_name(field.part.name, f);
  for (unsigned value = 0; value < field.values; ++value) {
    if (const std::string_view name = field.name_of(value); !name.empty()) f(name);
  }
}

}  // namespace

void FieldPath::each_name(Names f) const {
  const FieldPathParts parts(*this, target_);
  if (target_ == Target::bit) return each_bit_name(parts.bit(), f);
  struct Look {
    FieldGoal goal;
    Names f;
  } look{parts.goal(begins_at_pdu_), f};
  const auto report = [](void* context, const FieldPlace& place, const FieldList::Field& field) {
    const Look& at = *static_cast<Look*>(context);
    if (at.goal.is_at(place, field.part)) each_field_name(field, at.f);
  };
  FieldList list(&look, report);
  list_fields(list, std::nullopt);
}

bool any_value(const FieldPath& path, std::span<const std::byte> pdu, const PduHeader& header,
               FieldTest test) {
  if (!path.is_in(header.pdu_type)) return false;
  const FieldPathParts parts(path, path.target_);
  Search search(parts.goal(path.whole_.has(header.pdu_type)), path.target_, parts.bit(), test);
  const DecodeError error = visit(pdu, header, [&](const auto& typed) {
    FieldWalk walk(search, typed);
    fields(walk, typed);
  });
  if (error != DecodeError::none) {
    FieldWalk walk(search);
    walk("header", header);
  }
  return search.holds();
}

}  // namespace reckon::pdu
