// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/pdu/field_names.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>

#include "reckon/pdu/print.hpp"
#include "reckon/tests/support/places.hpp"

namespace reckon::pdu {
namespace {

/// All captures of the first group of `pattern`: in the list of names, or in the rest of pdu/.
std::set<std::string> found(const std::string& pattern, bool in_list) {
  std::set<std::string> names;
  const std::regex expression(pattern);
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(reckon::test::source_dir() + "/pdu")) {
    if ((entry.path().filename() == "field_names.cpp") != in_list) continue;
    if (entry.path().extension() != ".hpp" && entry.path().extension() != ".cpp") continue;
    std::ifstream stream(entry.path());
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    for (std::sregex_iterator at(text.begin(), text.end(), expression), end; at != end; ++at)
      names.insert((*at)[1]);
  }
  return names;
}

TEST(FieldNames, HaveOnlyRowsOfFieldsThatExist) {
  const auto rows = found("(?:values|bits)\\(\"(\\w+)\"", true);
  EXPECT_GT(rows.size(), 70U);
  std::set<std::string> fields = found("\"(\\w+)\"", false);
  fields.merge(found("\\n  [\\w:<>, ]+ (\\w+)(?: = \\w+|\\{\\})?;", false));  // members
  for (const std::string& row : rows) EXPECT_TRUE(fields.contains(row)) << row;
}

/// Visitor: an enumeration with its own type must not be listed under another table.
class NamedTwice {
 public:
  template <typename Record>
  explicit NamedTwice(const Record& record) : meanings_(record) {}

  template <typename T>
  void operator()(std::string_view name, const T& value) {
    if constexpr (std::is_enum_v<T>) {
      const FieldMeaning meaning = meanings_.of(name);
      EXPECT_EQ(meaning.bits, SisoBits::none) << name;
      if (meaning.values == SisoTable::none) return;
      for (unsigned i = 0; i < 256; ++i)
        EXPECT_EQ(siso_name(meaning.values, i), pdu::name(static_cast<T>(i))) << name << i;
    } else if constexpr (!Scalar<T> && !kIsStdArray<T>) {
      NamedTwice inner(value);
      fields(inner, value);
    }
  }
  template <typename View, typename Record, typename Count>
  void count(std::string_view, const View&, Records<Record, Count>) {}
  template <typename View, typename Record, typename Count>
  void records(std::string_view, const View&, Records<Record, Count>) {
    const Record record{};
    NamedTwice inner(record);
    fields(inner, record);
  }
  template <typename... Any>
  void walked(Any&&...) {}

 private:
  FieldMeanings meanings_;
};

template <typename... T>
void look_at_all(TypeList<T...>) {
  const auto look = [](const auto& pdu) {
    NamedTwice named(pdu);
    fields(named, pdu);
  };
  (look(T{}), ...);
}

TEST(FieldNames, AgreeWithTheTypesOfEnumerations) { look_at_all(PduTypes{}); }

template <typename T>
std::string tree(const T& pdu) {
  std::string text;
  TextSink sink(text);
  print_tree(pdu, sink);
  return text;
}

template <typename T>
std::string json(const T& pdu) {
  std::string text;
  TextSink sink(text);
  print_named_json(pdu, sink);
  return text;
}

EntityState tank() {
  EntityState pdu;
  pdu.force_id = ForceId::opposing;
  pdu.entity_type = {EntityKind::platform, EntityDomain::land, 225, 1, 1, 3, 0};
  pdu.appearance = kAppearanceFrozen | 3U << 3U | 1U << 12U;
  pdu.capabilities = 2;
  return pdu;
}

#define EXPECT_HOLDS(text, part) EXPECT_NE((text).find(part), std::string::npos) << (text)

TEST(NamesInATree, FollowTheNumbersOfAnEntityState) {
  const std::string text = tree(tank());
  EXPECT_HOLDS(text,
               "entity_type kind 1 (Platform) domain 1 (Land) country 225 (United States) "
               "category 1 (Tank) subcategory 1 specific 3 extra 0\n");
  EXPECT_HOLDS(text,
               "entity_appearance 2101272\n  damage 3 (Destroyed)\n  head_lights 1 (On)\n"
               "  frozen 1 (Yes)\ndead_reckoning_parameters\n");
  EXPECT_HOLDS(text, "capabilities 2\n  fuel_supply 1 (Yes)\n");
}

TEST(NamesInATree, TakeTheAppearanceOfTheKindAndDomain) {
  EntityState pdu = tank();
  pdu.entity_type = {EntityKind::life_form, EntityDomain::land, 78, 130, 0, 0, 0};
  pdu.appearance = 4U << 16U;
  EXPECT_HOLDS(tree(pdu), "  posture 4 (Kneeling)\n");
  pdu.entity_type.kind = EntityKind::environmental;
  EXPECT_HOLDS(tree(pdu), "  density 4 (Opaque)\n");
  pdu.entity_type.kind = EntityKind{77};
  EXPECT_HOLDS(tree(pdu), "entity_appearance 262144\ndead");
}

TEST(NamesInATree, DependOnOtherFieldsOfTheirRecord) {
  Transmitter radio;
  radio.modulation_type = {1, 3, 1, 5};
  EXPECT_HOLDS(tree(radio),
               "modulation_type spread_spectrum 1 (frequency_hopping Yes) major_modulation 3 "
               "(Angle) detail 1 (FM (Frequency Modulation)) radio_system 5 (SINCGARS)\n");
  Signal signal;
  signal.encoding_scheme = 4;
  EXPECT_HOLDS(tree(signal), "  class 0 (Encoded audio)\n  type 4 (16-bit Linear PCM");
  signal.encoding_scheme = 0x4004;
  EXPECT_HOLDS(tree(signal), "  class 1 (Raw Binary Data)\n  messages 4\n");
  Detonation detonation;
  detonation.descriptor.warhead = 1000;
  EXPECT_HOLDS(tree(detonation), "warhead 1000 (High Explosive (HE))\n");
  detonation.header.pdu_status = 0x10;
  EXPECT_HOLDS(tree(detonation), "pdu_status 16 (detonation_type Expendable)");
  detonation.header.protocol_version = 6;
  EXPECT_HOLDS(tree(detonation), "pdu_status 16 padding");
  AggregateState unit;
  unit.aggregate_type.kind = 1;
  EXPECT_HOLDS(tree(unit), "aggregate_type kind 1 (Military Hierarchy)");
}

TEST(NamesInATree, NamePartAndMetricOfAnArticulation) {
  ArticulatedPart part;
  part.parameter_type = 4096 + 11;
  EXPECT_HOLDS(tree(part), "parameter_type 4107\n  part 128 (Primary Turret Number 1)\n");
  EXPECT_HOLDS(tree(part), "  metric 11 (Azimuth)\n");
}

TEST(NamesInJson, FollowNumbersThatStay) {
  const std::string text = json(tank());
  EXPECT_HOLDS(text, R"("force_id":2,"force_id_name":"Opposing",)");
  EXPECT_HOLDS(text, R"("country":225,"country_name":"United States",)");
  EXPECT_HOLDS(text, R"("subcategory":1,"specific":3,"extra":0)");
  EXPECT_HOLDS(text, R"("entity_appearance":2101272,"entity_appearance_bits":)"
                     R"({"damage":"Destroyed","head_lights":"On","frozen":"Yes"},)");
}

TEST(NamesInJson, AreLeftOutOfPlainNumbers) {
  std::string text;
  TextSink sink(text);
  print_json(tank(), sink);
  EXPECT_EQ(text.find("_name"), std::string::npos) << text;
  EXPECT_EQ(text.find("_bits"), std::string::npos) << text;
}

TEST(TypeInWords, OmitsZerosAndGivesUnnamedNumbers) {
  const auto words = [](const EntityType& type) {
    std::string text;
    TextSink sink(text);
    put_type_in_words(sink, type);
    return text;
  };
  EXPECT_EQ(words(tank().entity_type), "Platform Land United States Tank");
  EXPECT_EQ(words({EntityKind::life_form, EntityDomain::land, 0, 0, 0, 0, 0}), "Life form Land");
  EXPECT_EQ(words({EntityKind::munition, EntityDomain{1}, 999, 77, 0, 0, 0}),
            "Munition Anti-Air country 999 category 77");
  EXPECT_EQ(words({EntityKind{12}, EntityDomain{9}, 0, 0, 0, 0, 0}), "kind 12 domain 9");
}

}  // namespace
}  // namespace reckon::pdu
