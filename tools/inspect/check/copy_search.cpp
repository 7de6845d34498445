// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/inspect/check/copy_search.hpp"

#include <algorithm>
#include <functional>
#include <span>
#include <string_view>

namespace reckon::tools {
namespace {

using std::chrono::nanoseconds;

constexpr nanoseconds kWithin = std::chrono::milliseconds(5);

std::uint64_t hash_of(const peer::SourceDatagram& datagram) {
  const auto* octets = reinterpret_cast<const char*>(datagram.bytes.data());
  const std::uint64_t content = std::hash<std::string_view>{}({octets, datagram.bytes.size()});
  const std::hash<peer::IpEndpoint> endpoint;
  constexpr std::uint64_t kOdd = 0x9E3779B97F4A7C15;  // so that the three hashes do not cancel out
  return (content * kOdd + endpoint(datagram.source)) * kOdd + endpoint(datagram.group);
}

}  // namespace

void CopySearch::look_at(const peer::SourceDatagram& datagram) {
  if (datagram.time == nanoseconds::zero()) return;
  const Seen now{hash_of(datagram), datagram.frame, datagram.time};
  const std::span<const Seen> known(seen_.data(), std::min(datagrams_, std::uint64_t{kRemembered}));
  const auto original = std::ranges::find_if(known, [&](const Seen& seen) {
    return seen.hash == now.hash && now.time - seen.time <= kWithin &&
           seen.time - now.time <= kWithin;
  });
  if (original != known.end() && copies_++ == 0)
    first_ = {now.frame, original->frame, now.time, now.time - original->time};
  seen_[datagrams_++ % kRemembered] = now;
}

}  // namespace reckon::tools
