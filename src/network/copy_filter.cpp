// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/network/copy_filter.hpp"

#include <algorithm>
#include <functional>
#include <string_view>

namespace reckon::peer {

std::size_t CopyFilter::key_of(const Datagram& datagram) const {
  IpEndpoint sender = datagram.sender;
  sender.port = 0;
  const bool is_own = std::find(own_.begin(), own_.end(), sender) != own_.end();
  sender = is_own ? IpEndpoint() : datagram.sender;
  sender.port = datagram.sender.port;
  const std::string_view octets(reinterpret_cast<const char*>(datagram.bytes.data()),
                                datagram.bytes.size());
  const std::hash<IpEndpoint> hash;
  return std::hash<std::string_view>()(octets) * 31 + hash(sender) * 7 + hash(datagram.group);
}

void CopyFilter::forget(nanoseconds now) {
  while (!ages_.empty() && (now - ages_.front().time > kWindow || ages_.size() >= kMost)) {
    const auto found = taken_.find(ages_.front().key);
    found->second.pop_front();
    if (found->second.empty()) taken_.erase(found);
    ages_.pop_front();
  }
}

bool CopyFilter::is_copy(const Datagram& datagram, unsigned interface) {
  forget(datagram.received);
  const std::uint64_t bit = std::uint64_t{1} << interface % 64;
  const std::size_t key = key_of(datagram);
  std::deque<Taken>& equal = taken_[key];
  for (Taken& one : equal) {
    if ((one.interfaces & bit) != 0) continue;
    one.interfaces |= bit;
    return true;
  }
  equal.push_back({bit});
  ages_.push_back({datagram.received, key});
  return false;
}

}  // namespace reckon::peer
