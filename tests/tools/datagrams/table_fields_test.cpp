// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Fields of every PDU type in a filter, by their names in JSON: each field of each golden sample
// selects that sample by its value.
#include <gmock/gmock.h>

#include <deque>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "reckon/pdu/pdu_types.hpp"
#include "reckon/tests/support/allocation_guard.hpp"
#include "reckon/tests/support/capture_builder.hpp"
#include "reckon/tests/support/wire_samples.hpp"
#include "reckon/tests/tools/support/captured_console.hpp"
#include "reckon/tools/datagrams/filter.hpp"

namespace reckon::tools::table_fields_test {
namespace {

using nlohmann::json;
using test::append_pdu;
using test::CaptureBuilder;
using test::Octets;
using test::run_reckon;
using ::testing::HasSubstr;
using ::testing::Not;

/// A datagram of one PDU as the inspector shows it.
struct Shown {
  Octets octets;
  DatagramInspector inspector;  // the row points into it
  PduRow row;
  peer::SourceDatagram datagram;

  Shown(const Shown&) = delete;
  Shown& operator=(const Shown&) = delete;
  explicit Shown(Octets from) : octets(std::move(from)) {
    datagram.bytes = octets;
    (void)inspector.inspect(datagram, [this](const PduRow& shown) {
      row = shown;
      return true;
    });
  }
  [[nodiscard]] bool matches(const std::string& text) const {
    return Filter(text).matches(row, datagram);
  }
};

template <typename Pdu>
Shown shown(const Pdu& pdu) {
  Octets octets;
  append_pdu(octets, pdu);
  return Shown(octets);
}

/// Every golden sample, and its values by their paths: "systems.beams.frequency" -> the values of
/// all beams of all systems, as in JSON.
struct Sample {
  std::string name;
  Shown shown;
  std::map<std::string, std::set<std::string>> values;
  Sample(const std::string& of, Octets octets) : name(of), shown(std::move(octets)) {
    collect(test::sample_values(of), "");
  }

 private:
  void collect(const json& value, const std::string& path) {
    if (value.is_object()) {
      for (const auto& [key, inner] : value.items())
        collect(inner, path.empty() ? key : path + "." + key);
    } else if (value.is_array()) {
      for (const json& element : value) collect(element, path);
    } else {
      values[path].insert(value.is_string() ? value.get<std::string>() : value.dump());
    }
  }
};

const std::deque<Sample>& samples() {
  static const std::deque<Sample> kSamples = [] {
    std::deque<Sample> all;
    const auto folder = test::sample_path("", "").parent_path();
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      if (entry.path().extension() != ".hex") continue;
      const std::string name = entry.path().stem();
      all.emplace_back(name, test::sample_octets(name));
    }
    return all;
  }();
  return kSamples;
}

std::string quoted(const std::string& value) {
  return (value.find('\'') == std::string::npos ? "'" + value + "'" : "\"" + value + "\"");
}

TEST(TableFields, EachValueSelectsItsSamplesOnly) {
  std::set<std::string> asked;
  std::size_t filters = 0;
  for (const Sample& sample : samples()) {
    for (const auto& [path, values] : sample.values) {
      for (const std::string& value : values) {
        const std::string text = "fields." + path + " == " + quoted(value);
        if (!asked.insert(text).second) continue;
        ++filters;
        const Filter filter(text);
        for (const Sample& other : samples()) {
          const auto there = other.values.find(path);
          const bool expected = there != other.values.end() && there->second.contains(value);
          EXPECT_EQ(filter.matches(other.shown.row, other.shown.datagram), expected)
              << text << " for " << other.name;
        }
      }
    }
  }
  RecordProperty("filters", static_cast<int>(filters));
  EXPECT_GE(samples().size(), 76U);
  EXPECT_GT(filters, 1400U);
}

TEST(TableFields, NeedOnlyTheEndOfTheirPath) {
  for (const Sample& sample : samples()) {
    for (const auto& [path, values] : sample.values) {
      const std::size_t dot = path.find('.');
      if (dot == std::string::npos) continue;
      // The inspector's own list has names of one word, and location.x; a field with the whole name
      // takes precedence.
      const std::string end = path.substr(dot + 1);
      if (end.find('.') == std::string::npos || end.starts_with("location.") ||
          sample.values.contains(end))
        continue;
      EXPECT_TRUE(sample.shown.matches(end + " == " + quoted(*values.begin())))
          << sample.name << ": " << end;
    }
  }
}

TEST(TableFields, AreListedForEveryType) {
  for (const Sample& sample : samples()) {
    const std::string text = "\n" + run_reckon({"inspect", "--fields", sample.name}).out;
    for (const auto& [path, values] : sample.values)
      EXPECT_THAT(text, HasSubstr("\n" + path + "\n")) << sample.name;
  }
  const auto wrong = run_reckon({"inspect", "--fields", "transmiter"});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_THAT(wrong.err, HasSubstr("did you mean 'transmitter'?"));
}

pdu::EntityState tank() {
  pdu::EntityState pdu;
  pdu.entity_id = {1, 20, 300};
  pdu.entity_type = {pdu::EntityKind::platform, pdu::EntityDomain::land, 225, 1, 0, 0, 0};
  pdu.location = {4336565.215, -2958480.588, 3612345.0};
  pdu.orientation = {0.1F, -0.25F, 3.0F};
  pdu.appearance = 1U << 3;  // slight damage
  pdu.marking.set("TANK 7");
  return pdu;
}

TEST(TableFields, TakeNamesOfValuesBitsIdsAndWildcards) {
  const Shown sample = shown(tank());
  for (const char* yes : {"entity_type.country == usa",
                          "entity_type.country == 'united states'",
                          "entity_type.country_name == '*states'",
                          "header.pdu_type == 'Entity State'",
                          "psi > 0.09 and psi < 0.11",
                          "entity_orientation.psi == 0.1",
                          "theta == -0.25",
                          "entity_location.x > 4.3e6",
                          "entity_id == 1:20:300",
                          "entity_id == 1:*:300",
                          "entity_id != 1:20:301",
                          "entity_id.site == 1",
                          "entity_appearance == 8",
                          "entity_appearance.damage == slight_damage",
                          "entity_appearance_bits.damage == 1",
                          "damage == slight_damage",
                          "damage != destroyed",
                          "entity_marking_string == 'tank*'",
                          "fields.force_id == 0",
                          "other_parameters == 000000000000000000000000000000"})
    EXPECT_TRUE(sample.matches(yes)) << yes;
  for (const char* no : {"entity_type.country == germany", "damage == destroyed", "psi < 0.1",
                         "psi > 0.1", "entity_id == 2:*:*", "entity_id == 1:20", "frequency > 0",
                         "frequency < 0", "radio_number != 1", "entity_marking_string != 'tank*'"})
    EXPECT_FALSE(sample.matches(no)) << no;
}

TEST(TableFields, PreferTheFieldWithTheWholePath) {
  pdu::EntityState pdu = tank();
  std::array<std::byte, pdu::kVariableParameterSize> octets{};
  pdu::EntityAssociation association;
  association.entity_id = {7, 8, 9};
  ASSERT_GT(store_record(association, octets), 0U);
  pdu.variable_parameters = octets;
  const Shown sample = shown(pdu);
  EXPECT_FALSE(sample.matches("entity_id == 7:8:9"));
  EXPECT_TRUE(sample.matches("variable_parameters.entity_id == 7:8:9"));
  EXPECT_TRUE(sample.matches("variable_parameters[0].entity_id == 7:8:9"));
  EXPECT_FALSE(sample.matches("variable_parameters[1].entity_id == 7:8:9"));
}

TEST(TableFields, CompareWholeNumbersExactly) {
  pdu::Presence pdu;
  pdu.scene_hash = 10428333160412253831U;
  const Shown sample = shown(pdu);
  EXPECT_TRUE(sample.matches("scene_hash == 10428333160412253831"));
  EXPECT_FALSE(sample.matches("scene_hash == 10428333160412253830"));
  EXPECT_TRUE(sample.matches("scene_hash > 10428333160412253830"));
}

TEST(TableFields, WithoutAFieldTableIncludeTheHeader) {
  Octets octets;
  append_pdu(octets, tank());
  octets[2] = std::byte{220};
  const Shown sample(octets);
  EXPECT_TRUE(sample.matches("header.pdu_type == 220"));
  EXPECT_TRUE(sample.matches("not entity_appearance == 8"));
}

std::string refusal(const std::string& text) {
  try {
    (void)Filter(text);
  } catch (const FilterError& error) {
    return error.what();
  }
  return "";
}

TEST(TableFields, ErrorsNameWrongNamesAndValues) {
  EXPECT_THAT(refusal("frequancy > 3"), HasSubstr("did you mean 'frequency'?"));
  EXPECT_THAT(refusal("descriptor.munition_typ.kind == 2"),
              HasSubstr("did you mean 'descriptor.munition_type.kind'?"));
  EXPECT_THAT(refusal("qqqqqqqqqqqq == 2"), HasSubstr("--fields TYPE"));
  EXPECT_THAT(refusal("frequency == loud"), HasSubstr("column 14: 'loud' is not a number"));
  EXPECT_THAT(refusal("entity_marking_string > 3"), HasSubstr("allows == and != only"));
  EXPECT_THAT(refusal("frequency >"), HasSubstr("expected a value of frequency"));
  for (const char* wrong : {".x == 1", "a..b == 1", "psi. == 1", "systems[ == 1", "systems[1 == 1",
                            "systems[x].beams == 1", "[0] == 1", "fields. == 1"})
    EXPECT_THAT(refusal(wrong), HasSubstr("there is no field")) << wrong;
}

TEST(TableFields, TakeLittleMemoryWhereTheyAreMany) {
  std::string text = "ez==1";
  while (text.size() < Filter::kLongest - 10) text += "||ez==1";
  const test::AllocationGuard guard;
  const Filter filter(text);
  EXPECT_LE(guard.peak_octets(), 128 * text.size() + 16384);
}

TEST(PlaceFields, AreDegreesAndMetresOfAnyPosition) {
  pdu::EntityState pdu;
  pdu.location = {6378137.0 + 100.0, 0, 0};
  const Shown entity = shown(pdu);
  for (const char* yes : {"latitude == 0", "longitude == 0", "height > 99.99 and height < 100.01",
                          "location.x == 6378237", "location.y == 0", "location.z == 0",
                          "port != 3000 or not port == 3000"})
    EXPECT_TRUE(entity.matches(yes)) << yes;
  pdu::Fire fire;
  fire.location_in_world_coordinates = {0, 6378137.0, 0};
  EXPECT_TRUE(shown(fire).matches("longitude == 90 and latitude == 0"));
  fire.location_in_world_coordinates = {0, 0, 6356752.314245179};
  EXPECT_TRUE(shown(fire).matches("latitude == 90 and height > -0.001 and height < 0.001"));
  EXPECT_FALSE(shown(pdu::Comment{}).matches("latitude > -91"));
  // A position at the centre of the earth is none.
  EXPECT_FALSE(shown(pdu::Fire{}).matches("latitude > -91"));
}

TEST(PlaceFields, KnowPortAndArrival) {
  CaptureBuilder capture;
  for (std::uint16_t i = 1; i <= 10; ++i) {
    pdu::EntityState pdu;
    pdu.entity_id = {1, 1, i};
    Octets datagram;
    append_pdu(datagram, pdu);
    capture.add(datagram, std::chrono::seconds(1'700'000'000 + i));
  }
  const auto lines = [&](const std::string& where) {
    return run_reckon({"inspect", capture.path(), "--json", "--where", where}).lines().size();
  };
  EXPECT_EQ(lines("time < 3"), 3U);
  EXPECT_EQ(lines("time >= 3 and time <= 4.5"), 2U);
  EXPECT_EQ(lines("port == 3000"), 10U);
  EXPECT_EQ(lines("port != 3000"), 0U);
  EXPECT_EQ(lines("sender_port == 3000 or sender_port > 0"), 10U);
}

}  // namespace
}  // namespace reckon::tools::table_fields_test
