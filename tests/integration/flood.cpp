// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A sender that floods a multicast group from one socket:
//   flood ADDRESS GROUP PORT RATE SECONDS KIND
// ADDRESS of the interface to send by; KIND junk: octets that no rule of DIS allows; states: whole
// Entity States of exercise 1 with invented IDs; another word: a file of sealed datagrams, a line
// of hex each, which are sent as they are, flipped, cut, or with another epoch, boot, stream or
// count. One JSON line: how many were sent, and how fast. It rests a fifth of its time: at
// real-time priority it would otherwise make the kernel stop all such threads of its core, servos
// among them, for 50 ms in each second, as no flooder on another machine could.
#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <functional>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/entity/entity_state.hpp"

namespace {

using namespace reckon;
using Clock = std::chrono::steady_clock;

constexpr std::size_t kSize = pdu::kFixedSize<pdu::EntityState>, kBatch = 64;
constexpr double kBusy = 0.8;  // of the time
using Octets = std::vector<std::byte>;

std::uint64_t next_number() {
  static std::uint64_t state = 1;
  state = state * 6364136223846793005u + 1442695040888963407u;
  return state >> 20;
}

Octets junk() {
  Octets octets(kSize);
  for (std::byte& octet : octets) octet = static_cast<std::byte>(next_number());
  octets[0] |= std::byte{0x80};
  return octets;
}

Octets state() {
  Octets octets(kSize);
  pdu::EntityState state;
  state.header.exercise_id = 1;
  state.entity_id = {7, 7, static_cast<std::uint16_t>(next_number())};
  if (pdu::encode(state, octets) != kSize) std::abort();
  return octets;
}

constexpr std::size_t kLeastSealed = 41;  // envelope and tag, and something in them

std::vector<Octets> read_recording(const char* file) {
  std::vector<Octets> recording;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    if (line.size() < 2 * kLeastSealed) continue;
    Octets& octets = recording.emplace_back();
    for (std::size_t i = 0; i + 1 < line.size(); i += 2) {
      octets.push_back(static_cast<std::byte>(std::stoi(line.substr(i, 2), nullptr, 16)));
    }
  }
  return recording;
}

void flip_within(Octets& octets, std::size_t first, std::size_t count) {
  octets[first + next_number() % count] ^= std::byte{1} << (next_number() % 8);
}

// One of the recording, as an attacker without the key would send it again.
Octets forged(const std::vector<Octets>& recording) {
  Octets octets = recording[next_number() % recording.size()];
  switch (next_number() % 8) {
    case 0:
      break;  // as it was
    case 1:
      octets.resize(next_number() % octets.size());
      break;
    case 2:
      flip_within(octets, 2, 2);  // epoch
      break;
    case 3:
      flip_within(octets, 8, 8);  // boot
      break;
    case 4:
      flip_within(octets, 16, 2);  // stream
      break;
    case 5:
      flip_within(octets, 18, 6);  // count
      break;
    case 6:
      flip_within(octets, 24, octets.size() - 24);
      break;
    default:
      for (int i = 0; i < 4; ++i) flip_within(octets, 0, octets.size());
  }
  return octets;
}

using Maker = std::function<Octets()>;

// What makes one after another; an empty function where there is nothing to forge.
Maker maker_of(std::string_view kind) {
  if (kind == "junk") return junk;
  if (kind == "states") return state;
  auto recording = read_recording(kind.data());
  if (recording.empty()) return {};
  return [recording = std::move(recording)] { return forged(recording); };
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

double cpu_seconds() {
  timespec used{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &used);
  return static_cast<double>(used.tv_sec) + 1e-9 * static_cast<double>(used.tv_nsec);
}

int run(char** words) {
  const int out = socket_to(words[1], words[2], words[3]);
  if (out < 0) return std::perror("flood"), 1;
  const double rate = std::atof(words[4]), seconds = std::atof(words[5]);
  const Maker make = maker_of(words[6]);
  if (!make) return std::fprintf(stderr, "flood: nothing in '%s'\n", words[6]), 1;
  const bool same = make.target<Octets (*)()>() != nullptr;  // one batch of it is enough
  std::array<Octets, kBatch> octets;
  std::array<iovec, kBatch> vectors{};
  std::array<mmsghdr, kBatch> messages{};
  const auto fill = [&] {
    for (std::size_t i = 0; i < kBatch; ++i) {
      octets[i] = make();
      vectors[i] = {octets[i].data(), octets[i].size()};
      messages[i].msg_hdr.msg_iov = &vectors[i];
      messages[i].msg_hdr.msg_iovlen = 1;
    }
  };
  fill();
  const auto begun = Clock::now();
  const double cpu_begun = cpu_seconds();
  const auto elapsed = [&] { return std::chrono::duration<double>(Clock::now() - begun).count(); };
  std::uint64_t sent = 0;
  while (elapsed() < seconds) {
    const double now = elapsed();
    if (static_cast<double>(sent) > rate * now || cpu_seconds() - cpu_begun > kBusy * now) {
      std::this_thread::sleep_for(std::chrono::microseconds(200));
      continue;
    }
    const int took = sendmmsg(out, messages.data(), kBatch, 0);
    if (took > 0) sent += static_cast<std::uint64_t>(took);
    if (!same) fill();
  }
  std::printf("{\"sent\":%llu,\"per_s\":%.0f}\n", static_cast<unsigned long long>(sent),
              static_cast<double>(sent) / elapsed());
  close(out);
  return 0;
}

}  // namespace

int main(int count, char** words) {
  if (count == 7) return run(words);
  std::fputs("usage: flood ADDRESS GROUP PORT RATE SECONDS junk|states|FILE\n", stderr);
  return 2;
}
