// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Receives one object: requests what is missing, and checks each block against the content hash, so
// that the sender need not be trusted.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "reckon/pdu/reckon/object_messages.hpp"
#include "reckon/peer/objects/chunk_map.hpp"
#include "reckon/peer/objects/chunk_store.hpp"
#include "reckon/peer/objects/object_layout.hpp"
#include "reckon/peer/reliable/repair_timer.hpp"

namespace reckon::peer {

/// How far a fetch is.
enum class FetchState : std::uint8_t {
  running,
  complete,    ///< each block has its hash
  unwritable,  ///< the store fails; see ChunkStore::problem()
  forged,      ///< kMostForged parts had another hash: somebody forges chunks
};

/// Sums since the start.
struct FetchCounts {
  std::uint64_t received = 0;  ///< chunks that were missing
  std::uint64_t doubled = 0;   ///< chunks that were there
  std::uint64_t refused = 0;   ///< chunks of a wrong length or index
  std::uint64_t forged = 0;    ///< blocks and hash lists with another hash
  std::uint64_t requests = 0;  ///< sent
};

/// Pure: time is passed in. One thread.
class ObjectFetch {
 public:
  /// Period of requests while chunks arrive.
  static constexpr std::chrono::milliseconds kPeriod{100};
  /// Longest wait after a server has nothing more to send: eight round trips of 1 ms.
  static constexpr std::chrono::milliseconds kLongestWait{8};
  /// Wait without any sign of a server; it doubles up to the longest.
  static constexpr std::chrono::milliseconds kSilence{200}, kLongestSilence{1000};
  /// After this time without a sign of it, any server may answer.
  static constexpr std::chrono::milliseconds kServerGone{900};
  static constexpr std::uint64_t kMostForged = 64;

  /// @param size at most kMostObjectOctets  @param store outlives this
  ObjectFetch(const ObjectHash& object, std::uint64_t size, ChunkStore& store, std::uint64_t seed,
              std::chrono::nanoseconds now);
  /// Stores how far it is, see ChunkStore::keep(). So does each request.
  ~ObjectFetch() { store_.keep(received_); }
  ObjectFetch(const ObjectFetch&) = delete;
  ObjectFetch& operator=(const ObjectFetch&) = delete;

  /// Takes chunks of the data that are stored already; wrong ones are found and fetched again.
  /// Call it before the first chunk.
  void take_kept(const ChunkMap& kept);

  [[nodiscard]] const ObjectHash& object() const noexcept { return object_; }
  /// The first 8 octets of object().
  [[nodiscard]] std::uint64_t key() const noexcept { return key_; }
  [[nodiscard]] FetchState state() const noexcept { return state_; }
  [[nodiscard]] const ChunkMap& received() const noexcept { return received_; }
  [[nodiscard]] const FetchCounts& counts() const noexcept { return counts_; }
  /// Epoch of the sender of the last chunk or status; 0: none.
  [[nodiscard]] std::uint32_t server() const noexcept { return server_; }

  /// Takes a chunk of any sender; one of a wrong index or length is counted.
  /// @param epoch, serial of the sender's record  @param octets of the chunk
  void take_chunk(std::uint32_t epoch, std::uint32_t serial, std::uint32_t index,
                  std::span<const std::byte> octets, std::chrono::nanoseconds now);
  /// Takes the status of a server.  @param pending chunks that it will send
  void take_status(std::uint32_t epoch, std::uint32_t serial, std::uint32_t pending,
                   std::chrono::nanoseconds now);
  /// Takes a request of another peer for the same object: ours is not sent if it asks for no more.
  void hear_request(const pdu::ObjectRequest& request, std::span<const std::byte> missing,
                    std::chrono::nanoseconds now);
  /// The request that is due at `now`.  @param room for the missing chunks
  /// @return octets of `room` that follow the request; 0: none is due
  [[nodiscard]] std::size_t take_request(std::chrono::nanoseconds now, pdu::ObjectRequest& request,
                                         std::span<std::byte> room);
  /// When to call take_request(); nanoseconds::max() after the end.
  [[nodiscard]] std::chrono::nanoseconds next_step() const noexcept { return ask_at_; }

 private:
  using Nanoseconds = std::chrono::nanoseconds;

  void hear_server(std::uint32_t epoch, std::uint32_t serial, Nanoseconds now) noexcept;
  void store_list(std::uint32_t index, std::span<const std::byte> octets) noexcept;
  void check_list();
  void check_block(std::uint32_t block);
  [[nodiscard]] bool is_whole(std::uint32_t first, std::uint32_t end) const noexcept {
    return received_.next(first, false) >= end;
  }
  void forget(std::uint32_t first, std::uint32_t end) noexcept;
  void end(FetchState state) noexcept;

  ObjectHash object_;
  std::uint64_t key_;
  ObjectLayout layout_;
  ChunkStore& store_;
  RepairTimer timer_;
  FetchState state_ = FetchState::running;
  ChunkMap received_, kept_, checked_;  // kept_: by an earlier run; checked_: of blocks
  std::vector<ObjectHash> list_;
  bool has_list_ = false;  // complete, and of the right hash
  std::vector<std::byte> block_;
  FetchCounts counts_;
  std::uint32_t server_ = 0, seen_ = 0;
  std::uint32_t begin_ = 0;  // first chunk of the next request, if one does not suffice
  Nanoseconds heard_, asked_;
  Nanoseconds silence_ = kSilence;
  Nanoseconds ask_at_;
};

}  // namespace reckon::peer
