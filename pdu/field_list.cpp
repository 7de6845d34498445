// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/pdu/field_list.hpp"

#include <memory>
#include <string>
#include <utility>

#include "reckon/pdu/fixed_fields.hpp"

namespace reckon::pdu {
namespace {

/// Visitor: sets the octets of flags that switch fields on.
struct AllFlags : FixedFields {
  template <typename T>
  void operator()(std::string_view name, T& value) {
    if constexpr (std::same_as<T, std::uint8_t>) {
      if (name.ends_with("flags")) value = 0xFF;
    }
  }
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

template <typename... T>
void list_tables(FieldList& list, std::optional<PduType> only, TypeList<T...>) {
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

/// Reports the fields of a PDU without a field table.
void list_header(FieldList& list, PduType type) {
  list.begin(type);
  FieldWalk walk(list);
  walk("header", PduHeader{});
}

}  // namespace

void list_fields(FieldList& list, std::optional<PduType> only) {
  list_tables(list, only, PduTypes{});
  for (unsigned number = 0; number < 256; ++number) {
    const auto type = static_cast<PduType>(number);
    if (!is_listed(type) && only.value_or(type) == type) list_header(list, type);
  }
}

void each_field_path(PduType type, const std::function<void(std::string_view)>& f) {
  struct Names {
    const std::function<void(std::string_view)>& f;
    std::string path;
  } names{f, {}};
  const auto report = [](void* context, const FieldPlace&, const FieldList::Field& field) {
    Names& to = *static_cast<Names*>(context);
    to.path.clear();
    for (const FieldPath::Part& part : field.around) to.path.append(part.name).append(".");
    to.path += field.part.name;
    to.f(to.path);
  };
  FieldList list(&names, report);
  list_fields(list, type);
}

}  // namespace reckon::pdu
