// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/capture/ip_reassembler.hpp"

#include <algorithm>
#include <cstring>
#include <functional>
#include <iterator>
#include <string_view>
#include <utility>

#include "reckon/peer/capture/internet_checksum.hpp"

namespace reckon::peer {
namespace {

constexpr std::size_t kMaxPacket = 65535;
constexpr std::size_t kFragmentHeader = 8;  // of IPv6
constexpr std::size_t kIpv6Header = 40;

/// Limit of gaps of a datagram; with more it is given up. An MTU of 1280 makes at most 51
/// fragments.
constexpr std::size_t kMaxRanges = 256;

/// Limit of fragments per datagram whose copies are detected.
constexpr std::size_t kMaxPieces = 64;

/// Age limit of copies after a complete datagram. Some senders use one identifier for all
/// datagrams.
constexpr std::chrono::nanoseconds kCopyAge = std::chrono::milliseconds(100);

/// Limit of finished datagrams that are kept. It is no option, as they only distinguish copies and
/// late fragments from new datagrams.
constexpr std::size_t kMaxFinished = 4096;

void put_u16(std::byte* at, std::size_t value) {
  at[0] = static_cast<std::byte>(value >> 8);
  at[1] = static_cast<std::byte>(value);
}

std::size_t hash_of(std::span<const std::byte> octets) {
  return std::hash<std::string_view>()(
      {reinterpret_cast<const char*>(octets.data()), octets.size()});
}

IpEndpoint without_port(IpEndpoint endpoint) {
  endpoint.port = 0;
  return endpoint;
}

/// Whether its length and offset are valid for a fragment.
bool is_sound(const IpFragment& fragment) {
  const bool fills_words = !fragment.has_more || fragment.size % 8 == 0;
  return fragment.size > 0 && fills_words && fragment.offset + fragment.size <= kMaxPacket;
}

/// The part of a datagram in a frame.
struct CarriedPart {
  bool is_whole{true};
  std::size_t offset{0};
  bool has_more{false};
};

/// Sets the lengths and the fragment field of the headers in `frame`. False if the packet is too
/// long.
bool set_headers(std::vector<std::byte>& frame, const IpFragment& head, bool is_v6,
                 const CarriedPart& carried) {
  std::byte* const ip = frame.data() + head.ip_at;
  const std::size_t packet = frame.size() - head.ip_at;
  if (is_v6) {
    if (packet - kIpv6Header > kMaxPacket) return false;
    put_u16(ip + 4, packet - kIpv6Header);
    if (carried.is_whole)
      frame[head.next_at] = head.next;
    else
      put_u16(frame.data() + head.octets_at - kFragmentHeader + 2,
              carried.offset | (carried.has_more ? 1U : 0U));
    return true;
  }
  if (packet > kMaxPacket) return false;
  put_u16(ip + 2, packet);
  put_u16(ip + 6, carried.offset / 8 | (carried.has_more ? 0x2000U : 0U));
  put_u16(ip + 10, 0);
  const std::uint16_t sum = folded(word_sum({ip, head.octets_at - head.ip_at}));
  std::memcpy(ip + 10, &sum, 2);
  return true;
}

}  // namespace

FragmentFate IpReassembler::take(LinkLayer layer, const IpFragment& fragment,
                                 SourceDatagram& datagram) {
  if (!is_sound(fragment)) return FragmentFate::malformed;
  advance(datagram.time);
  const Key key{without_port(datagram.source), without_port(datagram.group), fragment.id};
  if (fragment.octets.empty() || belongs_to_finished(key, fragment, datagram.time)) {
    ++counts_.frames;
    return FragmentFate::held;
  }
  const auto known = by_key_.find(key);
  const Place place = known != by_key_.end() ? known->second : start(key, datagram);
  const std::size_t before = place->octets.capacity();
  const Added added = add(*place, fragment);
  octets_ += place->octets.capacity() - before;
  if (added == Added::overlapping) {
    ++counts_.frames;
    ++counts_.overlapping;
    remember({key, datagram.time, std::move(place->ranges), {}});
    release(place);
    incomplete_.erase(place);
    datagram.portion = Portion::overlapping_fragment;
    datagram.source.port = datagram.group.port = 0;
    datagram.bytes = fragment.octets;
    return FragmentFate::overlapping;
  }
  if (added == Added::duplicate) ++counts_.duplicate;
  keep_head(*place, layer, fragment, datagram);
  const bool is_complete = place->end && place->ranges.size() == 1 && place->ranges[0].begin == 0 &&
                           place->ranges[0].end == *place->end;
  if (is_complete) return complete(place, datagram);
  ++counts_.frames;
  if (place->ranges.size() > kMaxRanges) give_up(place);
  bound();
  return FragmentFate::held;
}

bool IpReassembler::take_lost(SourceDatagram& out) {
  if (lost_.empty()) return false;
  const Incomplete lost = std::move(lost_.front());
  lost_.pop_front();
  out = {};
  const bool is_built = build_part(lost);
  const bool is_udp =
      is_built && parse_frame(lost.layer, frame_, frame_.size(), out).content == FrameContent::udp;
  if (!is_udp) {
    out.portion = Portion::later_fragment;
    out.bytes = std::span(frame_).subspan(lost.head.size());
    out.source = std::get<0>(lost.key);
    out.group = std::get<1>(lost.key);
  }
  out.frame = lost.first.frame;
  out.time = lost.first.time;
  out.link_type = lost.first.link_type;
  out.captured = frame_;
  out.captured_on_wire = frame_.size();
  return true;
}

void IpReassembler::give_up_all() {
  while (!incomplete_.empty()) give_up(incomplete_.begin());
}

void IpReassembler::advance(std::chrono::nanoseconds now) {
  while (!incomplete_.empty() && now - incomplete_.front().first.time > limits_.age)
    give_up(incomplete_.begin());
  while (!finished_.empty() && now - finished_.front().time > limits_.age) {
    finished_by_key_.erase(finished_.front().key);
    finished_.pop_front();
  }
}

void IpReassembler::bound() {
  while (octets_ > limits_.octets || incomplete_.size() > limits_.datagrams)
    give_up(incomplete_.begin());
}

// Whether it is a copy of a fragment of a completed datagram, or fills a gap of a datagram given
// up. Any other fragment with this key begins a new datagram.
bool IpReassembler::belongs_to_finished(const Key& key, const IpFragment& fragment,
                                        std::chrono::nanoseconds time) {
  const auto found = finished_by_key_.find(key);
  if (found == finished_by_key_.end()) return false;
  const Finished& finished = *found->second;
  const std::size_t end = fragment.offset + fragment.octets.size();
  if (finished.ranges.empty()) {
    // A datagram in progress with this key is newer.
    if (by_key_.contains(key) || time - finished.time > kCopyAge) return false;
    const auto is_copied = [&](const Piece& piece) {
      return piece.range.begin == fragment.offset && piece.range.end == end &&
             piece.hash == hash_of(fragment.octets);
    };
    const bool is_copy = std::any_of(finished.pieces.begin(), finished.pieces.end(), is_copied);
    if (is_copy) ++counts_.duplicate;
    return is_copy;
  }
  const auto overlaps = [&](const Range& range) {
    return fragment.offset < range.end && end > range.begin;
  };
  if (std::none_of(finished.ranges.begin(), finished.ranges.end(), overlaps)) {
    ++counts_.late;
    return true;
  }
  finished_.erase(found->second);
  finished_by_key_.erase(found);
  return false;
}

IpReassembler::Place IpReassembler::start(const Key& key, const SourceDatagram& datagram) {
  incomplete_.push_back({});
  const Place place = std::prev(incomplete_.end());
  place->key = key;
  place->first.frame = datagram.frame;
  place->first.time = datagram.time;
  by_key_.emplace(key, place);
  return place;
}

IpReassembler::Added IpReassembler::add(Incomplete& to, const IpFragment& fragment) {
  const std::size_t wire_end = fragment.offset + fragment.size;
  const bool is_past_end =
      to.end && (fragment.has_more ? wire_end >= *to.end : wire_end != *to.end);
  const bool is_before_data =
      !fragment.has_more && !to.ranges.empty() && to.ranges.back().end > wire_end;
  if (is_past_end || is_before_data) return Added::overlapping;

  const Range range{static_cast<std::uint32_t>(fragment.offset),
                    static_cast<std::uint32_t>(fragment.offset + fragment.octets.size())};
  // The first range that does not end before this one.
  auto next = std::lower_bound(to.ranges.begin(), to.ranges.end(), range.begin,
                               [](const Range& r, std::uint32_t at) { return r.end < at; });
  const auto hit = next != to.ranges.end() && next->end == range.begin ? std::next(next) : next;
  if (hit != to.ranges.end() && hit->begin < range.end) {
    const bool is_copy =
        hit->begin <= range.begin && hit->end >= range.end &&
        std::equal(fragment.octets.begin(), fragment.octets.end(),
                   to.octets.begin() + static_cast<std::ptrdiff_t>(fragment.offset));
    return is_copy ? Added::duplicate : Added::overlapping;
  }
  if (to.pieces.size() < kMaxPieces) to.pieces.push_back({range, hash_of(fragment.octets)});
  if (!fragment.has_more) to.end = wire_end;
  if (to.octets.size() < range.end) to.octets.resize(range.end);
  std::copy(fragment.octets.begin(), fragment.octets.end(),
            to.octets.begin() + static_cast<std::ptrdiff_t>(fragment.offset));

  const bool joins_next = hit != to.ranges.end() && hit->begin == range.end;
  if (next != hit) {  // continues the previous range
    next->end = joins_next ? hit->end : range.end;
    if (joins_next) to.ranges.erase(hit);
  } else if (joins_next) {
    hit->begin = range.begin;
  } else {
    to.ranges.insert(hit, range);
  }
  return Added::added;
}

void IpReassembler::keep_head(Incomplete& of, LinkLayer layer, const IpFragment& fragment,
                              const SourceDatagram& frame) {
  const bool is_first = fragment.offset == 0 && of.head_fragment.offset != 0;
  if (!of.head.empty() && !is_first) return;
  octets_ -= of.head.capacity();
  // Outer tunnel headers state the length of one fragment, so the packet begins at its own IP
  // header.
  const std::size_t begin = fragment.is_tunnelled ? fragment.ip_at : 0;
  const auto head = frame.captured.subspan(begin, fragment.octets_at - begin);
  of.head.assign(head.begin(), head.end());
  octets_ += of.head.capacity();
  of.head_fragment = fragment;
  of.head_fragment.octets = {};
  of.head_fragment.ip_at -= begin;
  of.head_fragment.octets_at -= begin;
  of.head_fragment.next_at -= begin;
  of.layer = fragment.is_tunnelled ? LinkLayer::raw_ip : layer;
  of.first.link_type = fragment.is_tunnelled ? kLinkTypeRawIp : frame.link_type;
}

FragmentFate IpReassembler::complete(Place place, SourceDatagram& datagram) {
  remember({place->key, datagram.time, {}, std::move(place->pieces)});
  const bool is_built = build_whole(*place);
  const LinkLayer layer = place->layer;
  SourceDatagram out = place->first;
  release(place);
  incomplete_.erase(place);
  if (!is_built) return FragmentFate::malformed;
  out.frame = datagram.frame;
  out.time = datagram.time;
  out.captured = frame_;
  out.captured_on_wire = frame_.size();
  const FrameContent content = parse_frame(layer, frame_, frame_.size(), out).content;
  if (content == FrameContent::not_udp) return FragmentFate::not_udp;
  if (content == FrameContent::malformed) return FragmentFate::malformed;
  datagram = out;
  ++counts_.frames;
  ++counts_.whole;
  return FragmentFate::whole;
}

void IpReassembler::give_up(Place place) {
  ++counts_.lost;
  remember({place->key, place->first.time + limits_.age, place->ranges, {}});
  release(place);
  lost_.splice(lost_.end(), incomplete_, place);
}

void IpReassembler::remember(Finished finished) {
  const auto known = finished_by_key_.find(finished.key);
  if (known != finished_by_key_.end()) {
    finished_.erase(known->second);
    finished_by_key_.erase(known);
  }
  finished_.push_back(std::move(finished));
  finished_by_key_.emplace(finished_.back().key, std::prev(finished_.end()));
  if (finished_.size() <= kMaxFinished) return;
  finished_by_key_.erase(finished_.front().key);
  finished_.pop_front();
}

// Removes it from the counts and the index, before it is moved or erased.
void IpReassembler::release(Place place) {
  octets_ -= place->octets.capacity() + place->head.capacity();
  by_key_.erase(place->key);
}

// Fills frame_ with the equivalent unfragmented frame.
bool IpReassembler::build_whole(const Incomplete& from) {
  const bool is_v6 = std::get<0>(from.key).is_v6;
  frame_ = from.head;
  if (is_v6) frame_.resize(frame_.size() - kFragmentHeader);
  frame_.insert(frame_.end(), from.octets.begin(),
                from.octets.begin() + static_cast<std::ptrdiff_t>(*from.end));
  return set_headers(frame_, from.head_fragment, is_v6, {});
}

// Fills frame_ with a fragment of the octets up to the first gap.
bool IpReassembler::build_part(const Incomplete& from) {
  const Range range = from.ranges.front();
  const bool has_more = !from.end || range.end < *from.end;
  std::size_t size = range.end - range.begin;
  if (has_more && size > 8) size -= size % 8;
  frame_ = from.head;
  const auto begin = from.octets.begin() + range.begin;
  frame_.insert(frame_.end(), begin, begin + static_cast<std::ptrdiff_t>(size));
  return set_headers(frame_, from.head_fragment, std::get<0>(from.key).is_v6,
                     {false, range.begin, has_more});
}

}  // namespace reckon::peer
