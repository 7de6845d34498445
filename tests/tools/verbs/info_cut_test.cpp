// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// `reckon info` and `reckon cut`: the behaviour that users and scripts rely on.
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "reckon/tests/support/capture_builder.hpp"
#include "reckon/tests/support/reference_data.hpp"
#include "reckon/tests/tools/support/capture_verbs.hpp"

namespace reckon::tools {
namespace {

using namespace captures;
using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(Info, CountsTypesSendersGroupsAndEntities) {
  const ScratchFolder folder;
  const json info = info_of(make_capture(folder, 10, 100ms));
  EXPECT_EQ(info["datagrams"], 10);
  EXPECT_EQ(info["pdus"], 13);
  EXPECT_EQ(info["ok"], 13);
  EXPECT_EQ(info["octets"], 10 * 144 + 3 * 32);
  EXPECT_EQ(info["types"].size(), 2U);
  EXPECT_EQ(info["types"][1]["type"], "entity_state");
  EXPECT_EQ(info["types"][1]["pdus"], 10);
  EXPECT_EQ(info["senders"][0]["sender"], "10.0.0.1:4000");
  EXPECT_EQ(info["senders"][0]["datagrams"], 10);
  EXPECT_EQ(info["groups"].size(), 2U);
  EXPECT_EQ(info["groups"][1]["group"], group(1).text());
  EXPECT_EQ(info["entities"][1]["id"], "1:2:2");
  EXPECT_EQ(info["entities"][1]["marking"], "HAND");
  EXPECT_EQ(info["entities"][1]["first"], 0.1);
  EXPECT_EQ(info["entities"][1]["last"], 0.9);
}

TEST(Info, ShowsTheSameToPeople) {
  const ScratchFolder folder;
  const ProgramResult result = run_reckon({"info", make_capture(folder, 10, 100ms)});
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.out, HasSubstr("10 datagrams, 13 PDUs, 1.536 kB of payload"));
  EXPECT_THAT(result.out, HasSubstr("from 2023-11-14 22:13:20.000000000 UTC"));
  EXPECT_THAT(result.out, HasSubstr("900 ms"));
  EXPECT_THAT(result.out, HasSubstr("entity_state"));
  EXPECT_THAT(result.out, HasSubstr("1:2:2"));
}

TEST(Info, ReadsLengthZeroAsTheRestIfLenient) {
  test::CaptureBuilder capture;
  Octets octets = entity_state(7);
  octets[9] = std::byte{0};  // in the length field, instead of 144
  capture.add(octets, 1s);
  const ProgramResult strict = run_reckon({"info", capture.path()});
  EXPECT_EQ(strict.status, 1);
  EXPECT_THAT(strict.out, HasSubstr("E-LENGTH"));
  const ProgramResult lenient = run_reckon({"info", capture.path(), "--lenient"});
  EXPECT_EQ(lenient.status, 0);
  EXPECT_THAT(lenient.out, AllOf(HasSubstr("1:2:7"), HasSubstr("I-NO-LENGTH")));
}

TEST(Info, ReportsATruncatedRecording) {
  const ScratchFolder folder;
  const std::string path = make_capture(folder, 10, 100ms);
  std::filesystem::resize_file(path, std::filesystem::file_size(path) - 100);
  const json info = info_of(path, 1);
  EXPECT_EQ(info["datagrams"], 9);
  EXPECT_THAT(info["problem"].get<std::string>(), HasSubstr("the 9 frames before that are good"));
  EXPECT_THAT(run_reckon({"info", path}).out, HasSubstr("damage: "));
}

TEST(Info, ReadsCompressedCapturesAndReportsTheirRatio) {
  const ScratchFolder folder;
  const std::string path = make_capture(folder, 1000, 100ms, "made.pcapng.zst");
  const json info = info_of(path);
  EXPECT_EQ(info["datagrams"], 1000);
  EXPECT_EQ(info["zstd_frames"], 1);
  EXPECT_EQ(info["compressed_octets"], std::filesystem::file_size(path));
  EXPECT_EQ(info["compressed_content"],
            std::filesystem::file_size(make_capture(folder, 1000, 100ms, "made.pcapng")));
  EXPECT_THAT(run_reckon({"info", path}).out, HasSubstr("times less, 1 zstd frame\n"));
}

TEST(Info, ReportsATruncatedCompressedRecording) {
  const ScratchFolder folder;
  const std::string path = make_capture(folder, 10, 100ms, "made.pcapng.zst");
  std::filesystem::resize_file(path, std::filesystem::file_size(path) - 1);
  const json info = info_of(path, 1);
  EXPECT_EQ(info["datagrams"], 10);
  EXPECT_THAT(info["problem"].get<std::string>(), HasSubstr("0 of 1 are intact"));
}

TEST(Info, RefusesOtherSources) {
  const ProgramResult missing = run_reckon({"info", "/nowhere/a.pcapng"});
  EXPECT_EQ(missing.status, 2);
  EXPECT_THAT(missing.err, HasSubstr("/nowhere/a.pcapng"));
  const ProgramResult live = run_reckon({"info", "udp://239.192.1.0"});
  EXPECT_EQ(live.status, 2);
  EXPECT_THAT(live.err, HasSubstr("reckon record FILE udp://239.192.1.0"));
  const ScratchFolder folder;
  const ProgramResult directory = run_reckon({"info", folder.file("")});
  EXPECT_EQ(directory.status, 2);
  EXPECT_THAT(directory.err, HasSubstr("is a folder"));
  std::ofstream(folder.file("empty"));
  EXPECT_THAT(run_reckon({"info", folder.file("empty")}).err, HasSubstr("is empty"));
}

/// Datagrams that are left after `reckon cut` with these flags.
std::size_t left_after_cut(const ScratchFolder& folder, const std::string& in,
                           std::vector<std::string> words) {
  words.insert(words.begin(), {"cut", in, folder.file("part.pcapng"), "--force"});
  const ProgramResult result = run_reckon(words);
  EXPECT_EQ(result.status, 0) << result.err;
  return info_of(folder.file("part.pcapng"))["datagrams"];
}

TEST(Cut, TakesARangeOfTime) {
  const ScratchFolder folder;
  const std::string in = make_capture(folder, 100, 100ms);
  EXPECT_EQ(left_after_cut(folder, in, {}), 100U);
  EXPECT_EQ(left_after_cut(folder, in, {"--from", "2s", "--to", "3s"}), 10U);
  const json info = info_of(folder.file("part.pcapng"));
  EXPECT_EQ(info["first"], 1'700'000'002);
  EXPECT_EQ(left_after_cut(folder, in, {"--from", "9.95s"}), 0U);
}

TEST(Cut, TakesDatagramsStampedBeforeTheFirst) {
  const ScratchFolder folder;
  const std::string in = make_capture(folder, 10, -100ms);
  EXPECT_EQ(left_after_cut(folder, in, {}), 10U);
  EXPECT_EQ(left_after_cut(folder, in, {"--to", "1s"}), 10U);
  EXPECT_EQ(left_after_cut(folder, in, {"--from", "0s"}), 1U);
}

TEST(Cut, TakesGroupsTypesAndEntities) {
  const ScratchFolder folder;
  const std::string in = make_capture(folder, 100, 100ms);
  EXPECT_EQ(left_after_cut(folder, in, {"--group", group(1).address_text()}), 50U);
  EXPECT_EQ(left_after_cut(folder, in, {"--group", "udp://" + group(1).text()}), 50U);
  EXPECT_EQ(left_after_cut(folder, in, {"--type", "attribute"}), 25U);
  EXPECT_EQ(left_after_cut(folder, in, {"--type", "attribute", "--type", "entity_state"}), 100U);
  EXPECT_EQ(left_after_cut(folder, in, {"--entity", "1:*:2"}), 50U);
  EXPECT_EQ(left_after_cut(folder, in, {"--entity", "1:*:2", "--type", "attribute"}), 0U);
}

TEST(Cut, TakesFilterMatches) {
  const ScratchFolder folder;
  const std::string in = make_capture(folder, 100, 100ms);
  EXPECT_EQ(left_after_cut(folder, in, {"--where", "entity.id == 1:*:2"}), 50U);
  EXPECT_EQ(left_after_cut(folder, in, {"--where", "type == attribute"}), 25U);
  EXPECT_EQ(left_after_cut(folder, in, {"--where", "type == attribute", "--from", "5s"}), 12U);
}

TEST(Cut, CompressesByNameAndReadsItsOutput) {
  const ScratchFolder folder;
  const std::string in = make_capture(folder, 1000, 100ms);
  const std::string out = folder.file("part.pcapng.zst");
  EXPECT_EQ(run_reckon({"cut", in, out}).status, 0);
  EXPECT_EQ(info_of(out)["zstd_frames"], 1);
  EXPECT_LT(std::filesystem::file_size(out), std::filesystem::file_size(in) / 10);
  EXPECT_EQ(run_reckon({"inspect", in, "--full"}).out, run_reckon({"inspect", out, "--full"}).out);
  EXPECT_EQ(run_reckon({"cut", out, folder.file("back.pcapng")}).status, 0);
  EXPECT_EQ(run_reckon({"inspect", in, "--full"}).out,
            run_reckon({"inspect", folder.file("back.pcapng"), "--full"}).out);
}

TEST(Cut, KeepsTheOctetsOfTakenDatagrams) {
  const ScratchFolder folder;
  const std::string in = make_capture(folder, 20, 100ms);
  EXPECT_EQ(left_after_cut(folder, in, {}), 20U);
  EXPECT_EQ(run_reckon({"inspect", in, "--full"}).out,
            run_reckon({"inspect", folder.file("part.pcapng"), "--full"}).out);
}

TEST(Cut, KeepsTheRecordedSessions) {
  RECKON_NEED_DATA("dis-captures/real-sessions");
  const ScratchFolder folder;
  std::size_t sessions = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(test::reference_data() / "dis-captures/real-sessions")) {
    if (entry.path().extension() != ".pcap") continue;
    const std::string part = folder.file("part.pcapng");
    EXPECT_EQ(run_reckon({"cut", entry.path(), part, "--force"}).status, 0);
    EXPECT_EQ(run_reckon({"inspect", entry.path(), "--full"}).out,
              run_reckon({"inspect", part, "--full"}).out)
        << entry.path();
    ++sessions;
  }
  EXPECT_GE(sessions, 7U);
}

TEST(Cut, NamesTheMistake) {
  const ScratchFolder folder;
  const std::string in = make_capture(folder, 2, 100ms);
  const auto error_of = [&](std::vector<std::string> words) {
    words.insert(words.begin(), "cut");
    const ProgramResult result = run_reckon(words);
    EXPECT_EQ(result.status, 2);
    EXPECT_TRUE(result.out.empty());
    return result.err;
  };
  const std::string out = folder.file("part.pcapng");
  EXPECT_THAT(error_of({in, out, "--type", "entity_sate"}),
              HasSubstr("did you mean 'entity_state'"));
  EXPECT_THAT(error_of({in, out, "--entity", "1:2"}), HasSubstr("site:application:entity"));
  EXPECT_THAT(error_of({in, out, "--group", "here"}), HasSubstr("not an address"));
  EXPECT_THAT(error_of({in, out, "--from", "3s", "--to", "2s"}), HasSubstr("the range is empty"));
  EXPECT_THAT(error_of({in, out, "--where", "colour == red"}), HasSubstr("^"));
  EXPECT_THAT(error_of({in, in, "--force"}), HasSubstr("overwritten while it is read"));
  EXPECT_THAT(error_of({in, in}), HasSubstr("choose another name"));
  EXPECT_THAT(error_of({in, "/nowhere/a.pcapng"}), HasSubstr("cannot be written"));
}

}  // namespace
}  // namespace reckon::tools
