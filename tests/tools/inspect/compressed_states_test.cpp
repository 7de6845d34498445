// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// `reckon inspect` of Compressed States: the fields of the restored states.
#include <gmock/gmock.h>

#include <array>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "reckon/tests/tools/support/captured_console.hpp"
#include "reckon/tests/tools/support/compressed_ship.hpp"

namespace reckon::tools {
namespace {

using nlohmann::json;
using std::chrono::milliseconds;
using std::chrono::seconds;
using test::run_reckon;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// A capture of a ship's updates from `first` on.
class ShipCapture {
 public:
  ShipCapture(pdu::CompressedForm form, int first, int updates) {
    peer::StateCompressor compressor(form);
    pdu::EntityState state;
    state.marking.set("SHIP");
    state.entity_type = {pdu::EntityKind::platform, pdu::EntityDomain::surface, 225, 3, 0, 0, 0};
    state.force_id = pdu::ForceId::opposing;
    for (int update = 0; update < first + updates; ++update) {
      const auto time = seconds(1'700'000'000) + update * milliseconds(500);
      const auto datagram = test::compressed_ship(compressor, update, time, state);
      if (update < first) continue;
      capture_.add(datagram, time);
      states_.push_back(state);
    }
  }
  [[nodiscard]] test::ProgramResult inspect(std::vector<std::string> words) const {
    words.insert(words.begin(), {"inspect", capture_.path()});
    return run_reckon(words);
  }
  [[nodiscard]] std::vector<json> rows(std::vector<std::string> words) const {
    std::vector<json> rows;
    for (const std::string& line : inspect(std::move(words)).lines())
      rows.push_back(json::parse(line));
    return rows;
  }
  [[nodiscard]] const pdu::EntityState& state(std::size_t update) const { return states_[update]; }

 private:
  test::CaptureBuilder capture_;
  std::vector<pdu::EntityState> states_;
};

TEST(InspectCompressedStates, GivesTheirFieldsAsJson) {
  const ShipCapture ship(pdu::CompressedForm::compact, 0, 3);
  const json row = ship.rows({"--full"})[2];
  EXPECT_EQ(row["type"], "compressed_states");
  ASSERT_EQ(row["states"].size(), 1U);
  const json& state = row["states"][0];
  EXPECT_EQ(state["id"], "7:1:3");
  EXPECT_EQ(state["form"], "Compact");
  EXPECT_EQ(state["offset"], 20);
  EXPECT_EQ(state["octets"], row["length"].get<int>() - 20);
  EXPECT_EQ(state["marking"], "SHIP");
  EXPECT_EQ(state["force_id"], 2);
  EXPECT_EQ(state["drm"], 4);
  EXPECT_EQ(state["fields"]["entity_type"]["country"], 225);
  EXPECT_FLOAT_EQ(state["fields"]["entity_linear_velocity"]["x"], ship.state(2).linear_velocity.x);
  EXPECT_EQ(state["fields"]["entity_location"]["x"], ship.state(2).location.x);
}

/// The key of updates 2 to 4 is 1. The next one is 5, in the compact form.
constexpr std::size_t kWithoutKey = 3;

TEST(InspectCompressedStates, RestoresResidualsFromTheirKeys) {
  const ShipCapture ship(pdu::CompressedForm::residual, 2, 15);
  const std::vector<json> rows = ship.rows({"--full"});
  ASSERT_EQ(rows.size(), 15U);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const json& state = rows[i]["states"][0];
    EXPECT_EQ(state["id"], "7:1:3");
    EXPECT_EQ(state["form"] == "Compact", i == kWithoutKey) << state;
    if (i < kWithoutKey) {
      EXPECT_THAT(state["reason"], HasSubstr("its key, an earlier plain or compact state, is m"));
      EXPECT_FALSE(state.contains("marking"));
    } else {
      EXPECT_EQ(state["fields"]["entity_location"]["y"], ship.state(i).location.y) << i;
    }
  }
}

TEST(InspectCompressedStates, TakesPlainStatesAsKeys) {
  peer::StateCompressor compressor(pdu::CompressedForm::residual);
  test::CaptureBuilder capture;
  pdu::EntityState state;
  for (int update = 0; update < 11; ++update) {
    const auto time = seconds(1'700'000'000) + update * milliseconds(500);
    const auto datagram = test::compressed_ship(compressor, update, time, state);
    test::Octets plain;
    test::append_pdu(plain, state);
    // Two without a key, then a plain one.
    if (update >= 6) capture.add(update == 8 ? plain : datagram, time);
  }
  std::vector<bool> known;
  for (const std::string& line : run_reckon({"inspect", capture.path(), "--json"}).lines())
    known.push_back(line.find("\"location\"") != std::string::npos);
  EXPECT_EQ(known, (std::vector<bool>{false, false, true, true, true}));
}

TEST(InspectCompressedStates, ShowsALineAndATreeForEach) {
  const ShipCapture ship(pdu::CompressedForm::residual, 4, 2);
  const std::vector<std::string> lines = ship.inspect({}).lines();
  ASSERT_EQ(lines.size(), 5U);
  EXPECT_THAT(lines[1], HasSubstr("compressed_states"));
  EXPECT_THAT(lines[2], AllOf(HasSubstr("Residual state"), HasSubstr("7:1:3"),
                              HasSubstr("cannot be restored: its key")));
  EXPECT_THAT(lines[4], AllOf(HasSubstr("7:1:3"), HasSubstr("SHIP  Platform Surface United States"),
                              HasSubstr("DRM RVW"), HasSubstr(" sent ")));
  const std::string tree = ship.inspect({"--tree"}).out;
  EXPECT_THAT(tree, HasSubstr("\n  state 7:1:3 +20  Residual  "));
  EXPECT_THAT(tree, HasSubstr("octets  cannot be restored: its key"));
  EXPECT_THAT(tree, HasSubstr("\n    entity_linear_velocity x -"));
}

TEST(InspectCompressedStates, MatchFiltersByAnyOfTheirStates) {
  const ShipCapture ship(pdu::CompressedForm::residual, 2, 20);
  const auto found = [&](const char* where) {
    return ship.rows({"--json", "--where", where}).size();
  };
  for (const char* all : {"id == 7:1:3", "type == compressed_states", "not marking == SHAPE"})
    EXPECT_EQ(found(all), 20U) << all;
  for (const char* restored :
       {"marking == SHIP", "entity.type == 1.3.225", "side == opposing", "speed > 7",
        "latitude > 40 and latitude < 60", "entity_location.x > 2999000 and drm == rvw",
        "entity_linear_velocity.z == 0",
        "type == compressed_states and not side == friendly "
        "and kind == platform"})
    EXPECT_EQ(found(restored), 20U - kWithoutKey) << restored;
  EXPECT_EQ(found("side == friendly"), 0U);
  EXPECT_EQ(found("not id == 7:1:3"), 0U);
  EXPECT_EQ(found("not marking == SHIP"), kWithoutKey);
}

TEST(InspectCompressedStates, AreCountedAsOnePdu) {
  const auto result = ShipCapture(pdu::CompressedForm::compact, 0, 3).inspect({"--json"});
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.err, HasSubstr("3 PDUs in 3 datagrams: 3 good"));
  EXPECT_THAT(result.out, Not(HasSubstr("\"fields\"")));
}

TEST(InspectCompressedStates, GiveTheNumberOfAnUnknownForm) {
  pdu::CompressedStates states;
  states.simulation = {7, 1};
  states.form = static_cast<pdu::CompressedForm>(9);
  states.number_of_states = 1;
  const std::array<std::byte, 8> octets{std::byte{0}, std::byte{3}};
  states.states.bytes = octets;
  test::Octets datagram;
  test::append_pdu(datagram, states);
  test::CaptureBuilder capture;
  capture.add(datagram, seconds(1'700'000'000));
  EXPECT_THAT(run_reckon({"inspect", capture.path(), "--tree"}).out, HasSubstr("  form 9  "));
  EXPECT_THAT(run_reckon({"inspect", capture.path()}).out, HasSubstr("form 9 state"));
}

TEST(InspectViews, TakeSourceAndViewInEitherOrder) {
  test::CaptureBuilder capture;
  test::Octets octets;
  test::append_pdu(octets, pdu::EntityState{});
  capture.add(octets, seconds(1'700'000'000));
  const std::string file = capture.path();
  for (const char* view : {"tail", "stats", "check", "bundles", "haptics", "top"}) {
    const auto behind = run_reckon({"inspect", file, view});
    const auto before = run_reckon({"inspect", view, file});
    EXPECT_EQ(before.out, behind.out) << view;
    EXPECT_EQ(before.status, behind.status) << view;
    const auto between = run_reckon({"inspect", "--json", view, "--where", "pdu == 1", file});
    EXPECT_EQ(between.status, behind.status) << view;
  }
  const auto wrong = run_reckon({"inspect", file, "stat"});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_THAT(wrong.err, HasSubstr("VIEW: 'stat' is not one of tail, stats, "));
  EXPECT_THAT(wrong.err, HasSubstr("did you mean 'stats'?"));
}

}  // namespace
}  // namespace reckon::tools
