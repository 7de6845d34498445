// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/datagram_outlet.hpp"

#include <algorithm>

#include "reckon/pdu/seconds.hpp"

namespace reckon::peer {

void DatagramOutlet::begin(std::chrono::nanoseconds now) noexcept {
  const double passed = pdu::to_seconds(now - filled_);
  filled_ = now;
  tokens_ = std::min(kBurst, tokens_ + kRate * std::max(0.0, passed));
}

std::size_t DatagramOutlet::paced_room() const noexcept {
  const auto paced = static_cast<std::size_t>(std::max(0.0, tokens_)) * kAhead;
  return std::min(room(), paced);
}

void DatagramOutlet::push(aoim::GroupIndex group, std::span<const std::byte> octets) noexcept {
  tokens_ -= 1.0;
  const bool fits = ring_.push(address_of(group), std::chrono::nanoseconds(0), octets);
  if (!fits) counted_.write_overflow.add();
  note(group, octets, fits ? DatagramFate::numbered : DatagramFate::write_overflow);
}

void DatagramOutlet::drop_stale(aoim::GroupIndex group,
                                std::span<const std::byte> octets) noexcept {
  counted_.stale_unsent.add();
  note(group, octets, DatagramFate::stale_unsent);
}

// Reports to the tap that the datagram has a number, and an immediate fate if any.
void DatagramOutlet::note(aoim::GroupIndex group, std::span<const std::byte> octets,
                          DatagramFate more) noexcept {
  if (tap_ == nullptr) return;
  tap_->note(DatagramTap::Loop::model, DatagramFate::numbered, address_of(group), octets);
  if (more != DatagramFate::numbered)
    tap_->note(DatagramTap::Loop::model, more, address_of(group), octets);
}

}  // namespace reckon::peer
