// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/object_model/field_types.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace reckon::tools {
namespace {

constexpr std::string_view kNone = "NA";

/// Unit of fields with this ending of their name; the first matching row is used.
struct UnitRow {
  std::string_view record, ending, unit;
};
// Units from the PDUs of IEEE 1278.1-2012, as in the comments of the structs.
constexpr std::array kUnits{
    UnitRow{"WorldCoordinates", "", "m"},
    UnitRow{"EulerAngles", "", "rad"},
    UnitRow{"HapticRecord", "grip_stiffness", "N/m"},
    UnitRow{"HapticRecord", "k1", "N/m"},
    UnitRow{"HapticRecord", "k3", "N/m^3"},
    UnitRow{"HapticRecord", "damping", "N s/m"},
    UnitRow{"HapticRecord", "mass", "kg"},
    UnitRow{"HapticRecord", "point", "m"},
    UnitRow{"HapticRecord", "radius", "m"},
    UnitRow{"HapticRecord", "validity_ms", "ms"},
    UnitRow{"EnergyAccountRecord", "given", "J"},
    UnitRow{"EnergyAccountRecord", "need", "uJ"},
    UnitRow{"EnergyAccountRecord", "spring_need", "uJ"},
    UnitRow{"CollisionElastic", "mass", "kg"},
    UnitRow{"Collision", "mass", "kg"},
    UnitRow{"Fire", "range", "m"},
    UnitRow{"", "angular_velocity", "rad/s"},
    UnitRow{"", "acceleration", "m/s^2"},
    UnitRow{"", "velocity", "m/s"},
    UnitRow{"Collision", "location", "m"},
    UnitRow{"", "location_of_impact", "m"},
    UnitRow{"Detonation", "location_in_entity_coordinates", "m"},
    UnitRow{"Designator", "power", "W"},
    UnitRow{"Designator", "wavelength", "um"},
    UnitRow{"Designator", "entity", "m"},
    UnitRow{"DirectedEnergyFire", "shot_time", "s"},
    UnitRow{"DirectedEnergyFire", "pulse_width", "s"},
    UnitRow{"DirectedEnergyFire", "location", "m"},
    UnitRow{"DirectedEnergyFire", "diameter", "m"},
    UnitRow{"DirectedEnergyFire", "wavelength", "m"},
    UnitRow{"DirectedEnergyFire", "frequency", "Hz"},
    UnitRow{"Transmitter", "frequency", "Hz"},
    UnitRow{"Transmitter", "bandwidth", "Hz"},
    UnitRow{"Transmitter", "power", "dBm"},
    UnitRow{"Receiver", "power", "dBm"},
    UnitRow{"", "relative_antenna_location", "m"},
    UnitRow{"AggregateState", "dimensions", "m"},
    UnitRow{"BasicLinearSegment_float", "length", "m"},
    UnitRow{"BasicLinearSegment_float", "width", "m"},
    UnitRow{"BasicLinearSegment_float", "height", "m"},
    UnitRow{"BasicLinearSegment_float", "depth", "m"},
    UnitRow{"CollisionIntermediateResult", "", "1/kg"},
};

std::string capitalised(std::string_view word) {
  std::string text(word);
  if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

}  // namespace

std::string_view unit_of(std::string_view record, std::string_view field) {
  const auto row = std::ranges::find_if(kUnits, [&](const UnitRow& r) {
    return (r.record.empty() || r.record == record) && field.ends_with(r.ending);
  });
  return row == kUnits.end() ? kNone : row->unit;
}

std::string FieldTypes::suffix(std::string_view unit) {
  if (unit == kNone) return {};
  std::string text;
  for (const char c : unit) {
    if (c == '/') {
      text += "_per_";
    } else if (c == ' ') {
      text += '_';
    } else if (c != '^') {
      text += c;
    }
  }
  return "_" + text;
}

std::string FieldTypes::array(const std::string& element, const std::string& cardinality) {
  const std::string kind = element == "HLAASCIIchar" ? "Text"
                           : element == "HLAoctet"   ? "Octets"
                                                     : element + "s";
  const std::string name = cardinality == "Dynamic" ? kind : kind + cardinality;
  types_.arrays[name] = {element, cardinality};
  return name;
}

std::string FieldTypes::number(std::size_t octets, char kind, std::string_view unit) {
  const std::string_view word = kind == 'f' ? "Float" : kind == 'i' ? "Integer" : "Unsigned";
  const std::string name = fmt::format("{}{}{}", word, 8 * octets, suffix(unit));
  types_.numbers[name] = {octets, kind, std::string(unit)};
  return name;
}

std::string FieldTypes::plain(std::string_view name) {
  std::string text(name);
  std::erase(text, '>');
  std::ranges::replace_if(
      text, [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return text;
}

// Joined words, each with a capital: the form of names in HLA.
std::string FieldTypes::identifier(std::string_view text) {
  std::string name, word;
  for (const char c : std::string(text) + " ") {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0) {
      word += c;
    } else {
      name += capitalised(word);
      word.clear();
    }
  }
  if (!name.empty() && std::isdigit(static_cast<unsigned char>(name[0])) != 0) name = "N" + name;
  return name;
}

}  // namespace reckon::tools
