// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/network/udp_recovery.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <exception>
#include <system_error>
#include <utility>
#include <vector>

namespace reckon::peer {
namespace {

using std::chrono::nanoseconds;

// Period of examining the host during a problem, or if the kernel sends no notices.
constexpr nanoseconds kLookEvery = std::chrono::milliseconds(500);
// Time after which an interface chosen by rule may be replaced by another.
constexpr nanoseconds kChooseAnother = std::chrono::seconds(5);
// IPv6 checks for a second or two whether an address is free; a longer refusal is reported.
constexpr nanoseconds kAddressTried = std::chrono::seconds(3);

}  // namespace

UdpRecovery::UdpRecovery(const Surroundings& link, const NetworkInterface& used)
    : link_(link), used_(used), refusal_reported_(link.sender.segment_refusal() != 0) {}

void UdpRecovery::recover() noexcept {
  const nanoseconds now = link_.clock.now();
  const bool has_news = link_.ready.host_changed() || away_ || hindered_;
  try {
    const bool looks_by_itself =
        away_ || hindered_ || link_.sockets.missing() > 0 || !link_.ready.has_host_notices();
    if (link_.ready.host_changed() || (looks_by_itself && now >= next_look_)) {
      link_.ready.clear_host_change();
      next_look_ = now + kLookEvery;
      look_at_host(now);
      join_missing();
      if (std::exchange(hindered_, false)) {
        report("interface " + used_.name + " can be read again");
      }
    }
    if (!away_) look_for_echo(now);
    report_offload();
  } catch (const std::exception& failure) {
    next_look_ = now + kLookEvery;  // no descriptor or no memory for now: tried again
    if (has_news) report_hindrance(failure.what());  // else refused groups are reported as such
  }
}

// Sending continues without it, but the user of a bulk sender should know the cost.
void UdpRecovery::report_offload() {
  const int why = link_.sender.segment_refusal();
  if (why == 0 || refusal_reported_) return;
  refusal_reported_ = true;
  report("the kernel does not segment datagrams on " + used_.name + " (UDP_SEGMENT: " +
         std::generic_category().message(why) + "); each is sent separately from now on");
}

// Once, until the host was examined successfully. Without an allocation, because memory may be
// short.
void UdpRecovery::report_hindrance(const char* what) noexcept {
  if (std::exchange(hindered_, true)) return;
  std::array<char, sizeof(LinkEvent::text)> text{};
  std::snprintf(text.data(), text.size(),
                "cannot read the state of interface %s: %s; retries every 0.5 s. For open files "
                "raise ulimit -n",
                used_.name.c_str(), what);
  report(text.data());
}

void UdpRecovery::look_at_host(nanoseconds now) {
  const std::vector<NetworkInterface> all = list_interfaces();
  InterfaceStanding standing = find_again(all, link_.options.interface, used_, link_.options.ipv6);
  if (standing.interface) return follow(*standing.interface);
  if (!away_) lose(standing, now);
  if (!link_.options.interface.empty() || now - away_since_ < kChooseAnother) return;
  const auto usable = [&](const NetworkInterface& candidate) {
    return rate(candidate, link_.options.ipv6).usable && (!candidate.loopback || used_.loopback);
  };
  if (std::any_of(all.begin(), all.end(), usable)) {
    follow(choose_interface(all, {}, link_.options.ipv6).interface);
  }
}

void UdpRecovery::lose(const InterfaceStanding& standing, nanoseconds now) {
  away_ = true;
  away_since_ = now;
  link_.counts.interface_losses.add();
  report("interface " + used_.name + ' ' + std::string(standing.why_not) +
         ": nothing is sent or received until this is fixed; see ip link and ip addr");
}

// The interface can be used: as before, or with another index or address.
void UdpRecovery::follow(const NetworkInterface& found) {
  const IpEndpoint address = found.address(link_.options.ipv6).value();
  IpEndpoint before = link_.local.value();
  before.port = 0;
  const bool is_other = found.index != used_.index || address != before;
  if (!away_ && !is_other) {
    used_ = found;
    return;
  }
  const std::string name = used_.name;
  used_ = found;
  link_.sockets.set_interface(found);
  link_.sender.set_interface(found.index);
  const std::uint16_t port = link_.local.value().port;
  if (const std::error_code error = reopen_sender(address)) {
    if (!away_) away_since_ = link_.clock.now();
    away_ = true;  // for example while IPv6 still checks whether the address is free
    if (link_.clock.now() - away_since_ < kAddressTried) return;
    throw std::system_error(error, "no socket on " + address.address_text());
  }
  away_ = false;
  link_.sockets.rejoin();
  std::string sentence =
      "interface " + used_.name + (name == used_.name ? "" : " in place of " + name);
  sentence += is_other ? ", now index " + std::to_string(used_.index) + " with " +
                             link_.local.value().address_text() + ", works again"
                       : " works again";
  if (link_.local.value().port != port) {
    sentence += "; port " + std::to_string(port) + " is taken, ours is " +
                std::to_string(link_.local.value().port) + " now";
  }
  report(sentence + "; " + groups_text());
}

// A socket that is bound to the same address only needs the new index.
std::error_code UdpRecovery::reopen_sender(const IpEndpoint& address) {
  IpEndpoint bound = address;
  bound.port = link_.local.value().port;
  if (bound == link_.local.value() && !is_link_local(bound)) {
    return link_.sockets.renew_outgoing_interface();
  }
  if (const std::error_code error = link_.sockets.reopen_unicast(bound)) return error;
  if (link_.options.offload) link_.sender.set_segment_refusal(link_.sockets.segment_error());
  refusal_reported_ = link_.sender.segment_refusal() != 0;
  return {};
}

void UdpRecovery::join_missing() {
  if (!away_) link_.sockets.join_missing();
}

std::string UdpRecovery::groups_text() const {
  std::string text = std::to_string(link_.sockets.joined()) + " groups joined again";
  const std::size_t missing = link_.sockets.missing();
  if (missing > 0) text += ", " + std::to_string(missing) + " not yet";
  return text;
}

void UdpRecovery::look_for_echo(nanoseconds now) {
  const EchoWatch::Turn turn = link_.echo.look(now);
  if (turn == EchoWatch::Turn::none) return;
  const std::string group = link_.echo.group().text();
  if (turn == EchoWatch::Turn::heard)
    return report("own datagrams return from " + group + " again");
  link_.sockets.rejoin();
  report("own datagrams do not return from " + group + " on " + used_.name +
         ", so others are not received either: does a firewall drop them? nft list ruleset; " +
         groups_text() + "; without multicast: reckon peer --to ADDRESSES");
}

void UdpRecovery::report(std::string_view sentence) noexcept {
  LinkEvent* event = events_.claim();
  if (event == nullptr) return;  // the caller lags by 32 events
  event->text = {};
  sentence.copy(event->text.data(), event->text.size() - 1);
  events_.publish();
}

}  // namespace reckon::peer
