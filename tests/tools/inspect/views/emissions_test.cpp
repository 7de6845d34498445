// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// `reckon inspect FILE emissions`: the emissions by entity in a capture of the test.
#include <gmock/gmock.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "reckon/pdu/pdu_types.hpp"
#include "reckon/tests/support/capture_builder.hpp"
#include "reckon/tests/support/emission_samples.hpp"
#include "reckon/tests/support/reference_data.hpp"
#include "reckon/tests/tools/support/captured_console.hpp"

namespace reckon::tools::emissions_test {
namespace {

using namespace std::chrono_literals;
using nlohmann::json;
using test::run_reckon;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr std::chrono::nanoseconds kStart = 1'700'000'000s;

std::vector<json> emissions_of(const std::string& file) {
  std::vector<json> rows;
  const auto result = run_reckon({"inspect", file, "emissions", "--json"});
  EXPECT_EQ(result.status, 0) << result.err;
  for (const std::string& line : result.lines()) rows.push_back(json::parse(line));
  return rows;
}

std::vector<std::size_t> beams_of(const std::vector<json>& rows) {
  std::vector<std::size_t> beams;
  for (const json& row : rows) beams.push_back(row["beams"].size());
  return beams;
}

TEST(InspectEmissions, ShowsSystemsBeamsAndTargets) {
  for (const int version : {6, 7}) {
    test::CaptureBuilder capture;
    const auto all = static_cast<std::uint8_t>(version);
    capture.add(test::emission_pdu({1, 1, 9}, test::kThreeSystems, 0, all), kStart);
    capture.add(test::emission_pdu({1, 1, 9}, {{2, {{5, 0}}}}, 1, all), kStart + 3s);
    const std::string file = capture.path();
    const auto rows = emissions_of(file);
    EXPECT_THAT(beams_of(rows), ElementsAre(0U, 3U, 1U));
    EXPECT_EQ(rows[0]["id"], "1:1:9");
    EXPECT_EQ(rows[0]["kind"], "emitter");
    EXPECT_EQ(rows[0]["emits"], false);
    EXPECT_EQ(rows[1]["number"], 2);
    EXPECT_EQ(rows[1]["since"], 0.0);
    EXPECT_EQ(rows[1]["last"], 3.0);
    EXPECT_EQ(rows[1]["updates"], 2);
    EXPECT_EQ(rows[1]["fields"]["emitter_function_name"], "Multi-function");
    EXPECT_EQ(rows[1]["beams"][2]["since"], 3.0);
    const json& targets = rows[2]["beams"][0]["track_jam_targets"];
    ASSERT_EQ(targets.size(), 2U);
    EXPECT_EQ(targets[1]["entity_id"]["entity"], 101);
    const auto text = run_reckon({"inspect", file, "emissions"}).lines();
    EXPECT_THAT(text,
                Contains(AllOf(HasSubstr("1:1:9"), HasSubstr("emitter 1"), HasSubstr("no beam"))));
    EXPECT_THAT(text, Contains(AllOf(HasSubstr("emitter 2"), HasSubstr("3 beams"))));
    EXPECT_THAT(text, Contains(AllOf(HasSubstr("beam 1"), HasSubstr("9.4 GHz"),
                                     HasSubstr("targets 2:1:100 2:1:101"))));
  }
}

TEST(InspectEmissions, ShowsCodesRadiosAndEndedOnes) {
  test::CaptureBuilder capture;
  test::Octets datagram;
  pdu::Iff iff;
  iff.emitting_entity_id = {1, 1, 9};
  iff.system_type = 1;
  iff.system_status = 1;
  iff.parameter_3 = 0x2000 | 01274;
  test::append_pdu(datagram, iff);
  pdu::Transmitter radio;
  radio.radio_reference_id = {1, 1, 9};
  radio.radio_number = 3;
  radio.transmit_state = 2;
  radio.frequency = 251'500'000;
  test::append_pdu(datagram, radio);
  capture.add(datagram, kStart);
  capture.add(test::emission_pdu({1, 1, 8}, {{1}}), kStart + 10s);
  const std::string file = capture.path();
  const auto rows = emissions_of(file);
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[1]["kind"], "iff");
  EXPECT_EQ(rows[1]["over"], false);
  EXPECT_EQ(rows[1]["fields"]["parameter_3_read"]["mode_3a"], "4721");
  EXPECT_EQ(rows[2]["kind"], "radio");
  EXPECT_EQ(rows[2]["over"], true) << "2.4 heartbeats of 2 s";
  EXPECT_EQ(rows[2]["fields"]["frequency"], 251'500'000);
  const auto text = run_reckon({"inspect", file, "emissions"}).lines();
  EXPECT_THAT(text, Contains(AllOf(HasSubstr("IFF 0"), HasSubstr("mode_3a 4721"))));
  EXPECT_THAT(text, Contains(AllOf(HasSubstr("radio 3"), HasSubstr("transmitting, over"),
                                   HasSubstr("251.5 MHz"))));
}

TEST(InspectEmissions, ReadsACaptureOfAnotherPacker) {
  RECKON_NEED_DATA("field/f06-ee-zero-beams.pcap");
  const auto rows = emissions_of(test::reference_data() / "field/f06-ee-zero-beams.pcap");
  EXPECT_THAT(beams_of(rows), ElementsAre(0U, 2U, 1U));
  EXPECT_EQ(rows[1]["beams"][0]["track_jam_targets"].size(), 1U);
  EXPECT_EQ(rows[1]["beams"][1]["track_jam_targets"].size(), 0U);
  EXPECT_EQ(rows[2]["beams"][0]["track_jam_targets"].size(), 2U);
  EXPECT_EQ(rows[0]["updates"], 2) << "by DIS 6 and by DIS 7";
}

}  // namespace
}  // namespace reckon::tools::emissions_test
