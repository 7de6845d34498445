// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Keeps a UdpMulticast working when its interface disappears, returns, or is replaced under the
// same name. Private to the network.
#pragma once

#include <chrono>
#include <string>
#include <string_view>
#include <system_error>

#include "reckon/haptics/exchange/spsc_ring.hpp"
#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/network/echo_watch.hpp"
#include "reckon/peer/network/interface_choice.hpp"
#include "reckon/peer/network/link_counters.hpp"
#include "reckon/peer/network/local_endpoint.hpp"
#include "reckon/peer/network/udp_multicast.hpp"
#include "reckon/peer/network/udp_readiness.hpp"
#include "reckon/peer/network/udp_sender.hpp"
#include "reckon/peer/network/udp_socket_table.hpp"

namespace reckon::peer {

/// Examines the host's interfaces after a possible change, reopens sockets if needed, and reports
/// that. For the reading thread, except take_event().
class UdpRecovery {
 public:
  using nanoseconds = std::chrono::nanoseconds;

  /// Parts of the link, which outlives this.
  struct Surroundings {
    const UdpMulticastOptions& options;
    const Clock& clock;
    UdpReadiness& ready;
    UdpSocketTable& sockets;
    UdpSender& sender;
    const LocalEndpoint& local;
    EchoWatch& echo;
    LinkCounters& counts;
  };

  UdpRecovery(const Surroundings& link, const NetworkInterface& used);

  /// Call it while the reading thread has nothing to read. Some ns if nothing has changed;
  /// examining the host costs some 0.2 ms, and allocates.
  void recover() noexcept;

  /// Takes the reports since the last call, oldest first; one thread, any.
  bool take_event(LinkEvent& event) noexcept { return events_.pop(event); }

 private:
  void look_at_host(nanoseconds now);
  void follow(const NetworkInterface& found);
  std::error_code reopen_sender(const IpEndpoint& address);
  void join_missing();
  void lose(const InterfaceStanding& standing, nanoseconds now);
  void look_for_echo(nanoseconds now);
  void report(std::string_view sentence) noexcept;
  void report_offload();
  void report_hindrance(const char* what) noexcept;
  [[nodiscard]] std::string groups_text() const;

  Surroundings link_;
  NetworkInterface used_;
  bool away_ = false;              // the interface cannot be used
  bool hindered_ = false;          // the last examination of the host failed, and that is reported
  bool refusal_reported_ = false;  // that the kernel does not cut runs
  nanoseconds away_since_{0};
  nanoseconds next_look_{0};
  haptics::SpscRing<LinkEvent> events_{32};
};

}  // namespace reckon::peer
