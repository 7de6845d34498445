// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A sender that floods a multicast group from one socket:
//   flood ADDRESS GROUP PORT RATE SECONDS KIND
// ADDRESS of the interface to send by; KIND junk: octets that no rule of DIS allows; states: whole
// Entity States of exercise 1 with invented IDs. One JSON line: how many were sent, and how fast.
#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string_view>
#include <thread>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/entity/entity_state.hpp"

namespace {

using namespace reckon;
using Clock = std::chrono::steady_clock;

constexpr std::size_t kSize = pdu::kFixedSize<pdu::EntityState>, kBatch = 64;
using Octets = std::array<std::byte, kSize>;

std::uint64_t next_number() {
  static std::uint64_t state = 1;
  state = state * 6364136223846793005u + 1442695040888963407u;
  return state >> 20;
}

Octets make(std::string_view kind) {
  Octets octets{};
  if (kind == "junk") {
    for (std::byte& octet : octets) octet = static_cast<std::byte>(next_number());
    octets[0] |= std::byte{0x80};
    return octets;
  }
  pdu::EntityState state;
  state.header.exercise_id = 1;
  state.entity_id = {7, 7, static_cast<std::uint16_t>(next_number())};
  if (pdu::encode(state, octets) != kSize) std::abort();
  return octets;
}

int socket_to(const char* from, const char* group, const char* port) {
  const int out = socket(AF_INET, SOCK_DGRAM, 0);
  in_addr by{};
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(static_cast<std::uint16_t>(std::atoi(port)));
  const bool good = inet_pton(AF_INET, from, &by) == 1 &&
                    inet_pton(AF_INET, group, &to.sin_addr) == 1 &&
                    setsockopt(out, IPPROTO_IP, IP_MULTICAST_IF, &by, sizeof by) == 0 &&
                    connect(out, reinterpret_cast<const sockaddr*>(&to), sizeof to) == 0;
  return good ? out : -1;
}

int run(char** words) {
  const int out = socket_to(words[1], words[2], words[3]);
  if (out < 0) return std::perror("flood"), 1;
  const double rate = std::atof(words[4]), seconds = std::atof(words[5]);
  std::array<Octets, kBatch> octets;
  std::array<iovec, kBatch> vectors{};
  std::array<mmsghdr, kBatch> messages{};
  for (std::size_t i = 0; i < kBatch; ++i) {
    octets[i] = make(words[6]);
    vectors[i] = {octets[i].data(), kSize};
    messages[i].msg_hdr.msg_iov = &vectors[i];
    messages[i].msg_hdr.msg_iovlen = 1;
  }
  const auto begun = Clock::now();
  const auto elapsed = [&] { return std::chrono::duration<double>(Clock::now() - begun).count(); };
  std::uint64_t sent = 0;
  while (elapsed() < seconds) {
    if (static_cast<double>(sent) > rate * elapsed()) {
      std::this_thread::sleep_for(std::chrono::microseconds(200));
      continue;
    }
    const int took = sendmmsg(out, messages.data(), kBatch, 0);
    if (took > 0) sent += static_cast<std::uint64_t>(took);
  }
  std::printf("{\"sent\":%llu,\"per_s\":%.0f}\n", static_cast<unsigned long long>(sent),
              static_cast<double>(sent) / elapsed());
  close(out);
  return 0;
}

}  // namespace

int main(int count, char** words) {
  if (count == 7) return run(words);
  std::fputs("usage: flood ADDRESS GROUP PORT RATE SECONDS junk|states\n", stderr);
  return 2;
}
