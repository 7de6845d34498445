// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Transfer of objects over a link: serves own objects and fetches those of others. It has two
// groups: one for the messages, which all peers join, and one for the chunks, which only receivers
// join.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "reckon/pdu/reckon/assured_record.hpp"
#include "reckon/pdu/reckon/object_messages.hpp"
#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/network/link.hpp"
#include "reckon/peer/objects/chunk_store.hpp"
#include "reckon/peer/objects/object_fetch.hpp"
#include "reckon/peer/objects/object_server.hpp"

namespace reckon::peer {

/// The group of all messages but chunks: the base group of the exercise, two ports higher.
/// @throws std::invalid_argument if there is no such port
[[nodiscard]] GroupAddress object_messages_group(const GroupAddress& base);
/// The group of chunks: the one behind the pool, two ports higher.
/// @throws std::invalid_argument if there is no such group
[[nodiscard]] GroupAddress object_chunks_group(const GroupAddress& base, std::size_t pool_size);

struct ObjectExchangeOptions {
  GroupAddress base;                  ///< of the exercise; with a key the sealed one
  std::uint8_t exercise = 1;          ///< 0: any, for a peer that does not know it yet
  std::uint32_t epoch = 0;            ///< of this run, not 0, different for each peer
  pdu::SimulationAddress simulation;  ///< named in own messages; 0:0 for a peer without one
  double rate = 12.5e6;               ///< of chunks without headers [octet/s], above 0
  std::uint64_t seed = 1;             ///< of the random waits
};

/// A scene that another peer offers.
struct SceneOffer {
  pdu::ObjectOffer offer;
  pdu::SimulationAddress simulation;  ///< of the first peer that offered it
  IpEndpoint from;
};

/// Sums since the start.
struct ExchangeCounts {
  std::uint64_t chunks_sent = 0, octets_sent = 0;
  std::uint64_t requests_sent = 0, requests_in = 0;
  std::uint64_t refused = 0;  ///< datagrams that are no message of an exchange
};

class ObjectExchange;

/// Ends a fetch; its store may be destroyed then.
struct FetchEnd {
  ObjectExchange* exchange = nullptr;
  void operator()(ObjectFetch* fetch) const noexcept;
};
/// A fetch of an exchange. The exchange must outlive the handle.
using FetchHandle = std::unique_ptr<ObjectFetch, FetchEnd>;

/// One thread calls all functions and has exclusive use of the link.
class ObjectExchange {
 public:
  static constexpr std::size_t kMostOffers = 16;  ///< of others that are kept

  /// Joins the group of messages.  @param link, clock outlive this
  /// @throws std::invalid_argument if there is no such group, std::system_error if it cannot be
  /// joined
  ObjectExchange(Link& link, const Clock& clock, const ObjectExchangeOptions& options);

  /// Serves an object from now on.
  void serve(std::shared_ptr<const ObjectSource> source) { server_.add(std::move(source)); }
  /// Offers a served manifest to those who ask. Objects go to the chunks group of this pool.
  /// @throws std::invalid_argument if there is no such group
  void offer(const pdu::ObjectOffer& offer);

  /// Asks for a scene every 100 ms, until stop_asking().  @param scene_hash 0: any
  void ask(std::uint64_t scene_hash);
  void stop_asking() noexcept { ask_at_ = Nanoseconds::max(); }
  /// What others have offered since ask(), each scene once, at most kMostOffers.
  [[nodiscard]] std::span<const SceneOffer> offered() const noexcept { return offered_; }
  /// Whether object_chunks_group() exists for this pool.
  [[nodiscard]] bool has_chunks_group(std::size_t pool_size) const noexcept;
  /// Fetches an object that was offered with this pool, until the handle is destroyed.
  /// @param size at most kMostObjectOctets  @param store outlives the fetch
  /// @throws std::invalid_argument unless has_chunks_group(), std::system_error if the group cannot
  /// be joined
  [[nodiscard]] FetchHandle fetch(std::size_t pool_size, const ObjectHash& object,
                                  std::uint64_t size, ChunkStore& store);
  /// Reads what has arrived and sends what is due.
  void step();
  /// When step() is due, unless a datagram arrives.
  [[nodiscard]] std::chrono::nanoseconds next_step() const noexcept;
  [[nodiscard]] const ExchangeCounts& counts() const noexcept { return counts_; }

 private:
  friend FetchEnd;
  using Nanoseconds = std::chrono::nanoseconds;
  static constexpr std::size_t kBatch = 16;
  static constexpr std::size_t kMostOctets = 1352;  // of a PDU
  static constexpr std::size_t kMostMissing = 1200;
  static constexpr Nanoseconds kAskPeriod = std::chrono::milliseconds(100);

  struct Own {
    pdu::ObjectOffer offer;
    Nanoseconds due = Nanoseconds::max();
  };

  [[nodiscard]] bool is_ours(std::uint8_t exercise) const noexcept {
    return exercise == options_.exercise || exercise == 0 || options_.exercise == 0;
  }
  void finish(const ObjectFetch& fetch) noexcept;
  void take(const Datagram& datagram);
  void take_query(const pdu::AssuredRecord& record);
  void take_offer(const pdu::AssuredRecord& record, const IpEndpoint& from);
  void take_request(const pdu::AssuredRecord& record);
  void take_status(const pdu::AssuredRecord& record);
  void take_chunk(const pdu::AssuredRecord& record);
  void send_messages();
  void send_requests();
  void send_chunks();
  [[nodiscard]] std::size_t encode(pdu::AssuredKind kind, std::uint32_t sequence,
                                   std::span<const std::byte> content, std::span<std::byte> out);
  void send(pdu::AssuredKind kind, std::uint32_t sequence, std::span<const std::byte> content);

  Link& link_;
  const Clock& clock_;
  ObjectExchangeOptions options_;
  ObjectServer server_;
  RepairTimer timer_;
  std::vector<std::unique_ptr<ObjectFetch>> fetches_;
  GroupAddress messages_, chunks_;
  std::vector<Own> offers_;
  std::uint64_t asked_ = 0;
  Nanoseconds ask_at_ = Nanoseconds::max();
  std::vector<SceneOffer> offered_;
  ExchangeCounts counts_;
  Nanoseconds now_{0};
  std::uint64_t fetched_ = 0;  // fetches so far, for their seeds
  std::array<std::array<std::byte, kMostOctets>, kBatch> octets_{};
};

}  // namespace reckon::peer
