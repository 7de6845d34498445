// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Where datagrams leave the model loop, and what it tells a tap of each one, where somebody
// listens.
#include <array>

#include "reckon/peer/loops/model_loop.hpp"

namespace reckon::peer {
namespace {

// By aoim::IncomingVerdict.
constexpr std::array<DatagramFate, aoim::kIncomingVerdicts> kFateOfVerdict{
    DatagramFate::delivered,  DatagramFate::delivered,   DatagramFate::own,
    DatagramFate::not_joined, DatagramFate::other_scene, DatagramFate::former_life,
    DatagramFate::duplicate,  DatagramFate::too_old,     DatagramFate::other_exercise,
    DatagramFate::impostor,   DatagramFate::stranger};

}  // namespace

void ModelLoop::tell_judged(const QueuedDatagram& datagram, const aoim::Incoming& incoming,
                            std::uint64_t lost_before) noexcept {
  const DatagramFate fate = kFateOfVerdict[static_cast<std::size_t>(incoming.verdict)];
  DatagramEvent event = tap_->event_of(fate, datagram.group, datagram.octets);
  event.verdict = incoming.sequence;
  event.lost = static_cast<std::int32_t>(aoim_.sequences().counts().lost - lost_before);
  tap_->push(DatagramTap::Loop::model, event);
}

// That it has a number, and what else befell it at once.
void ModelLoop::tell_numbered(aoim::GroupIndex group, std::span<const std::byte> octets,
                              DatagramFate more) noexcept {
  tap_->note(DatagramTap::Loop::model, DatagramFate::numbered, address_of(group), octets);
  if (more != DatagramFate::numbered)
    tap_->note(DatagramTap::Loop::model, more, address_of(group), octets);
}

void ModelLoop::push_datagram(aoim::GroupIndex group, std::span<const std::byte> octets) noexcept {
  const bool fits = outbound_.push(address_of(group), std::chrono::nanoseconds(0), octets);
  if (!fits) counted_.write_overflow.add();
  if (tap_ != nullptr)
    tell_numbered(group, octets, fits ? DatagramFate::numbered : DatagramFate::write_overflow);
}

void ModelLoop::settle() noexcept {
  if (tap_ == nullptr) return;
  for (DatagramRing* ring : {felt_, &inbound_}) {
    while (const QueuedDatagram* datagram = ring == nullptr ? nullptr : ring->front()) {
      tap_->note(DatagramTap::Loop::model, DatagramFate::unread, datagram->group, datagram->octets);
      ring->pop();
    }
  }
}

}  // namespace reckon::peer
