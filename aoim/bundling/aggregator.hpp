// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Bundles the updates of one peer per group, by size and deadline. A datagram of any size costs
// about the same CPU time, so packets are the resource; a deadline per update bounds the delay.
//
// Contents of a bundle, in order: Entity States, other standard PDUs, ONE Attribute PDU with a
// record set per entity, ONE Compressed States PDU, other experimental PDUs, and last the trailer
// of 24 octets (sequence per group, epoch, send time). Groups marked interop carry nothing after
// the Attribute PDU.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "reckon/aoim/bundling/waiting_index.hpp"
#include "reckon/aoim/groups/datagram_sink.hpp"
#include "reckon/aoim/groups/group_index.hpp"
#include "reckon/aoim/groups/peer_id.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/pdu/entity/entity_state.hpp"
#include "reckon/pdu/reckon/compressed_states.hpp"

namespace reckon::aoim {

/// Least payload of a datagram [octets]: an Entity State, an Attribute PDU with one record, and the
/// trailer.
inline constexpr std::size_t kLeastPayload = 280;

/// Tunables and identity of the sender.
struct AggregatorConfig {
  /// Most octets of one datagram's payload, at least kLeastPayload and `reserved`; default 1352
  /// (IPv6 over an MTU of 1400).
  std::size_t payload_limit = 1352;
  /// Part of payload_limit that stays free for a later authentication tag; default 64.
  std::size_t reserved = 64;
  /// G; groups 0 .. G exist.
  std::size_t pool = kDefaultPool;
  /// Most pending octets of one group, up to 1 GiB; further updates are refused. Default 16 MiB,
  /// some 100,000 Entity States. Memory is taken only for pending updates.
  std::size_t waiting_limit = 16 * 1024 * 1024;
  PeerId sender;
  std::uint32_t epoch = 0;
  std::uint8_t exercise_id = 1;
};

/// When an update is sent: the policy of its group or class. Time-out alone: a deadline and no
/// quorum; quorum alone: a deadline of never; both: hybrid. An update that may not wait has a
/// deadline of now.
struct BundleTerms {
  /// Latest time of sending (same clock as `now` in flush_due); in the past or now = at the next
  /// flush.
  std::chrono::nanoseconds deadline{};
  /// n: its bundle is sent as soon as it holds this many updates; 0 = by size alone. The least
  /// quorum of the updates in a bundle applies.
  std::uint32_t quorum = 0;

  template <class Count, class Period>
  BundleTerms(std::chrono::duration<Count, Period> latest, std::uint32_t updates = 0) noexcept
      : deadline(latest), quorum(updates) {}
};

/// Result of adding an update.
enum class AddResult : std::uint8_t {
  queued,
  replaced,  ///< an older update of the same entity was still pending: newest wins
  /// Not exactly one PDU, malformed records, a raw Attribute PDU or trailer, or one of our PDUs in
  /// an interop group.
  refused_kind,
  refused_size,   ///< longer than the largest possible datagram
  refused_full,   ///< waiting_limit reached: flush_due was not called for long
  refused_group,  ///< group above the pool
};

/// Sums since the start.
struct AggregatorCounts {
  std::uint64_t updates = 0, replaced = 0, refused = 0;
  std::uint64_t datagrams = 0, octets = 0;
  std::uint64_t full = 0;         ///< datagrams sent because nothing more fits
  std::uint64_t by_deadline = 0;  ///< datagrams sent because an update was due
  std::uint64_t oversized = 0;    ///< datagrams above the payload limit, which one PDU exceeds
};

/// Hybrid (quorum or deadline) bundling. One thread. Allocates only when more updates are pending
/// than ever before: in more than 4 groups, beyond 16 KiB or 128 updates in a group, 512 entities
/// in all, or a PDU longer than the payload limit. A group takes memory only while an update is
/// pending in it, or if it once held more than that. Cost: about 30 ns an update up to 10,000
/// pending entities, 40 to 200 ns at 100,000, see docs/measurements/interest.md.
class Aggregator {
 public:
  /// @throws std::invalid_argument if the payload limit leaves no room for an Entity State with
  /// force model and trailer, the pool is above 1,000, or waiting_limit is above 1 GiB.
  explicit Aggregator(const AggregatorConfig& config);

  /// Queues one encoded PDU. An Entity State replaces a pending one of the same entity and keeps
  /// the earlier deadline and the lower quorum; other PDUs keep their order.
  /// @param mark an encoded experimental PDU that is sent in the same datagram, or empty; ignored
  /// for an Entity State
  AddResult add(GroupIndex group, std::span<const std::byte> pdu, const BundleTerms& terms,
                std::span<const std::byte> mark = {});

  /// Queues an Entity State and the records that go into the Attribute PDU of the same datagram
  /// (HapticRecord, EnergyAccountRecord; already encoded, one after the other, may be empty). Sets
  /// the coupled-extension bit if there are records. A pending record of the same type (and, for
  /// energy accounts, the same counterpart) is replaced; other records of that entity are kept.
  AddResult add(GroupIndex group, const pdu::EntityState& state, std::span<const std::byte> records,
                const BundleTerms& terms);

  /// Queues an Entity State in a compressed form, as written by pdu::store_compressed(). All states
  /// of a group between two flushes have the same `form` of body (compact may be mixed with any). A
  /// state that depends on a pending key state would replace it, so send key states at once. The
  /// bundle holds the compressed states in one Compressed States PDU, at most kMostCompressed.
  AddResult add_compressed(GroupIndex group, const pdu::EntityId& entity, pdu::CompressedForm form,
                           std::span<const std::byte> state, std::span<const std::byte> records,
                           const BundleTerms& terms);
  static constexpr std::size_t kMostCompressed = 100;

  /// Queues records alone, e.g. a force model that changed while the pose did not.
  AddResult add_records(GroupIndex group, const pdu::EntityId& entity,
                        std::span<const std::byte> records, const BundleTerms& terms);

  /// Emits every bundle that is full or holds an update with a deadline <= now; other pending
  /// updates of that bundle are sent with it. `sink` gets (GroupIndex, std::span<const std::byte>)
  /// and must not call the aggregator.
  void flush_due(std::chrono::nanoseconds now, DatagramSink sink);

  /// Emits everything, e.g. before leaving.
  void flush_all(std::chrono::nanoseconds now, DatagramSink sink);

  /// Latest time of the next flush_due; a moment in the past if a bundle is full; none if nothing
  /// is pending.
  [[nodiscard]] std::optional<std::chrono::nanoseconds> next_deadline() const noexcept;

  /// Marks a group as plain DIS: no experimental PDUs, no trailer.
  void set_interop(GroupIndex group, bool interop) noexcept;

  /// UTC since 1970 = now + offset; `synchronised` = the host's clock can be trusted, so timestamps
  /// are marked absolute. Used for trailers and Attribute PDUs; default 0, relative.
  void set_utc_offset(std::chrono::nanoseconds offset, bool synchronised) noexcept;

  /// Sets the new number of the same process after an identity conflict. Sequences continue.
  void set_sender(PeerId sender) noexcept { config_.sender = sender; }

  [[nodiscard]] const AggregatorCounts& counts() const noexcept { return counts_; }
  /// Octets available for a bundle's PDUs in this group, without the trailer.
  [[nodiscard]] std::size_t room(GroupIndex group) const noexcept;

 private:
  static constexpr std::size_t kScanned = 16;  // more than a bundle of bare Entity States
  static constexpr std::uint32_t kNoQuorum = std::numeric_limits<std::uint32_t>::max();
  /// Place within a bundle; the order of the values is the order on the wire.
  enum class Place : std::uint8_t { entity, compressed, standard, experimental };
  static constexpr std::uint64_t kNoEntity = ~std::uint64_t{0};  // above any key
  struct Named {
    std::uint64_t key = kNoEntity;  ///< of the entity, if it is a state of one or its records
    pdu::EntityId entity;
    Place place = Place::standard;
  };
  struct Item : Named {
    std::uint32_t offset = 0;    ///< into the lane's octets: PDU, then records or mark
    std::uint32_t pdu_size = 0;  ///< 0 = records alone
    std::uint32_t records_size = 0;
    std::uint32_t mark_size = 0;  ///< only without records
    std::uint32_t quorum = kNoQuorum;
    std::chrono::nanoseconds deadline = std::chrono::nanoseconds::max();
  };
  /// Pending updates of a group. Memory of the usual size goes from group to group; larger memory
  /// stays.
  struct Room {
    std::vector<std::byte> octets;
    std::vector<Item> items;
  };
  struct Lane : Room {
    std::chrono::nanoseconds earliest = std::chrono::nanoseconds::max();
    std::size_t size = 0;              ///< sum of cost over the items
    std::size_t sets = 0;              ///< items with records
    std::size_t compressed = 0;        ///< items in a compressed form
    std::uint32_t quorum = kNoQuorum;  ///< least of the items
    std::uint32_t first = 0;  ///< ordinal of items.front(), or of the next one; may wrap around
    std::uint32_t sequence = 0;
    pdu::CompressedForm form = pdu::CompressedForm::compact;
    bool interop = false;
    bool listed = false;  ///< in active_
  };

  /// Null if nothing of the entity is pending, or the queue is short.
  struct Found {
    Item* item = nullptr;
    std::uint32_t* ordinal = nullptr;  ///< of the entity in the index, if its row is there
  };
  /// A run of items that is sent together.
  struct Bundle {
    std::size_t count = 0;
    bool full = false;
    std::chrono::nanoseconds earliest = std::chrono::nanoseconds::max();
  };

  AddResult add_entity(GroupIndex group, const pdu::EntityId& entity, Place place,
                       std::span<const std::byte> state, std::span<const std::byte> records,
                       const BundleTerms& terms);
  AddResult append_item(GroupIndex group, const Named& named, std::span<const std::byte> bytes,
                        std::span<const std::byte> behind, const BundleTerms& terms,
                        std::uint32_t* ordinal = nullptr);
  AddResult replace(GroupIndex group, Item& item, Place place, std::span<const std::byte> state,
                    std::span<const std::byte> records, const BundleTerms& terms);
  static void hasten(Item& item, const BundleTerms& terms) noexcept;
  AddResult refuse(AddResult why) noexcept;
  void reserve_rooms();
  static Room usual_room();
  void take_room(Lane& lane);
  void give_room_back(Lane& lane);
  [[nodiscard]] bool make_room(Lane& lane, std::size_t octets);
  void make_datagram_room(std::size_t octets);
  void list(GroupIndex group);
  void compact(Lane& lane);
  [[nodiscard]] Found find(GroupIndex group, const pdu::EntityId& entity) noexcept;
  void index_added(GroupIndex group, std::uint32_t* ordinal);
  [[nodiscard]] bool index_from(GroupIndex group, std::size_t first) noexcept;
  [[nodiscard]] bool index_all() noexcept;
  void rebuild_index();
  static std::size_t cost(const Item& item) noexcept;
  static std::size_t bundled(std::size_t size, std::size_t sets, std::size_t compressed) noexcept;
  static void measure(Lane& lane) noexcept;
  static void count_in(Lane& lane, const Item& item) noexcept;
  [[nodiscard]] bool is_full(const Lane& lane, std::size_t limit) const noexcept;

  void flush(std::chrono::nanoseconds now, std::chrono::nanoseconds until, DatagramSink sink);
  void flush_lane(GroupIndex group, std::chrono::nanoseconds now, std::chrono::nanoseconds until,
                  DatagramSink sink);
  [[nodiscard]] Bundle next_bundle(const Lane& lane, std::size_t first,
                                   std::size_t limit) const noexcept;
  void emit(GroupIndex group, std::span<const Item> items, std::chrono::nanoseconds now,
            DatagramSink sink);
  std::size_t write_pdus(const Lane& lane, std::span<const Item> items, Place place,
                         std::size_t at) noexcept;
  std::size_t write_compressed(const Lane& lane, std::span<const Item> items, std::size_t at,
                               std::chrono::nanoseconds now) noexcept;
  std::size_t write_attribute(const Lane& lane, std::span<const Item> items, std::size_t at,
                              std::chrono::nanoseconds now) noexcept;
  std::size_t write_trailer(Lane& lane, std::span<std::byte> out,
                            std::chrono::nanoseconds now) noexcept;

  AggregatorConfig config_;
  std::vector<Lane> lanes_;
  std::vector<Room> rooms_;            ///< empty ones of the usual size
  WaitingIndex waiting_;               ///< of the entities in queues longer than kScanned
  std::vector<std::uint16_t> active_;  ///< lanes with items
  std::vector<std::byte> datagram_;    ///< the bundle being built
  std::vector<std::byte> scratch_;     ///< one encoded Entity State
  std::vector<std::byte> merged_;      ///< an update merged from an old and a new one
  std::vector<std::byte> compacted_;
  std::chrono::nanoseconds utc_offset_{};
  bool synchronised_ = false;
  AggregatorCounts counts_;
};

}  // namespace reckon::aoim
