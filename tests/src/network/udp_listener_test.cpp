// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A listener on the loopback interface, whose datagrams come from bare sockets.
#include "reckon/peer/network/udp_listener.hpp"

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <net/if.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/peer/network/bound_endpoints.hpp"

namespace reckon::peer {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// A socket of another program.
class BareSocket {
 public:
  BareSocket() {
    const int on = 1;
    setsockopt(socket_, SOL_SOCKET, SO_BROADCAST, &on, sizeof on);
    in_addr lo{htonl(INADDR_LOOPBACK)};
    setsockopt(socket_, IPPROTO_IP, IP_MULTICAST_IF, &lo, sizeof lo);
  }
  ~BareSocket() { close(socket_); }
  BareSocket(const BareSocket&) = delete;
  BareSocket& operator=(const BareSocket&) = delete;

  void send(const IpEndpoint& to, std::string_view text) const {
    sockaddr_storage address{};
    const socklen_t size = to_sockaddr(to, 0, address);
    ASSERT_EQ(sendto(socket_, text.data(), text.size(), 0,
                     reinterpret_cast<const sockaddr*>(&address), size),
              static_cast<ssize_t>(text.size()))
        << strerror(errno);
  }
  [[nodiscard]] bool bind_shared(const IpEndpoint& endpoint) const {
    const int on = 1;
    setsockopt(socket_, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
    sockaddr_storage address{};
    const socklen_t size = to_sockaddr(endpoint, 0, address);
    return bind(socket_, reinterpret_cast<const sockaddr*>(&address), size) == 0;
  }
  [[nodiscard]] std::string next() const {
    std::array<char, 64> text{};
    const ssize_t size = recv(socket_, text.data(), text.size(), MSG_DONTWAIT);
    return size < 0 ? "" : std::string(text.data(), static_cast<std::size_t>(size));
  }

 private:
  int socket_ = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
};

class ListenerOnLo : public testing::Test {
 protected:
  IpEndpoint place(const std::string& address) const { return *IpEndpoint::parse(address, port_); }

  /// The texts that arrive within a second, until there are `count`.
  std::vector<std::string> texts(UdpListener& listener, std::size_t count) {
    std::vector<std::string> out;
    std::array<Datagram, 8> batch;
    const auto end = clock_.now() + 1s;
    while (out.size() < count && clock_.now() < end) {
      listener.wait(10ms);
      const std::size_t got = listener.receive(batch);
      for (std::size_t i = 0; i < got; ++i) {
        out.emplace_back(reinterpret_cast<const char*>(batch[i].bytes.data()),
                         batch[i].bytes.size());
        groups_.push_back(batch[i].group.address_text());
        std::array<char, IF_NAMESIZE> name{};
        interfaces_.emplace_back(if_indextoname(listener.interface_of(batch[i]), name.data()));
      }
    }
    return out;
  }

  SteadyClock clock_;
  std::uint16_t port_ = static_cast<std::uint16_t>(20000 + getpid() % 20000);
  std::vector<std::string> groups_, interfaces_;
  BareSocket sender_;
};

TEST_F(ListenerOnLo, ReceivesAndLabelsGroupsBroadcastAndUnicast) {
  UdpListener listener({"", {place("239.192.77.1"), place("0.0.0.0")}}, clock_);
  sender_.send(place("239.192.77.1"), "to a group");
  EXPECT_THAT(texts(listener, 1), ElementsAre("to a group"));
  sender_.send(place("127.255.255.255"), "to the subnet");
  EXPECT_THAT(texts(listener, 1), ElementsAre("to the subnet"));
  sender_.send(place("127.0.0.1"), "to one");
  EXPECT_THAT(texts(listener, 1), ElementsAre("to one"));
  EXPECT_THAT(groups_, ElementsAre("239.192.77.1", "127.255.255.255", "127.0.0.1"));
  EXPECT_THAT(interfaces_, ElementsAre("lo", "lo", "lo"));
}

TEST_F(ListenerOnLo, ReceivesEqualDatagramsAsOftenAsSent) {
  UdpListener listener({"", {place("239.192.77.1")}}, clock_);
  for (int i = 0; i < 3; ++i) sender_.send(place("239.192.77.1"), "same");
  EXPECT_THAT(texts(listener, 3), ElementsAre("same", "same", "same"));
  EXPECT_EQ(listener.copies(), 0U);
}

TEST_F(ListenerOnLo, TakesNoUnicastFromAnotherProgram) {
  BareSocket simulator;
  ASSERT_TRUE(simulator.bind_shared(place("0.0.0.0")));
  try {
    UdpListener listener({"", {place("127.0.0.1")}}, clock_);
    ADD_FAILURE() << "it listens";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("only one program receives its datagrams"));
  }
  UdpListener listener({"lo", {place("0.0.0.0")}}, clock_);
  ASSERT_FALSE(listener.warnings().empty());
  EXPECT_THAT(listener.warnings().front(), HasSubstr("127.0.0.1"));
  sender_.send(place("127.0.0.1"), "to the simulator");
  sender_.send(place("127.255.255.255"), "to all");
  EXPECT_THAT(texts(listener, 1), ElementsAre("to all"));
  EXPECT_EQ(simulator.next(), "to the simulator");
  EXPECT_EQ(simulator.next(), "to all");
}

TEST_F(ListenerOnLo, LetsALaterProgramBindThePort) {
  UdpListener listener({"", {place("127.0.0.1")}}, clock_);
  BareSocket simulator;
  EXPECT_TRUE(simulator.bind_shared(place("0.0.0.0")));
}

TEST_F(ListenerOnLo, RefusesAnAddressOfAnotherHost) {
  try {
    UdpListener listener({"", {place("198.51.100.1")}}, clock_);
    ADD_FAILURE() << "it listens";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("an address or a broadcast address of this host"));
  }
  UdpListener listener({"", {place("198.51.100.1"), place("127.0.0.1")}, true}, clock_);
  sender_.send(place("127.0.0.1"), "heard");
  EXPECT_THAT(texts(listener, 1), ElementsAre("heard"));
}

TEST(BoundEndpoints, AreReadFromTheKernelsTable) {
  std::istringstream table(
      "   sl  local_address rem_address   st\n"
      "  1: 0001C0EF:0BB8 00000000:0000 07\n"
      "  2: 00000000:0044 00000000:0000 07\n"
      "  3: 0001C0EF:0BB8 00000000:0000 07\n"
      "  4: 0001C0:0BB8 00000000:0000 07\n");
  const auto found = read_bound_endpoints(table, false);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].text(), "239.192.1.0:3000");
  EXPECT_EQ(found[1].text(), "0.0.0.0:68");
}

}  // namespace
}  // namespace reckon::peer
