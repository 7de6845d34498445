// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reckon/tests/support/capture_builder.hpp"
#include "reckon/tests/tools/support/captured_console.hpp"
#include "reckon/tests/tools/support/driven_trucks.hpp"

namespace reckon::tools {
namespace {

using test::run_reckon;
using testing::HasSubstr;
using testing::MatchesRegex;

TEST(ViewVerb, ServesACaptureAndPrintsItsAddressAlone) {
  test::CaptureBuilder capture;
  for (const trucks::Sent& sent : trucks::drive(2, 2)) capture.add(sent.octets, sent.time);
  const auto result = run_reckon({"view", capture.path(), "--port", "0", "--for", "50ms"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, MatchesRegex("http://127\\.0\\.0\\.1:[0-9]+/#word=[0-9a-f]+\n"));
  EXPECT_THAT(result.err, HasSubstr("0 tabs looked"));
}

TEST(ViewVerb, SaysWhomElseAnAddressLetsIn) {
  test::CaptureBuilder capture;
  const auto result =
      run_reckon({"view", capture.path(), "--port", "0", "--listen", "0.0.0.0", "--for", "50ms"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("http://127.0.0.1:"));
}

TEST(ViewVerb, RefusesWhatItCannotServe) {
  EXPECT_EQ(run_reckon({"view", "/no/such.pcap", "--port", "0"}).status, 2);
  EXPECT_EQ(run_reckon({"view", "/no/such.toml", "--port", "0"}).status, 2);
  test::CaptureBuilder capture;
  EXPECT_EQ(run_reckon({"view", capture.path(), "--port", "70000"}).status, 2);
  EXPECT_EQ(run_reckon({"view", capture.path(), "--port", "0", "--listen", "nowhere"}).status, 3);
}

TEST(ViewVerb, IsNoPartOfASimulatedDemo) {
  const auto result = run_reckon({"demo", "--simulated-time", "--for", "1s", "--view"});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("--view"));
  EXPECT_EQ(run_reckon({"demo", "--view=x", "--for", "1s"}).status, 2);
}

}  // namespace
}  // namespace reckon::tools
