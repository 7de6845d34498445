// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/datagram_outlet.hpp"

#include <chrono>

namespace reckon::peer {

void DatagramOutlet::push(aoim::GroupIndex group, std::span<const std::byte> octets) noexcept {
  const bool fits = ring_.push(address_of(group), std::chrono::nanoseconds(0), octets);
  if (!fits) counted_.write_overflow.add();
  note(group, octets, fits ? DatagramFate::numbered : DatagramFate::write_overflow);
}

void DatagramOutlet::drop_stale(aoim::GroupIndex group,
                                std::span<const std::byte> octets) noexcept {
  counted_.stale_unsent.add();
  note(group, octets, DatagramFate::stale_unsent);
}

// Notifies the tap that the datagram has a number, and of an immediate fate.
void DatagramOutlet::note(aoim::GroupIndex group, std::span<const std::byte> octets,
                          DatagramFate more) noexcept {
  if (tap_ == nullptr) return;
  tap_->note(DatagramTap::Loop::model, DatagramFate::numbered, address_of(group), octets);
  if (more != DatagramFate::numbered)
    tap_->note(DatagramTap::Loop::model, more, address_of(group), octets);
}

}  // namespace reckon::peer
