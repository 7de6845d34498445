// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/pdu/codec/siso_names.hpp"

#include <algorithm>
#include <array>
#include <span>

namespace reckon::pdu {
namespace {

// Storage of a table's values: none (they are consecutive), or one of two lists.
enum class Values : std::uint8_t { dense, narrow, wide };

struct Table {
  std::uint16_t first;  // name
  std::uint16_t count;
  Values values;
  std::uint16_t place;  // the first value, or its position in the list
};

struct BitRow {
  std::uint16_t name_at;
  std::uint8_t name_size;
  std::uint8_t first;
  std::uint8_t width;
  std::uint8_t table;
};

struct BitSet {
  std::uint16_t first;  // row
  std::uint8_t count;
  bool shows_zeros;
};

#include "reckon/pdu/codec/siso_names_data.inc"

std::string_view text_at(std::size_t offset, std::size_t size) {
  return {static_cast<const char*>(kText) + offset, size};
}

std::string_view name_at(std::size_t i) { return text_at(kOffsets[i], kLengths[i]); }

template <typename Value>
std::size_t find(std::span<const Value> values, std::uint32_t value) {
  const auto found = std::lower_bound(values.begin(), values.end(), value);
  if (found == values.end() || *found != value) return values.size();
  return static_cast<std::size_t>(found - values.begin());
}

/// Position of a value in its table; the size of the table if it has no name.
std::size_t place_of(const Table& table, std::uint32_t value) {
  switch (table.values) {
    case Values::dense:
      return std::min<std::size_t>(value - table.place, table.count);
    case Values::narrow:
      return find(std::span(kNarrowValues).subspan(table.place, table.count), value);
    case Values::wide:
      return find(std::span(kWideValues).subspan(table.place, table.count), value);
  }
  return table.count;
}

/// The choice for a domain; none for a domain beyond the list.
template <typename Choice>
Choice by_domain(const std::array<Choice, 6>& choices, EntityDomain domain) {
  const auto i = static_cast<std::size_t>(domain);
  return i < choices.size() ? choices[i] : Choice::none;
}

using T = SisoTable;
using B = SisoBits;
constexpr std::array kPlatformCategories{T::none,
                                         T::land_category,
                                         T::air_category,
                                         T::surface_category,
                                         T::subsurface_category,
                                         T::space_category};
constexpr std::array kLifeFormCategories{T::none,
                                         T::land_life_form_category,
                                         T::air_life_form_category,
                                         T::surface_life_form_category,
                                         T::subsurface_life_form_category,
                                         T::space_life_form_category};
constexpr std::array kEnvironmentalCategories{T::none,
                                              T::land_environmental_category,
                                              T::air_environmental_category,
                                              T::surface_environmental_category,
                                              T::subsurface_environmental_category,
                                              T::none};
constexpr std::array kCulturalCategories{T::none,
                                         T::land_cultural_category,
                                         T::none,
                                         T::surface_cultural_category,
                                         T::subsurface_cultural_category,
                                         T::none};
constexpr std::array kExpendableCategories{T::none,
                                           T::none,
                                           T::air_expendable_category,
                                           T::surface_expendable_category,
                                           T::subsurface_expendable_category,
                                           T::none};
constexpr std::array kPlatformAppearances{B::none,
                                          B::land_appearance,
                                          B::air_appearance,
                                          B::surface_appearance,
                                          B::subsurface_appearance,
                                          B::space_appearance};
constexpr std::array kPlatformCapabilities{B::none,
                                           B::land_capabilities,
                                           B::air_capabilities,
                                           B::land_capabilities,
                                           B::land_capabilities,
                                           B::service_capabilities};

constexpr std::uint8_t kFirstAnimal = 200;  // categories of life forms

}  // namespace

std::string_view siso_name(SisoTable table, std::uint32_t value) noexcept {
  const Table& row = kTables[static_cast<std::size_t>(table)];
  const std::size_t i = place_of(row, value);
  return i < row.count ? name_at(row.first + i) : std::string_view();
}

std::size_t siso_size(SisoTable table) noexcept {
  return kTables[static_cast<std::size_t>(table)].count;
}

SisoEntry siso_entry(SisoTable table, std::size_t i) noexcept {
  const Table& row = kTables[static_cast<std::size_t>(table)];
  const std::string_view name = name_at(row.first + i);
  if (row.values == Values::narrow) return {kNarrowValues[row.place + i], name};
  if (row.values == Values::wide) return {kWideValues[row.place + i], name};
  return {static_cast<std::uint32_t>(row.place + i), name};
}

std::size_t siso_size(SisoBits bits) noexcept {
  return kBitSets[static_cast<std::size_t>(bits)].count;
}

SisoBitField siso_bit_field(SisoBits bits, std::size_t i) noexcept {
  const BitRow& row = kBitRows[kBitSets[static_cast<std::size_t>(bits)].first + i];
  return {text_at(row.name_at, row.name_size), row.first, row.width,
          static_cast<SisoTable>(row.table)};
}

bool shows_zeros(SisoBits bits) noexcept {
  return kBitSets[static_cast<std::size_t>(bits)].shows_zeros;
}

SisoTable domain_table(EntityKind kind) noexcept {
  if (kind == EntityKind::munition) return T::munition_domain;
  return kind == EntityKind::supply ? T::supply_domain : T::platform_domain;
}

SisoTable category_table(EntityKind kind, EntityDomain domain) noexcept {
  switch (kind) {
    case EntityKind::platform:
      return by_domain(kPlatformCategories, domain);
    case EntityKind::munition:
      return T::munition_category;
    case EntityKind::life_form:
      return by_domain(kLifeFormCategories, domain);
    case EntityKind::environmental:
      return by_domain(kEnvironmentalCategories, domain);
    case EntityKind::cultural_feature:
      return by_domain(kCulturalCategories, domain);
    case EntityKind::supply:
      return domain == EntityDomain::other ? T::supply_category : T::none;
    case EntityKind::radio:
      return T::radio_category;
    case EntityKind::expendable:
      return by_domain(kExpendableCategories, domain);
    case EntityKind::sensor_emitter:
      return T::sensor_category;
    default:
      return T::none;
  }
}

SisoBits appearance_bits(EntityKind kind, EntityDomain domain, std::uint8_t category) noexcept {
  switch (kind) {
    case EntityKind::platform:
      return by_domain(kPlatformAppearances, domain);
    case EntityKind::munition:
      return B::munition_appearance;
    case EntityKind::life_form:
      return category >= kFirstAnimal ? B::animal_appearance : B::life_form_appearance;
    case EntityKind::environmental:
      return B::environmental_appearance;
    case EntityKind::cultural_feature:
      return B::cultural_appearance;
    case EntityKind::supply:
      return B::supply_appearance;
    case EntityKind::radio:
      return B::radio_appearance;
    case EntityKind::expendable:
      return B::expendable_appearance;
    case EntityKind::sensor_emitter:
      return B::sensor_appearance;
    default:
      return B::none;
  }
}

SisoBits capability_bits(EntityKind kind, EntityDomain domain) noexcept {
  switch (kind) {
    case EntityKind::platform:
      return by_domain(kPlatformCapabilities, domain);
    case EntityKind::life_form:
      return B::service_capabilities;
    case EntityKind::supply:
      return B::supply_capabilities;
    case EntityKind::munition:
    case EntityKind::environmental:
    case EntityKind::cultural_feature:
    case EntityKind::sensor_emitter:
      return B::carried_capabilities;
    default:
      return B::none;
  }
}

}  // namespace reckon::pdu
