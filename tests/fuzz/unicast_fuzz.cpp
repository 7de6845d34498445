// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Datagrams of any octets as input of a link with a unicast list. A returned datagram belongs to a
// joined group and is a part of the input, sent datagrams read back, and no heap is allocated. The
// octets are also read as a list of addresses, which reads back as it is written.
#include <algorithm>
#include <array>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "reckon/peer/network/fan_out_link.hpp"
#include "reckon/peer/network/unicast_peers.hpp"
#include "reckon/tests/fuzz/fuzz_target.hpp"

namespace reckon::fuzz {
namespace {

using Octets = std::span<const std::byte>;

constexpr std::size_t kPool = 6;

/// A link that receives one datagram, and keeps the last one that it sends.
class OneDatagram final : public peer::Link {
 public:
  bool send(const peer::IpEndpoint&, Octets bytes) noexcept override {
    sent = bytes;
    return true;
  }
  std::size_t receive(std::span<peer::Datagram> out) noexcept override {
    if (!heard || out.empty()) return 0;
    out[0] = {local_endpoint(), {}, *heard, {}};
    heard.reset();
    return 1;
  }
  std::error_code join(const peer::GroupAddress&) noexcept override { return {}; }
  void leave(const peer::GroupAddress&) noexcept override {}
  bool wait(std::chrono::nanoseconds) noexcept override { return true; }
  void wake() noexcept override {}
  [[nodiscard]] peer::IpEndpoint local_endpoint() const noexcept override {
    return peer::IpEndpoint::v4(0x7f000001, 3000);
  }
  [[nodiscard]] std::size_t max_payload() const noexcept override { return 1472; }
  [[nodiscard]] peer::LinkStatistics statistics() const noexcept override { return {}; }

  std::optional<Octets> heard;
  Octets sent;
};

/// One for all runs, because its buffers are large: the base group and half of the pool are joined.
struct Listener {
  Listener() {
    static_cast<void>(link.join(pool.base()));
    for (std::size_t i = 0; i < kPool; i += 2) static_cast<void>(link.join(pool.address(i)));
  }
  [[nodiscard]] bool has_joined(const peer::GroupAddress& group) const {
    if (group == pool.base()) return true;
    const auto index = pool.index(group);
    return index && *index % 2 == 0;
  }
  static peer::FanOutOptions options() {
    peer::FanOutOptions options;
    options.peers = {peer::IpEndpoint::v4(0x0a000007, 3000)};
    return options;
  }

  peer::GroupPool pool{peer::GroupPool::ipv4_default().base(), kPool};
  OneDatagram wire;
  peer::FanOutLink link{wire, pool, options()};
};

void hear(Listener& listener, Octets input) {
  std::array<peer::Datagram, 2> out;
  listener.wire.heard = input;
  const std::size_t before = listener.link.not_listened();
  const std::size_t came = listener.link.receive(out);
  require(came + listener.link.not_listened() - before == 1, "neither heard nor counted");
  if (came == 0) return;
  require(listener.has_joined(out[0].group), "heard of a group that is not joined");
  const Octets bytes = out[0].bytes;
  require(bytes.size() <= input.size() && std::ranges::equal(bytes, input.last(bytes.size())),
          "what came up is not the end of what came in");

  // Sent again as it was received, it comes back unchanged.
  if (bytes.size() > listener.link.max_payload()) return;
  const peer::GroupAddress group = out[0].group;
  require(listener.link.send(group, bytes), "not sent");
  listener.wire.heard = listener.wire.sent;
  require(listener.link.receive(out) == 1 && out[0].group == group &&
              std::ranges::equal(out[0].bytes, bytes),
          "what was sent does not read back");
}

void read_list(std::string_view text) {
  std::vector<peer::NamedPeer> peers;
  try {
    peers = peer::parse_peers(text);
  } catch (const std::invalid_argument&) {
    return;
  }
  require(!peers.empty() && peers.size() <= peer::kMostUnicastPeers, "too many, or none");
  for (const peer::NamedPeer& peer : peers)
    require(peer::parse_peer(peer.text()) == peer, "is read otherwise than it is written");
}

}  // namespace

void check(std::span<const std::byte> input) {
  static Listener listener;
  {
    const HeapMeter heap;
    hear(listener, input);
    require(heap.allocations() == 0, "hearing took heap");
  }
  read_list(text_of(input));
}

}  // namespace reckon::fuzz
