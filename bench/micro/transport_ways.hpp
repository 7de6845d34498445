// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Network paths of transport_bench (loopback, and a veth pair between two network namespaces), and
// loops of bare system calls for comparison.
#pragma once

#include <fcntl.h>
#include <netinet/in.h>
#include <sched.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "reckon/bench/timing/cpu_ns.hpp"
#include "reckon/peer/network/interface_choice.hpp"
#include "reckon/peer/network/udp_multicast.hpp"

namespace reckon::peer {

inline constexpr std::size_t kUpdate = 144, kPerDatagram = 9, kDatagrams = 64;
inline constexpr std::size_t kRounds = 8;         // in a turn, so that caches hold only its data
inline constexpr std::size_t kRoundsBehind = 22;  // as many as the ring of a peer holds
inline constexpr std::uint16_t kEntities = 1000;
inline constexpr std::size_t kBuffer = std::size_t{8} << 20;  // has room for a round

/// @throws std::runtime_error
inline void check(bool good, const char* what) {
  if (!good) throw std::runtime_error(what);
}

/// Two namespaces with a cable from a0 to b0, and loopback in the first. The calling thread moves
/// into the first permanently: no traffic leaves it.
class Cable {
 public:
  Cable() {
    check(unshare(CLONE_NEWNET) == 0, "needs root for network namespaces");
    near_ = open("/proc/thread-self/ns/net", O_RDONLY);
    std::thread([this] {
      if (unshare(CLONE_NEWNET) != 0) return;
      const bool good =
          std::system(("ip link set lo up && ip link add b0 type veth peer name a0 netns " +
                       std::to_string(getpid()) +
                       " && ip addr add 10.66.0.2/24 dev b0 && "
                       "ip link set b0 up")
                          .c_str()) == 0;
      if (good) far_ = open("/proc/thread-self/ns/net", O_RDONLY);
    }).join();
    check(far_ >= 0 && std::system("ip link set lo up && ip addr add 10.66.0.1/24 dev a0 && "
                                   "ip link set a0 up") == 0,
          "no cable: is iproute2 there?");
  }
  void enter(bool far) const { check(setns(far ? far_ : near_, CLONE_NEWNET) == 0, "setns"); }
  static const Cable& instance() {
    static const Cable cable;
    return cable;
  }

 private:
  int near_ = -1, far_ = -1;
};

/// The path of a row.
struct Way {
  const char *sender, *receiver;
  bool far;
};
inline constexpr Way kLoopback{"lo", "lo", false}, kNamespaces{"a0", "b0", true};

inline UdpMulticastOptions options_of(const char* interface, bool offload) {
  UdpMulticastOptions options;
  options.interface = interface;
  options.receive_buffer = kBuffer;
  options.batch = 64;
  options.offload = offload;
  return options;
}

/// Only sendto and recvmmsg.
class BareLoop {
 public:
  BareLoop(const Way& way, std::size_t size, const GroupAddress& group) : octets_(size) {
    sender_ = socket(AF_INET, SOCK_DGRAM, 0);
    const ip_mreqn out{{}, {}, index_of(way.sender)};
    check(setsockopt(sender_, IPPROTO_IP, IP_MULTICAST_IF, &out, sizeof out) == 0, "multicast if");
    to_.sin_family = AF_INET;
    to_.sin_port = htons(group.port);
    std::copy_n(group.octets.begin(), 4, reinterpret_cast<std::uint8_t*>(&to_.sin_addr));
    Cable::instance().enter(way.far);
    receiver_ = socket(AF_INET, SOCK_DGRAM, 0);
    const int room = kBuffer, none = 0;
    setsockopt(receiver_, SOL_SOCKET, SO_RCVBUFFORCE, &room, sizeof room);
    setsockopt(receiver_, IPPROTO_IP, IP_MULTICAST_ALL, &none, sizeof none);
    check(bind(receiver_, reinterpret_cast<sockaddr*>(&to_), sizeof to_) == 0, "bind");
    const ip_mreqn in{to_.sin_addr, {}, index_of(way.receiver)};
    check(setsockopt(receiver_, IPPROTO_IP, IP_ADD_MEMBERSHIP, &in, sizeof in) == 0, "join");
    Cable::instance().enter(false);
    for (std::size_t i = 0; i < kDatagrams; ++i) {
      vectors_[i] = {buffers_[i].data(), buffers_[i].size()};
      messages_[i].msg_hdr.msg_iov = &vectors_[i];
      messages_[i].msg_hdr.msg_iovlen = 1;
    }
  }
  ~BareLoop() {
    close(sender_);
    close(receiver_);
  }
  BareLoop(const BareLoop&) = delete;
  BareLoop& operator=(const BareLoop&) = delete;

  /// CPU for each datagram [ns], over a turn.
  double turn() {
    const double begin = bench::cpu_ns();
    for (std::size_t i = 0; i < kRounds; ++i) round();
    return (bench::cpu_ns() - begin) / (kRounds * kDatagrams);
  }

 private:
  void round() {
    for (std::size_t i = 0; i < kDatagrams; ++i) {
      sendto(sender_, octets_.data(), octets_.size(), 0, reinterpret_cast<sockaddr*>(&to_),
             sizeof to_);
    }
    std::size_t got = 0;
    while (got < kDatagrams) {
      const int count = recvmmsg(receiver_, messages_.data(), kDatagrams, MSG_DONTWAIT, nullptr);
      check(count > 0, "a bare datagram was lost");
      got += static_cast<std::size_t>(count);
    }
  }

  static int index_of(const std::string& name) {
    for (const NetworkInterface& found : list_interfaces()) {
      if (found.name == name) return static_cast<int>(found.index);
    }
    throw std::runtime_error("no interface " + name);
  }
  int sender_, receiver_;
  sockaddr_in to_{};
  std::vector<std::byte> octets_;
  std::array<std::array<std::byte, 2048>, kDatagrams> buffers_;
  std::array<iovec, kDatagrams> vectors_{};
  std::array<mmsghdr, kDatagrams> messages_{};
};

/// A different group at each call.
inline GroupAddress next_group() {
  static std::uint32_t number = 0;
  return IpEndpoint::v4(0xefc04f01u + number++, 3100);
}

}  // namespace reckon::peer
