// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "reckon/tests/support/capture_builder.hpp"
#include "reckon/tests/support/scratch_folder.hpp"
#include "reckon/tests/tools/support/captured_console.hpp"
#include "reckon/tests/tools/support/driven_trucks.hpp"
#include "reckon/tests/tools/support/test_certificate.hpp"

namespace reckon::tools::view_test {
namespace {

using test::run_reckon;
using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::MatchesRegex;
using testing::Not;

TEST(ViewVerb, ServesACaptureAndPrintsItsAddressAlone) {
  test::CaptureBuilder capture;
  for (const trucks::Sent& sent : trucks::drive(2, 2)) capture.add(sent.octets, sent.time);
  const auto result = run_reckon({"view", capture.path(), "--port", "0", "--for", "50ms"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, MatchesRegex("http://127\\.0\\.0\\.1:[0-9]+/#word=[0-9a-f]+\n"));
  EXPECT_THAT(result.err, HasSubstr("0 tabs looked"));
}

TEST(ViewVerb, PrintsThePageAddressOfAnOpenListener) {
  test::CaptureBuilder capture;
  const auto result =
      run_reckon({"view", capture.path(), "--port", "0", "--listen", "0.0.0.0", "--for", "50ms"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("http://127.0.0.1:"));
}

TEST(ViewVerb, KeyNeedsTlsOrATunnelForOthers) {
  test::CaptureBuilder capture;
  const test::ScratchFolder folder;
  const std::string key = folder.file("k.key"), own = test::write_certificate(folder.file("own"));
  ASSERT_EQ(run_reckon({"key", "new", key}).status, 0);
  const auto view = [&](std::vector<std::string> more) {
    std::vector<std::string> words{"view", capture.path(), "--port", "0", "--for", "50ms"};
    words.insert(words.end(), more.begin(), more.end());
    return run_reckon(words);
  };
  const auto clear = view({"--key", key, "--listen", "0.0.0.0"});
  EXPECT_EQ(clear.status, 2);
  EXPECT_THAT(clear.err, AllOf(HasSubstr("has a key"), HasSubstr("add --tls CERT KEY"),
                               HasSubstr("--behind-tunnel")));
  EXPECT_EQ(view({"--key", key}).status, 0);
  EXPECT_EQ(view({"--key", key, "--listen", "0.0.0.0", "--behind-tunnel"}).status, 0);
  const auto secure =
      view({"--key", key, "--listen", "0.0.0.0", "--tls", own + ".crt", own + ".key"});
  EXPECT_EQ(secure.status, 0) << secure.err;
  EXPECT_THAT(secure.out, MatchesRegex("https://localhost:[0-9]+/#word=[0-9a-f]+\n"));
  EXPECT_EQ(view({"--tls", own + ".crt", own + ".key"}).status, 0) << "without a key";
  const auto swapped = view({"--tls", own + ".key", own + ".crt"});
  EXPECT_EQ(swapped.status, 2);
  EXPECT_THAT(swapped.err, HasSubstr("is not a PEM certificate"));
}

TEST(ViewVerb, RefusesUnreadableSourcesAndBadAddresses) {
  EXPECT_EQ(run_reckon({"view", "/no/such.pcap", "--port", "0"}).status, 2);
  EXPECT_EQ(run_reckon({"view", "/no/such.toml", "--port", "0"}).status, 2);
  test::CaptureBuilder capture;
  EXPECT_EQ(run_reckon({"view", capture.path(), "--port", "70000"}).status, 2);
  EXPECT_EQ(run_reckon({"view", capture.path(), "--port", "0", "--listen", "nowhere"}).status, 3);
}

std::string text_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(ViewVerb, SavesAPageWithACapturesEnd) {
  test::CaptureBuilder capture;
  for (const trucks::Sent& sent : trucks::drive(2, 4)) capture.add(sent.octets, sent.time);
  const test::ScratchFolder folder;
  const std::string path = folder.file("run.html");
  const auto whole = run_reckon({"view", capture.path(), "--save", path});
  EXPECT_EQ(whole.status, 0) << whole.err;
  EXPECT_EQ(whole.out, "");
  EXPECT_THAT(whole.err, AllOf(HasSubstr("wrote " + path + "\n"),
                               ContainsRegex("3\\.5 s, 2 entities, 10[5-7] pictures, ")));
  EXPECT_THAT(whole.err, Not(HasSubstr("left out")));
  EXPECT_THAT(text_of(path), HasSubstr(R"(id="saved">[[0.000,"text",{"type":"hello",)"));
  EXPECT_THAT(text_of(path), Not(HasSubstr(std::filesystem::path(capture.path()).parent_path())));
  const auto again = run_reckon({"view", capture.path(), "--save", path});
  EXPECT_EQ(again.status, 2);
  EXPECT_THAT(again.err, HasSubstr("--force"));
  const auto end = run_reckon({"view", capture.path(), "--save", path, "--force", "--for", "1s"});
  EXPECT_EQ(end.status, 0);
  EXPECT_THAT(end.err, AllOf(HasSubstr("1.0 s, 2 entities"), HasSubstr("the 2.5 s before are")));
}

TEST(ViewVerb, ShowsPdusWithALengthOf0IfLenient) {
  test::CaptureBuilder capture;
  for (const trucks::Sent& sent : trucks::drive(2, 1)) {
    std::vector<std::byte> octets = sent.octets;
    octets[8] = octets[9] = std::byte{0};
    capture.add(octets, sent.time);
  }
  const test::ScratchFolder folder;
  const std::string path = folder.file("run.html");
  const auto strict = run_reckon({"view", capture.path(), "--save", path});
  EXPECT_EQ(strict.status, 1);
  EXPECT_THAT(strict.err, HasSubstr("no entity"));
  const auto lenient = run_reckon({"view", capture.path(), "--save", path, "--lenient"});
  EXPECT_EQ(lenient.status, 0) << lenient.err;
  EXPECT_THAT(lenient.err, HasSubstr("2 entities"));
}

TEST(ViewVerb, SavesNothingThatItCannot) {
  test::CaptureBuilder capture;
  const test::ScratchFolder folder;
  const std::string path = folder.file("run.html");
  const auto nobody = run_reckon({"view", capture.path(), "--save", path});
  EXPECT_EQ(nobody.status, 1);
  EXPECT_THAT(nobody.err, HasSubstr("no entity"));
  EXPECT_FALSE(std::filesystem::exists(path));
  const auto live = run_reckon({"view", "--save", path});
  EXPECT_EQ(live.status, 2);
  EXPECT_THAT(live.err, HasSubstr("--for 1min"));
  EXPECT_EQ(run_reckon({"view", capture.path(), "--save", "/no/folder/run.html"}).status, 2);
  EXPECT_EQ(run_reckon({"view", capture.path(), "--save", path, "--open"}).status, 2);
  EXPECT_EQ(run_reckon({"view", capture.path(), "--force"}).status, 2);
  const auto itself = run_reckon({"view", capture.path(), "--save", capture.path(), "--force"});
  EXPECT_EQ(itself.status, 2);
  EXPECT_THAT(itself.err, HasSubstr("another name"));
}

TEST(ViewVerb, IsNoPartOfASimulatedDemo) {
  const auto result = run_reckon({"demo", "--simulated-time", "--for", "1s", "--view"});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("--view"));
  EXPECT_EQ(run_reckon({"demo", "--view=x", "--for", "1s"}).status, 2);
}

TEST(ViewVerb, DemoServesOtherHostsOnRequest) {
  const auto alone = run_reckon({"demo", "--view=0", "--for", "200ms"});
  EXPECT_EQ(alone.status, 0);
  EXPECT_THAT(alone.err, HasSubstr("page: http://127.0.0.1:"));
  EXPECT_THAT(alone.err, Not(HasSubstr("other hosts")));
  const auto open = run_reckon({"demo", "--view=0", "--listen", "0.0.0.0", "--for", "200ms"});
  EXPECT_EQ(open.status, 0);
  EXPECT_THAT(open.err, HasSubstr("page: http://127.0.0.1:"));
  EXPECT_EQ(run_reckon({"demo", "--view=0", "--listen", "nowhere", "--for", "200ms"}).status, 3);
  for (const auto& flags : {std::vector<std::string>{"--listen", "0.0.0.0"}, {"--open"}}) {
    std::vector<std::string> typed{"demo", "--for", "200ms"};
    typed.insert(typed.end(), flags.begin(), flags.end());
    const auto pageless = run_reckon(typed);
    EXPECT_EQ(pageless.status, 2);
    EXPECT_THAT(pageless.err, HasSubstr("add --view"));
  }
}

}  // namespace
}  // namespace reckon::tools::view_test
