// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Sources of datagrams for the inspector, with a common interface: a capture file, one raw file,
// stdin, an interface or live groups.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/peer/network/link.hpp"

namespace reckon::peer {

/// Available part of a UDP datagram.
enum class Portion : std::uint8_t {
  whole,
  first_fragment,  ///< IP fragments with the UDP header: bytes are its beginning
  later_fragment,  ///< IP fragments without UDP header: ports are 0, bytes are its middle or end
  overlapping_fragment,  ///< IP fragment that contradicts earlier ones: bytes are its own octets
  cut                    ///< the capture kept less of the frame than was on the wire
};

/// True without a UDP header: the octets are not the beginning of a datagram, and the ports are 0.
[[nodiscard]] constexpr bool is_headless(Portion portion) noexcept {
  return portion == Portion::later_fragment || portion == Portion::overlapping_fragment;
}

/// LINKTYPE_RAW of pcap files: a frame begins with its IP header.
inline constexpr std::uint16_t kLinkTypeRawIp = 101;

/// One datagram of a source. `bytes` is valid until the next call of next(). For a reassembled
/// datagram, frame and time come from the fragment that completed it; for an incomplete one, from
/// the first fragment that arrived.
struct SourceDatagram {
  std::uint64_t frame{0};  ///< 1, 2, ... as in other tools; counts skipped frames too
  /// Since 1970-01-01 UTC; 0 for a raw file. In a damaged capture the year is 1901 to 2160.
  std::chrono::nanoseconds time{};
  IpEndpoint source;   ///< unspecified for a raw file
  GroupAddress group;  ///< destination, perhaps no group; unspecified for a raw file
  std::span<const std::byte> bytes;
  Portion portion{Portion::whole};
  std::string_view interface;  ///< live groups: the receiving interface; else empty
  /// The captured frame, beginning with its link layer; empty if the source is no capture. For a
  /// reassembled datagram, an equivalent unfragmented frame.
  std::span<const std::byte> captured;
  std::size_t captured_on_wire{0};          ///< its length before the capture truncated it [octets]
  std::uint16_t link_type{kLinkTypeRawIp};  ///< its LINKTYPE_... of pcap
};

/// Result of next().
enum class SourceEvent : std::uint8_t {
  datagram,
  nothing_yet,  ///< a live source was quiet for the given time
  end           ///< no more will come; report() states whether this was the regular end
};

/// Counts of IP fragments by result.
struct FragmentCounts {
  std::uint64_t frames{0};       ///< frames with a fragment
  std::uint64_t whole{0};        ///< reassembled datagrams
  std::uint64_t lost{0};         ///< datagrams given up because of missing fragments
  std::uint64_t waiting{0};      ///< incomplete datagrams
  std::uint64_t overlapping{0};  ///< datagrams refused because of contradicting fragments
  std::uint64_t late{0};         ///< fragments that arrived after their datagram was given up
  std::uint64_t duplicate{0};    ///< copies of fragments
};

/// An interface of this host on which live groups are received.
struct ListenedInterface {
  std::string name;
  std::uint64_t datagrams{0};  ///< received there first
};

/// Counts and errors of a source.
struct SourceReport {
  std::uint64_t frames{0};     ///< all frames read
  std::uint64_t datagrams{0};  ///< UDP datagrams, whole or not, returned
  FragmentCounts fragments;
  std::uint64_t cut{0};        ///< of the datagrams, truncated by the capture
  std::uint64_t skipped{0};    ///< frames without UDP
  std::uint64_t malformed{0};  ///< skipped frames with broken IP or UDP headers
  std::uint64_t dropped{0};    ///< lost before they reached us (kernel buffer)
  /// Of a compressed capture after reading: the method ("zstd", "gzip", "bzip2", "xz", "lz4"),
  /// octets of the file and of its content, whole zstd frames.
  std::string_view compression;
  std::uint64_t compressed_octets{0}, compressed_content{0}, zstd_frames{0};
  /// Live groups: counts of each interface, copies received over further interfaces and dropped,
  /// and sentences about groups that cannot be received.
  std::vector<ListenedInterface> interfaces;
  std::uint64_t copies{0};
  std::vector<std::string> unheard;
  std::string problem;  ///< a sentence if the source ended early; else empty

  /// Calls visit(name, meaning, value) for each count of a live source; both texts are literals.
  void for_each(auto&& visit) const {
    visit("frames_in", "frames read", frames);
    visit("datagrams_in", "datagrams read, whole or not", datagrams);
    visit("datagrams_cut", "of these, datagrams that were captured in part", cut);
    visit("frames_skipped", "frames without UDP", skipped);
    visit("frames_malformed", "of these, frames with broken IP or UDP headers", malformed);
    visit("kernel_drops", "datagrams lost because the receive buffer was full", dropped);
    visit("copies_in", "ignored copies of datagrams that arrived on several interfaces", copies);
    visit("fragments_in", "IP fragments", fragments.frames);
    visit("fragmented_datagrams_in", "datagrams reassembled from fragments", fragments.whole);
    visit("fragmented_datagrams_lost", "datagrams dropped because fragments are missing",
          fragments.lost);
    visit("fragmented_datagrams_refused",
          "datagrams refused because fragments overlap with different octets",
          fragments.overlapping);
  }
};

/// A stream of datagrams. One thread; stop() from any thread or a signal handler.
class DatagramSource {
 public:
  virtual ~DatagramSource() = default;

  /// The next datagram. A live source waits at most `patience`; a file never waits. Damaged input
  /// never throws: it ends the source with a sentence in report().problem.
  [[nodiscard]] virtual SourceEvent next(SourceDatagram& out,
                                         std::chrono::nanoseconds patience) = 0;
  [[nodiscard]] virtual const SourceReport& report() const noexcept = 0;
  /// True if more may arrive at any time (groups, interface).
  [[nodiscard]] virtual bool is_live() const noexcept = 0;
  /// LINKTYPE_... of pcap, of the first captured frames.
  [[nodiscard]] virtual std::uint16_t link_type() const noexcept { return kLinkTypeRawIp; }
  /// The interface that captured the last datagram, if the capture names it; else empty.
  [[nodiscard]] virtual std::string_view interface_name() const noexcept { return {}; }
  /// Makes next() return `end` soon.
  virtual void stop() noexcept = 0;
};

/// A whole file as one datagram of frame 1 (at most 65535 octets; more are cut off and reported).
/// @throws std::system_error with the path if it cannot be read.
[[nodiscard]] std::unique_ptr<DatagramSource> open_raw_file(const std::string& path);

/// Options of open_groups().
struct GroupsOptions {
  std::string interface;             ///< name, address or index; empty: every interface
  std::vector<GroupAddress> groups;  ///< or broadcast or own addresses, see UdpListenerOptions
  bool skips_failures{false};        ///< skips groups and interfaces that fail
};

/// Live groups, received on one interface or on all. A datagram received over several interfaces is
/// returned once.
/// @throws std::system_error or std::runtime_error with the value and the remedy if the interface
/// or a group cannot be used.
[[nodiscard]] std::unique_ptr<DatagramSource> open_groups(const GroupsOptions& options);

/// A source by its text: "raw:FILE", "-" (a pcap or pcapng on stdin), "iface:NAME" (all UDP of an
/// interface, needs CAP_NET_RAW), else a pcap or pcapng file, which may be growing with `follow`.
/// @throws the exceptions of the open functions.
[[nodiscard]] std::unique_ptr<DatagramSource> open_source(std::string_view text,
                                                          bool follow = false);

}  // namespace reckon::peer
