// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// `reckon inspect` on captures of real products and on generated ones with known fields.
#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "reckon/pdu/type_names.hpp"
#include "reckon/tests/support/reference_data.hpp"
#include "reckon/tests/tools/support/captured_console.hpp"

namespace reckon::tools {
namespace {

using nlohmann::json;
using test::run_reckon;

std::filesystem::path captures() { return test::reference_data() / "dis-captures"; }

struct Inspected {
  int status;
  std::vector<json> rows;
  std::string err;
};

Inspected inspect_json(const std::string& source, const std::string& flag = "--json") {
  const auto result = run_reckon({"inspect", source, flag});
  Inspected inspected{result.status, {}, result.err};
  for (const std::string& line : result.lines()) inspected.rows.push_back(json::parse(line));
  return inspected;
}

json sidecar(const std::string& name) {
  std::ifstream file(captures() / "generated-a" / (name + ".json"));
  return json::parse(file).at("datagrams");
}

std::string id_text(const json& id) {
  return std::to_string(id[0].get<int>()) + ":" + std::to_string(id[1].get<int>()) + ":" +
         std::to_string(id[2].get<int>());
}

struct Session {
  const char* name;
  std::size_t datagrams;
  std::size_t pdus;
};

constexpr std::array kSessions{Session{"turn90-1", 197, 316},
                               Session{"turn90-2", 171, 279},
                               Session{"gaz69-straight", 174, 300},
                               Session{"gaz69-patrol", 231, 383},
                               Session{"gaz69-single-block", 320, 531},
                               Session{"gaz69-multi-block-1", 1280, 2109},
                               Session{"gaz69-multi-block-2", 1222, 2083}};

TEST(InspectFiles, ListsEveryPduOfTheRecordedSessions) {
  RECKON_NEED_DATA("dis-captures/real-sessions");
  std::size_t all = 0;
  std::map<std::string, std::size_t> types;
  for (const Session& session : kSessions) {
    const std::string file = captures() / "real-sessions" / (std::string(session.name) + ".pcap");
    const Inspected inspected = inspect_json(file);
    EXPECT_EQ(inspected.rows.size(), session.pdus) << session.name;
    EXPECT_EQ(inspected.rows.back()["frame"], session.datagrams) << session.name;
    EXPECT_NE(inspected.err.find(" in " + std::to_string(session.datagrams) + " datagrams"),
              std::string::npos)
        << inspected.err;
    all += inspected.rows.size();
    for (const json& row : inspected.rows) ++types[row["type"]];
  }
  EXPECT_EQ(all, 6001U);
  const std::map<std::string, std::size_t> expected{
      {"entity_state", 2132}, {"attribute", 2406},  {"environmental_process", 944},
      {"data", 275},          {"transmitter", 237}, {"receiver", 7}};
  EXPECT_EQ(types, expected);
}

TEST(InspectFiles, ShowsTheSameRowsInTheTable) {
  RECKON_NEED_DATA("dis-captures/real-sessions");
  const auto result = run_reckon({"inspect", captures() / "real-sessions/gaz69-patrol.pcap"});
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.lines().size(), 1U + 383U);
}

TEST(InspectFiles, NamesTheDatagramThatTheRecorderCut) {
  RECKON_NEED_DATA("dis-captures/real-sessions");
  for (const char* name : {"turn90-1", "turn90-2"}) {
    const Inspected inspected =
        inspect_json(captures() / "real-sessions" / (std::string(name) + ".pcap"));
    EXPECT_EQ(inspected.status, 1) << name;
    std::size_t errors = 0;
    for (const json& row : inspected.rows) {
      if (row["status"] != "error") continue;
      ++errors;
      EXPECT_EQ(row["rule"], "E-TRUNCATED");
      EXPECT_EQ(row["type"], "data");
      EXPECT_EQ(row["length"], 14064);
      EXPECT_NE(row["reason"].get<std::string>().find("8192 remain"), std::string::npos);
    }
    EXPECT_EQ(errors, 1U) << name;
  }
}

void expect_numbers(const json& object, std::initializer_list<const char*> keys,
                    const json& expected) {
  std::size_t i = 0;
  for (const char* key : keys) {
    const double wanted = expected[i++].get<double>();
    const double found = object.at(key).get<double>();
    // Floats are printed as the shortest decimal of 32 bits; the sidecar has 64 bits.
    EXPECT_EQ(static_cast<float>(found), static_cast<float>(wanted)) << key;
  }
}

void expect_entity_state(const json& row, const json& wanted) {
  EXPECT_EQ(row["id"], id_text(wanted["entityID"]));
  EXPECT_EQ(row["marking"], wanted["marking"]);
  EXPECT_EQ(row["force_id"], wanted["forceID"]);
  EXPECT_EQ(row["drm"], wanted["deadReckoningAlgorithm"]);
  const json& fields = row["fields"];
  for (std::size_t i = 0; i < 3; ++i) {
    const double exact = wanted["location"][i].get<double>();
    EXPECT_NEAR(row["location"][i].get<double>(), exact, 0.00051);
    EXPECT_EQ(fields["entity_location"][std::string(1, "xyz"[i])].get<double>(), exact);
  }
  static constexpr std::initializer_list<const char*> kXyz = {"x", "y", "z"};
  static constexpr std::initializer_list<const char*> kType = {
      "kind", "domain", "country", "category", "subcategory", "specific", "extra"};
  expect_numbers(fields["entity_type"], kType, wanted["entityType"]);
  expect_numbers(fields["alternate_entity_type"], kType, wanted["alternativeEntityType"]);
  expect_numbers(fields["entity_linear_velocity"], kXyz, wanted["linearVelocity"]);
  expect_numbers(fields["entity_orientation"], {"psi", "theta", "phi"}, wanted["orientation"]);
  EXPECT_EQ(fields["entity_appearance"], wanted["appearance"]);
  EXPECT_EQ(fields["capabilities"], wanted["capabilities"]);
  const json& reckoning = fields["dead_reckoning_parameters"];
  EXPECT_EQ(reckoning["other_parameters"], wanted["otherParameters"]);
  expect_numbers(reckoning["entity_linear_acceleration"], kXyz, wanted["linearAcceleration"]);
  expect_numbers(reckoning["entity_angular_velocity"], kXyz, wanted["angularVelocity"]);
  EXPECT_EQ(fields["variable_parameters"].size(), wanted["variableParameters"].size());
}

TEST(InspectFiles, ShowsGeneratedHeadersAndEntityStates) {
  RECKON_NEED_DATA("dis-captures/generated-a");
  std::size_t entity_states = 0;
  for (const char* name : {"a-entity-state", "a-interaction", "a-simulation-management", "a-radio",
                           "a-bundles", "a-custom"}) {
    const Inspected inspected =
        inspect_json(captures() / "generated-a" / (std::string(name) + ".pcap"), "--full");
    std::size_t i = 0;
    for (const json& datagram : sidecar(name)) {
      std::size_t number = 0;
      for (const json& wanted : datagram["pdus"]) {
        SCOPED_TRACE(std::string(name) + " frame " + datagram["frame"].dump());
        ASSERT_LT(i, inspected.rows.size());
        const json& row = inspected.rows[i++];
        EXPECT_EQ(row["frame"], datagram["frame"]);
        EXPECT_EQ(row["pdu"], ++number);
        EXPECT_EQ(row["type_number"], wanted["header"]["pduType"]);
        EXPECT_EQ(row["length"], wanted["header"]["length"]);
        EXPECT_EQ(row["fields"]["header"]["timestamp"], wanted["header"]["timestamp"]);
        EXPECT_EQ(row["fields"]["header"]["exercise_id"], wanted["header"]["exerciseID"]);
        const int type = row["type_number"];
        const bool known = pdu::is_named(static_cast<pdu::PduType>(type));
        EXPECT_TRUE(known ? row["status"] == "ok" : row["rule"] == "I-UNKNOWN-TYPE") << row;
        if (type != 1) continue;
        expect_entity_state(row, wanted["fields"]);
        ++entity_states;
      }
    }
    EXPECT_EQ(i, inspected.rows.size()) << name;
  }
  EXPECT_GE(entity_states, 24U);
}

/// The expected rule and octet of the first bad PDU of each malformed datagram.
struct Malformed {
  int frame;
  const char* rule;
  std::size_t pdu;
  std::size_t at;
};

constexpr std::array kMalformed = std::to_array<Malformed>(
    {{1, "E-TRUNCATED", 1, 0},    {2, "E-TRUNCATED", 1, 0},    {3, "E-TRUNCATED", 1, 0},
     {4, "E-TRUNCATED", 1, 0},    {5, "E-TRUNCATED", 1, 0},    {6, "E-TRUNCATED", 1, 0},
     {7, "E-TRUNCATED", 1, 0},    {8, "E-TRUNCATED", 1, 12},   {9, "E-TRUNCATED", 1, 13},
     {10, "E-TRUNCATED", 1, 143}, {11, "E-TRUNCATED", 1, 8},   {12, "E-TRUNCATED", 1, 8},
     {13, "E-TRUNCATED", 1, 8},   {14, "E-LENGTH", 1, 8},      {15, "E-LENGTH", 1, 8},
     {16, "E-LENGTH", 1, 8},      {17, "E-LENGTH", 1, 8},      {18, "E-LENGTH", 1, 8},
     {19, "E-TRUNCATED", 1, 8},   {20, "E-TRUNCATED", 1, 8},   {21, "E-COUNT", 1, 19},
     {22, "E-COUNT", 1, 72},      {23, "E-COUNT", 1, 32},      {24, "E-RECORD", 1, 40},
     {25, "E-COUNT", 1, 32},      {26, "E-COUNT", 1, 104},     {27, "E-COUNT", 1, 112},
     {28, "E-COUNT", 1, 88},      {29, "E-COUNT", 1, 88},      {30, "E-RECORD", 1, 40},
     {31, "E-RECORD", 1, 40},     {32, "E-RECORD", 1, 40},     {33, "E-LENGTH", 2, 152},
     {34, "E-TRUNCATED", 2, 244}, {35, "E-TRUNCATED", 2, 144}, {36, "W-NOT-FINITE", 1, 48},
     {37, "W-NOT-FINITE", 1, 48}, {38, "E-VERSION", 1, 0}});

TEST(InspectFiles, NamesRuleAndOctetOfEveryFault) {
  RECKON_NEED_DATA("dis-captures/generated-a");
  const Inspected inspected = inspect_json(captures() / "generated-a/a-malformed.pcap");
  EXPECT_EQ(inspected.status, 1);
  EXPECT_NE(inspected.err.find("38 datagrams"), std::string::npos);

  for (const Malformed& expected : kMalformed) {
    SCOPED_TRACE("frame " + std::to_string(expected.frame));
    const auto found = std::find_if(
        inspected.rows.begin(), inspected.rows.end(),
        [&](const json& row) { return row["frame"] == expected.frame && row["status"] != "ok"; });
    ASSERT_NE(found, inspected.rows.end());
    EXPECT_EQ((*found)["rule"], expected.rule);
    EXPECT_EQ((*found)["pdu"], expected.pdu);
    EXPECT_EQ((*found)["at"], expected.at);
    EXPECT_FALSE((*found)["reason"].get<std::string>().empty());
  }
}

TEST(InspectFiles, DeliversTheGoodPdusBeforeAFault) {
  RECKON_NEED_DATA("dis-captures/generated-a");
  const Inspected inspected = inspect_json(captures() / "generated-a/a-malformed.pcap");
  for (const json& datagram : sidecar("a-malformed")) {
    const auto good =
        std::count_if(inspected.rows.begin(), inspected.rows.end(), [&](const json& row) {
          return row["frame"] == datagram["frame"] &&
                 (row["status"] == "ok" || row["status"] == "warning");
        });
    EXPECT_EQ(good, datagram["valid_pdus_before"].get<long>()) << datagram["why"];
  }
}

TEST(InspectFiles, ReadsEveryBarePduAsOneDatagram) {
  RECKON_NEED_DATA("dis-captures/real-pdus");
  std::size_t files = 0;
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(captures() / "real-pdus")) {
    if (entry.is_directory()) continue;
    SCOPED_TRACE(entry.path());
    ++files;
    const Inspected inspected = inspect_json("raw:" + entry.path().string(), "--full");
    ASSERT_FALSE(inspected.rows.empty());
    std::size_t next = 0;
    for (const json& row : inspected.rows) {
      EXPECT_EQ(row["frame"], 1);
      EXPECT_EQ(row["offset"], next);
      next += row["length"].get<std::size_t>();
    }
    // This one file is a whole Ethernet frame and not a PDU.
    if (entry.path().filename() == "StartResumePdu.raw") {
      EXPECT_EQ(inspected.rows.front()["type"], "foreign");
      continue;
    }
    const json& first = inspected.rows.front();
    // Type 137 of JCATS is outside the standard.
    const bool known = first["type_number"] != 137;
    EXPECT_TRUE(known ? first["status"] == "ok" : first["rule"] == "I-UNKNOWN-TYPE") << first;
  }
  EXPECT_EQ(files, 36U);
}

}  // namespace
}  // namespace reckon::tools
