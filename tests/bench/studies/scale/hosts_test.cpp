// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Commands to peers on several hosts and their results; hosts.py has whole runs.
#include "reckon/bench/studies/scale/hosts.hpp"

#include <gmock/gmock.h>

#include "reckon/bench/studies/scale/host_lines.hpp"
#include "reckon/bench/studies/scale/host_share.hpp"
#include "reckon/bench/studies/scale/remote_command.hpp"
#include "reckon/tools/command_line/console.hpp"

namespace reckon::bench {
namespace {

PeerProcess some_process() {
  PeerProcess process;
  std::uint64_t value = 0x1000000000000001;
  for (const WholeSum& sum : kWholeSums) process.outcome.counts.*sum.of = value++;
  process.outcome.counts.seconds = 2.5;
  process.outcome.counts.cpu = 0.1 + 0.2;
  process.outcome.latest = 1e-7;
  process.resident = 12345678;
  process.outcome.samples.pose = {0, 0.25F, 1e-5F, 1234.5F};
  return process;
}

TEST(HostLines, TellAPeerAsItWas) {
  const PeerProcess told = some_process();
  std::size_t peer = 0;
  PeerProcess read;
  ASSERT_TRUE(read_peer_line(peer_line(41, told), peer, read));
  EXPECT_EQ(peer, 41U);
  for (const WholeSum& sum : kWholeSums)
    EXPECT_EQ(read.outcome.counts.*sum.of, told.outcome.counts.*sum.of) << sum.name;
  EXPECT_EQ(read.outcome.counts.seconds, told.outcome.counts.seconds);
  EXPECT_EQ(read.outcome.counts.cpu, told.outcome.counts.cpu);
  EXPECT_EQ(read.outcome.latest, told.outcome.latest);
  EXPECT_EQ(read.resident, told.resident);
  EXPECT_EQ(read.outcome.samples.pose, told.outcome.samples.pose);
  EXPECT_TRUE(read.outcome.samples.discovery.empty());
}

TEST(HostLines, AreRefusedWhereverTheyAreCut) {
  const std::string line = peer_line(3, some_process());
  std::size_t peer = 0;
  PeerProcess read;
  for (std::size_t length = 0; length < line.size(); ++length)
    EXPECT_FALSE(read_peer_line(line.substr(0, length), peer, read)) << length;
  EXPECT_FALSE(read_ready_line(line));
  EXPECT_EQ(read_ready_line(ready_line(0xFFFFFFFFFFFFFFFE)), 0xFFFFFFFFFFFFFFFEU);
  EXPECT_FALSE(read_ready_line(R"({"kind":"ready","scene":x})"));
}

TEST(HostLines, SayWhenToBegin) {
  using std::chrono::nanoseconds;
  EXPECT_EQ(read_begin_word(begin_word(nanoseconds(1'500'000'001))), nanoseconds(1'500'000'001));
  EXPECT_EQ(read_begin_word(begin_word(nanoseconds(-5))), nanoseconds(-5));  // already late
  for (const std::string_view word : {"", "begin", "begin ", "begin soon", "begin 5 ", "clock"})
    EXPECT_FALSE(read_begin_word(word)) << word;
}

TEST(Hosts, AreNamesWithOrWithoutAnInterface) {
  const auto hosts = read_hosts("anna@a.example, b=eth1");
  ASSERT_EQ(hosts.size(), 2U);
  EXPECT_EQ(hosts[0].name, "anna@a.example");
  EXPECT_EQ(hosts[0].interface, "");
  EXPECT_EQ(hosts[1].name, "b");
  EXPECT_EQ(hosts[1].interface, "eth1");
  for (const std::string_view wrong : {"", "a,", "a,a", "a,a=eth0", "-v", "=eth0", "a="})
    EXPECT_THROW(static_cast<void>(read_hosts(wrong)), tools::UsageError) << wrong;
}

// A remote shell must read each quoted text as one word.
TEST(Hosts, GetWordsThatNoShellCutsOrRuns) {
  const auto echoed = [](const std::string& word) {
    RemoteCommand command("sh -c", "printf '%s\\n' " + quoted_for_shell(word), "unused");
    return command.read_line([] { return true; }).value_or("nothing");
  };
  for (const std::string word : {"eth0", "two words", "it's", "$(exit 3)`;|&\"\\*", "''"})
    EXPECT_EQ(echoed(word), word);
}

TEST(Hosts, AreAskedForThisExercise) {
  ScaleSetting setting;
  setting.seconds = 2.5;
  setting.grid.cell_size = 80.5;
  setting.port = 20'001;
  const std::string command = share_command(setting, {"a", "eth 0"}, 16, 32);
  for (const char* part : {"reckon bench scale --share 17-32='eth 0' ", "--peers 64 ",
                           "--cell 80.5m ", "--for 2500000000ns ", "--port 20001"})
    EXPECT_THAT(command, testing::HasSubstr(part));
}

TEST(Hosts, GetAShareOfPeers) {
  const HostShare share = read_host_share("17-32=eth1");
  EXPECT_EQ(share.first, 16U);
  EXPECT_EQ(share.end, 32U);
  EXPECT_EQ(share.interface, "eth1");
  EXPECT_EQ(read_host_share("1-1").interface, "");
  for (const char* wrong : {"", "5", "0-3", "5-4", "1-2x", "a-b", "1-", "1--2", "-1-2"})
    EXPECT_THROW(static_cast<void>(read_host_share(wrong)), tools::UsageError) << wrong;
}

TEST(RemoteCommands, TellHowTheyEnded) {
  RemoteCommand good("sh -c", "echo one; echo two; exit 5", "unused");
  EXPECT_EQ(good.read_line([] { return true; }), "one");
  EXPECT_EQ(good.read_line([] { return true; }), "two");
  EXPECT_EQ(good.read_line([] { return true; }), std::nullopt);
  EXPECT_TRUE(good.has_ended());
  EXPECT_EQ(good.status(), 5);
  RemoteCommand missing("/nowhere/ssh", "a", "true");
  EXPECT_EQ(missing.read_line([] { return true; }), std::nullopt);
  EXPECT_EQ(missing.status(), 127);
  RemoteCommand waits("sh -c", "read word; echo \"heard $word\"; kill -9 $$", "unused");
  int asked = 0;
  EXPECT_EQ(waits.read_line([&] { return ++asked < 2; }), std::nullopt);
  EXPECT_FALSE(waits.has_ended());
  waits.write_line("clock");
  EXPECT_EQ(waits.read_line([] { return true; }), "heard clock");
  EXPECT_EQ(waits.read_line([] { return true; }), std::nullopt);
  EXPECT_EQ(waits.status(), 137);
}

}  // namespace
}  // namespace reckon::bench
