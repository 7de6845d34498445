// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/network_read_loop.hpp"

#include <algorithm>
#include <span>

#include "reckon/aoim/groups/group_index.hpp"
#include "reckon/pdu/zero_length.hpp"

namespace reckon::peer {
namespace {

constexpr std::chrono::nanoseconds kRetry = std::chrono::seconds(1);

}  // namespace

NetworkReadLoop::NetworkReadLoop(Link& link, haptics::SpscRing<GroupCommand>& commands,
                                 DatagramRing& out, Counters& counters,
                                 std::optional<std::uint8_t> exercise, bool lenient,
                                 DatagramTap* tap, std::optional<UrgentRing> urgent)
    : link_(link),
      commands_(commands),
      out_(out),
      exercise_(exercise),
      lenient_(lenient),
      tap_(tap),
      urgent_(urgent),
      datagrams_(counters.make("datagrams_in", "datagrams received")),
      octets_(counters.make("octets_in", "octets of UDP payload received")),
      waits_(counters.make("read_waits",
                           "times that the read loop waited for a model loop that lags")),
      too_long_(counters.make_in(kRefusedDatagrams, "too_long", "too_long_in",
                                 "dropped datagrams that are longer than any of a peer")),
      muted_in_(counters.make_in(kRefusedDatagrams, "flood", "muted_in",
                                 "datagrams of flooding senders, dropped without reading")),
      refused_{nullptr,
               &counters.make_in(kRefusedDatagrams, "version", "refused_version_in",
                                 "datagrams whose first octet is not a DIS version"),
               &counters.make_in(kRefusedDatagrams, "length", "refused_length_in",
                                 "datagrams that do not begin with a PDU header"),
               &counters.make_in(kRefusedDatagrams, "exercise", "refused_exercise_in",
                                 "datagrams that begin with another exercise"),
               &counters.make_in(kRefusedDatagrams, "sealed_without_key", "sealed_unread_in",
                                 "sealed datagrams received without a key"),
               &counters.make_in(kRefusedDatagrams, "no_length", "refused_no_length_in",
                                 "datagrams that begin with a PDU whose length field is 0")},
      join_errors_(counters.make("join_errors", "groups that could not be joined")),
      groups_unjoined_(
          counters.make_level("groups_unjoined", "of these, groups that are still not joined")),
      base_unjoined_(counters.make_level("base_unjoined", "1 while the base group is not joined")),
      stale_(counters.make_in(
          kRefusedDatagrams, "stale", "stale_datagrams",
          "datagrams dropped because they were read more than 1 s after arrival")) {
  unjoined_.reserve(aoim::kMaximumPool + 1);
  if (lenient) mended_.reserve(pdu::kMaxPduSize);
}

std::size_t NetworkReadLoop::step(std::chrono::nanoseconds now) noexcept {
  while (const GroupCommand* command = commands_.front()) {
    obey(*command);
    commands_.pop();
  }
  retry_joins(now);
  if (known_.update()) budget_.know(known_.read());
  static_cast<void>(felt_.update());
  budget_.look(now);
  refused_senders_.look(now);

  taken_felt_ = false;
  std::size_t taken = 0;
  for (;;) {
    const std::size_t wanted = std::min(batch_.size(), room());
    full_ = wanted == 0;
    if (full_) waits_.add();
    pressed_ = out_.room() < out_.most() / 2;
    const std::size_t got = full_ ? 0 : link_.receive(std::span(batch_).first(wanted));
    for (std::size_t i = 0; i < got; ++i) taken += take_datagram(batch_[i], now) ? 1 : 0;
    if (got < wanted || full_) return taken;
  }
}

std::size_t NetworkReadLoop::room() const noexcept {
  return urgent_ ? std::min(out_.room(), urgent_->ring.room()) : out_.room();
}

DatagramRing& NetworkReadLoop::ring_of(const GroupAddress& group) noexcept {
  return urgent_ && urgent_->groups.index(group) ? urgent_->ring : out_;
}

void NetworkReadLoop::obey(const GroupCommand& command) noexcept {
  if (!base_) base_ = command.group;
  std::erase(unjoined_, command.group);
  if (!command.join) {
    link_.leave(command.group);
  } else if (link_.join(command.group)) {
    join_errors_.add();
    if (unjoined_.size() < unjoined_.capacity()) unjoined_.push_back(command.group);
  }
  count_unjoined();
}

void NetworkReadLoop::count_unjoined() noexcept {
  groups_unjoined_.set(unjoined_.size());
  const bool deaf = std::find(unjoined_.begin(), unjoined_.end(), base_) != unjoined_.end();
  base_unjoined_.set(deaf ? 1 : 0);
}

// A limit on open files or memory usually applies to all groups, so the first refusal ends the
// attempt. The refused group is moved to the end, because the cause may be the group itself.
void NetworkReadLoop::retry_joins(std::chrono::nanoseconds now) noexcept {
  if (unjoined_.empty() || now < next_retry_) return;
  next_retry_ = now + kRetry;
  const auto base = std::find(unjoined_.begin(), unjoined_.end(), base_);
  if (base != unjoined_.end()) std::rotate(base, base + 1, unjoined_.end());
  while (!unjoined_.empty() && !link_.join(unjoined_.back())) unjoined_.pop_back();
  if (!unjoined_.empty()) std::rotate(unjoined_.begin(), unjoined_.end() - 1, unjoined_.end());
  count_unjoined();
}

void NetworkReadLoop::drop(DatagramFate fate, const Datagram& datagram, Counter& counter) noexcept {
  counter.add();
  if (tap_ != nullptr) tap_->note(DatagramTap::Loop::read, fate, datagram.group, datagram.bytes);
}

bool NetworkReadLoop::take_datagram(const Datagram& datagram,
                                    std::chrono::nanoseconds now) noexcept {
  datagrams_.add();
  octets_.add(datagram.bytes.size());
  if (now - datagram.received > kStale) {
    drop(DatagramFate::stale, datagram, stale_);
    return false;
  }
  const std::chrono::nanoseconds came = std::min(now, datagram.received);
  if (!is_wanted(datagram, came)) return false;
  DatagramRing& ring = ring_of(datagram.group);
  const auto bytes = lenient_ ? mended(datagram.bytes) : datagram.bytes;
  const bool fits = ring.push(datagram.group, came, bytes, datagram.sender, datagram.boot);
  if (!fits) drop(DatagramFate::too_long, datagram, too_long_);
  taken_felt_ = taken_felt_ || (fits && felt_.read().contains(datagram.sender));
  return fits;
}

bool NetworkReadLoop::is_wanted(const Datagram& datagram, std::chrono::nanoseconds came) noexcept {
  // Without sender addresses no sender can be muted.
  if (!datagram.sender.is_unspecified() && !budget_.admit(datagram.sender, came, pressed_)) {
    drop(DatagramFate::muted, datagram, muted_in_);
    return false;
  }
  const Refusal refusal = exercise_ ? refuse_at_gate(datagram.bytes, *exercise_) : Refusal::none;
  if (refusal == Refusal::none || (lenient_ && refusal == Refusal::no_length)) return true;
  drop(DatagramFate::refused, datagram, *refused_[static_cast<std::size_t>(refusal)]);
  refused_senders_.note(datagram, refusal, came);
  return false;
}

// A UDP datagram fits into the reserved capacity.
std::span<const std::byte> NetworkReadLoop::mended(std::span<const std::byte> bytes) noexcept {
  const auto at = bytes.size() <= mended_.capacity() ? pdu::find_zero_length(bytes) : std::nullopt;
  if (!at) return bytes;
  mended_.assign(bytes.begin(), bytes.end());
  pdu::set_length(mended_, *at, static_cast<std::uint16_t>(bytes.size() - *at));
  return mended_;
}

}  // namespace reckon::peer
