// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/network/impaired_link.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "reckon/haptics/exchange/triple_buffer.hpp"
#include "reckon/peer/counters/counters.hpp"
#include "reckon/peer/network/datagram_tap.hpp"
#include "reckon/peer/network/delay_queue.hpp"

namespace reckon::peer {
namespace {

using std::chrono::nanoseconds;

// Datagrams taken from the inner link in one receive(): bounded, so that a flood cannot hold us.
constexpr std::size_t kBatch = 64;
constexpr int kBatchesPerReceive = 8;

struct Sender {
  IpEndpoint endpoint;
  std::uint64_t number;
  std::uint64_t next_sequence;
};

}  // namespace

// The inner link, the impairment law, and the delayed datagrams.
struct ImpairedLink::Emulator {
  Emulator(Link& wrapped, const ImpairedLinkOptions& options, const Clock& steady)
      : inner(wrapped),
        clock(steady),
        start(options.start),
        tap(options.tap),
        max_senders(std::max<std::size_t>(options.max_senders, 1)),
        seed(direction_seed(options.seed, options.receiver)),
        impairment(options.law, seed),
        next_law(impairment),
        queue(options.queue, options.max_datagram) {
    senders.reserve(max_senders);
  }

  Sender& sender_of(const IpEndpoint& endpoint) noexcept;
  void take_in(const Datagram& datagram) noexcept;
  void note(DatagramFate fate, const Datagram& datagram) const noexcept {
    if (tap != nullptr) tap->note(DatagramTap::Loop::read, fate, datagram.group, datagram.bytes);
  }

  Link& inner;
  const Clock& clock;
  nanoseconds start;
  DatagramTap* tap;
  std::size_t max_senders;
  std::uint64_t seed;
  Impairment impairment;
  haptics::TripleBuffer<Impairment> next_law;  // of change_law()
  DelayQueue queue;
  std::vector<Sender> senders;
  std::uint64_t numbered_by_appearance{0};
  std::array<Datagram, kBatch> batch{};
  Counter delivered, delivered_bytes, lost, duplicated, overflows, truncated;
};

Sender& ImpairedLink::Emulator::sender_of(const IpEndpoint& endpoint) noexcept {
  for (Sender& sender : senders) {
    if (sender.endpoint == endpoint) return sender;
  }
  if (senders.size() == max_senders) return senders.back();
  return senders.emplace_back(Sender{endpoint, numbered_by_appearance++, 0});
}

void ImpairedLink::Emulator::take_in(const Datagram& datagram) noexcept {
  Sender& sender = sender_of(datagram.sender);
  const Fate fate =
      impairment.decide(sender.number, sender.next_sequence++, datagram.received - start);
  if (fate.copies == 0) return note(DatagramFate::lost_by_law, datagram), lost.add();
  if (datagram.bytes.size() > queue.max_bytes())
    return note(DatagramFate::queue_overflow, datagram), truncated.add();
  if (fate.copies == 2) note(DatagramFate::copied_by_law, datagram), duplicated.add();
  for (std::size_t copy = 0; copy < fate.copies; ++copy) {
    const nanoseconds due = datagram.received + fate.delay[copy];
    if (queue.push(due, datagram.group, datagram.sender, datagram.bytes)) continue;
    note(DatagramFate::queue_overflow, datagram);
    overflows.add();
  }
}

ImpairedLink::ImpairedLink(Link& inner, const ImpairedLinkOptions& options, const Clock& clock)
    : LinkAround(inner), emulator_(std::make_unique<Emulator>(inner, options, clock)) {}

ImpairedLink::~ImpairedLink() = default;

void ImpairedLink::number_sender(const IpEndpoint& sender, std::uint64_t number) {
  emulator_->sender_of(sender).number = number;
}

void ImpairedLink::change_law(const ImpairmentLaw& law) {
  emulator_->next_law.write(Impairment(law, emulator_->seed));
}

SentBatch ImpairedLink::send_batch(std::span<const OutgoingDatagram> batch) noexcept {
  return emulator_->inner.send_batch(batch);
}

std::size_t ImpairedLink::receive(std::span<Datagram> out) noexcept {
  Emulator& s = *emulator_;
  if (s.next_law.update()) s.impairment = s.next_law.read();
  s.queue.release();
  for (int i = 0; i < kBatchesPerReceive; ++i) {
    const std::size_t count = s.inner.receive(s.batch);
    for (std::size_t k = 0; k < count; ++k) s.take_in(s.batch[k]);
    if (count == 0) break;
  }
  const std::size_t count = s.queue.pop_due(s.clock.now(), out);
  s.delivered.add(count);
  for (const Datagram& datagram : out.first(count)) s.delivered_bytes.add(datagram.bytes.size());
  return count;
}

// Waits no longer than until the next held datagram is due.
bool ImpairedLink::wait(nanoseconds timeout) noexcept {
  Emulator& s = *emulator_;
  const nanoseconds due = s.queue.next_due();
  const nanoseconds now = s.clock.now();
  const nanoseconds until_due =
      due == nanoseconds::max() ? due : std::max(due - now, nanoseconds{0});
  const bool readable = s.inner.wait(std::min(timeout, until_due));
  return readable || due <= s.clock.now();
}

std::size_t ImpairedLink::max_payload() const noexcept {
  return std::min(emulator_->inner.max_payload(), emulator_->queue.max_bytes());
}

void ImpairedLink::settle() noexcept {
  Emulator& s = *emulator_;
  s.inner.settle();
  if (s.tap == nullptr) return;
  for (std::size_t count = 1; count > 0;) {
    s.queue.release();
    count = s.queue.pop_due(nanoseconds::max(), s.batch);
    for (const Datagram& datagram : std::span(s.batch).first(count))
      s.note(DatagramFate::unread, datagram);
  }
}

LinkStatistics ImpairedLink::statistics() const noexcept {
  LinkStatistics out = emulator_->inner.statistics();
  out.received = emulator_->delivered.value();
  out.received_bytes = emulator_->delivered_bytes.value();
  out.lost_by_law += emulator_->lost.value();
  out.duplicated_by_law += emulator_->duplicated.value();
  out.queue_overflows += emulator_->overflows.value();
  out.truncated += emulator_->truncated.value();
  return out;
}

}  // namespace reckon::peer
