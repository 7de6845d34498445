// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/network/fan_out_link.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstring>

#include "reckon/pdu/reckon/unicast_frame.hpp"
#include "reckon/peer/counters/counters.hpp"
#include "reckon/peer/network/datagram_tap.hpp"

namespace reckon::peer {
namespace {

constexpr std::size_t kAtOnce = 64;  // datagrams of a batch copied at a time
constexpr std::size_t kSlot = kMaxDatagram + pdu::kUnicastFrameSize;

}  // namespace

GroupFrame group_frame_of(std::span<const std::byte> datagram, const GroupPool& pool) noexcept {
  const auto frame = pdu::unicast_frame_of(datagram);
  if (!frame) return {0, pool.base(), datagram};
  const std::size_t place = frame->group;
  const std::span<const std::byte> behind = datagram.subspan(frame->header.length);
  if (place > pool.size()) return {std::nullopt, {}, behind};
  return {place, place == 0 ? pool.base() : pool.address(place - 1), behind};
}

// The inner link, the addresses, and the joined groups.
struct FanOutLink::UnicastGroups {
  UnicastGroups(Link& wrapped, const GroupPool& groups, const FanOutOptions& asked)
      : inner(wrapped), pool(groups), options(asked), joined(groups.size() + 1) {
    std::erase(options.peers, inner.local_endpoint());
    octets.resize(kAtOnce * kSlot);
    copies.reserve(kAtOnce * options.peers.size());
  }

  [[nodiscard]] std::size_t place_of(const GroupAddress& group) const noexcept {
    const auto index = pool.index(group);
    return index ? *index + 1 : 0;
  }
  [[nodiscard]] std::span<const std::byte> framed(std::size_t slot,
                                                  const OutgoingDatagram& datagram) noexcept;
  [[nodiscard]] bool unwrap(Datagram& datagram) noexcept;
  void note_out(const OutgoingDatagram& datagram, bool goes) noexcept;

  Link& inner;
  GroupPool pool;
  FanOutOptions options;
  std::vector<std::atomic<bool>> joined;  ///< base group, then the pool
  std::vector<std::byte> octets;          ///< of the copies to send
  std::vector<OutgoingDatagram> copies;
  Counter not_listened, joins, leaves;
};

// The datagram as sent; nothing if it is too long.
std::span<const std::byte> FanOutLink::UnicastGroups::framed(
    std::size_t slot, const OutgoingDatagram& datagram) noexcept {
  if (options.plain) return datagram.bytes;
  if (datagram.bytes.size() > kMaxDatagram) return {};
  pdu::UnicastFrame front;
  front.header.exercise_id = options.exercise;
  front.group = static_cast<std::uint16_t>(place_of(datagram.to));
  const std::span<std::byte> out = std::span(octets).subspan(slot * kSlot, kSlot);
  const std::size_t size = pdu::encode(front, out);
  if (!datagram.bytes.empty())
    std::memcpy(out.data() + size, datagram.bytes.data(), datagram.bytes.size());
  return out.first(size + datagram.bytes.size());
}

// Removes the frame; false if the datagram is for others. One without a frame is plain DIS.
bool FanOutLink::UnicastGroups::unwrap(Datagram& datagram) noexcept {
  const GroupFrame said = group_frame_of(datagram.bytes, pool);
  datagram.bytes = said.bytes;
  if (said.place) datagram.group = said.group;
  if (said.place && joined[*said.place].load(std::memory_order_relaxed)) return true;
  not_listened.add();
  if (options.tap != nullptr)
    options.tap->note(DatagramTap::Loop::read, DatagramFate::not_listened, datagram.group,
                      datagram.bytes);
  return false;
}

// Records the number of copies for the inner link, which reports their fates.
void FanOutLink::UnicastGroups::note_out(const OutgoingDatagram& datagram, bool goes) noexcept {
  if (options.tap == nullptr) return;
  const std::size_t peers = options.peers.size();
  if (goes && peers == 1) return;
  const DatagramFate fate = !goes        ? DatagramFate::send_error
                            : peers == 0 ? DatagramFate::to_nobody
                                         : DatagramFate::copied_to_list;
  DatagramEvent event = options.tap->event_of(fate, datagram.to, datagram.bytes);
  if (fate == DatagramFate::copied_to_list) event.count = static_cast<std::uint32_t>(peers - 1);
  options.tap->push(DatagramTap::Loop::write, event);
}

FanOutLink::FanOutLink(Link& inner, const GroupPool& pool, const FanOutOptions& options)
    : LinkAround(inner), groups_(std::make_unique<UnicastGroups>(inner, pool, options)) {}

FanOutLink::~FanOutLink() = default;

bool FanOutLink::send(const IpEndpoint& to, std::span<const std::byte> bytes) noexcept {
  const OutgoingDatagram datagram{to, bytes};
  return send_batch({&datagram, 1}).datagrams == 1;
}

// Address by address, so that the datagrams to one address are a run.
SentBatch FanOutLink::send_batch(std::span<const OutgoingDatagram> batch) noexcept {
  UnicastGroups& s = *groups_;
  SentBatch sent;
  const std::size_t peers = s.options.peers.size();
  for (; !batch.empty(); batch = batch.subspan(std::min(batch.size(), kAtOnce))) {
    const std::span<const OutgoingDatagram> part = batch.first(std::min(batch.size(), kAtOnce));
    std::array<std::span<const std::byte>, kAtOnce> framed;
    std::size_t octets = 0;
    for (std::size_t i = 0; i < part.size(); ++i) {
      framed[i] = s.framed(i, part[i]);
      octets += part[i].bytes.size();
      s.note_out(part[i], !framed[i].empty());
    }
    s.copies.clear();
    for (const IpEndpoint& peer : s.options.peers) {
      for (std::size_t i = 0; i < part.size(); ++i) {
        if (!framed[i].empty()) s.copies.push_back({peer, framed[i]});
      }
    }
    const std::size_t went = s.inner.send_batch(s.copies).datagrams;
    const bool all = went == part.size() * peers;
    sent.datagrams += all ? part.size() : went / std::max<std::size_t>(peers, 1);
    if (all) sent.octets += octets;
  }
  return sent;
}

std::size_t FanOutLink::receive(std::span<Datagram> out) noexcept {
  for (;;) {
    const std::size_t came = groups_->inner.receive(out);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < came; ++i) {
      if (groups_->unwrap(out[i])) out[kept++] = out[i];
    }
    if (kept > 0 || came < out.size()) return kept;
  }
}

std::error_code FanOutLink::join(const GroupAddress& group) noexcept {
  if (!groups_->joined[groups_->place_of(group)].exchange(true)) groups_->joins.add();
  return {};
}

void FanOutLink::leave(const GroupAddress& group) noexcept {
  if (groups_->joined[groups_->place_of(group)].exchange(false)) groups_->leaves.add();
}

std::size_t FanOutLink::max_payload() const noexcept {
  const std::size_t most = groups_->inner.max_payload();
  return groups_->options.plain ? most : most - std::min(most, pdu::kUnicastFrameSize);
}

LinkStatistics FanOutLink::statistics() const noexcept {
  LinkStatistics out = groups_->inner.statistics();
  out.joins = groups_->joins.value();
  out.leaves = groups_->leaves.value();
  return out;
}

std::uint64_t FanOutLink::not_listened() const noexcept { return groups_->not_listened.value(); }

std::size_t FanOutLink::peers() const noexcept { return groups_->options.peers.size(); }

}  // namespace reckon::peer
