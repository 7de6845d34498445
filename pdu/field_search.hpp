// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Finds fields of any PDU by their names in JSON. The field tables are the list of names.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "reckon/pdu/codec/pdu_header.hpp"
#include "reckon/pdu/pdu_types.hpp"

namespace reckon::pdu {

/// A value of a field.
struct FieldValue {
  enum class Kind : std::uint8_t { whole, single, real, text, octets, id };
  Kind kind = Kind::whole;
  /// whole, single (32-bit float) and real: the value. A long double holds each of them exactly.
  long double number = 0;
  std::string_view text;              ///< text: the characters before the first NUL
  std::span<const std::byte> octets;  ///< octets
  std::string_view name;              ///< whole: the name of the number; empty without a name
  std::string_view code;              ///< whole: the code of a country, "USA"; empty without one
  std::array<std::uint16_t, 3> id{};  ///< id: site, application and number
  std::size_t id_parts = 0;           ///< id: the used elements of `id`, 2 or 3
};

/// A predicate about a value. It does not own the context, which must outlive it.
struct FieldTest {
  const void* context = nullptr;
  bool (*holds)(const void* context, const FieldValue& value) = nullptr;
};

/// A set of PDU types.
class PduTypeSet {
 public:
  void add(PduType type) noexcept { bits_[index(type)] |= mask(type); }
  [[nodiscard]] bool has(PduType type) const noexcept {
    return (bits_[index(type)] & mask(type)) != 0;
  }
  [[nodiscard]] bool empty() const noexcept { return bits_ == decltype(bits_){}; }

 private:
  static constexpr std::size_t index(PduType type) noexcept {
    return static_cast<std::size_t>(type) / 64;
  }
  static constexpr std::uint64_t mask(PduType type) noexcept {
    return std::uint64_t{1} << (static_cast<unsigned>(type) % 64);
  }
  std::array<std::uint64_t, 4> bits_{};
};

/// A field as written: "entity_location.x", "systems[0].beams.frequency". The end of the path is
/// enough, as "psi" or "munition_type.kind". In a PDU type that has a field with exactly this whole
/// path, the path means only that field. Without an index it means any element of a list. A bit
/// field is written behind its word or alone: "entity_appearance.damage". Endings from JSON are
/// accepted too: "country_name", "entity_appearance_bits.damage". An ID of an entity, event or
/// simulation is one value.
class FieldPath {
 public:
  static constexpr std::size_t kDeepest = 10;  ///< parts of a path

  /// No value if the text has an empty part, a malformed index or too many parts, or if no PDU type
  /// has such a field.
  /// @param whole the path begins at the PDU
  [[nodiscard]] static std::optional<FieldPath> find(std::string_view text, bool whole = false);

  /// Whether PDUs of this type may have the field.
  [[nodiscard]] bool is_in(PduType type) const noexcept {
    return whole_.has(type) || end_.has(type);
  }
  /// Whether a value of the field may be a number, may have a name, may be something else.
  [[nodiscard]] bool has_numbers() const noexcept { return has_numbers_; }
  [[nodiscard]] bool has_names() const noexcept { return has_names_; }
  [[nodiscard]] bool has_others() const noexcept { return has_others_; }

  /// Calls `f` with each name that a value of the field may have in any PDU; names may repeat.
  void each_name(const std::function<void(std::string_view)>& f) const;
  /// Whether the path means the name of a field's value: "country_name".
  [[nodiscard]] bool is_name() const noexcept { return target_ == Target::name; }

  /// One part of a path.
  struct Part {
    std::string_view name;
    std::size_t index;  ///< static_cast<std::size_t>(-1): any
  };
  /// What the last part names: a field, the name of its value, or a bit field.
  enum class Target : std::uint8_t { field, name, bit };

 private:
  friend class FieldPathParts;
  friend bool any_value(const FieldPath& path, std::span<const std::byte> pdu,
                        const PduHeader& header, FieldTest test);

  [[nodiscard]] bool look_for(Target target);

  struct StoredPart {
    std::uint16_t begin = 0;
    std::uint16_t size = 0;
    std::uint32_t index = 0;
  };
  std::string text_;
  std::array<StoredPart, kDeepest> parts_{};
  std::size_t count_ = 0;
  Target target_ = Target::field;
  bool begins_at_pdu_ = false;
  PduTypeSet whole_;
  PduTypeSet end_;
  bool has_numbers_ = false;
  bool has_names_ = false;
  bool has_others_ = false;
};

/// Whether the test holds for a value of the field in this PDU; false for a type that lacks it, and
/// for octets that cannot be decoded. The header can be searched in a PDU of any type.
[[nodiscard]] bool any_value(const FieldPath& path, std::span<const std::byte> pdu,
                             const PduHeader& header, FieldTest test);

/// Calls `f` with the path of each field that PDUs of this type may have, in wire order, as
/// "systems.beams.frequency"; paths may repeat. The text is valid during the call.
void each_field_path(PduType type, const std::function<void(std::string_view)>& f);

}  // namespace reckon::pdu
