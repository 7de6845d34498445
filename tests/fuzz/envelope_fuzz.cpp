// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Octets as edits of genuine sealed datagrams, or as datagrams themselves. An opener that has taken
// the genuine ones takes no other, makes no entry for a forgery, and allocates no heap. The octets
// are also read as a greeting.
#include <algorithm>
#include <span>
#include <vector>

#include "reckon/peer/sealing/envelope_opener.hpp"
#include "reckon/peer/sealing/hello.hpp"
#include "reckon/tests/fuzz/fuzz_target.hpp"

namespace reckon::fuzz {
namespace {

using Octets = std::vector<std::byte>;
using peer::SealedVerdict;

constexpr std::size_t kGenuine = 4;
constexpr std::size_t kLongest = 4096;

peer::GroupKey group() {
  peer::GroupKey key;
  key.group = "fuzz";
  key.suite = peer::SealingSuite::xchacha20_poly1305;
  key.epochs.resize(2);
  key.epochs[1].number = 2;
  key.epochs[1].from = std::chrono::hours(1);
  key.epochs[1].secret.fill(std::byte{9});
  return key;
}

// Constant random octets, so that findings can be replayed.
bool fixed(std::span<std::byte> out) noexcept {
  std::ranges::fill(out, std::byte{0x5A});
  return true;
}

const peer::GroupKey& key() {
  static const peer::GroupKey kKey = group();
  return kKey;
}

peer::GroupAddress group_of_all() { return peer::GroupPool::ipv4_default().base(); }

peer::OpenedDatagram open(peer::EnvelopeOpener& opener, std::span<const std::byte> octets,
                          std::span<std::byte> room) {
  const std::chrono::nanoseconds now = std::chrono::seconds(1);
  return opener.open({group_of_all(), {}, octets, now}, std::chrono::nanoseconds::min(), now, room);
}

const std::vector<Octets>& genuine() {
  static const std::vector<Octets> kAll = [] {
    peer::EnvelopeSealer sealer(key(), 1, 2, {}, fixed);
    std::vector<Octets> all;
    for (std::size_t i = 0; i < kGenuine; ++i) {
      Octets room(peer::kEnvelope + 16 * i);
      const auto stream = static_cast<peer::SealingStream>(i % 2);
      static_cast<void>(sealer.seal(stream, i / 2, group_of_all(), std::chrono::seconds(1),
                                    Octets(16 * i), room));
      all.push_back(room);
    }
    return all;
  }();
  return kAll;
}

/// The first octet selects the datagram to edit; pairs of position and change follow. The last
/// selection takes the octets unchanged.
Octets edited(std::span<const std::byte> input) {
  if (input.empty()) return {};
  const auto which = std::to_integer<std::size_t>(input[0]) % (kGenuine + 1);
  input = input.subspan(1);
  if (which == kGenuine) return {input.begin(), input.end()};
  Octets out = genuine()[which];
  for (std::size_t i = 0; i + 1 < input.size(); i += 2)
    out[std::to_integer<std::size_t>(input[i]) % out.size()] ^= input[i + 1];
  return out;
}

/// One opener for all runs, because its table is large; it has already taken the genuine datagrams.
peer::EnvelopeOpener& opener() {
  static peer::EnvelopeOpener kOpener(key(), {});
  static const bool kHasTaken = [] {
    std::vector<std::byte> room(kLongest);
    for (const Octets& one : genuine()) {
      const auto opened = open(kOpener, one, room);
      require(opened.verdict == SealedVerdict::opened, "a genuine one was not taken");
    }
    return true;
  }();
  static_cast<void>(kHasTaken);
  return kOpener;
}

}  // namespace

void check(std::span<const std::byte> input) {
  const Octets datagram = edited(input);
  if (datagram.size() > kLongest) return;
  static std::vector<std::byte> room(kLongest);
  peer::EnvelopeOpener& all = opener();
  const HeapMeter heap;
  const auto opened = open(all, datagram, room);
  require(opened.verdict != SealedVerdict::opened, "a forgery or a replay was taken");
  require(heap.allocations() == 0, "opening took heap");
  require(all.senders().size() == 1, "a forgery made an entry");

  peer::Hello hello;
  if (!hello.read(input)) return;
  static_cast<void>(hello.has_echo({hello.nonce(), 1}));
  static_cast<void>(hello.wants(1));
}

}  // namespace reckon::fuzz
