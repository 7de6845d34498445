// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// `reckon zwidth`: the effect of each flag, its files and its errors.
#include <gmock/gmock.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "reckon/tests/bench/support/bench_console.hpp"
#include "reckon/tests/support/scratch_folder.hpp"
#include "reckon/tests/tools/support/written_files.hpp"

namespace reckon::bench {
namespace {

using nlohmann::json;
using test::content;
using test::run_bench;
using ::testing::HasSubstr;

json first_row(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "zwidth");
  arguments.insert(arguments.end(), {"--walls", "0", "--json"});
  const auto result = run_bench(arguments);
  EXPECT_EQ(result.status, 0) << result.err;
  return result.lines().empty() ? json() : json::parse(result.lines().front());
}

TEST(ZWidthVerb, ShowsTheBorderOfAnOrdinaryDevice) {
  const auto result = run_bench({"zwidth", "--walls", "0,0.5"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("mass 100 g, damping 1 N s/m, 1 kHz, no delay"));
  EXPECT_THAT(result.out, ::testing::ContainsRegex("\n +0 +2000 +2000 +2000 "));
  EXPECT_THAT(result.out, ::testing::ContainsRegex("\n +0.5 +1000 +1000 +1000 "));
  EXPECT_THAT(result.out, HasSubstr("A wall of 2 kN/m needs a device with more than 1 N s/m"));
}

TEST(ZWidthVerb, EachFlagHasItsEffect) {
  const json plain = first_row({});
  EXPECT_DOUBLE_EQ(plain["passive"], 2000.0);
  EXPECT_DOUBLE_EQ(first_row({"--damping", "2 N s/m"})["passive"], 4000.0);
  EXPECT_DOUBLE_EQ(first_row({"--rate", "4kHz"})["passive"], 8000.0);
  EXPECT_DOUBLE_EQ(first_row({"--delay", "2ms"})["passive"], 400.0);
  EXPECT_EQ(first_row({"--delay", "2.1ms"})["device_delay_samples"], 3) << "rounded up";
  EXPECT_NE(first_row({"--mass", "10g"})["unstable"], plain["unstable"]);
  EXPECT_EQ(first_row({"--mass", "10g"})["energy"], plain["energy"]) << "of the port alone";
}

TEST(ZWidthVerb, TakesTheDevicesOfAScene) {
  const test::ScratchFolder scratch;
  const std::string scene = scratch.file("lab.toml");
  std::ofstream(scene) << "[[operator]]\npassive = true\n[[device]]\n[[device]]\npeer = 2\n"
                          "damping = \"2 N s/m\"\nrate = \"2 kHz\"\ndelay = \"1 ms\"\n"
                          "max_stiffness = \"300 N/m\"\n";
  EXPECT_DOUBLE_EQ(first_row({scene})["passive"], 2000.0);
  const json second = first_row({scene, "--device", "2"});
  EXPECT_DOUBLE_EQ(second["passive"], 2 / (5e-4 * 2.5));
  EXPECT_EQ(second["device_delay_samples"], 2);
  EXPECT_DOUBLE_EQ(second["shown"], 300.0);
  EXPECT_DOUBLE_EQ(first_row({scene, "--device", "2", "--damping", "1"})["passive"],
                   1 / (5e-4 * 2.5))
      << "a flag goes before the scene";
  EXPECT_EQ(first_row({scene, "--device", "2", "--rate", "1kHz"})["device_delay_samples"], 1)
      << "the delay is a time";
  EXPECT_THAT(run_bench({"zwidth", scene, "--device", "2", "--walls", "0"}).out,
              HasSubstr("device 2 of 2"));
}

TEST(ZWidthVerb, WritesTableCurveAndPage) {
  const test::ScratchFolder scratch;
  const std::string csv = scratch.file("z.csv"), svg = scratch.file("z.svg"),
                    page = scratch.file("z.html");
  const auto result =
      run_bench({"zwidth", "--walls", "0..1/3", "--csv", csv, "--svg", svg, "--report", page});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(content(csv),
              ::testing::StartsWith("damping_Ns_m,undelayed_N_m,passive_N_m,energy_N_m,"
                                    "unstable_N_m,shown_N_m\n0,2000,2000,"));
  EXPECT_THAT(content(svg), HasSubstr("<circle"));
  EXPECT_THAT(content(page), HasSubstr("reckon zwidth --walls 0..1/3"));
  EXPECT_THAT(content(page), HasSubstr("<circle"));
}

TEST(ZWidthVerb, RefusesInvalidArguments) {
  const auto refusal = [](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "zwidth");
    const auto result = run_bench(arguments);
    EXPECT_EQ(result.status, 2) << result.out;
    return result.err;
  };
  EXPECT_THAT(refusal({"--device", "2"}), HasSubstr("--device needs a SCENE"));
  EXPECT_THAT(refusal({"--damping", "0"}), HasSubstr("--damping: '0' is not above 0"));
  EXPECT_THAT(refusal({"--damping", "1,2"}), HasSubstr("write one"));
  EXPECT_THAT(refusal({"--rate", "50Hz"}), HasSubstr("--rate: '50Hz' is not from 100 Hz"));
  EXPECT_THAT(refusal({"--delay", "2s"}), HasSubstr("2000 samples at 1 kHz; write at most 1000"));
  EXPECT_THAT(refusal({"--walls", "-1..1"}), HasSubstr("--walls"));
  EXPECT_THAT(refusal({"nowhere.toml"}), HasSubstr("nowhere.toml"));
  EXPECT_THAT(refusal({"--csv", "/nowhere/z.csv"}), HasSubstr("cannot be written"));
  EXPECT_THAT(refusal({"--wall", "0"}), HasSubstr("--walls"));
}

}  // namespace
}  // namespace reckon::bench
