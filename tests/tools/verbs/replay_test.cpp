// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// `reckon replay`, as users and scripts call it. All traffic stays on the loopback interface.
#include <gmock/gmock.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "reckon/tests/src/support/own_network.hpp"
#include "reckon/tests/support/reference_data.hpp"
#include "reckon/tests/tools/support/capture_verbs.hpp"
#include "reckon/tools/captures/replay_reach.hpp"
#include "reckon/tools/captures/replay_senders.hpp"

namespace reckon::tools {
namespace {

using namespace captures;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

/// A receiver on the loopback interface, like any other program.
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
      for (std::size_t i = 0; i < count; ++i) {
        out.emplace_back(batch[i].bytes.begin(), batch[i].bytes.end());
        senders_.insert(batch[i].sender.text());
      }
    }
    return out;
  }
  /// The source endpoints of everything that arrived.
  [[nodiscard]] const std::set<std::string>& senders() const { return senders_; }

 private:
  std::set<std::string> senders_;
  peer::SteadyClock clock_;
  peer::UdpMulticast link_;
};

TEST(Replay, ReachesTheSocketsOfThisHost) {
  const ScratchFolder folder;
  Receiver receiver({group(0), group(1)});
  const ProgramResult result = run_reckon({"replay", make_capture(folder, 20, 10ms)});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_TRUE(result.out.empty());
  EXPECT_THAT(result.err, StartsWith("sending to " + group(0).text() + " on lo (only this host; "));
  EXPECT_THAT(result.err, HasSubstr("replayed 20 datagrams"));
  EXPECT_THAT(result.err,
              HasSubstr(" to " + group(0).text() + " and 1 more on lo (only this host; --iface "));
  EXPECT_THAT(result.err, HasSubstr("requested 1x, got "));
  EXPECT_EQ(receiver.take().size(), 20U);
  EXPECT_EQ(receiver.senders().size(), 1U) << "one sender, from one port";
}

TEST(Replay, SendsDatagramsStampedBeforeTheFirst) {
  const ScratchFolder folder;
  const std::string in = make_capture(folder, 6, -10ms);
  Receiver receiver({group(0), group(1)});
  const ProgramResult whole = run_reckon({"replay", in});
  EXPECT_THAT(whole.err, HasSubstr("replayed 6 datagrams"));
  EXPECT_THAT(whole.err, Not(HasSubstr("left out")));
  EXPECT_EQ(receiver.take().size(), 6U);
  const ProgramResult part = run_reckon({"replay", in, "--from", "0s"});
  EXPECT_THAT(part.err, HasSubstr("replayed 1 datagram "));
  EXPECT_THAT(part.err, HasSubstr("5 datagrams left out: not selected by the flags"));
}

TEST(Replay, KeepsTheTimesOfTheCapture) {
  const ScratchFolder folder;
  const std::string in = make_capture(folder, 11, 30ms);
  const auto seconds = [&](const char* rate) {
    const auto begin = std::chrono::steady_clock::now();
    EXPECT_EQ(run_reckon({"replay", in, "--rate", rate}).status, 0);
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  // Never early; the lateness depends on the machine's load, and is reported rather than tested.
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
                  "--entity", "1:2:2", "--from", "100ms", "--to", "180ms"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("requested as fast as possible, got "));
  EXPECT_EQ(receiver.take(), std::vector<Octets>(12, entity_state(2)));

  EXPECT_EQ(run_reckon({"replay", in, "--rate", "0", "--to", "udp://" + receiver.endpoint().text()})
                .status,
            0);
  EXPECT_EQ(receiver.take().size(), 20U);
}

TEST(Replay, SendsAnotherExerciseOtherIdsAndAnotherPlace) {
  const ScratchFolder folder;
  const std::string in = make_capture(folder, 8, 1ms);
  Receiver receiver({group(7)});
  const ProgramResult result =
      run_reckon({"replay", in, "--rate", "0", "--to", "udp://" + group(7).text(), "--entity",
                  "1:2:2", "--map-exercise", "1=7", "--map-id", "1:2:*=9:2:*", "--json"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("4 PDUs mapped\n"));
  EXPECT_EQ(json::parse(result.lines().back())["mapped"], 4);
  Octets expected = entity_state(2);
  expected[1] = std::byte{7};
  expected[13] = std::byte{9};
  EXPECT_EQ(receiver.take(), std::vector<Octets>(4, expected));

  const ProgramResult nowhere = run_reckon({"replay", in, "--rate", "0", "--map-place", "10,20"});
  EXPECT_THAT(nowhere.err, HasSubstr("no PDU has a location: none was moved"));
  EXPECT_EQ(run_reckon({"replay", in, "--map-id", "1:2"}).status, 2);
}

TEST(Replay, ReadsCompressedCapturesAndFilters) {
  const ScratchFolder folder;
  Receiver receiver({group(1)});
  const ProgramResult result =
      run_reckon({"replay", make_capture(folder, 20, 1ms, "made.pcapng.zst"), "--where",
                  "entity.id == 1:*:2", "--loop", "2"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(receiver.take(), std::vector<Octets>(20, entity_state(2)));
}

TEST(Replay, PrintsASummaryAsJson) {
  const ScratchFolder folder;
  const ProgramResult result = run_reckon(
      {"replay", make_capture(folder, 11, 10ms), "--rate", "2", "--loop", "3", "--json"});
  EXPECT_EQ(result.status, 0) << result.err;
  const json line = json::parse(result.lines().back());
  EXPECT_EQ(line["event"], "summary");
  EXPECT_EQ(line["datagrams"], 33);
  EXPECT_EQ(line["octets"], 33 * 144 + 9 * 32);
  EXPECT_EQ(line["refused"], 0);
  EXPECT_EQ(line["too_big"], 0);
  EXPECT_EQ(line["incomplete"], 0);
  EXPECT_EQ(line["asked"], 2.0);
  EXPECT_GT(line["got"], 0.0);
  EXPECT_LE(line["got"], 2.0);  // never early
  EXPECT_GE(line["seconds"], 0.16);
  EXPECT_GE(line["late"], 0.0);
  EXPECT_EQ(line["paused"], 0.0);
  EXPECT_EQ(line["laps"], 3);
  EXPECT_EQ(line["problem"], "");
}

/// Reassembled datagrams to `to` that a packet socket on `interface` receives.
std::vector<Octets> captured_on(peer::DatagramSource& source, const peer::GroupAddress& to) {
  std::vector<Octets> out;
  peer::SourceDatagram datagram;
  while (source.next(datagram, 500ms) == peer::SourceEvent::datagram)
    if (datagram.group == to && datagram.portion == peer::Portion::whole)
      out.emplace_back(datagram.bytes.begin(), datagram.bytes.end());
  return out;
}

TEST(Replay, SendsDatagramsAboveTheMtuInFragments) {
  RECKON_IN_OWN_NETWORK([] {
    test::make_cable();
    const ScratchFolder folder;
    std::vector<Octets> sent;
    peer::CaptureWriter writer({.path = folder.file("big.pcapng")});
    for (const std::size_t size : {144, 7000, 1472, 1473, 65'507}) {
      sent.emplace_back(size, static_cast<std::byte>(size));
      peer::SourceDatagram datagram;
      datagram.group = group(0);
      datagram.bytes = sent.back();
      writer.write(datagram);
    }
    writer.finish(sent.size(), 0);
    const auto source = peer::open_interface_capture("b0");
    const ProgramResult result = run_reckon({"replay", folder.file("big.pcapng"), "--iface", "a0"});
    EXPECT_EQ(result.status, 0);
    EXPECT_THAT(result.err, HasSubstr("replayed 5 datagrams"));
    EXPECT_THAT(result.err,
                HasSubstr("3 datagrams sent in IP fragments: above the MTU of a0, 1500 octets"));
    EXPECT_EQ(captured_on(*source, group(0)), sent);
    EXPECT_EQ(source->report().fragments.whole, 3U);
  });
}

TEST(Replay, SendsRealSessionsToALanWithoutLoss) {
  RECKON_NEED_DATA("dis-captures");
  const auto file = test::reference_data() / "dis-captures/real-sessions/gaz69-patrol.pcap";
  RECKON_IN_OWN_NETWORK([&] {
    test::make_cable();
    const auto source = peer::open_interface_capture("b0");
    const ProgramResult result =
        run_reckon({"replay", file.string(), "--iface", "a0", "--rate", "100", "--json"});
    EXPECT_EQ(result.status, 0) << result.err;
    const json line = json::parse(result.lines().back());
    EXPECT_EQ(line["datagrams"], 231);
    EXPECT_EQ(line["refused"], 0);
    EXPECT_EQ(line["fragmented"], 24);
    const auto recorded = peer::open_capture(file.string());
    std::vector<Octets> wanted;
    peer::SourceDatagram datagram;
    while (recorded->next(datagram, {}) == peer::SourceEvent::datagram)
      wanted.emplace_back(datagram.bytes.begin(), datagram.bytes.end());
    EXPECT_EQ(captured_on(*source, peer::IpEndpoint::v4(0xef010203, 3000)), wanted);
  });
}

/// A plain socket of any other program: bound to a port, in no group.
class PlainReceiver {
 public:
  PlainReceiver() : socket_(socket(AF_INET, SOCK_DGRAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    socklen_t size = sizeof address;
    EXPECT_EQ(bind(socket_, reinterpret_cast<sockaddr*>(&address), size), 0);
    getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &size);
    port_ = ntohs(address.sin_port);
  }
  ~PlainReceiver() { close(socket_); }
  PlainReceiver(const PlainReceiver&) = delete;
  PlainReceiver& operator=(const PlainReceiver&) = delete;

  [[nodiscard]] std::string port() const { return std::to_string(port_); }
  std::size_t take() {
    std::size_t count = 0;
    std::array<char, 2000> buffer{};
    while (recv(socket_, buffer.data(), buffer.size(), MSG_DONTWAIT) > 0) ++count;
    return count;
  }

 private:
  int socket_;
  std::uint16_t port_ = 0;
};

TEST(Replay, ReachesHostsAndBroadcastAddresses) {
  const ScratchFolder folder;
  const std::string in = make_capture(folder, 10, 1ms);
  PlainReceiver receiver;
  for (const char* address : {"127.0.0.1", "127.255.255.255"}) {
    const ProgramResult result =
        run_reckon({"replay", in, "--to", std::string("udp://") + address + ":" + receiver.port()});
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(receiver.take(), 10U) << address;
  }
}

TEST(ReplaySenders, KnowBroadcastAddresses) {
  const std::vector<LocalNetwork> networks{{"lo", 0x7f000001, 0xff000000},
                                           {"eth0", 0xc0a80117, 0xffffff00},
                                           {"tun0", 0x0a000001, 0xffffffff},
                                           {"p2p0", 0x0a000102, 0xfffffffe}};
  const auto interface = [&](const char* to) {
    return broadcast_interface(parse_destination(to), networks).value_or("none");
  };
  EXPECT_EQ(interface("udp://192.168.1.255:3000"), "eth0");
  EXPECT_EQ(interface("127.255.255.255"), "lo");
  EXPECT_EQ(interface("255.255.255.255"), "");
  EXPECT_EQ(interface("192.168.1.23"), "none");
  EXPECT_EQ(interface("192.168.2.255"), "none");
  EXPECT_EQ(interface("10.0.0.1"), "none");
  EXPECT_EQ(interface("10.0.1.3"), "none");
  EXPECT_EQ(interface("239.1.2.3"), "none");
  EXPECT_EQ(interface("[ff15::1]:3000"), "none");
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

TEST(Replay, RequestsADestinationForUnicastCaptures) {
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
  EXPECT_THAT(result.err, HasSubstr("192.168.1.255:3000, which is not a multicast group"));
  EXPECT_THAT(result.err, HasSubstr("--to udp://"));
}

TEST(Replay, ReportsThatNothingCouldBeSent) {
  const ScratchFolder folder;
  const ProgramResult result =
      run_reckon({"replay", make_capture(folder, 5, 1ms), "--to", "udp://192.0.2.1:3000"});
  EXPECT_EQ(result.status, 3);
  EXPECT_THAT(result.err, HasSubstr("replayed 0 datagrams"));
  EXPECT_THAT(result.err, HasSubstr("5 refused by the kernel; lo reaches only this host"));
  EXPECT_EQ(result.err.find("got"), std::string::npos);
}

TEST(Replay, TakesTheInterfaceThatTheCaptureNames) {
  const ScratchFolder folder;
  const auto capture = [&](const std::string& interface) {
    const std::string path = folder.file(interface + ".pcapng");
    peer::CaptureWriter writer({.path = path, .interface = interface});
    peer::SourceDatagram datagram;
    datagram.source = peer::IpEndpoint::v4(0x0a000001, 4000);
    datagram.group = group(0);
    const Octets bytes = entity_state(1);
    datagram.bytes = bytes;
    writer.write(datagram);
    writer.finish(1, 0);
    return path;
  };
  const ProgramResult here = run_reckon({"replay", capture("lo"), "--iface", "recorded"});
  EXPECT_EQ(here.status, 0) << here.err;
  EXPECT_THAT(here.err, HasSubstr(" on lo "));
  EXPECT_THAT(run_reckon({"replay", capture("no_such_lan"), "--iface", "recorded"}).err,
              HasSubstr("no_such_lan is not on this host"));
  EXPECT_THAT(run_reckon({"replay", capture(""), "--iface", "recorded"}).err,
              HasSubstr("the capture names no interface"));
}

TEST(Replay, NamesTheMistake) {
  const ScratchFolder folder;
  const std::string in = make_capture(folder, 2, 1ms);
  EXPECT_THAT(run_reckon({"replay", in, "--rate", "-1"}).err, HasSubstr("--rate -1"));
  EXPECT_THAT(run_reckon({"replay", in, "--to", "there"}).err,
              HasSubstr("neither a destination nor a time"));
  EXPECT_THAT(run_reckon({"replay", "-", "--loop", "2"}).err, HasSubstr("only once"));
  EXPECT_THAT(run_reckon({"replay", in, "--to", "1s", "--to", "2s"}).err,
              HasSubstr("the second end of the range"));
  EXPECT_THAT(run_reckon({"replay", in, "--to", "127.0.0.1", "--to", "127.0.0.2"}).err,
              HasSubstr("the second destination"));
  EXPECT_THAT(run_reckon({"replay", in, "--where", "colour == red"}).err, HasSubstr("^"));
  EXPECT_THAT(run_reckon({"replay", folder.file("none")}).err, HasSubstr("cannot be opened"));
  const ProgramResult result = run_reckon({"replay", in, "--iface", "none0"});
  EXPECT_EQ(result.status, 3);
  EXPECT_THAT(result.err, HasSubstr("none0"));
}

TEST(ReplayReach, CountsAtLeastBeyondItsLimit) {
  ReplayReach reach;
  const auto note = [&](std::size_t port) {
    reach.note(peer::IpEndpoint::v4(0xEFC00100, static_cast<std::uint16_t>(port)));
  };
  for (std::size_t port = 1; port < ReplayReach::kMost; ++port) note(port);
  EXPECT_THAT(reach.text("e0"), HasSubstr(" and 998 more on e0"));
  note(ReplayReach::kMost);
  note(ReplayReach::kMost + 1);
  EXPECT_THAT(reach.text("e0"), HasSubstr(" and at least 999 more on e0"));
}

}  // namespace
}  // namespace reckon::tools
