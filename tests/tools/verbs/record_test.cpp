// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// `reckon record`: the behaviour that users and scripts rely on. All traffic stays on the loopback
// interface.
#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "reckon/tests/tools/support/capture_verbs.hpp"
#include "reckon/tools/command_line/status_line.hpp"

namespace reckon::tools {
namespace {

using namespace captures;
using ::testing::HasSubstr;

const std::vector<std::string> kNames{"a.pcapng", "a.pcapng.zst"};

/// Records the traffic of `send` until all `count` datagrams are in the file.
template <typename Send>
ProgramResult record(std::vector<std::string> words, const std::string& path, std::size_t count,
                     Send&& send) {
  words.insert(words.begin(), "record");
  std::atomic<bool> stop{false};
  ProgramResult result{};
  std::thread recorder([&] { result = run_reckon(words, &stop); });
  // The groups are joined before the file is created.
  EXPECT_TRUE(soon([&] { return std::filesystem::exists(path); }));
  send();
  EXPECT_TRUE(soon([&] { return datagrams_in(path) == count; })) << datagrams_in(path);
  stop = true;
  recorder.join();
  EXPECT_EQ(result.status, 0) << result.err;
  return result;
}

TEST(Record, WritesSentDatagramsUntilStopped) {
  for (const std::string& name : kNames) {
    const ScratchFolder folder;
    const std::string path = folder.file(name);
    const ProgramResult result = record({path, "udp://" + group(20).text(), "--iface", "lo"}, path,
                                        50, [] { send_some(group(20), 50); });
    EXPECT_TRUE(result.out.empty());
    EXPECT_THAT(result.err, HasSubstr("recorded 50 datagrams (50 PDUs, 7.2 kB)"));
    EXPECT_THAT(result.err, HasSubstr("; 0 lost before they reached this program"));
    const json info = info_of(path);
    EXPECT_EQ(info["datagrams"], 50);
    EXPECT_EQ(info["groups"][0]["group"], group(20).text());
    EXPECT_EQ(info["zstd_frames"], path.ends_with(".zst") ? 1 : 0);
  }
}

TEST(Record, CompressesWhereItIsAskedTo) {
  const ScratchFolder folder;
  const std::string path = folder.file("a.pcapng.zst");
  const ProgramResult result =
      record({folder.file("a.pcapng"), "udp://" + group(26).text(), "--iface", "lo", "--compress"},
             path, 5, [] { send_some(group(26), 5); });
  EXPECT_THAT(result.err, HasSubstr(path));
  EXPECT_EQ(info_of(path)["zstd_frames"], 1);
}

TEST(Record, TakesOnlyMatches) {
  const ScratchFolder folder;
  const std::string path = folder.file("a.pcapng");
  const ProgramResult result =
      record({path, "udp://" + group(25).text(), "--iface", "lo", "--where", "entity.id == 1:*:2"},
             path, 7, [] {
               send_some(group(25), 20, 1);
               send_some(group(25), 7, 2);
             });
  EXPECT_THAT(result.err, HasSubstr("recorded 7 datagrams"));
  EXPECT_THAT(result.err, HasSubstr("20 datagrams did not match and were omitted"));
  EXPECT_EQ(info_of(path)["entities"][0]["id"], "1:2:2");
}

TEST(Record, PrintsASummaryAsJson) {
  const ScratchFolder folder;
  const std::string path = folder.file("a.pcapng");
  const ProgramResult result = record({path, "udp://" + group(27).text(), "--iface", "lo", "--json",
                                       "--where", "entity.id == 1:*:2"},
                                      path, 3, [] {
                                        send_some(group(27), 4, 1);
                                        send_some(group(27), 3, 2);
                                      });
  const json line = json::parse(result.lines().back());
  EXPECT_EQ(line["event"], "summary");
  EXPECT_EQ(line["datagrams"], 3);
  EXPECT_EQ(line["safe"], 3);
  EXPECT_EQ(line["pdus"], 3);
  EXPECT_EQ(line["octets"], 3 * 144);
  EXPECT_EQ(line["left_out"], 4);
  EXPECT_EQ(line["lost"], 0);
  EXPECT_EQ(line["file_octets"], std::filesystem::file_size(path));
  EXPECT_EQ(line["paths"], json::array({path}));
  EXPECT_EQ(line["problem"], "");
  EXPECT_GT(line["seconds"], 0.0);
}

TEST(Record, ReportsRemovedFiles) {
  const ScratchFolder folder;
  std::atomic<bool> stop{false};
  ProgramResult result{};
  std::thread recorder([&] {
    result = run_reckon({"record", folder.file("a.pcapng"), "udp://" + group(33).text(), "--iface",
                         "lo", "--json", "--rotate-size", "1kB", "--rotate-total", "3kB"},
                        &stop);
  });
  EXPECT_TRUE(soon([&] { return std::filesystem::exists(folder.file("a_00001.pcapng")); }));
  send_some(group(33), 15);  // five fill a file
  const std::string last = folder.file("a_00003.pcapng");
  EXPECT_TRUE(soon([&] { return std::filesystem::exists(last) && datagrams_in(last) == 5; }));
  stop = true;
  recorder.join();
  EXPECT_THAT(result.err,
              HasSubstr("removed the oldest: 1 file with 5 datagrams (--rotate-total 3kB)"));
  const json line = json::parse(result.lines().back());
  EXPECT_EQ(line["datagrams"], 15);
  EXPECT_EQ(line["safe"], 10);
  EXPECT_EQ(line["removed_files"], 1);
  EXPECT_EQ(line["paths"], json::array({folder.file("a_00002.pcapng"), last}));
}

TEST(StatusLine, IsDueEveryFiveSeconds) {
  const test::CapturedStream stream;
  StatusLine line(stream.file(), 100s);
  EXPECT_FALSE(line.due(104s));
  EXPECT_TRUE(line.due(105s));
  line.show("what is no terminal stays clean", 106s);
  EXPECT_FALSE(line.due(110s));
  EXPECT_TRUE(line.due(111s));
  EXPECT_TRUE(stream.text().empty());
}

std::atomic<bool> child_stop{false};
extern "C" void stop_child(int) { child_stop = true; }

/// Records in a child process into a file limited to `limit` octets; its messages go to `path`.out.
pid_t begin_recording(const std::string& path, const peer::GroupAddress& from,
                      rlim_t limit = RLIM_INFINITY) {
  const pid_t child = fork();
  if (child != 0) return child;
  (void)std::signal(SIGTERM, stop_child);
  (void)std::signal(SIGXFSZ, SIG_IGN);
  const rlimit most{limit, RLIM_INFINITY};
  setrlimit(RLIMIT_FSIZE, &most);
  const ProgramResult result =
      run_reckon({"record", path, "udp://" + from.text(), "--iface", "lo", "--json"}, &child_stop);
  std::ofstream(path + ".out") << result.out;
  _exit(result.status);
}

/// The same, ended by `signal` once 30 datagrams are in it; returns its wait status.
int end_recording(const std::string& path, const peer::GroupAddress& from, int signal) {
  const pid_t child = begin_recording(path, from);
  EXPECT_TRUE(soon([&] { return std::filesystem::exists(path); }));
  send_some(from, 30);
  EXPECT_TRUE(soon([&] { return datagrams_in(path) == 30; }));
  kill(child, signal);
  int status = 0;
  waitpid(child, &status, 0);
  return status;
}

TEST(Record, LeavesAReadableFileWhenKilled) {
  const ScratchFolder folder;
  EXPECT_TRUE(WIFSIGNALED(end_recording(folder.file("a.pcapng"), group(21), SIGKILL)));
  const json info = info_of(folder.file("a.pcapng"));
  EXPECT_EQ(info["datagrams"], 30);
  EXPECT_EQ(info["problem"], "");
}

TEST(Record, LeavesAReadableCompressedFileWhenKilled) {
  const ScratchFolder folder;
  EXPECT_TRUE(WIFSIGNALED(end_recording(folder.file("a.pcapng.zst"), group(28), SIGKILL)));
  const json info = info_of(folder.file("a.pcapng.zst"), 1);
  EXPECT_EQ(info["datagrams"], 30);
  EXPECT_THAT(info["problem"].get<std::string>(),
              HasSubstr("it ends within a zstd frame: 0 of 1 are intact"));
  EXPECT_THAT(info["problem"].get<std::string>(), HasSubstr("the 30 frames before that are good"));
}

TEST(Record, EndsInGoodOrderAtSigterm) {
  for (const std::string& name : kNames) {
    const ScratchFolder folder;
    const std::string path = folder.file(name);
    const int status = end_recording(path, group(24), SIGTERM);
    EXPECT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 0);
    EXPECT_EQ(info_of(path)["datagrams"], 30);
  }
}

/// Whether a capture has a datagram of this entity.
bool holds_entity(const std::string& path, int entity) {
  if (std::filesystem::file_size(path) == 0) return false;  // stopped before it wrote the header
  const auto source = peer::open_capture(path);
  peer::SourceDatagram datagram;
  while (source->next(datagram, {}) == peer::SourceEvent::datagram) {
    if (std::to_integer<int>(datagram.bytes[17]) == entity) return true;
  }
  return false;
}

TEST(Record, CountsEveryDatagramThatTheKernelDropped) {
  for (const std::string& name : kNames) {
    const ScratchFolder folder;
    const std::string path = folder.file(name);
    const pid_t child = begin_recording(path, group(30));
    EXPECT_TRUE(soon([&] { return std::filesystem::exists(path); }));
    kill(child, SIGSTOP);  // simulates a busy machine
    std::size_t sent = 20'000;
    send_some(group(30), sent);
    kill(child, SIGCONT);
    // The kernel reports its count with the next delivered datagram.
    EXPECT_TRUE(soon([&] {
      ++sent;
      send_some(group(30), 1, 2);
      return holds_entity(path, 2);
    }));
    kill(child, SIGTERM);
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_EQ(WEXITSTATUS(status), 0);
    std::ifstream told(path + ".out");
    std::string line;
    while (std::getline(told, line) && line.find("summary") == std::string::npos) continue;
    const json summary = json::parse(line);
    EXPECT_GT(summary["lost"], 0);
    EXPECT_EQ(summary["datagrams"].get<std::size_t>() + summary["lost"].get<std::size_t>(), sent);
    EXPECT_EQ(info_of(path)["datagrams"], summary["datagrams"]);
  }
}

TEST(Record, LeavesAWholeFileOnAFullDisk) {
  for (const std::string& name : kNames) {
    const ScratchFolder folder;
    const std::string path = folder.file(name);
    const pid_t child = begin_recording(path, group(29), 4000);
    EXPECT_TRUE(soon([&] { return std::filesystem::exists(path); }));
    int status = 0;
    // Compressible Entity States, too many for a file of 4,000 octets.
    EXPECT_TRUE(soon([&] {
      send_some(group(29), 20);
      return waitpid(child, &status, WNOHANG) == child;
    }));
    EXPECT_EQ(WEXITSTATUS(status), 3);
    std::ifstream told(path + ".out");
    const json line = json::parse(told);
    EXPECT_THAT(line["problem"].get<std::string>(), HasSubstr("File too large"));
    const json info = info_of(path);
    EXPECT_EQ(info["datagrams"], line["safe"]);
    EXPECT_GT(info["datagrams"], 0);
    EXPECT_EQ(info["problem"], "");
    EXPECT_LE(std::filesystem::file_size(path), 4000U);
  }
}

TEST(Record, EndsByItselfWithAReadableEmptyFile) {
  const ScratchFolder folder;
  const std::string path = folder.file("empty.pcapng");
  const ProgramResult result =
      run_reckon({"record", path, "udp://" + group(22).text(), "--iface", "lo", "--for", "50ms"});
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.err, HasSubstr("recorded 0 datagrams"));
  EXPECT_EQ(info_of(path)["datagrams"], 0);
}

TEST(Record, NamesTheMistake) {
  const ScratchFolder folder;
  const std::string in = make_capture(folder, 2, 1ms);
  const auto error_of = [](std::vector<std::string> words) {
    words.insert(words.begin(), "record");
    const ProgramResult result = run_reckon(words);
    EXPECT_EQ(result.status, 2) << result.err;
    return result.err;
  };
  const std::string from = "udp://" + group(23).text();
  EXPECT_THAT(error_of({}), HasSubstr("FILE"));
  EXPECT_THAT(error_of({folder.file("b.pcapng"), in}), HasSubstr("is not live"));
  EXPECT_THAT(error_of({folder.file("b.pcapng"), "--rotate-size", "big"}), HasSubstr("100MB"));
  const auto error_of_total = [&](const std::string& total, const std::string& flag,
                                  const std::string& value) {
    return error_of({folder.file("b.pcapng"), from, "--iface", "lo", "--for", "10ms",
                     "--rotate-total", total, flag, value});
  };
  EXPECT_THAT(error_of_total("big", "--rotate-time", "1h"), HasSubstr("100MB"));
  EXPECT_THAT(error_of_total("1GB", "--pool", "0"), HasSubstr("needs --rotate-time"));
  EXPECT_THAT(error_of_total("1GB", "--rotate-size", "1GB"), HasSubstr("at least twice"));
  EXPECT_THAT(error_of({in, from, "--iface", "lo"}), HasSubstr("--force"));
  EXPECT_THAT(error_of({folder.file("none/b.pcapng"), from, "--iface", "lo"}),
              HasSubstr("cannot be written: No such file or directory; choose another place"));
  EXPECT_THAT(error_of({folder.file(""), from, "--iface", "lo"}), HasSubstr("is a folder"));
  EXPECT_THAT(error_of({folder.file("b.pcapng"), from, "--where", "colour == red"}),
              HasSubstr("^"));
  EXPECT_EQ(run_reckon({"record", folder.file("b.pcapng"), from, "--iface", "none0"}).status, 3);
}

}  // namespace
}  // namespace reckon::tools
