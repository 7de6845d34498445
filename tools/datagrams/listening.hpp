// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Reports to the user where a live source listens, which interfaces receive datagrams, and, while
// none arrive, which other DIS traffic this host receives.
#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "reckon/peer/capture/datagram_source.hpp"
#include "reckon/tools/datagrams/source.hpp"

namespace reckon::tools {

/// "239.192.1.0:3000 and 256 groups behind it on lo and eth0" for groups, else the source as it was
/// entered.
[[nodiscard]] std::string listening_text(const SourceChoice& choice,
                                         const peer::SourceReport& report);

/// "received on lo: 391 datagrams, eth0: none; 12 datagrams also arrived on another interface", and
/// what cannot be received, as lines; empty if the source is not groups.
[[nodiscard]] std::string heard_text(const peer::SourceReport& report);

/// Watches a source of groups that may be silent. After kPatience of silence from the start it
/// reports where the source listens and tries kMostPlaces other places of this host: the broadcast
/// addresses and the default groups, on every interface, the groups of other programs of this host,
/// and the source's own group on the interfaces that it leaves out. DIS traffic or sealed datagrams
/// found there are reported once for each place; after kTried without any, its absence is reported.
/// One thread.
class SilenceWatch {
 public:
  using nanoseconds = std::chrono::nanoseconds;
  static constexpr nanoseconds kPatience = std::chrono::seconds(3);
  static constexpr nanoseconds kTried = std::chrono::seconds(6);  // longer than a heartbeat of DIS
  static constexpr std::size_t kMostPlaces = 32;
  static constexpr std::size_t kMostStated = 4;

  /// @param choice outlives this  @param start steady
  SilenceWatch(const SourceChoice& choice, nanoseconds start) : choice_(choice), start_(start) {}

  /// Sentences for the user, mostly none. Cheap once a datagram was received. Call it several times
  /// a second.  @param now of the same clock as the start
  [[nodiscard]] std::vector<std::string> look(const peer::SourceReport& report, nanoseconds now);

 private:
  void begin(const peer::SourceReport& report, std::vector<std::string>& out);
  void listen(std::vector<std::string>& out);
  [[nodiscard]] std::string remedy_for(const peer::SourceDatagram& datagram) const;

  const SourceChoice& choice_;
  nanoseconds start_;
  bool over_ = false;  // a datagram was received, or all is reported
  bool begun_ = false;
  std::unique_ptr<peer::DatagramSource> elsewhere_;
  std::vector<peer::IpEndpoint> own_;              // of the source
  std::vector<peer::IpEndpoint> places_, stated_;  // tried places, and the ones with DIS traffic
};

/// Places that SilenceWatch tries: at most `most`, without duplicates.
/// @param own of the source
/// @param own_too the source leaves interfaces out, so its first place is tried on all
/// @param bound endpoints of this host's programs
[[nodiscard]] std::vector<peer::IpEndpoint> other_places(const std::vector<peer::IpEndpoint>& own,
                                                         bool own_too,
                                                         const std::vector<peer::IpEndpoint>& bound,
                                                         std::size_t most);

}  // namespace reckon::tools
