// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/world/row_owners.hpp"

#include <algorithm>

#include "reckon/pdu/seconds.hpp"

namespace reckon::peer {
namespace {

using aoim::SourceAddress;

constexpr std::size_t kHosts = 1024;
constexpr std::uint64_t kProbes = 4;  // possible keys of a sender, in case two fold to the same

std::uint64_t word_at(const SourceAddress& address, std::size_t offset) noexcept {
  std::uint64_t word = 0;
  for (std::size_t i = 0; i < 8; ++i) word = word << 8 | address.octets[offset + i];
  return word;
}

// A sender with a proven identity has that as its key. Else the key is an IPv4 address with its
// port, or a folded IPv6 one.
std::uint64_t key_of(const SourceAddress& address) noexcept {
  if (address.boot != 0) return address.boot;
  const std::uint64_t high = word_at(address, 0), low = word_at(address, 8);
  if (high == 0 && low >> 32 == 0xFFFF) return (low & 0xFFFFFFFF) << 16 | address.port;
  const std::uint64_t mixed = (high ^ (high >> 29)) * 0xBF58476D1CE4E5B9ULL + low;
  return (mixed ^ (mixed >> 32)) * 0x94D049BB133111EBULL + address.port;
}

}  // namespace

RowOwners::RowOwners(std::size_t rows) : rows_(rows), index_(kSenders) {
  senders_.reserve(kSenders);
  free_.reserve(kSenders);
  hosts_.reserve(kHosts);
}

std::uint32_t RowOwners::find(const SourceAddress& from) const noexcept {
  const std::uint64_t key = key_of(from);
  for (std::uint64_t i = 0; i < kProbes; ++i) {
    const std::uint32_t place = index_.find(key + i);
    if (place != kNone && senders_[place].address == from) return place;
  }
  return kNone;
}

std::chrono::nanoseconds RowOwners::patience_with_guest(double timeout) noexcept {
  return std::clamp<std::chrono::nanoseconds>(pdu::from_seconds(timeout / 2.0), kSilence,
                                              kGuestSilence);
}

void RowOwners::heard(const SourceAddress& from, std::chrono::nanoseconds now) noexcept {
  const std::uint32_t place = find(from);
  if (place == kNone) return;
  senders_[place].last_heard = now;
  if (from.boot != 0) senders_[place].address = from;  // it may have moved
}

std::uint32_t RowOwners::find_host(const SourceAddress& from) const noexcept {
  const auto found = std::find_if(hosts_.begin(), hosts_.end(), [&](const Host& host) {
    return host.senders > 0 && host.address == from.octets;
  });
  return found == hosts_.end() ? kNone : static_cast<std::uint32_t>(found - hosts_.begin());
}

// The host, or a new place for it.
std::uint32_t RowOwners::host_of(const SourceAddress& from) noexcept {
  const std::uint32_t known = find_host(from);
  if (known != kNone) return known;
  auto place = std::find_if(hosts_.begin(), hosts_.end(),
                            [](const Host& host) { return host.senders == 0; });
  if (place == hosts_.end()) {
    if (hosts_.size() == kHosts) return kNone;
    place = hosts_.emplace(hosts_.end());  // within the capacity of construction
  }
  *place = {from.octets};
  return static_cast<std::uint32_t>(place - hosts_.begin());
}

std::uint32_t RowOwners::find_or_add(const SourceAddress& from,
                                     std::chrono::nanoseconds now) noexcept {
  const std::uint32_t known = find(from);
  if (known != kNone) return known;
  std::uint64_t key = key_of(from);
  const std::uint64_t last = key + kProbes;
  while (key != last && index_.find(key) != kNone) ++key;
  const std::uint32_t host = host_of(from);
  if (key == last || host == kNone || hosts_[host].senders >= kSenders / 2) return kNone;
  const std::uint32_t place = free_place();
  if (place == kNone) return kNone;
  ++hosts_[host].senders;
  senders_[place] = {from, now, key, host, 0};
  index_.put(key, place);
  return place;
}

std::uint32_t RowOwners::free_place() noexcept {
  if (!free_.empty()) {
    const std::uint32_t place = free_.back();
    free_.pop_back();
    return place;
  }
  if (senders_.size() == kSenders) return kNone;
  senders_.emplace_back();  // within the capacity of construction
  return static_cast<std::uint32_t>(senders_.size() - 1);
}

void RowOwners::give(std::uint32_t sender, bool guest) noexcept {
  ++senders_[sender].rows;
  Host& host = hosts_[senders_[sender].host];
  ++host.rows;
  if (guest) ++host.guests, ++guests_;
}

// Removes a sender without rows.
void RowOwners::take(const Row& row) noexcept {
  Sender& sender = senders_[row.sender];
  Host& host = hosts_[sender.host];
  --host.rows;
  if (row.guest) --host.guests, --guests_;
  if (--sender.rows > 0) return;
  --host.senders;
  index_.erase(sender.key);
  free_.push_back(row.sender);
}

bool RowOwners::push(const SourceAddress& from, bool guest, std::chrono::nanoseconds now) noexcept {
  const std::uint32_t sender = find_or_add(from, now);
  if (sender == kNone) return false;
  give(sender, guest);
  rows_.push({static_cast<std::uint16_t>(sender), guest});
  return true;
}

void RowOwners::erase(std::size_t place) noexcept {
  take(rows_[place]);
  rows_.erase(place);
}

bool RowOwners::hand_over(std::size_t place, const SourceAddress& to,
                          std::chrono::nanoseconds now) noexcept {
  const std::uint32_t sender = find_or_add(to, now);
  if (sender == kNone) return false;
  give(sender, rows_[place].guest);  // first, so that it is not removed in between
  take(rows_[place]);
  rows_[place].sender = static_cast<std::uint16_t>(sender);
  return true;
}

// The host that has to give up rows.
std::uint32_t RowOwners::crowded_host(bool guest) const noexcept {
  const auto most = [&](auto count) {
    return std::max_element(hosts_.begin(), hosts_.end(),
                            [&](const Host& a, const Host& b) { return a.*count < b.*count; });
  };
  const auto place = [&](auto host) { return static_cast<std::uint32_t>(host - hosts_.begin()); };
  const std::size_t half = rows_.capacity() / 2;
  const auto most_guests = most(&Host::guests);
  if (most_guests->guests > (guest ? half : 0)) return place(most_guests);
  const auto most_rows = most(&Host::rows);
  return !guest && most_rows->rows > half ? place(most_rows) : kNone;
}

std::optional<std::size_t> RowOwners::row_to_give_up(const SourceAddress& to, bool guest) noexcept {
  if (hosts_.empty()) return {};
  const std::uint32_t own = find_host(to);
  const bool has_half = own != kNone && hosts_[own].rows >= rows_.capacity() / 2;
  const std::uint32_t crowded = crowded_host(guest);
  if (crowded == kNone || rows_.size() == 0) return {};
  const bool guests_alone = hosts_[crowded].guests > 0;
  if (has_half && (guest || !guests_alone)) return {};
  return next_of(crowded, guests_alone);
}

std::optional<std::size_t> RowOwners::guest_to_give_up(const SourceAddress& to) noexcept {
  if (guests_ == 0) return {};
  const auto most =
      std::max_element(hosts_.begin(), hosts_.end(),
                       [](const Host& a, const Host& b) { return a.guests < b.guests; });
  const std::uint32_t own = find_host(to);
  if (own != kNone && most->guests <= hosts_[own].guests + 1) return {};
  return next_of(static_cast<std::uint32_t>(most - hosts_.begin()), true);
}

// Continues at the end of the last search.
std::optional<std::size_t> RowOwners::next_of(std::uint32_t host, bool guests_alone) noexcept {
  for (std::size_t i = std::min(kLooks, rows_.size()); i > 0; --i) {
    cursor_ = cursor_ + 1 < rows_.size() ? cursor_ + 1 : 0;
    const Row& row = rows_[cursor_];
    if (senders_[row.sender].host == host && (row.guest || !guests_alone)) return cursor_;
  }
  return {};
}

}  // namespace reckon::peer
