// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/latency/udp_ping.hpp"

#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>

#include "reckon/peer/threads/thread_name.hpp"

namespace reckon::bench {
namespace {

using std::chrono::nanoseconds;

nanoseconds now() noexcept { return std::chrono::steady_clock::now().time_since_epoch(); }

struct Place {
  sockaddr_storage address{};
  socklen_t size = 0;
};

Place place_of(const peer::IpEndpoint& endpoint) {
  Place place;
  if (endpoint.is_v6) {
    sockaddr_in6 six{};
    six.sin6_family = AF_INET6;
    std::memcpy(&six.sin6_addr, endpoint.octets.data(), sizeof six.sin6_addr);
    place.size = sizeof six;
    std::memcpy(&place.address, &six, sizeof six);
  } else {
    sockaddr_in four{};
    four.sin_family = AF_INET;
    std::memcpy(&four.sin_addr, endpoint.octets.data(), sizeof four.sin_addr);
    place.size = sizeof four;
    std::memcpy(&place.address, &four, sizeof four);
  }
  return place;
}

[[noreturn]] void fail(const char* what, const peer::IpEndpoint& endpoint) {
  throw std::system_error(errno, std::generic_category(),
                          what + (" " + endpoint.address_text()) + " for the bare datagrams");
}

int bound_to(const peer::IpEndpoint& endpoint) {
  const int descriptor =
      ::socket(endpoint.is_v6 ? AF_INET6 : AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (descriptor < 0) fail("no socket on", endpoint);
  const timeval second{1, 0};
  setsockopt(descriptor, SOL_SOCKET, SO_RCVTIMEO, &second, sizeof second);
  const Place place = place_of(endpoint);
  if (::bind(descriptor, reinterpret_cast<const sockaddr*>(&place.address), place.size) == 0) {
    return descriptor;
  }
  ::close(descriptor);
  fail("cannot bind to", endpoint);
}

bool connect_to(int descriptor, int other) noexcept {
  Place place;
  place.size = sizeof place.address;
  auto* address = reinterpret_cast<sockaddr*>(&place.address);
  return getsockname(other, address, &place.size) == 0 &&
         ::connect(descriptor, address, place.size) == 0;
}

}  // namespace

UdpPing::UdpPing(const peer::IpEndpoint& address, std::size_t octets)
    : question_(octets), heard_(octets), asking_(bound_to(address)), answering_(-1) {
  try {
    answering_ = bound_to(address);
    if (!connect_to(asking_, answering_) || !connect_to(answering_, asking_)) {
      fail("cannot connect on", address);
    }
    answerer_ = std::thread([this] { answer(); });
    peer::name_thread(answerer_.native_handle(), "rk-answer");
  } catch (...) {
    ::close(asking_);
    if (answering_ >= 0) ::close(answering_);
    throw;
  }
}

UdpPing::~UdpPing() {
  stop_ = true;
  ::send(asking_, question_.data(), question_.size(), MSG_DONTWAIT);
  answerer_.join();
  ::close(asking_);
  ::close(answering_);
}

void UdpPing::answer() noexcept {
  std::vector<std::byte> octets(question_.size());
  while (!stop_) {
    const ssize_t size = ::recv(answering_, octets.data(), octets.size(), 0);
    if (size <= 0) continue;
    heard_at_.store(now().count(), std::memory_order_release);
    ::send(answering_, octets.data(), static_cast<std::size_t>(size), MSG_DONTWAIT);
  }
}

std::optional<PingAnswer> UdpPing::ask() noexcept {
  std::memcpy(question_.data(), &++number_, sizeof number_);
  const nanoseconds sent = now();
  if (::send(asking_, question_.data(), question_.size(), MSG_DONTWAIT) < 0) return std::nullopt;
  // A late answer to an earlier question is skipped.
  std::int64_t number = 0;
  while (number != number_) {
    if (::recv(asking_, heard_.data(), heard_.size(), 0) <= 0) return std::nullopt;
    std::memcpy(&number, heard_.data(), sizeof number);
  }
  const nanoseconds back = now();
  return PingAnswer{nanoseconds(heard_at_.load(std::memory_order_acquire)) - sent, back - sent};
}

}  // namespace reckon::bench
