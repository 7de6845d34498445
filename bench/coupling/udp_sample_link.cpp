// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/coupling/udp_sample_link.hpp"

#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/network/udp_socket.hpp"

namespace reckon::bench {
namespace {

constexpr std::chrono::milliseconds kSayAgain(20);

void check_call(int result, const char* what) {
  if (result != 0) throw std::system_error(errno, std::generic_category(), what);
}

}  // namespace

UdpSampleLink::UdpSampleLink(const peer::IpEndpoint& local, SampleQueue incoming,
                             std::chrono::milliseconds patience)
    : socket_(::socket(local.is_v6 ? AF_INET6 : AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0),
              "coupling study: socket"),
      incoming_(std::move(incoming)),
      patience_(patience) {
  sockaddr_storage address{};
  const socklen_t size = peer::to_sockaddr(local, 0, address);
  check_call(::bind(socket_.get(), reinterpret_cast<const sockaddr*>(&address), size),
             "coupling study: bind");
}

peer::IpEndpoint UdpSampleLink::local() const {
  sockaddr_storage address{};
  socklen_t size = sizeof address;
  check_call(::getsockname(socket_.get(), reinterpret_cast<sockaddr*>(&address), &size),
             "coupling study: getsockname");
  return peer::from_sockaddr(address);
}

void UdpSampleLink::connect(const peer::IpEndpoint& remote) {
  sockaddr_storage address{};
  const socklen_t size = peer::to_sockaddr(remote, 0, address);
  check_call(::connect(socket_.get(), reinterpret_cast<const sockaddr*>(&address), size),
             "coupling study: connect");
}

std::span<const CouplingSample> UdpSampleLink::receive(std::uint32_t number) {
  if (heard_ < number) await(number);
  return incoming_.take(number);
}

void UdpSampleLink::send(std::uint32_t number, const std::optional<CouplingSample>& sample) {
  said_[1] = said_[0];
  said_[0] = to_record(number, sample);
  said_count_ = std::min(said_count_ + 1, 2U);
  say();
}

// A datagram that the kernel does not accept is sent again later.
void UdpSampleLink::say() noexcept {
  SampleDatagram datagram;
  const std::size_t size = encode_samples({said_.data(), said_count_}, datagram);
  static_cast<void>(::send(socket_.get(), datagram.data(), size, MSG_DONTWAIT | MSG_NOSIGNAL));
}

// Waits until the samples 0 .. number - 1 of the other side have arrived. Other datagrams, for
// example from another run, do not extend the wait.
void UdpSampleLink::await(std::uint32_t number) {
  const peer::SteadyClock clock;
  const std::chrono::nanoseconds end = clock.now() + patience_;
  auto say_again = clock.now() + kSayAgain;
  while (heard_ < number) {
    pollfd wanted{socket_.get(), POLLIN, 0};
    if (::poll(&wanted, 1, static_cast<int>(kSayAgain.count())) > 0) read();
    const std::chrono::nanoseconds now = clock.now();
    if (heard_ < number && now >= end) {
      throw std::runtime_error(
          "coupling study: sample " + std::to_string(number - 1) +
          " of the other side did not arrive in time: start it with the same run and this address");
    }
    if (now < say_again) continue;
    say();
    say_again = now + kSayAgain;
  }
}

// An error here reports a datagram that nobody received: the other side has not started yet.
void UdpSampleLink::read() {
  SampleDatagram datagram;
  const auto size = ::recv(socket_.get(), datagram.data(), datagram.size(), MSG_DONTWAIT);
  if (size <= 0) return;
  const SampleRecords heard =
      decode_samples(std::span(datagram).first(static_cast<std::size_t>(size)));
  for (std::size_t i = heard.count; i-- > 0;) {  // the older one first
    const SampleRecord& record = heard.records[i];
    if (record.number != heard_) continue;
    ++heard_;
    if (const auto sample = from_record(record)) incoming_.put(*sample);
  }
}

}  // namespace reckon::bench
