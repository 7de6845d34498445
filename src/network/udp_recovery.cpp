// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// How a UdpMulticast lives on when its interface goes, comes back, or is another one by that name.
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <exception>
#include <system_error>
#include <utility>

#include "reckon/peer/network/udp_multicast_state.hpp"

namespace reckon::peer {
namespace {

using std::chrono::nanoseconds;

// So often the host is looked at while something is amiss, or where the kernel tells nothing.
constexpr nanoseconds kLookEvery = std::chrono::milliseconds(500);
// An interface that was chosen by rule may be replaced by another after so long.
constexpr nanoseconds kChooseAnother = std::chrono::seconds(5);
// IPv6 tries for a second or two whether an address is free; a longer refusal is reported.
constexpr nanoseconds kAddressTried = std::chrono::seconds(3);

}  // namespace

// Called while the reading thread has nothing to read. Looking costs some 0.2 ms, and allocates.
void UdpMulticast::State::recover() noexcept {
  const nanoseconds now = clock.now();
  const bool has_news = host_changed || away || hindered;
  try {
    const bool looks_by_itself = away || hindered || !unjoined.empty() || !told_by_kernel;
    if (host_changed || (looks_by_itself && now >= next_look)) {
      host_changed = false;
      next_look = now + kLookEvery;
      look_at_host(now);
      retry_groups();
      if (std::exchange(hindered, false)) {
        tell("interface " + used.name + " can be looked at again");
      }
    }
    if (!away) look_for_echo(now);
    tell_of_offload();
  } catch (const std::exception& failure) {
    next_look = now + kLookEvery;  // no descriptor or no memory for now: looked at again
    if (has_news) tell_hindrance(failure.what());  // else refused groups are reported as such
  }
}

// Sending goes on without it: whoever sends in bulk should know what it costs.
void UdpMulticast::State::tell_of_offload() {
  const int why = segment_refusal.load(std::memory_order_relaxed);
  if (why == 0 || segment_told) return;
  segment_told = true;
  tell("the kernel does not cut runs of datagrams on " + used.name + " (UDP_SEGMENT: " +
       std::generic_category().message(why) + "); each is sent by itself from now on");
}

// Once, until a look has gone through. Without an allocation: memory may be what is missing.
void UdpMulticast::State::tell_hindrance(const char* what) noexcept {
  if (std::exchange(hindered, true)) return;
  std::array<char, sizeof(LinkEvent::text)> text{};
  std::snprintf(
      text.data(), text.size(),
      "interface %s cannot be looked at: %s; tried again every 0.5 s. For open files raise "
      "ulimit -n",
      used.name.c_str(), what);
  tell(text.data());
}

void UdpMulticast::State::look_at_host(nanoseconds now) {
  const std::vector<NetworkInterface> all = list_interfaces();
  InterfaceStanding standing = find_again(all, options.interface, used, options.ipv6);
  if (standing.interface) return follow(*standing.interface);
  if (!away) lose(standing, now);
  if (!options.interface.empty() || now - away_since < kChooseAnother) return;
  const auto usable = [&](const NetworkInterface& candidate) {
    return rate(candidate, options.ipv6).usable && (!candidate.loopback || used.loopback);
  };
  if (std::any_of(all.begin(), all.end(), usable)) {
    follow(choose_interface(all, {}, options.ipv6).interface);
  }
}

void UdpMulticast::State::lose(const InterfaceStanding& standing, nanoseconds now) {
  away = true;
  away_since = now;
  counts.interface_losses.add();
  tell("interface " + used.name + ' ' + std::string(standing.why_not) +
       ": nothing is sent or heard until that is mended; see ip link and ip addr");
}

// The interface carries us: as before, or under another index or address.
void UdpMulticast::State::follow(const NetworkInterface& found) {
  const IpEndpoint address = found.address(options.ipv6).value();
  IpEndpoint before = local;
  before.port = 0;
  const bool is_other = found.index != used.index || address != before;
  if (!away && !is_other) {
    used = found;
    return;
  }
  const std::string name = used.name;
  used = found;
  socket_options.interface_index = found.index;
  interface_index.store(found.index, std::memory_order_relaxed);
  const std::uint16_t port = local.port;
  if (const std::error_code error = reopen_sender(address)) {
    if (!away) away_since = clock.now();
    away = true;  // as while IPv6 still tries whether the address is free
    if (clock.now() - away_since < kAddressTried) return;
    throw std::system_error(error, "no socket on " + address.address_text());
  }
  away = false;
  rejoin();
  std::string sentence =
      "interface " + used.name + (name == used.name ? "" : " in place of " + name);
  sentence += is_other ? ", now index " + std::to_string(used.index) + " with " +
                             local.address_text() + ", carries us again"
                       : " carries us again";
  if (local.port != port) {
    sentence += "; port " + std::to_string(port) + " is taken, ours is " +
                std::to_string(local.port) + " now";
  }
  tell(sentence + "; " + groups_text());
}

// The new socket takes the number of the old one, so that the writing thread never sees none. One
// that is bound to the same address only learns the new index.
std::error_code UdpMulticast::State::reopen_sender(const IpEndpoint& address) {
  IpEndpoint bound = address;
  bound.port = local.port;
  if (bound == local && !is_link_local(bound)) {
    return set_outgoing_interface(slots[0].socket, socket_options);
  }
  std::error_code error;
  asio::ip::udp::socket socket = open_sender(context, socket_options, bound, error);
  if (error == std::errc::address_in_use) {
    bound.port = 0;
    socket = open_sender(context, socket_options, bound, error);
  }
  if (error) return error;
  if (dup2(socket.native_handle(), slots[0].socket.native_handle()) < 0 || !watch(0)) {
    return {errno, std::generic_category()};
  }
  slots[0].drops_seen = 0;
  if (options.offload) segment_refusal = segment_error(slots[0].socket);
  segment_told = segment_refusal != 0;
  take_local_endpoint();
  return {};
}

// A membership belongs to an interface, not to its name: all are made anew.
void UdpMulticast::State::rejoin() {
  counts.recoveries.add();
  for (std::size_t i = 1; i < slots.size(); ++i) {
    if (!slots[i].socket.is_open()) continue;
    close(slots[i]);
    unjoined.push_back(slots[i].group);
  }
  event_count = next_event = 0;
  retry_groups();
  echo.restart();
}

void UdpMulticast::State::retry_groups() {
  if (away) return;
  std::erase_if(unjoined, [this](const GroupAddress& group) { return !open(group); });
}

std::string UdpMulticast::State::groups_text() const {
  const auto joined = std::count_if(slots.begin() + 1, slots.end(),
                                    [](const Slot& slot) { return slot.socket.is_open(); });
  std::string text = std::to_string(joined) + " groups joined again";
  if (!unjoined.empty()) text += ", " + std::to_string(unjoined.size()) + " not yet";
  return text;
}

void UdpMulticast::State::look_for_echo(nanoseconds now) {
  const EchoWatch::Turn turn = echo.look(now);
  if (turn == EchoWatch::Turn::none) return;
  const std::string group = echo.group().text();
  if (turn == EchoWatch::Turn::heard)
    return tell("own datagrams come back from " + group + " again");
  rejoin();
  tell("own datagrams do not come back from " + group + " on " + used.name +
       ", so others are not heard either: does a firewall drop them? nft list ruleset; " +
       groups_text() + "; without multicast: reckon peer --to ADDRESSES");
}

void UdpMulticast::State::tell(std::string_view sentence) noexcept {
  LinkEvent* event = link_events.claim();
  if (event == nullptr) return;  // whoever asks lags by 32 of them
  event->text = {};
  sentence.copy(event->text.data(), event->text.size() - 1);
  link_events.publish();
}

}  // namespace reckon::peer
