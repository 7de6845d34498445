// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A sender that floods a multicast group from one socket:
//   flood ADDRESS GROUP PORT RATE SECONDS KIND
// ADDRESS of the sending interface; RATE datagrams a second, or max: as fast as possible, without
// the rests below. KIND crowd: bundles of nine states of a thousand entities, stamped when sent,
// from eight sockets in turn, so that none is a flood by itself; hosts: the same from the eight
// addresses above ADDRESS, so that no address is muted; runs: whole states, 64 in a run that the
// kernel segments; junk: octets that violate DIS; states: whole Entity States of exercise 1 with
// forged IDs; another word: a file of sealed datagrams, one line of hex each, sent unchanged,
// flipped, cut, or with another epoch, boot, stream or count. Prints one JSON line: count and rate.
// It rests a fifth of the time: at real-time priority the kernel would otherwise stop all real-time
// threads of its core, servos among them, for 50 ms in each second, which a flooder on another
// machine could not cause.
#include <arpa/inet.h>
#include <netinet/udp.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/entity/entity_state.hpp"
#include "reckon/pdu/random/split_mix.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/pdu/timestamp.hpp"
#include "reckon/peer/threads/cpu_time.hpp"

namespace {

using namespace reckon;
using Clock = std::chrono::steady_clock;

constexpr std::size_t kSize = pdu::kFixedSize<pdu::EntityState>, kBatch = 64;
constexpr double kBusy = 0.8;  // share of the time
using Octets = std::vector<std::byte>;

std::uint64_t next_number() {
  static std::uint64_t state = 1;
  return pdu::mixed_bits(state += pdu::kGoldenStep);
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

// Nine current states of the next entities of a thousand.
Octets bundle() {
  constexpr std::size_t kStates = 9;
  static std::uint16_t next = 0;
  Octets octets(kStates * kSize);
  pdu::EntityState state;
  state.header.exercise_id = 1;
  state.header.timestamp =
      pdu::to_dis_timestamp(std::chrono::system_clock::now().time_since_epoch(), true);
  state.entity_type = {pdu::EntityKind::platform, pdu::EntityDomain::air};
  state.location = {4308876.4, 629365.2, 4646597.9};  // a kilometre above where hands touch
  for (std::size_t i = 0; i < kStates; ++i, next = static_cast<std::uint16_t>((next + 1) % 1000)) {
    state.entity_id = {7, 8, static_cast<std::uint16_t>(next + 1)};
    if (pdu::encode(state, std::span(octets).subspan(i * kSize, kSize)) != kSize) std::abort();
  }
  return octets;
}

constexpr std::size_t kLeastSealed = 41;  // envelope, tag and content

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

// A recorded datagram, as an attacker without the key would resend it.
Octets forged(const std::vector<Octets>& recording) {
  Octets octets = recording[next_number() % recording.size()];
  switch (next_number() % 8) {
    case 0:
      break;  // unchanged
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

// The function that makes the datagrams; empty if there is nothing to forge.
Maker maker_of(std::string_view kind) {
  if (kind == "junk") return junk;
  if (kind == "states" || kind == "runs") return state;
  if (kind == "crowd" || kind == "hosts") return bundle;
  auto recording = read_recording(kind.data());
  if (recording.empty()) return {};
  return [recording = std::move(recording)] { return forged(recording); };
}

bool bind_to(int out, const in_addr& by, std::uint32_t host) {
  if (host == 0) return true;
  sockaddr_in own{};
  own.sin_family = AF_INET;
  own.sin_addr.s_addr = htonl(ntohl(by.s_addr) + host);
  return bind(out, reinterpret_cast<const sockaddr*>(&own), sizeof own) == 0;
}

// A socket on the interface of `from`. @param host offset of the source address above `from`; 0:
// the kernel's choice
int socket_to(const char* from, const char* group, const char* port, std::uint32_t host) {
  const int out = socket(AF_INET, SOCK_DGRAM, 0);
  in_addr by{};
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(static_cast<std::uint16_t>(std::atoi(port)));
  const bool good =
      inet_pton(AF_INET, from, &by) == 1 && inet_pton(AF_INET, group, &to.sin_addr) == 1 &&
      setsockopt(out, IPPROTO_IP, IP_MULTICAST_IF, &by, sizeof by) == 0 && bind_to(out, by, host) &&
      connect(out, reinterpret_cast<const sockaddr*>(&to), sizeof to) == 0;
  return good ? out : -1;
}

// Sends a batch, segmented by the kernel where needed. Returns how many were sent.
std::uint64_t send_run(int out, std::array<iovec, kBatch>& vectors) {
  msghdr message{};
  message.msg_iov = vectors.data();
  message.msg_iovlen = vectors.size();
  return sendmsg(out, &message, 0) > 0 ? kBatch : 0;
}

std::uint64_t send_each(int out, std::array<mmsghdr, kBatch>& messages) {
  const int took = sendmmsg(out, messages.data(), kBatch, 0);
  return took > 0 ? static_cast<std::uint64_t>(took) : 0;
}

double cpu_seconds() { return pdu::to_seconds(peer::thread_cpu_time()); }

int run(char** words) {
  const bool hosts = std::string_view(words[6]) == "hosts";
  const bool crowd = hosts || std::string_view(words[6]) == "crowd";
  std::array<int, 8> sockets;
  for (std::uint32_t i = 0; i < sockets.size(); ++i)
    sockets[i] = socket_to(words[1], words[2], words[3], hosts ? i + 1 : 0);
  const int out = sockets[0];
  if (sockets.back() < 0) return std::perror("flood"), 1;
  const bool all_it_can = std::string_view(words[4]) == "max";
  const double rate = all_it_can ? 1e12 : std::atof(words[4]), seconds = std::atof(words[5]);
  const double busy = all_it_can ? 1e12 : kBusy;
  const Maker make = maker_of(words[6]);
  if (!make) return std::fprintf(stderr, "flood: nothing in '%s'\n", words[6]), 1;
  // A single batch is enough for constant content.
  const bool same = make.target<Octets (*)()>() != nullptr && !crowd;
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
  const bool runs = std::string_view(words[6]) == "runs";
  const int segment = kSize;
  if (runs && setsockopt(out, SOL_UDP, UDP_SEGMENT, &segment, sizeof segment) != 0)
    return std::perror("flood: UDP_SEGMENT"), 1;
  const auto begun = Clock::now();
  const double cpu_begun = cpu_seconds();
  const auto elapsed = [&] { return std::chrono::duration<double>(Clock::now() - begun).count(); };
  std::uint64_t sent = 0;
  while (elapsed() < seconds) {
    const double now = elapsed();
    if (static_cast<double>(sent) > rate * now || cpu_seconds() - cpu_begun > busy * now) {
      std::this_thread::sleep_for(std::chrono::microseconds(200));
      continue;
    }
    const int by = crowd ? sockets[sent / kBatch % sockets.size()] : out;
    sent += runs ? send_run(by, vectors) : send_each(by, messages);
    if (!same) fill();
  }
  std::printf("{\"sent\":%llu,\"per_s\":%.0f}\n", static_cast<unsigned long long>(sent),
              static_cast<double>(sent) / elapsed());
  for (const int each : sockets) close(each);
  return 0;
}

}  // namespace

int main(int count, char** words) {
  if (count == 7) return run(words);
  std::fputs("usage: flood ADDRESS GROUP PORT RATE|max SECONDS junk|states|runs|crowd|hosts|FILE\n",
             stderr);
  return 2;
}
