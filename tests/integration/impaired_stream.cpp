// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A stream of numbered datagrams through the impairment law, on a real link or in process; prints
// the effect of the law as one JSON object.
//   impaired_stream simulate|send|receive [--iface NAME] [--count N] [--rate HZ] [--seed S]
#include <fmt/format.h>

#include <cstring>
#include <memory>
#include <string_view>
#include <thread>
#include <vector>

#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/network/impaired_link.hpp"
#include "reckon/peer/network/simulated_network.hpp"
#include "reckon/peer/network/udp_multicast.hpp"

namespace {

using namespace reckon::peer;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;

const GroupAddress kGroup = GroupAddress::v4(0xEFC00101, 3000);
constexpr std::size_t kOctets = 144;
constexpr std::uint64_t kSender = 0;
constexpr std::uint64_t kReceiver = 1;
constexpr nanoseconds kQuiet = std::chrono::seconds(3);  // silence that ends the stream

struct Options {
  std::string iface = "lo";
  std::uint64_t count = 30'000;
  std::uint64_t rate = 3000;
  std::uint64_t seed = 1;
};

ImpairmentLaw law() {
  ImpairmentLaw law;
  law.delay = milliseconds(200);
  law.jitter = milliseconds(100);
  law.loss = 0.2;
  law.reorder = 0.1;
  law.duplicate = 0.1;
  return law;
}

struct Message {
  std::uint64_t number;
  std::int64_t sent;  // steady [ns]; the same clock in all namespaces of a host
};

std::array<std::byte, kOctets> encode(const Message& message) {
  std::array<std::byte, kOctets> octets{};
  std::memcpy(octets.data(), &message, sizeof message);
  return octets;
}

// The received datagrams: numbers, copies, order, delays.
class Tally {
 public:
  explicit Tally(std::uint64_t count) : seen_(count, false) {}

  void take(const Datagram& datagram, nanoseconds now) {
    Message message{};
    if (datagram.bytes.size() != kOctets) return;
    std::memcpy(&message, datagram.bytes.data(), sizeof message);
    if (message.number >= seen_.size()) return;
    ++arrived_;
    if (seen_[message.number]) ++doubled_;
    if (message.number < newest_) ++overtaken_;
    newest_ = std::max(newest_, message.number);
    seen_[message.number] = true;
    due_ += static_cast<double>(datagram.received.count() - message.sent);
    handed_over_ += static_cast<double>(now.count() - message.sent);
  }
  [[nodiscard]] std::uint64_t arrived() const { return arrived_; }

  // `loss`: share of numbers never received; `delay_s`: mean delay by the law; `handed_over_s`:
  // mean time until the receiver had it.
  void print(const Options& options) const {
    std::uint64_t distinct = 0;
    for (const bool seen : seen_) distinct += seen ? 1 : 0;
    const auto n = static_cast<double>(arrived_);
    fmt::print(R"({{"sent":{},"arrived":{},"loss":{:.6f},"doubled":{:.6f},"overtaken":{:.6f},)"
               R"("delay_s":{:.6f},"handed_over_s":{:.6f}}})"
               "\n",
               options.count, arrived_,
               1.0 - static_cast<double>(distinct) / static_cast<double>(options.count),
               static_cast<double>(doubled_) / n, static_cast<double>(overtaken_) / n,
               1e-9 * due_ / n, 1e-9 * handed_over_ / n);
  }

 private:
  std::vector<bool> seen_;
  std::uint64_t arrived_ = 0, doubled_ = 0, overtaken_ = 0, newest_ = 0;
  double due_ = 0, handed_over_ = 0;  // [ns], sums
};

void take_all(Link& link, const Clock& clock, Tally& tally) {
  std::array<Datagram, 64> batch;
  for (std::size_t n = link.receive(batch); n > 0; n = link.receive(batch)) {
    for (std::size_t i = 0; i < n; ++i) tally.take(batch[i], clock.now());
  }
}

int simulate(const Options& options) {
  ManualClock clock;
  SimulatedNetworkOptions network_options;
  network_options.seed = options.seed;
  network_options.datagrams_in_flight = 4096;
  SimulatedNetwork network(network_options, clock);
  network.impair(law());
  if (network.link(kReceiver).join(kGroup)) return 1;
  Tally tally(options.count);
  const nanoseconds period(1'000'000'000 / options.rate);
  const nanoseconds end = clock.now() + period * static_cast<std::int64_t>(options.count) + kQuiet;
  nanoseconds next = clock.now();
  for (std::uint64_t number = 0; clock.now() < end; clock.advance(std::chrono::microseconds(50))) {
    for (; number < options.count && next <= clock.now(); next += period) {
      if (!network.link(kSender).send(kGroup, encode({number++, clock.now().count()}))) return 1;
    }
    take_all(network.link(kReceiver), clock, tally);
  }
  tally.print(options);
  return 0;
}

UdpMulticastOptions real_link(const Options& options) {
  UdpMulticastOptions udp;
  udp.interface = options.iface;
  return udp;
}

int send(const Options& options) {
  const SteadyClock clock;
  UdpMulticast link(real_link(options), clock);
  const nanoseconds period(1'000'000'000 / options.rate);
  nanoseconds next = clock.now();
  for (std::uint64_t number = 0; number < options.count; ++number, next += period) {
    std::this_thread::sleep_for(next - clock.now());
    if (!link.send(kGroup, encode({number, clock.now().count()}))) return 1;
  }
  return 0;
}

int receive(const Options& options) {
  const SteadyClock clock;
  UdpMulticast real(real_link(options), clock);
  ImpairedLinkOptions impaired;
  impaired.law = law();
  impaired.seed = options.seed;
  impaired.receiver = kReceiver;
  impaired.start = clock.now();
  ImpairedLink link(real, impaired, clock);  // the first received sender is 0 = kSender
  if (link.join(kGroup)) return 1;
  fmt::print(stderr, "ready\n");
  std::fflush(stderr);
  Tally tally(options.count);
  nanoseconds last = clock.now() + std::chrono::seconds(10);  // longest wait for the first one
  while (clock.now() < last + kQuiet) {
    const std::uint64_t before = tally.arrived();
    link.wait(milliseconds(100));
    take_all(link, clock, tally);
    if (tally.arrived() > before) last = clock.now();
  }
  const LinkStatistics statistics = real.statistics();
  fmt::print(stderr, "kernel drops {}\n", statistics.kernel_drops);
  tally.print(options);
  return tally.arrived() > 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  const std::string_view mode = argc > 1 ? argv[1] : "";
  for (int i = 2; i + 1 < argc; i += 2) {
    const std::string_view name = argv[i];
    if (name == "--iface") options.iface = argv[i + 1];
    if (name == "--count") options.count = std::stoull(argv[i + 1]);
    if (name == "--rate") options.rate = std::stoull(argv[i + 1]);
    if (name == "--seed") options.seed = std::stoull(argv[i + 1]);
  }
  if (mode == "simulate") return simulate(options);
  if (mode == "send") return send(options);
  if (mode == "receive") return receive(options);
  fmt::print(stderr,
             "usage: impaired_stream simulate|send|receive [--iface NAME] [--count N] "
             "[--rate HZ] [--seed S]\n");
  return 2;
}
