// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Cost of a datagram of 7,000 octets in five IP fragments, from frames of a capture to its payload,
// and the number of datagrams that are reassembled: in order, with the fragments of 16 datagrams
// mixed, and with a fragment of every hundredth datagram lost. Each row first compares every octet
// with the sent ones.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <random>
#include <span>
#include <vector>

#include "reckon/peer/capture/ip_reassembler.hpp"
#include "reckon/tests/src/support/made_fragments.hpp"

namespace {

using namespace reckon::peer;
using frames::Bytes;

constexpr std::size_t kDatagrams = 960, kPayload = 7000, kMixed = 16, kLostEach = 100;
constexpr std::chrono::microseconds kSpacing{200};  // 5,000 datagrams a second
constexpr std::size_t kUdpHeader = 8, kIdAt = 18;   // of IPv4 in Ethernet

/// A fragment, and its datagram.
struct Piece {
  Bytes frame;
  std::size_t datagram = 0;
};

std::vector<Piece> pieces(bool mixed, bool lossy) {
  std::vector<Piece> all;
  for (std::size_t i = 0; i < kDatagrams; ++i) {
    auto of_one = frames::fragments(frames::numbered_udp(kPayload, i), 0, frames::fragment4);
    if (lossy && i % kLostEach == 0) of_one.erase(of_one.begin() + 2);
    for (Bytes& frame : of_one) all.push_back({std::move(frame), i});
  }
  std::mt19937 random(1);
  const std::size_t window = kMixed * 5;
  for (std::size_t at = 0; mixed && at + window <= all.size(); at += window)
    std::shuffle(all.begin() + static_cast<std::ptrdiff_t>(at),
                 all.begin() + static_cast<std::ptrdiff_t>(at + window), random);
  return all;
}

/// Feeds all pieces repeatedly, each time with the next identifiers, as a sender does.
class Feed {
 public:
  explicit Feed(std::vector<Piece> pieces) : pieces_(std::move(pieces)) {}

  /// @param take called with the number and the payload of each complete datagram
  template <typename Take>
  void run(Take&& take) {
    for (Piece& piece : pieces_) {
      const auto id = static_cast<std::uint16_t>(first_id_ + piece.datagram);
      piece.frame[kIdAt] = static_cast<std::uint8_t>(id >> 8U);
      piece.frame[kIdAt + 1] = static_cast<std::uint8_t>(id);
      SourceDatagram datagram;
      datagram.time = now_ + piece.datagram * kSpacing;
      datagram.captured = std::as_bytes(std::span(piece.frame));
      const ParsedFrame parsed =
          parse_frame(LinkLayer::ethernet, datagram.captured, datagram.captured.size(), datagram);
      if (!parsed.fragment.has_value()) continue;
      const auto fate = reassembler_.take(LinkLayer::ethernet, *parsed.fragment, datagram);
      if (fate == FragmentFate::whole) take(piece.datagram, datagram.bytes);
      held_ = std::max(held_, reassembler_.octets());
      while (reassembler_.take_lost(datagram)) continue;
    }
    now_ += kDatagrams * kSpacing;
    first_id_ += kDatagrams;
  }
  [[nodiscard]] std::size_t held() const { return held_; }

 private:
  std::vector<Piece> pieces_;
  IpReassembler reassembler_;
  std::chrono::nanoseconds now_{std::chrono::seconds(1)};
  std::size_t first_id_ = 0;
  std::size_t held_ = 0;
};

void Reassembled(benchmark::State& run, bool mixed, bool lossy) {
  Feed feed(pieces(mixed, lossy));
  std::uint64_t whole = 0, wrong = 0;
  feed.run([&](std::size_t number, std::span<const std::byte> payload) {
    const Bytes sent = frames::numbered_udp(kPayload, number);
    ++whole;
    wrong += payload.size() != kPayload ||
             std::memcmp(payload.data(), sent.data() + kUdpHeader, kPayload) != 0;
  });
  const std::size_t lost = lossy ? (kDatagrams + kLostEach - 1) / kLostEach : 0;
  if (wrong > 0 || whole != kDatagrams - lost) return run.SkipWithError("not what was sent");
  for (auto _ : run)
    feed.run([&](std::size_t, std::span<const std::byte> payload) {
      benchmark::DoNotOptimize(payload.data());
      ++whole;
    });
  const double sent = static_cast<double>(kDatagrams) * static_cast<double>(run.iterations() + 1);
  run.counters["whole_share"] = static_cast<double>(whole) / sent;
  run.counters["wrong"] = static_cast<double>(wrong);
  run.counters["held_octets"] = static_cast<double>(feed.held());
  run.counters["each_s"] = benchmark::Counter(
      kDatagrams, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK_CAPTURE(Reassembled, in_order, false, false);
BENCHMARK_CAPTURE(Reassembled, mixed, true, false);
BENCHMARK_CAPTURE(Reassembled, one_lost_of_100, true, true);

}  // namespace
