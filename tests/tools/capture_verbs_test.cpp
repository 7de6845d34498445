// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// `reckon record`, `replay`, `info` and `cut`: what users and scripts rely on. All traffic stays
// on the loopback interface.
#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "pdu/pdu_types.hpp"
#include "src/capture_writer.hpp"
#include "src/clock.hpp"
#include "src/udp_multicast.hpp"
#include "tests/support/reference_data.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/tools/captured_console.hpp"

namespace reckon::tools {
namespace {

using namespace std::chrono_literals;
using nlohmann::json;
using std::chrono::nanoseconds;
using test::ProgramResult;
using test::run_reckon;
using test::ScratchFolder;
using ::testing::HasSubstr;

using Octets = std::vector<std::byte>;

/// A group of this program's own.
peer::GroupAddress group(std::uint8_t number) {
  return peer::IpEndpoint::v4(0xefc04f00U + number,
                              static_cast<std::uint16_t>(20000 + getpid() % 20000));
}

template <typename Pdu>
void append(Octets& datagram, const Pdu& pdu) {
  const std::size_t begin = datagram.size();
  datagram.resize(begin + wire_size(pdu));
  ASSERT_GT(encode(pdu, std::span(datagram).subspan(begin)), 0U);
}

Octets entity_state(std::uint16_t entity) {
  pdu::EntityState pdu;
  pdu.entity_id = {1, 2, entity};
  pdu.marking.set("HAND");
  Octets out;
  append(out, pdu);
  return out;
}

/// A capture of `count` datagrams, one every `spacing`: entity 1 to group 0 and entity 2 to group 1
/// in turn, every fourth with an Attribute PDU behind it.
std::string make_capture(const ScratchFolder& folder, std::size_t count, nanoseconds spacing) {
  const std::string path = folder.file("made.pcapng");
  peer::CaptureWriter writer({.path = path});
  for (std::size_t i = 0; i < count; ++i) {
    Octets bytes = entity_state(static_cast<std::uint16_t>(1 + i % 2));
    if (i % 4 == 0) append(bytes, pdu::Attribute{});
    peer::SourceDatagram datagram;
    datagram.time = 1'700'000'000s + static_cast<std::int64_t>(i) * spacing;
    datagram.source = peer::IpEndpoint::v4(0x0a000001, 4000);
    datagram.group = group(static_cast<std::uint8_t>(i % 2));
    datagram.bytes = bytes;
    writer.write(datagram);
  }
  writer.finish(count, 0);
  return path;
}

json info_of(const std::string& path, int status = 0) {
  const ProgramResult result = run_reckon({"info", path, "--json"});
  EXPECT_EQ(result.status, status) << result.err;
  return json::parse(result.out);
}

peer::UdpMulticastOptions on_loopback() {
  peer::UdpMulticastOptions options;
  options.interface = "lo";
  return options;
}

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

TEST(Info, TellsWhereARecordingEndsTooEarly) {
  const ScratchFolder folder;
  const std::string path = make_capture(folder, 10, 100ms);
  std::filesystem::resize_file(path, std::filesystem::file_size(path) - 100);
  const json info = info_of(path, 1);
  EXPECT_EQ(info["datagrams"], 9);
  EXPECT_THAT(info["problem"].get<std::string>(), HasSubstr("the 9 frames before that are good"));
  EXPECT_THAT(run_reckon({"info", path}).out, HasSubstr("damage: "));
}

TEST(Info, RefusesWhatIsNoFile) {
  const ProgramResult missing = run_reckon({"info", "/nowhere/a.pcapng"});
  EXPECT_EQ(missing.status, 2);
  EXPECT_THAT(missing.err, HasSubstr("/nowhere/a.pcapng"));
  const ProgramResult live = run_reckon({"info", "udp://239.192.1.0"});
  EXPECT_EQ(live.status, 2);
  EXPECT_THAT(live.err, HasSubstr("reckon record FILE udp://239.192.1.0"));
}

/// Datagrams that are left after `reckon cut` with these words.
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

TEST(Cut, KeepsTheOctetsOfWhatItTakes) {
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
  EXPECT_THAT(error_of({in, out, "--group", "here"}), HasSubstr("no address"));
  EXPECT_THAT(error_of({in, out, "--from", "3s", "--to", "2s"}), HasSubstr("the range is empty"));
  EXPECT_THAT(error_of({in, in, "--force"}), HasSubstr("overwritten while it is read"));
  EXPECT_THAT(error_of({in, in}), HasSubstr("take another name"));
  EXPECT_THAT(error_of({in, "/nowhere/a.pcapng"}), HasSubstr("cannot be written"));
}

/// A receiver on the loopback interface, as any other program would be.
class Receiver {
 public:
  explicit Receiver(std::initializer_list<peer::GroupAddress> groups)
      : link_(on_loopback(), clock_) {
    for (const auto& address : groups) EXPECT_FALSE(link_.join(address));
  }
  [[nodiscard]] peer::IpEndpoint endpoint() const { return link_.local_endpoint(); }

  /// Everything that has arrived.
  std::vector<Octets> take() {
    std::vector<Octets> out;
    std::array<peer::Datagram, 32> batch;
    while (link_.wait(100ms)) {
      const std::size_t count = link_.receive(batch);
      for (std::size_t i = 0; i < count; ++i)
        out.emplace_back(batch[i].bytes.begin(), batch[i].bytes.end());
    }
    return out;
  }

 private:
  peer::SteadyClock clock_;
  peer::UdpMulticast link_;
};

TEST(Replay, ReachesTheSocketsOfThisHost) {
  const ScratchFolder folder;
  Receiver receiver({group(0), group(1)});
  const ProgramResult result = run_reckon({"replay", make_capture(folder, 20, 10ms)});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_TRUE(result.out.empty());
  EXPECT_THAT(result.err, HasSubstr("replayed 20 datagrams"));
  EXPECT_THAT(result.err, HasSubstr("asked 1x, got "));
  EXPECT_EQ(receiver.take().size(), 20U);
}

TEST(Replay, KeepsTheTimesOfTheCapture) {
  const ScratchFolder folder;
  const std::string in = make_capture(folder, 11, 30ms);
  const auto seconds = [&](const char* rate) {
    const auto begin = std::chrono::steady_clock::now();
    EXPECT_EQ(run_reckon({"replay", in, "--rate", rate}).status, 0);
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  // Never early; how late depends on the machine's load, and is told rather than tested.
  EXPECT_GE(seconds("1"), 0.3);
  EXPECT_GE(seconds("0.5"), 0.6);
  EXPECT_GE(seconds("3"), 0.1);
}

TEST(Replay, SendsElsewhereChosenAndOften) {
  const ScratchFolder folder;
  const std::string in = make_capture(folder, 20, 10ms);
  Receiver receiver({group(7)});
  const ProgramResult result =
      run_reckon({"replay", in, "--rate", "0", "--to", "udp://" + group(7).text(), "--loop", "3",
                  "--entity", "1:2:2", "--from", "100ms", "--to-time", "180ms"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("asked as fast as it goes, got "));
  EXPECT_EQ(receiver.take(), std::vector<Octets>(12, entity_state(2)));

  EXPECT_EQ(run_reckon({"replay", in, "--rate", "0", "--to", "udp://" + receiver.endpoint().text()})
                .status,
            0);
  EXPECT_EQ(receiver.take().size(), 20U);
}

TEST(Replay, RewritesTimestampsOnlyWhereAsked) {
  const ScratchFolder folder;
  const std::string in = make_capture(folder, 2, 1ms);
  Receiver receiver({group(1)});
  EXPECT_EQ(run_reckon({"replay", in}).status, 0);
  EXPECT_EQ(receiver.take(), std::vector<Octets>{entity_state(2)});
  EXPECT_EQ(run_reckon({"replay", in, "--rewrite-time"}).status, 0);
  const std::vector<Octets> rewritten = receiver.take();
  ASSERT_EQ(rewritten.size(), 1U);
  Octets same = rewritten[0];
  std::fill(same.begin() + 4, same.begin() + 8, std::byte{0});
  EXPECT_NE(rewritten[0], entity_state(2));
  EXPECT_EQ(same, entity_state(2));
}

TEST(Replay, EndsInGoodOrderWhenStopped) {
  const ScratchFolder folder;
  const std::string in = make_capture(folder, 2, 1h);
  std::atomic<bool> stop{false};
  std::thread stopper([&] {
    std::this_thread::sleep_for(50ms);
    stop = true;
  });
  const ProgramResult result = run_reckon({"replay", in}, &stop);
  stopper.join();
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.err, HasSubstr("replayed 1 datagram "));
}

TEST(Replay, AsksWhereToSendWhatWentToNoGroup) {
  const ScratchFolder folder;
  const std::string path = folder.file("unicast.pcapng");
  {
    peer::CaptureWriter writer({.path = path});
    const Octets bytes = entity_state(1);
    peer::SourceDatagram datagram;
    datagram.group = peer::IpEndpoint::v4(0xc0a801ff, 3000);
    datagram.bytes = bytes;
    writer.write(datagram);
  }
  const ProgramResult result = run_reckon({"replay", path});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("192.168.1.255:3000, which is no multicast group"));
  EXPECT_THAT(result.err, HasSubstr("--to udp://"));
}

TEST(Replay, SaysWhereNothingCouldBeSent) {
  const ScratchFolder folder;
  const ProgramResult result =
      run_reckon({"replay", make_capture(folder, 5, 1ms), "--to", "udp://192.0.2.1:3000"});
  EXPECT_EQ(result.status, 3);
  EXPECT_THAT(result.err, HasSubstr("replayed 0 datagrams"));
  EXPECT_THAT(result.err, HasSubstr("5 refused by the kernel; lo reaches this host only"));
  EXPECT_EQ(result.err.find("got"), std::string::npos);
}

TEST(Replay, NamesTheMistake) {
  const ScratchFolder folder;
  const std::string in = make_capture(folder, 2, 1ms);
  EXPECT_THAT(run_reckon({"replay", in, "--rate", "-1"}).err, HasSubstr("--rate -1"));
  EXPECT_THAT(run_reckon({"replay", in, "--to", "there"}).err, HasSubstr("no destination"));
  EXPECT_THAT(run_reckon({"replay", "-", "--loop", "2"}).err, HasSubstr("only once"));
  const ProgramResult result = run_reckon({"replay", in, "--iface", "none0"});
  EXPECT_EQ(result.status, 3);
  EXPECT_THAT(result.err, HasSubstr("none0"));
}

/// Sends `count` datagrams to a group on the loopback interface.
void send_some(const peer::GroupAddress& to, std::size_t count) {
  const peer::SteadyClock clock;
  peer::UdpMulticast link(on_loopback(), clock);
  for (std::size_t i = 0; i < count; ++i) EXPECT_TRUE(link.send(to, entity_state(1)));
}

/// Waits until the file is longer than its header, at most 5 s.
bool holds_datagrams(const std::string& path) {
  for (int i = 0; i < 500; ++i) {
    std::error_code none;
    if (const auto size = std::filesystem::file_size(path, none); !none && size > 60) return true;
    std::this_thread::sleep_for(10ms);
  }
  return false;
}

bool exists_soon(const std::string& path) {
  for (int i = 0; i < 500 && !std::filesystem::exists(path); ++i) std::this_thread::sleep_for(10ms);
  return std::filesystem::exists(path);
}

TEST(Record, WritesWhatWasSentUntilItIsStopped) {
  const ScratchFolder folder;
  const std::string path = folder.file("live.pcapng");
  std::atomic<bool> stop{false};
  ProgramResult result{};
  std::thread recorder([&] {
    result = run_reckon({"record", path, "udp://" + group(20).text(), "--iface", "lo"}, &stop);
  });
  EXPECT_TRUE(exists_soon(path));  // the groups are joined before the file is made
  send_some(group(20), 50);
  EXPECT_TRUE(holds_datagrams(path));
  std::this_thread::sleep_for(200ms);
  stop = true;
  recorder.join();
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_TRUE(result.out.empty());
  EXPECT_THAT(result.err, HasSubstr("recorded 50 datagrams (50 PDUs, 7.2 kB)"));
  EXPECT_THAT(result.err, HasSubstr("; 0 lost before they reached us"));
  const json info = info_of(path);
  EXPECT_EQ(info["datagrams"], 50);
  EXPECT_EQ(info["groups"][0]["group"], group(20).text());
}

std::atomic<bool> child_stop{false};
extern "C" void stop_child(int) { child_stop = true; }

/// Records in a process of its own, ends it by `signal`, and gives its wait status.
int end_recording(const std::string& path, const peer::GroupAddress& from, int signal) {
  const pid_t child = fork();
  if (child == 0) {
    (void)std::signal(SIGTERM, stop_child);
    _exit(
        run_reckon({"record", path, "udp://" + from.text(), "--iface", "lo"}, &child_stop).status);
  }
  EXPECT_TRUE(exists_soon(path));
  send_some(from, 30);
  EXPECT_TRUE(holds_datagrams(path));
  std::this_thread::sleep_for(300ms);  // twice the longest time that anything stays unwritten
  kill(child, signal);
  int status = 0;
  waitpid(child, &status, 0);
  return status;
}

TEST(Record, LeavesAReadableFileWhenKilled) {
  const ScratchFolder folder;
  const std::string path = folder.file("killed.pcapng");
  EXPECT_TRUE(WIFSIGNALED(end_recording(path, group(21), SIGKILL)));
  const json info = info_of(path);
  EXPECT_EQ(info["datagrams"], 30);
  EXPECT_EQ(info["problem"], "");
}

TEST(Record, EndsInGoodOrderAtSigterm) {
  const ScratchFolder folder;
  const std::string path = folder.file("ended.pcapng");
  const int status = end_recording(path, group(24), SIGTERM);
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
  EXPECT_EQ(info_of(path)["datagrams"], 30);
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
  EXPECT_THAT(error_of({in, from, "--iface", "lo"}), HasSubstr("--force"));
  EXPECT_EQ(run_reckon({"record", folder.file("b.pcapng"), from, "--iface", "none0"}).status, 3);
}

}  // namespace
}  // namespace reckon::tools
