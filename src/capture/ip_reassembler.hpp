// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Puts IP fragments of captured frames together. Private to the peer library.
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

/// What became of a fragment.
enum class FragmentFate : std::uint8_t {
  held,         ///< nothing to return yet, or nothing new
  whole,        ///< its datagram is complete
  overlapping,  ///< its datagram is refused
  not_udp,      ///< its packet is complete and carries no UDP
  malformed     ///< it, or its completed packet, is broken
};

/// Bounds of an IpReassembler.
struct ReassemblyLimits {
  /// A datagram is given up this long after its first fragment, by the times of the frames. IPv4
  /// identifiers repeat after 65,536 datagrams: a longer time would mix fragments of different
  /// datagrams of a fast sender.
  std::chrono::nanoseconds age{std::chrono::seconds(5)};
  std::size_t octets{std::size_t{16} << 20};  ///< held; beyond them the oldest datagram is given up
  std::size_t datagrams{4096};                ///< incomplete ones; beyond them likewise
};

/// Holds incomplete datagrams. Fragments come in any order; copies of them do no harm, also those
/// that come up to 0.1 s after their datagram was completed. A datagram whose fragments contradict
/// each other or overlap is refused as a whole (RFC 8200 4.5, here for IPv4 too).
/// Memory is bounded by the limits. One thread.
class IpReassembler {
 public:
  explicit IpReassembler(const ReassemblyLimits& limits = {}) : limits_(limits) {}

  /// Takes a fragment of `datagram`, as parse_frame() left it. With `whole` and `overlapping`,
  /// `datagram` is what to return, valid until the next call of take() or take_lost().
  FragmentFate take(LinkLayer layer, const IpFragment& fragment, SourceDatagram& datagram);
  /// Gives up what is too old at the time of a frame. take() does it too.
  void advance(std::chrono::nanoseconds now);
  /// The oldest datagram that was given up and not yet returned: its octets up to the first gap.
  /// False if there is none. Call it until then before the next take().
  bool take_lost(SourceDatagram& out);
  [[nodiscard]] bool has_lost() const noexcept { return !lost_.empty(); }
  /// Gives up what is incomplete: nothing more will come.
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
  /// A fragment, to know its copies by.
  struct Piece {
    Range range;
    std::size_t hash;  ///< of its octets
  };
  /// An incomplete datagram.
  struct Incomplete {
    Key key;
    SourceDatagram first;         ///< frame and time of the first fragment to come
    LinkLayer layer{};            ///< of the frame that gave `head`, as is first's link type
    IpFragment head_fragment;     ///< the fragment of that frame: at offset 0 if it has come
    std::vector<std::byte> head;  ///< octets of that frame before its fragment's own
    std::vector<std::byte> octets;
    std::vector<Range> ranges;  ///< ascending, with gaps between them
    std::vector<Piece> pieces;  ///< the fragments, as many as are remembered
    std::optional<std::size_t> end;
  };
  /// A datagram of which fragments may still come.
  struct Finished {
    Key key;
    std::chrono::nanoseconds time{};
    std::vector<Range> ranges;  ///< of one that was given up; empty if it was completed
    std::vector<Piece> pieces;  ///< of one that was completed
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
  FragmentCounts counts_;             ///< without those that are incomplete
  std::list<Incomplete> incomplete_;  ///< the oldest first
  std::list<Incomplete> lost_;        ///< given up, not yet returned
  std::list<Finished> finished_;      ///< the oldest first
  std::map<Key, Place> by_key_;
  std::map<Key, std::list<Finished>::iterator> finished_by_key_;
  std::size_t octets_{0};
  std::vector<std::byte> frame_;  ///< the one returned
};

}  // namespace reckon::peer
