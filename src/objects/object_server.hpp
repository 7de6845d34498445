// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Serves the chunks that others request. All peers that have an object receive the requests, but
// one of them sends at a time; if it stops, another one takes over.
//
// Chunks are sent in rounds by ascending index. What one receiver has lost is sent in the next
// round, together with what a late receiver needs.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "reckon/pdu/reckon/object_messages.hpp"
#include "reckon/peer/objects/chunk_map.hpp"
#include "reckon/peer/objects/object_source.hpp"
#include "reckon/peer/reliable/repair_timer.hpp"

namespace reckon::peer {

/// A chunk to send.
struct DueChunk {
  const ObjectSource* source = nullptr;
  std::uint32_t index = 0;
  std::uint32_t serial = 0;
};

/// A status to send.
struct DueStatus {
  std::uint64_t key = 0;
  std::uint32_t serial = 0;
  std::uint32_t pending = 0;
};

/// Pure: time is passed in. One thread. Allocates 4 octets for each chunk of an object while it is
/// requested.
class ObjectServer {
 public:
  /// Longest wait of a peer before it serves an object that nobody serves.
  static constexpr std::chrono::milliseconds kLongestWait{10};
  /// Silence of a server after which another one serves.
  static constexpr std::chrono::milliseconds kSilent{500};
  /// Period of the status while chunks are sent.
  static constexpr std::chrono::milliseconds kStatusPeriod{100};
  /// Without chunks to send, the pauses between the status double from the first to the last.
  static constexpr std::chrono::milliseconds kFirstPause{5}, kLastPause{320};
  /// Chunks are not sent if nobody has requested any for this time: all receivers have gone.
  static constexpr std::chrono::seconds kUnwanted{1};
  /// A server forgets an object after this time without a request.
  static constexpr std::chrono::seconds kForgets{5};
  /// Longest burst: the octets of this time at the rate, but at least two chunks.
  static constexpr std::chrono::milliseconds kBurst{2};

  /// @param epoch of this peer's records  @param rate [octet/s], above 0
  ObjectServer(std::uint32_t epoch, double rate, std::uint64_t seed);

  /// Serves an object from now on. A second one with the same first 8 octets of its hash is
  /// ignored.
  void add(std::shared_ptr<const ObjectSource> source);
  [[nodiscard]] std::size_t objects() const noexcept { return served_.size(); }

  /// Takes a request of another peer.
  void take_request(const pdu::ObjectRequest& request, std::span<const std::byte> missing,
                    std::chrono::nanoseconds now);
  /// Takes the status of another server. Of two servers that send, the one with the lower epoch
  /// continues. One that only repeats its status may not receive the requests.
  void take_status(std::uint32_t epoch, const DueStatus& status,
                   std::chrono::nanoseconds now) noexcept;
  /// The next chunk that may be sent at `now`. @return false if there is none
  [[nodiscard]] bool take_chunk(std::chrono::nanoseconds now, DueChunk& due);
  /// The next status that is due. @return false if there is none
  [[nodiscard]] bool take_status(std::chrono::nanoseconds now, DueStatus& due) noexcept;
  /// When to call take_chunk() and take_status(); nanoseconds::max(): no object is requested.
  [[nodiscard]] std::chrono::nanoseconds next_step(std::chrono::nanoseconds now) const noexcept;

 private:
  using Nanoseconds = std::chrono::nanoseconds;
  static constexpr Nanoseconds kNever = Nanoseconds::max();

  /// A request that another server may answer.
  struct Waiting {
    pdu::ObjectRequest request;
    std::vector<std::byte> missing;
    Nanoseconds until = kNever;
  };
  struct Served {
    std::shared_ptr<const ObjectSource> source;
    std::uint64_t key = 0;
    bool serves = false;
    ChunkMap pending;
    std::vector<std::uint32_t> serials;  // of the last transmission of each chunk; 0: none
    std::uint32_t cursor = 0;
    Nanoseconds requested{0};
    Nanoseconds status_at = kNever, pause{0};
    Nanoseconds heard = Nanoseconds::min() / 2;  // the last status of another server that sends
    std::uint32_t other = 0, other_serial = 0;   // of the last status
    Waiting waiting;
  };

  void serve(Served& served, const pdu::ObjectRequest& request, std::span<const std::byte> missing,
             Nanoseconds now);
  void stop(Served& served) noexcept;
  void advance(Nanoseconds now);

  std::uint32_t epoch_;
  double rate_;
  RepairTimer timer_;
  std::vector<Served> served_;
  std::uint32_t serial_ = 0;
  std::size_t turn_ = 0;  // place of the object whose chunk is next
  double credit_ = 0;     // [octets]
  Nanoseconds credited_{0};
};

}  // namespace reckon::peer
