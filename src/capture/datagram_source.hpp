// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Where the inspector gets datagrams from: a capture file, one raw file, stdin, an interface or the
// live groups, all behind one interface.
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

/// How much of a UDP datagram is at hand.
enum class Portion : std::uint8_t {
  whole,
  first_fragment,  ///< IP fragment with the UDP header: bytes are its beginning
  later_fragment,  ///< IP fragment without UDP header: ports are 0, bytes are its middle or end
  cut              ///< the capture kept less of the frame than was on the wire
};

/// One datagram of a source. `bytes` stays valid until the next call of next().
struct SourceDatagram {
  std::uint64_t frame{0};  ///< 1, 2, ... as in other tools; counts skipped frames too
  /// Since 1970-01-01 UTC; 0 for a raw file. A damaged capture's year is 1901 to 2160 at most.
  std::chrono::nanoseconds time{};
  IpEndpoint source;   ///< unspecified for a raw file
  GroupAddress group;  ///< destination, a group or not; unspecified for a raw file
  std::span<const std::byte> bytes;
  Portion portion{Portion::whole};
  /// The frame that a capture holds, from its link layer on; empty where the source is no capture.
  std::span<const std::byte> captured;
  std::size_t captured_on_wire{0};  ///< its length before the capture cut it [octets]
};

/// LINKTYPE_RAW of pcap files: a frame begins with its IP header.
inline constexpr std::uint16_t kLinkTypeRawIp = 101;

/// What next() found.
enum class SourceEvent : std::uint8_t {
  datagram,
  nothing_yet,  ///< a live source was quiet for the time asked
  end           ///< no more will come; report() says whether that was the true end
};

/// What a source met on its way.
struct SourceReport {
  std::uint64_t frames{0};     ///< all frames read
  std::uint64_t datagrams{0};  ///< UDP datagrams (and fragments of such) handed out
  std::uint64_t fragments{0};  ///< of these, IP fragments
  std::uint64_t cut{0};        ///< of these, cut by the capture
  std::uint64_t skipped{0};    ///< frames that hold no UDP
  std::uint64_t malformed{0};  ///< frames with broken IP or UDP headers, skipped
  std::uint64_t dropped{0};    ///< lost before they reached us (kernel buffer)
  /// Of a compressed capture once it has been read: zstd frames that were whole, octets of the file
  /// and of what it holds.
  std::uint64_t zstd_frames{0}, zstd_octets{0}, zstd_content{0};
  std::string problem;  ///< a sentence where the source ended early; else empty
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
  /// True where more may come at any time (groups, interface).
  [[nodiscard]] virtual bool is_live() const noexcept = 0;
  /// How the captured frames begin, as pcap files number it (LINKTYPE_...).
  [[nodiscard]] virtual std::uint16_t link_type() const noexcept { return kLinkTypeRawIp; }
  /// Makes next() give `end` soon.
  virtual void stop() noexcept = 0;
};

/// One file, whole, as one datagram of frame 1 (at most 65535 octets; more is cut and reported).
/// @throws std::system_error with the path where it cannot be read.
[[nodiscard]] std::unique_ptr<DatagramSource> open_raw_file(const std::string& path);

/// What open_groups() listens to.
struct GroupsOptions {
  std::string interface;             ///< name, address or index; empty = chosen by rule
  std::vector<GroupAddress> groups;  ///< at least one, all of one address family
};

/// The live groups through UdpMulticast. @throws std::system_error or std::runtime_error with the
/// value and the remedy where the interface or a group cannot be used.
[[nodiscard]] std::unique_ptr<DatagramSource> open_groups(const GroupsOptions& options);

/// By the user's words: "raw:FILE", "-" (a pcap or pcapng on stdin), "iface:NAME" (all UDP of an
/// interface, needs CAP_NET_RAW), else a pcap or pcapng file, which may be growing where `follow`
/// is set. @throws as the open functions do.
[[nodiscard]] std::unique_ptr<DatagramSource> open_source(std::string_view text,
                                                          bool follow = false);

}  // namespace reckon::peer
