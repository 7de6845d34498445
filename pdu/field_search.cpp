// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/pdu/field_search.hpp"

#include <algorithm>
#include <charconv>
#include <concepts>
#include <memory>
#include <type_traits>

#include "reckon/pdu/field_walk.hpp"

namespace reckon::pdu {
namespace {

using Part = FieldPath::Part;
using Target = FieldPath::Target;

/// Stored for a part of a path without an index.
constexpr std::uint32_t kAnyIndex = static_cast<std::uint32_t>(-1);

/// The records around the field that is visited, from the PDU on.
class Place {
 public:
  [[nodiscard]] bool is_full() const { return depth_ == parts_.size(); }
  void enter(std::string_view name, std::size_t index) { parts_[depth_++] = {name, index}; }
  void leave() { --depth_; }
  [[nodiscard]] std::span<const Part> parts() const { return std::span(parts_).first(depth_); }

 private:
  std::array<Part, FieldPath::kDeepest> parts_{};
  std::size_t depth_ = 0;
};

bool is_same(const Part& there, const Part& wanted) {
  return (wanted.index == kNoIndex || there.index == kNoIndex || there.index == wanted.index) &&
         there.name == wanted.name;
}

/// The path of the fields that are sought, without a bit field.
struct Goal {
  std::span<const Part> parts;
  bool whole = false;  ///< the path begins at the PDU

  [[nodiscard]] bool is_at(const Place& place, const Part& field) const {
    const std::span<const Part> around = place.parts();
    if (parts.empty()) return true;
    if (!is_same(field, parts.back()) || around.size() + 1 < parts.size() ||
        (whole && around.size() + 1 != parts.size()))
      return false;
    const auto outer = parts.first(parts.size() - 1);
    return std::equal(outer.begin(), outer.end(),
                      around.end() - static_cast<std::ptrdiff_t>(outer.size()),
                      [](const Part& wanted, const Part& there) { return is_same(there, wanted); });
  }
  /// Whether it may be inside a record at this place.
  [[nodiscard]] bool may_be_in(const Place& place, const Part& record) const {
    if (!whole) return true;
    const std::size_t depth = place.parts().size();
    return depth + 1 < parts.size() && is_same(record, parts[depth]);
  }
};

template <typename T>
concept Id =
    std::same_as<T, EntityId> || std::same_as<T, LiveEntityId> || std::same_as<T, EventId> ||
    std::same_as<T, SimulationAddress> || std::same_as<T, LiveSimulationAddress>;

template <Id T>
FieldValue value_of(const T& id) {
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

/// Handler of a walk: asks the test about each value at the goal until it holds.
class Search {
 public:
  static constexpr bool kExamples = false;
  Search(const Goal& goal, Target target, std::string_view bit, FieldTest test)
      : goal_(goal), target_(target), bit_(bit), test_(test) {}

  template <typename Record>
  bool enter(std::string_view name, std::size_t index, const Record& record) {
    const Part here{name, index};
    if constexpr (Id<Record>) {
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

  Goal goal_;
  Target target_;
  std::string_view bit_;
  FieldTest test_;
  Place place_;
  bool holds_ = false;
};

/// What kind of value a field has.
enum class ValueClass : std::uint8_t { number, named_number, other };

/// Handler of a walk through examples: tells of each field.
class FieldList {
 public:
  struct Field {
    PduType type;
    std::span<const Part> around;
    Part part;
    ValueClass value;
  };
  using Tell = void (*)(void* context, const Place& place, const Field& field);
  static constexpr bool kExamples = true;
  FieldList(void* context, Tell told) : context_(context), tell_(told) {}

  /// The fields that follow are those of PDUs of this type.
  void begin(PduType type) { type_ = type; }
  template <typename Record>
  bool enter(std::string_view name, std::size_t index, const Record&) {
    if constexpr (Id<Record>) tell(name, ValueClass::other);
    if (place_.is_full()) return false;
    place_.enter(name, index);
    return true;
  }
  void leave() { place_.leave(); }
  template <typename T>
  void leaf(std::string_view name, const T&, const FieldMeanings&) {
    if constexpr (!Scalar<T>)
      tell(name, ValueClass::other);
    else
      tell(name, kMayHaveNames<T> ? ValueClass::named_number : ValueClass::number);
  }
  void octets(std::string_view name, std::span<const std::byte>) { tell(name, ValueClass::other); }

 private:
  void tell(std::string_view name, ValueClass value) {
    tell_(context_, place_, {type_, place_.parts(), {name, kNoIndex}, value});
  }

  void* context_;
  Tell tell_;
  Place place_;
  PduType type_ = PduType::other;
};

/// Visitor: sets the octets of flags that switch fields on.
struct AllFlags {
  template <typename T>
  void operator()(std::string_view name, T& value) {
    if constexpr (std::same_as<T, std::uint8_t>) {
      if (name.ends_with("flags")) value = 0xFF;
    }
  }
  template <typename... Any>
  void count(Any&&...) {}
  template <typename... Any>
  void records(Any&&...) {}
  template <typename... Any>
  void walked(Any&&...) {}
};

constexpr std::array<std::byte, 64> kZeros{};

/// Calls `f` with PDUs of this type that differ in the fields they have.
template <typename Pdu, typename F>
void each_variant(F&& f) {
  const auto pdu = std::make_unique<Pdu>();
  AllFlags flags;
  fields(flags, *pdu);
  f(std::as_const(*pdu));
  if constexpr (std::same_as<Pdu, Fire> || std::same_as<Pdu, Detonation>) {
    for (const std::uint8_t status : {std::uint8_t{0x10}, std::uint8_t{0x20}}) {
      pdu->header.pdu_status = status;
      f(std::as_const(*pdu));
    }
  } else if constexpr (std::same_as<Pdu, Transmitter>) {
    pdu->antenna_pattern_type = BeamAntennaPattern::kBeam;
    pdu->antenna_pattern.bytes = std::span(kZeros).first(kFixedSize<BeamAntennaPattern>);
    for (const auto& [system, size] :
         {std::pair<std::uint16_t, std::size_t>{2, 16}, {6, 16}, {8, 8}}) {
      pdu->modulation_type.radio_system = system;
      pdu->modulation_parameters.bytes = std::span(kZeros).first(size);
      f(std::as_const(*pdu));
    }
  } else if constexpr (std::same_as<Pdu, GriddedData>) {
    pdu->number_of_grid_axes = 1;  // more than there are: octets
    f(std::as_const(*pdu));
  } else if constexpr (std::same_as<Pdu, AggregateState>) {
    pdu->silent_systems_and_variable_datums.bytes = std::span(kZeros).first(8);
    f(std::as_const(*pdu));
    pdu->number_of_silent_entity_systems = 1;  // more than there are: octets
    pdu->silent_systems_and_variable_datums.bytes = {};
    f(std::as_const(*pdu));
  }
  pdu->header.protocol_version = 6;
  f(std::as_const(*pdu));
}

/// Tells of the fields of each type in the list, or of one.
template <typename... T>
void list_fields(FieldList& list, std::optional<PduType> only, TypeList<T...>) {
  const auto show = [&]<typename Pdu>(std::type_identity<Pdu>) {
    if (only.has_value() && *only != Pdu::kPduType) return;
    list.begin(Pdu::kPduType);
    each_variant<Pdu>([&](const Pdu& pdu) {
      FieldWalk walk(list, pdu);
      fields(walk, pdu);
    });
  };
  (show(std::type_identity<T>{}), ...);
}

/// Tells of the fields of a PDU without a field table.
void list_header(FieldList& list, PduType type) {
  list.begin(type);
  FieldWalk walk(list);
  walk("header", PduHeader{});
}

bool is_bit_field(std::string_view name) {
  for (unsigned set = 1; set < static_cast<unsigned>(SisoBits::end_); ++set) {
    for (std::size_t i = 0; i < siso_size(static_cast<SisoBits>(set)); ++i)
      if (siso_bit_field(static_cast<SisoBits>(set), i).name == name) return true;
  }
  return false;
}

}  // namespace

/// The parts of a path as text, valid as long as the path stays where it is.
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
  [[nodiscard]] Goal goal(bool whole) const { return {std::span(parts_).first(count_), whole}; }
  [[nodiscard]] std::string_view bit() const { return bit_; }
  /// Whether the endings that this target needs are there.
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
    Goal goal;
    Target target;
    bool found = false;
  } look{*this, parts.goal(begins_at_pdu_), target};
  const auto tell = [](void* context, const Place& place, const FieldList::Field& field) {
    Look& at = *static_cast<Look*>(context);
    if (at.target != Target::field && field.value != ValueClass::named_number) return;
    if (!at.goal.is_at(place, field.part)) return;
    at.found = true;
    const bool whole = field.around.size() + 1 == at.goal.parts.size();
    (whole ? at.path.whole_ : at.path.end_).add(field.type);
    const bool is_number = field.value != ValueClass::other && at.target != Target::name;
    at.path.has_numbers_ |= is_number;
    at.path.has_names_ |= is_number && field.value == ValueClass::named_number;
    at.path.has_others_ |= !is_number;
  };
  FieldList list(&look, tell);
  list_fields(list, std::nullopt, PduTypes{});
  for (unsigned type = 0; type < 256; ++type) {
    if (!is_listed(static_cast<PduType>(type))) list_header(list, static_cast<PduType>(type));
  }
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

void each_field_path(PduType type, const std::function<void(std::string_view)>& f) {
  struct Names {
    const std::function<void(std::string_view)>& f;
    std::string path;
  } names{f, {}};
  const auto tell = [](void* context, const Place&, const FieldList::Field& field) {
    Names& to = *static_cast<Names*>(context);
    to.path.clear();
    for (const Part& part : field.around) to.path.append(part.name).append(".");
    to.path += field.part.name;
    to.f(to.path);
  };
  FieldList list(&names, tell);
  if (!is_listed(type)) return list_header(list, type);
  list_fields(list, type, PduTypes{});
}

}  // namespace reckon::pdu
