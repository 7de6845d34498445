// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// `reckon FILE`: captures, scenes and meshes are opened; for other files the verb is named.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "reckon/tests/support/places.hpp"
#include "reckon/tests/support/scratch_folder.hpp"
#include "reckon/tests/tools/support/captured_console.hpp"
#include "reckon/tools/command_line/file_kind.hpp"

namespace reckon::tools {
namespace {

using test::run_reckon;
using ::testing::HasSubstr;

class GivenFile : public testing::Test {
 protected:
  [[nodiscard]] std::string write(const std::string& name, const std::string& text) {
    std::ofstream(folder_.file(name), std::ios::binary) << text;
    return folder_.file(name);
  }
  [[nodiscard]] static std::string shipped(const std::string& name) {
    return test::source_dir() + "/scenes/" + name;
  }

  test::ScratchFolder folder_;
};

TEST_F(GivenFile, IsInspectedIfItIsACapture) {
  const auto by_name = run_reckon({shipped("exercise.pcapng"), "stats", "--json"});
  EXPECT_EQ(by_name.status, 0);
  EXPECT_THAT(by_name.err, HasSubstr("exercise.pcapng is a capture: reckon inspect "));
  EXPECT_EQ(by_name.out,
            run_reckon({"inspect", shipped("exercise.pcapng"), "stats", "--json"}).out);
  // Detected by its octets, whatever its name.
  std::filesystem::copy_file(shipped("exercise.pcapng"), folder_.file("recorded"));
  EXPECT_EQ(run_reckon({folder_.file("recorded"), "stats", "--json"}).status, 0);
}

TEST_F(GivenFile, StartsADemoIfASceneOrMesh) {
  const std::vector<std::string> quick{"--simulated-time", "--for", "100ms", "--json"};
  for (const char* name : {"two_hands.toml", "touchstone.obj"}) {
    std::vector<std::string> words{shipped(name)};
    words.insert(words.end(), quick.begin(), quick.end());
    const auto result = run_reckon(words);
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_THAT(result.err, HasSubstr(": reckon demo "));
    EXPECT_THAT(result.out, HasSubstr("pose_error_m"));
  }
}

TEST_F(GivenFile, NamesTheVerbForOtherFiles) {
  const auto key = run_reckon({write("crane.key", "epoch 1\n")});
  EXPECT_EQ(key.status, 2);
  EXPECT_THAT(key.err, HasSubstr("a key: `reckon peer SCENE --key " + folder_.file("crane.key")));
  const auto table = run_reckon({shipped("truck_track.csv")});
  EXPECT_EQ(table.status, 2);
  EXPECT_THAT(table.err, HasSubstr("`reckon tune " + shipped("truck_track.csv") + "`"));
  const auto other = run_reckon({write("notes.txt", "hello")});
  EXPECT_EQ(other.status, 2);
  EXPECT_THAT(other.err, HasSubstr("not a capture, a scene (.toml)"));
  EXPECT_TRUE((key.out + table.out + other.out).empty());
}

TEST_F(GivenFile, IsReportedIfMissingAndVerbsTakePrecedence) {
  const auto missing = run_reckon({folder_.file("none.pcap")});
  EXPECT_EQ(missing.status, 2);
  EXPECT_THAT(missing.err, HasSubstr("there is no file '" + folder_.file("none.pcap") + "'"));
  EXPECT_THAT(run_reckon({"inspetc"}).err, HasSubstr("there is no verb 'inspetc'; did you mean"));
  EXPECT_EQ(run_reckon({test::source_dir() + "/scenes"}).status, 2);
}

TEST_F(GivenFile, MayBeANetworkInterface) {
  const auto result = run_reckon({"lo"});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("it is a network interface: `reckon inspect --iface lo`"));
}

TEST_F(GivenFile, IsNoSceneIfACaptureOrMesh) {
  const std::string capture = shipped("exercise.pcapng"), mesh = shipped("touchstone.obj");
  const auto checked = run_reckon({"scene", "check", capture});
  EXPECT_EQ(checked.status, 1);
  EXPECT_EQ(checked.out, capture + ": this is a capture: reckon inspect " + capture + "\n");
  const auto joined = run_reckon({"peer", capture, "--iface", "lo"});
  EXPECT_EQ(joined.status, 2);
  EXPECT_THAT(joined.err, HasSubstr("this is a capture: reckon inspect " + capture));
  EXPECT_THAT(run_reckon({"demo", mesh}).err, HasSubstr("a mesh: reckon demo --mesh " + mesh));
}

TEST_F(GivenFile, IsACaptureForEveryVerbByContent) {
  const std::string path = folder_.file("recorded.toml");
  std::filesystem::copy_file(shipped("exercise.pcapng"), path);
  const auto inspected = run_reckon({"inspect", path, "stats", "--json"});
  EXPECT_EQ(inspected.status, 0) << inspected.err;
  EXPECT_EQ(inspected.out,
            run_reckon({"inspect", shipped("exercise.pcapng"), "stats", "--json"}).out);
  EXPECT_EQ(run_reckon({"info", path}).status, 0);
  EXPECT_EQ(run_reckon({"inspect", "diff", path, shipped("exercise.pcapng")}).status, 0);
  const auto viewed = run_reckon({"view", path, "--save", folder_.file("run.html")});
  EXPECT_EQ(viewed.status, 0) << viewed.err;
}

TEST_F(GivenFile, IsDetectedByItsContentOrName) {
  EXPECT_EQ(kind_of_file(write("A.OBJ", "v 0 0 0\n")), FileKind::mesh);
  EXPECT_EQ(kind_of_file(write("a.stl", "solid a\n")), FileKind::mesh);
  EXPECT_EQ(kind_of_file(write("empty.pcap", "")), FileKind::capture);
  EXPECT_EQ(kind_of_file(write("a", "\x28\xb5\x2f\xfd")), FileKind::capture);
  EXPECT_EQ(kind_of_file(write("b", "\x1f\x8b\x08")), FileKind::capture);
  EXPECT_EQ(kind_of_file(write("c", "x")), FileKind::unknown);
  EXPECT_EQ(kind_of_file(folder_.file("absent.csv")), FileKind::unknown);
  // A read of a pipe without a writer would wait for ever.
  ASSERT_EQ(mkfifo(folder_.file("pipe.toml").c_str(), 0600), 0);
  EXPECT_EQ(kind_of_file(folder_.file("pipe.toml")), FileKind::scene);
}

}  // namespace
}  // namespace reckon::tools
