// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Reassembles IP fragments of captured frames. Private to the peer library.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <list>
#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include "reckon/peer/capture/datagram_source.hpp"
#include "reckon/peer/capture/frame_parser.hpp"

namespace reckon::peer {

/// Result for a fragment.
enum class FragmentFate : std::uint8_t {
  held,         ///< nothing to return yet, or nothing new
  whole,        ///< its datagram is complete
  overlapping,  ///< its datagram is refused
  not_udp,      ///< its packet is complete and contains no UDP
  malformed     ///< it, or its completed packet, is broken
};

/// Limits of an IpReassembler.
struct ReassemblyLimits {
  /// A datagram is given up this long after its first fragment, by the times of the frames. IPv4
  /// identifiers repeat after 65,536 datagrams: a longer time would mix fragments of different
  /// datagrams of a fast sender.
  std::chrono::nanoseconds age{std::chrono::seconds(5)};
  std::size_t octets{std::size_t{16} << 20};  ///< held; above it the oldest datagram is given up
  std::size_t datagrams{4096};                ///< incomplete ones; above it the oldest is given up
};

/// Holds incomplete datagrams. Fragments may arrive in any order; copies of them are harmless, also
/// up to 0.1 s after their datagram was completed. A datagram with contradicting or overlapping
/// fragments is refused as a whole (RFC 8200 4.5, here for IPv4 too). Memory is bounded by the
/// limits. One thread.
class IpReassembler {
 public:
  explicit IpReassembler(const ReassemblyLimits& limits = {}) : limits_(limits) {}

  /// Takes a fragment of `datagram`, as filled by parse_frame(). For `whole` and `overlapping`,
  /// `datagram` becomes the datagram to return, valid until the next call of take() or take_lost().
  FragmentFate take(LinkLayer layer, const IpFragment& fragment, SourceDatagram& datagram);
  /// Gives up datagrams that are too old at the time of a frame. take() does it too.
  void advance(std::chrono::nanoseconds now);
  /// The oldest datagram that was given up and not yet returned: its octets up to the first gap.
  /// False if there is none. Call it until then before the next take().
  bool take_lost(SourceDatagram& out);
  [[nodiscard]] bool has_lost() const noexcept { return !lost_.empty(); }
  /// Gives up all incomplete datagrams, when no more fragments can arrive.
  void give_up_all();

  [[nodiscard]] FragmentCounts counts() const noexcept {
    FragmentCounts out = counts_;
    out.waiting = incomplete_.size();
    return out;
  }
  /// Octets held for incomplete datagrams.
  [[nodiscard]] std::size_t octets() const noexcept { return octets_; }

 private:
  /// Source and destination without ports, and the identifier.
  using Key = std::tuple<IpEndpoint, GroupAddress, std::uint32_t>;
  /// Octets of a datagram that are present.
  struct Range {
    std::uint32_t begin, end;
  };
  /// A fragment, to detect its copies.
  struct Piece {
    Range range;
    std::size_t hash;  ///< of its octets
  };
  /// An incomplete datagram.
  struct Incomplete {
    Key key;
    SourceDatagram first;         ///< frame and time of the first fragment that arrived
    LinkLayer layer{};            ///< of the frame that gave `head`, as first.link_type
    IpFragment head_fragment;     ///< fragment of that frame: the one at offset 0 if it has arrived
    std::vector<std::byte> head;  ///< octets of that frame before the fragment's content
    std::vector<std::byte> octets;
    std::vector<Range> ranges;  ///< ascending, with gaps between them
    std::vector<Piece> pieces;  ///< fragments, up to kMaxPieces
    std::optional<std::size_t> end;
  };
  /// A finished datagram, of which further fragments may arrive.
  struct Finished {
    Key key;
    std::chrono::nanoseconds time{};
    std::vector<Range> ranges;  ///< of a datagram given up; empty if it was completed
    std::vector<Piece> pieces;  ///< of a completed datagram
  };
  using Place = std::list<Incomplete>::iterator;
  enum class Added : std::uint8_t { added, duplicate, overlapping };

  void bound();
  bool belongs_to_finished(const Key& key, const IpFragment& fragment,
                           std::chrono::nanoseconds time);
  Place start(const Key& key, const SourceDatagram& datagram);
  Added add(Incomplete& to, const IpFragment& fragment);
  void keep_head(Incomplete& of, LinkLayer layer, const IpFragment& fragment,
                 const SourceDatagram& frame);
  FragmentFate complete(Place place, SourceDatagram& datagram);
  void give_up(Place place);
  void remember(Finished finished);
  void release(Place place);
  bool build_whole(const Incomplete& from);
  bool build_part(const Incomplete& from);

  ReassemblyLimits limits_;
  FragmentCounts counts_;             ///< without the incomplete ones
  std::list<Incomplete> incomplete_;  ///< the oldest first
  std::list<Incomplete> lost_;        ///< given up, not yet returned
  std::list<Finished> finished_;      ///< the oldest first
  std::map<Key, Place> by_key_;
  std::map<Key, std::list<Finished>::iterator> finished_by_key_;
  std::size_t octets_{0};
  std::vector<std::byte> frame_;  ///< octets of the returned frame
};

}  // namespace reckon::peer
