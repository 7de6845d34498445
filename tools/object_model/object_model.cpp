// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Writes the object model of a federate (IEEE 1516.2, OMT) from the field tables: classes of
// entities, their attributes, interactions, and all data types with their units.
//   reckon_object_model               prints it
//   reckon_object_model --check FILE  compares the file with it (exit 1: it differs)
#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "reckon/tools/object_model/field_types.hpp"

namespace reckon::tools {
namespace {

/// Nested XML elements, each indented by two more spaces.
class Xml {
 public:
  void open(std::string_view element) {
    line("<" + std::string(element) + ">");
    open_.emplace_back(element.substr(0, element.find(' ')));
  }
  void close() {
    const std::string element = open_.back();
    open_.pop_back();
    line("</" + element + ">");
  }
  void leaf(std::string_view element, std::string_view text) {
    line(fmt::format("<{0}>{1}</{0}>", element, escaped(text)));
  }
  /// An element of `leaves` alone.
  void element(std::string_view name,
               std::initializer_list<std::pair<std::string_view, std::string>> leaves) {
    open(name);
    for (const auto& [leaf_name, text] : leaves) leaf(leaf_name, text);
    close();
  }
  void line(const std::string& text) { text_ += std::string(2 * open_.size(), ' ') + text + "\n"; }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  static std::string escaped(std::string_view text) {
    std::string out;
    for (const char c : text) {
      out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
    }
    return out;
  }
  std::string text_;
  std::vector<std::string> open_;
};

void write_identification(Xml& xml) {
  xml.open("modelIdentification");
  xml.leaf("name", "Reckon");
  xml.leaf("type", "FOM");
  xml.leaf("version", "0.1");
  xml.leaf("modificationDate", "2026-01-01");
  xml.leaf("securityClassification", "unclassified");
  xml.leaf("purpose", "What a federate of Reckon can send and receive");
  xml.leaf("applicationDomain", "Haptics and distributed interactive simulation");
  xml.leaf(
      "description",
      "Written by reckon_object_model from the field tables of IEEE 1278.1 PDUs, which are what "
      "goes over the network: big endian, without the padding of HLA's encodings.");
  xml.element("poc", {{"pocType", "Primary author"}, {"pocName", "The Reckon authors"}});
  xml.close();
}

void write_attribute(Xml& xml, const ModelField& field, std::string_view when,
                     std::string_view ownership) {
  xml.open("attribute");
  xml.leaf("name", field.name);
  xml.leaf("dataType", field.type);
  xml.leaf("updateType", "Conditional");
  xml.leaf("updateCondition", when);
  xml.leaf("ownership", ownership);
  xml.leaf("sharing", "PublishSubscribe");
  xml.leaf("transportation", "HLAbestEffort");
  xml.leaf("order", "Receive");
  xml.close();
}

// Begins a class of objects with an Entity State.
void open_class(Xml& xml, std::string_view name, std::string_view semantics, ModelTypes& types,
                std::string_view ownership) {
  FieldTypes state(types, "EntityState");
  const pdu::EntityState entity_state{};
  fields(state, entity_state);
  xml.open("objectClass");
  xml.leaf("name", name);
  xml.leaf("sharing", "PublishSubscribe");
  xml.leaf("semantics", semantics);
  for (const ModelField& field : state.members()) {
    if (field.name == "header") continue;
    write_attribute(xml, field,
                    "An error above the thresholds, an event, a newcomer, or the heartbeat",
                    ownership);
  }
}

// The first level of EntityClass: kinds. All of them have the same attributes.
void write_entities(Xml& xml, ModelTypes& types) {
  FieldTypes felt(types, "Entity");
  felt("force_model", pdu::HapticRecord{});
  const std::string account = felt.record(pdu::EnergyAccountRecord{}, "energy_accounts");
  types.arrays[account + "s"] = {account, "Dynamic"};

  open_class(xml, "Entity",
             "An entity as EntityClass{} means it: Entity State PDU, and records of the Attribute "
             "PDU for what hands feel",
             types, "NoTransfer");
  const std::string_view touched = "With each update of an entity that hands can touch";
  write_attribute(xml, felt.members().front(), touched, "NoTransfer");
  write_attribute(xml, {"energy_accounts", account + "s"}, touched, "NoTransfer");
  for (const auto& [value, name] : types.enumerations.at("EntityKind").values) {
    xml.open("objectClass");
    xml.leaf("name", name);
    xml.leaf("sharing", "PublishSubscribe");
    xml.leaf("semantics", fmt::format("Entities of kind {}; further numbers of the entity type "
                                      "narrow the class",
                                      value));
    xml.close();
  }
  xml.close();
}

void write_objects(Xml& xml, ModelTypes& types) {
  xml.open("objects");
  xml.open("objectClass");
  xml.leaf("name", "HLAobjectRoot");
  write_entities(xml, types);
  FieldTypes owned(types, "Body");
  owned("ownership", pdu::OwnershipRecord{});
  open_class(xml, "Body",
             "An object of the scene with a mass (kind Other, category 66). Its attributes change "
             "owner together, by FederateBodies",
             types, "DivestAcquire");
  write_attribute(xml, owned.members().front(), "With each Entity State PDU", "DivestAcquire");
  xml.close();
  xml.close();
  xml.close();
}

// All PDUs except object states and PDUs between peers.
template <typename T>
constexpr bool kIsInteraction = T::kPduType != pdu::PduType::entity_state&& T::kPduType !=
                                pdu::PduType::entity_state_update&& T::kPduType !=
                                pdu::PduType::attribute&& static_cast<int>(T::kPduType) < 129;

template <typename T>
void write_interaction(Xml& xml, ModelTypes& types) {
  if constexpr (kIsInteraction<T>) {
    FieldTypes members(types, struct_name<T>());
    const T value{};
    fields(members, value);
    xml.open("interactionClass");
    xml.leaf("name", struct_name<T>());
    xml.leaf("sharing", "PublishSubscribe");
    xml.leaf("transportation", "HLAbestEffort");
    xml.leaf("order", "Receive");
    xml.leaf("semantics",
             fmt::format("{} PDU, type {}", pdu::name(T::kPduType), static_cast<int>(T::kPduType)));
    for (const ModelField& field : members.members()) {
      if (field.name == "header") continue;
      xml.element("parameter", {{"name", field.name}, {"dataType", field.type}});
    }
    xml.close();
  }
}

template <typename... T>
void write_interactions(Xml& xml, ModelTypes& types, pdu::TypeList<T...>) {
  xml.open("interactions");
  xml.open("interactionClass");
  xml.leaf("name", "HLAinteractionRoot");
  (write_interaction<T>(xml, types), ...);
  xml.close();
  xml.close();
}

std::string representation_of(std::size_t octets, char kind) {
  if (kind == 'f') return octets == 4 ? "HLAfloat32BE" : "HLAfloat64BE";
  if (octets == 1) return "HLAoctet";
  return fmt::format("{}{}BE", kind == 'i' ? "HLAinteger" : "Unsigned", 8 * octets);
}

void write_representations(Xml& xml) {
  xml.open("basicDataRepresentations");
  for (const int bits : {16, 32, 64}) {
    xml.element("basicData",
                {{"name", fmt::format("Unsigned{}BE", bits)},
                 {"size", std::to_string(bits)},
                 {"interpretation", fmt::format("Whole number from 0 to 2^{} - 1", bits)},
                 {"endian", "Big"},
                 {"encoding", "Binary, most significant bit first"}});
  }
  xml.close();
}

void write_numbers(Xml& xml, const ModelTypes& types) {
  xml.open("simpleDataTypes");
  for (const auto& [name, number] : types.numbers) {
    xml.open("simpleData");
    xml.leaf("name", name);
    xml.leaf("representation", representation_of(number.octets, number.kind));
    xml.leaf("units", number.unit);
    xml.leaf("resolution", "NA");
    xml.leaf("accuracy", "NA");
    xml.close();
  }
  xml.close();
}

void write_enumerations(Xml& xml, const ModelTypes& types) {
  xml.open("enumeratedDataTypes");
  for (const auto& [name, enumeration] : types.enumerations) {
    xml.open("enumeratedData");
    xml.leaf("name", name);
    xml.leaf("representation", representation_of(enumeration.octets, 'u'));
    xml.leaf("semantics", "SISO-REF-010; values without a name here may occur");
    for (const auto& [value, text] : enumeration.values) {
      xml.element("enumerator", {{"name", text}, {"value", std::to_string(value)}});
    }
    xml.close();
  }
  xml.close();
}

void write_arrays_and_records(Xml& xml, const ModelTypes& types) {
  xml.open("arrayDataTypes");
  for (const auto& [name, array] : types.arrays) {
    xml.open("arrayData");
    xml.leaf("name", name);
    xml.leaf("dataType", array.element);
    xml.leaf("cardinality", array.cardinality);
    xml.leaf("encoding", "The elements in sequence; their number is in the PDU");
    xml.close();
  }
  xml.close();
  xml.open("fixedRecordDataTypes");
  for (const auto& [name, members] : types.records) {
    xml.open("fixedRecordData");
    xml.leaf("name", name);
    xml.leaf("encoding", "The fields in sequence, big endian");
    for (const ModelField& field : members) {
      xml.element("field", {{"name", field.name}, {"dataType", field.type}});
    }
    xml.close();
  }
  xml.close();
}

std::string object_model() {
  ModelTypes types;
  Xml xml;
  xml.line("<?xml version=\"1.0\" encoding=\"UTF-8\"?>");
  xml.open("objectModel xmlns=\"http://standards.ieee.org/IEEE1516-2010\"");
  write_identification(xml);
  write_objects(xml, types);
  write_interactions(xml, types, pdu::PduTypes{});
  xml.open("dataTypes");
  write_representations(xml);
  write_numbers(xml, types);
  write_enumerations(xml, types);
  write_arrays_and_records(xml, types);
  xml.close();
  xml.close();
  return xml.text();
}

int check(const char* path) {
  std::ifstream file(path, std::ios::binary);
  const std::string there{std::istreambuf_iterator<char>(file), {}};
  if (there == object_model()) return 0;
  fmt::print(stderr,
             "{}: is not the object model of the field tables; renew it with\n"
             "  reckon_object_model > {}\n",
             path, path);
  return 1;
}

}  // namespace
}  // namespace reckon::tools

int main(int argc, char** argv) {
  if (argc == 3 && std::string_view(argv[1]) == "--check") return reckon::tools::check(argv[2]);
  if (argc == 1) {
    fmt::print("{}", reckon::tools::object_model());
    return 0;
  }
  fmt::print(stderr, "usage: reckon_object_model [--check FILE]\n");
  return 2;
}
