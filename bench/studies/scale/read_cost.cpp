// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/scale/read_cost.hpp"

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <system_error>
#include <thread>

#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/threads/cpu_time.hpp"

namespace reckon::bench {
namespace {

using std::chrono::steady_clock;

constexpr int kDatagrams = 1000;
constexpr std::size_t kOctets = 1000;
constexpr std::chrono::microseconds kGap{200};
constexpr timeval kSilence{0, 200'000};  // receive time-out

/// A UDP socket on loopback.
class UdpSocket {
 public:
  UdpSocket() : number_(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
    address_.sin_family = AF_INET;
    address_.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address_;
    auto* address = reinterpret_cast<sockaddr*>(&address_);
    check(number_ >= 0 && bind(number_, address, size) == 0 &&
          getsockname(number_, address, &size) == 0 &&
          setsockopt(number_, SOL_SOCKET, SO_RCVTIMEO, &kSilence, sizeof kSilence) == 0);
  }
  UdpSocket(const UdpSocket&) = delete;
  UdpSocket& operator=(const UdpSocket&) = delete;
  ~UdpSocket() { close(number_); }

  void send_to(const UdpSocket& other) const {
    const std::array<char, kOctets> octets{};
    static_cast<void>(sendto(number_, octets.data(), octets.size(), 0,
                             reinterpret_cast<const sockaddr*>(&other.address_),
                             sizeof other.address_));
  }
  /// False if nothing arrives within kSilence.
  [[nodiscard]] bool receive() const {
    std::array<char, kOctets> octets;
    return recv(number_, octets.data(), octets.size(), 0) > 0;
  }

 private:
  static void check(bool good) {
    if (!good) throw std::system_error(errno, std::generic_category(), "a socket on loopback");
  }
  int number_;
  sockaddr_in address_{};
};

double one_run() {
  const UdpSocket to, from;
  std::jthread sender([&] {
    auto next = steady_clock::now();
    for (int i = 0; i < kDatagrams; ++i) {
      std::this_thread::sleep_until(next += kGap);
      from.send_to(to);
    }
  });
  int count = 0;
  const nanoseconds begin = peer::thread_cpu_time();
  while (count < kDatagrams && to.receive()) ++count;
  return pdu::to_seconds(peer::thread_cpu_time() - begin) / std::max(count, 1);
}

}  // namespace

double measure_read_cost() {
  std::array<double, 3> runs{one_run(), one_run(), one_run()};
  std::ranges::sort(runs);
  return runs[1];
}

}  // namespace reckon::bench
