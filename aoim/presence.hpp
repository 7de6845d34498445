// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Who else is here. Each peer announces itself on the base group at once on start, when it hears a
// newcomer, and every second; six missed announcements mean it is gone. Another scene is told once
// and not joined. Two peers under one (site, application) settle it between themselves.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "reckon/aoim/peer_id.hpp"
#include "reckon/aoim/source_address.hpp"
#include "reckon/pdu/reckon/presence_pdu.hpp"

namespace reckon::aoim {

/// Tunables of the presence protocol.
struct PresenceConfig {
  std::chrono::nanoseconds heartbeat = std::chrono::seconds(1);  ///< default 1 s, > 0
  /// Announcements missed in a row after which a peer is lost; default 6. At 20 % loss three in a
  /// row go missing every two minutes, six every four hours.
  int missed = 6;
  /// Least time between two announcements of ours, so that many newcomers cause no storm; default
  /// 100 ms. It is also the slack that the last missed announcement is given.
  std::chrono::nanoseconds minimum_gap = std::chrono::milliseconds(100);
  /// Peers remembered; default 256. Further ones are counted and not joined.
  std::size_t capacity = 256;
};

/// What happened to a peer.
enum class PresenceEventKind : std::uint8_t {
  newcomer,          ///< same scene: joined. We introduce our entities to it now
  restarted,         ///< same id, new epoch: drop what its former life left behind, introduce
  departed,          ///< said good-bye: drop its entities
  timed_out,         ///< silent for three heartbeats: drop its entities
  scene_mismatch,    ///< another scene or cell grid: told once per life, not joined; drop its
                     ///< entities
  identity_changed,  ///< we lost a dispute: `announced` is ours with the new id, `former` the old
                     ///< id
};

struct PresenceEvent {
  PresenceEventKind kind = PresenceEventKind::newcomer;
  pdu::Presence announced;  ///< last heard of the peer
  PeerId former;            ///< identity_changed only
  /// restarted only: epoch of the life that is over.
  std::uint32_t former_epoch = 0;

  [[nodiscard]] PeerId peer() const noexcept { return announced.simulation; }
};

/// One other peer.
struct Peer {
  pdu::Presence announced;
  std::chrono::nanoseconds first_heard{}, last_heard{};
  bool joined = false;   ///< same scene and grid
  SourceAddress source;  ///< of the announcement heard last

  [[nodiscard]] PeerId id() const noexcept { return announced.simulation; }
};

/// How the sender of a datagram, named by its epoch, stands with us.
enum class Standing : std::uint8_t {
  unknown,      ///< no announcement heard (yet)
  own,          ///< ourselves
  member,       ///< same scene, present life
  other_scene,  ///< told and not joined
  former_life,  ///< a later life of that peer has been heard since
};

/// Sums since the start.
struct PresenceCounts {
  std::uint64_t announced = 0, heard = 0, former_life = 0, conflicts = 0, table_full = 0;
};

/// The peers table and our own announcements. One thread; allocates nothing after construction.
class Presence {
 public:
  /// `own` carries all that we tell: simulation address wanted, epoch (drawn at random at every
  /// start of the process), start time, scene hash, cells. @throws std::invalid_argument for a
  /// heartbeat or number of misses that is not positive, or an epoch of 0.
  Presence(const PresenceConfig& config, const pdu::Presence& own);

  /// From now on we announce ourselves, at once at the next step.
  void start(std::chrono::nanoseconds now);
  /// The next step says good-bye, and nothing follows.
  void stop();

  /// Takes an announcement heard on the base group; our own echoes and those of other exercises are
  /// ignored.
  /// @param from the source of the datagram it was in
  void receive(const pdu::Presence& heard, std::chrono::nanoseconds now,
               const SourceAddress& from = {});

  /// Any datagram of a member shows that it lives: announcements lost in a row say nothing while
  /// its updates arrive. Unknown epochs are ignored.
  void note_alive(std::uint32_t epoch, std::chrono::nanoseconds now) noexcept;

  /// Announcements to send on the base group now (mostly 0 or 1), good until the next step; finds
  /// who has timed out. Send times and timestamps are left to the caller.
  [[nodiscard]] std::span<const pdu::Presence> step(std::chrono::nanoseconds now);

  /// Events since the last call, oldest first; the span is good until the next call.
  [[nodiscard]] std::span<const PresenceEvent> take_events();

  /// Whether the next step at `now` announces us.
  [[nodiscard]] bool is_due(std::chrono::nanoseconds now) const noexcept {
    return running_ && now >= next_;
  }
  /// Who we are at present.
  [[nodiscard]] const pdu::Presence& own() const noexcept { return own_; }
  [[nodiscard]] PeerId id() const noexcept { return own_.simulation; }
  [[nodiscard]] std::span<const Peer> peers() const noexcept { return peers_; }
  [[nodiscard]] Standing standing(std::uint32_t epoch) const noexcept;
  /// Epoch of the living member that holds this id: who may speak for its entities. Ourselves are
  /// no member. Linear in the peers known.
  [[nodiscard]] std::optional<std::uint32_t> epoch_of(PeerId id) const noexcept;
  /// Where the peer of this epoch speaks from; port 0 where that is not known, nothing where the
  /// epoch is not known.
  [[nodiscard]] std::optional<SourceAddress> source_of(std::uint32_t epoch) const noexcept;
  [[nodiscard]] const PresenceCounts& counts() const noexcept { return counts_; }
  /// When step has to be called next at the latest; duration max where there is nothing to do.
  [[nodiscard]] std::chrono::nanoseconds next_step() const noexcept;

 private:
  struct FormerLife {
    PeerId id;
    std::uint32_t epoch;
  };
  [[nodiscard]] std::chrono::nanoseconds patience() const noexcept;
  [[nodiscard]] std::size_t find(PeerId id) const noexcept;
  [[nodiscard]] bool is_former(std::uint32_t epoch) const noexcept;
  [[nodiscard]] bool shares_scene(const pdu::Presence& heard) const noexcept;
  [[nodiscard]] PeerId next_free() const noexcept;
  void announce_soon(std::chrono::nanoseconds now) noexcept;
  void settle_conflict(const pdu::Presence& heard, std::chrono::nanoseconds now,
                       const SourceAddress& from);
  void welcome(const pdu::Presence& heard, std::chrono::nanoseconds now, const SourceAddress& from);
  void update(std::size_t index, const pdu::Presence& heard, std::chrono::nanoseconds now,
              const SourceAddress& from);
  void begin_life(std::size_t index, const pdu::Presence& heard, std::chrono::nanoseconds now,
                  const SourceAddress& from);
  void bury(PeerId id, std::uint32_t epoch);
  void remove(std::size_t index, PresenceEventKind why);

  PresenceConfig config_;
  pdu::Presence own_;
  bool running_ = false;
  std::chrono::nanoseconds next_ = std::chrono::nanoseconds::max();
  std::optional<std::chrono::nanoseconds> last_;  ///< our last announcement under this id
  std::vector<Peer> peers_;
  std::vector<std::uint32_t> epochs_;  ///< of peers_, in the same order: scanned for each datagram
  std::vector<FormerLife> former_;     ///< oldest first
  std::vector<pdu::Presence> outgoing_, farewells_;
  std::vector<PresenceEvent> events_, taken_;
  PresenceCounts counts_;
};

}  // namespace reckon::aoim
