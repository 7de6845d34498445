// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// How a peer comes into an exercise: link, identity, what the scene gives it, and who runs its
// loops. The one place that puts these together; Federate speaks HLA's words on top of it, the
// program's verbs look at the peer itself.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/loops/notice.hpp"
#include "reckon/peer/network/lan_link.hpp"
#include "reckon/peer/network/link.hpp"
#include "reckon/peer/peer.hpp"
#include "reckon/peer/peer_threads.hpp"
#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/peer/sealing/sealed_link.hpp"

namespace reckon::peer {

/// Who runs the loops.
enum class FederateLoops : std::uint8_t {
  in_step,  ///< step() makes a pass of each: one thread, the caller's; for simulated time too
  threads,  ///< threads of the federate's own; step() only calls back. Needed for haptic devices
  by_hand,  ///< the caller steps the loops of peer() in an order of his own, as several peers in
            ///< one simulated time need; step() only calls back
};

/// How a program takes part.
struct FederateOptions {
  std::string name = "federate";  ///< of the peer, and marking of its first hand
  /// The world: origin, cells and radius of interest, groups, impairment. load_scene_file() reads
  /// one; a scene of defaults has a radius of 2 m, see dis_exercise() for vehicles.
  SceneFile scene;
  std::string interface;  ///< name, address or index; empty: the scene's, else chosen by rule
  FederateLoops loops = FederateLoops::in_step;
  /// Which of the scene's [[entity]] tables are ours: those with this `peer`; 0: none. They move by
  /// themselves.
  std::uint32_t scene_peer = 0;
  std::vector<PeerDevice> devices;  ///< haptic devices that move hands; at most kMaxDevices
  /// Instead of both: the number is dealt out on the LAN by identity, so that peers which start in
  /// one instant get different ones (it takes a second), and this makes the devices of that number.
  /// Not over a link of the caller's, nor in an interop scene: there the number is 1.
  std::function<std::vector<PeerDevice>(std::uint32_t scene_peer)> deal;
  /// Of the entity IDs. Site: absent, by the host's address, or 1 over a link of the caller's.
  std::optional<std::uint16_t> site;
  std::uint16_t application = 1;  ///< in a conflict the next free one is taken
  bool transfer = true;           ///< energy given on demand; without it no hand can push another
  bool record_shown = false;      ///< fill Peer::shown() at every model step
  /// Number by which the scene's impairment draws what this peer loses; peers with others lose
  /// others.
  std::uint64_t receiver = 0;
  /// The thread that serves the devices, with those of other peers; outlives the federate. Null:
  /// one of its own.
  ServoThread* servo = nullptr;
  /// Where there is no multicast: to whom each datagram goes, as parse_peers() reads a list; this
  /// host may be among them. Empty: those of the scene, else to groups. Not over a link of the
  /// caller's.
  std::vector<NamedPeer> peers;
  /// Is told what becomes of each datagram, see DatagramBalance; outlives the federate.
  DatagramTap* tap = nullptr;
};

class RollCall;

/// A peer that has joined. From construction it is on the network, and its loops stand still until
/// run(): prepare peer() meanwhile. All functions by one thread.
///
///   JoinedPeer joined(options);
///   joined.run();
///   while (more) look_at(joined.peer().views());
///   joined.resign();
class JoinedPeer {
 public:
  /// Joins over UDP multicast, under an epoch drawn at random. @param guest takes part in each pass
  /// and may follow RemoteEntities::take_changes(), outlives this; may be null. @throws
  /// SceneFileError, KeyFileError, RandomSourceError, std::invalid_argument, std::runtime_error or
  /// std::system_error with the value and the remedy.
  explicit JoinedPeer(const FederateOptions& options, ModelGuest* guest = nullptr);
  /// The same over a link and a clock of the caller's, which outlive it.
  /// @param epoch names this life; never 0, never the same twice
  JoinedPeer(const FederateOptions& options, Link& link, const Clock& clock, std::uint32_t epoch,
             ModelGuest* guest = nullptr);
  ~JoinedPeer() { resign(); }
  JoinedPeer(const JoinedPeer&) = delete;
  JoinedPeer& operator=(const JoinedPeer&) = delete;

  /// Begins the threads, where the options ask for some; also again after stop_loops(). @throws
  /// std::system_error with the remedy
  void run();
  /// Without threads: one pass of each loop, at the clock's time.
  void pass() noexcept;
  /// Ends the threads; what they tell of themselves stays until the next run().
  void stop_loops() noexcept;
  /// stop_loops(), then every entity says that it goes, then the peer. A second call does nothing.
  void resign() noexcept;

  [[nodiscard]] Peer& peer() noexcept { return *peer_; }
  [[nodiscard]] const Peer& peer() const noexcept { return *peer_; }
  /// Null without threads, and before run().
  [[nodiscard]] PeerThreads* threads() noexcept { return threads_.get(); }
  [[nodiscard]] const PeerThreads* threads() const noexcept { return threads_.get(); }
  [[nodiscard]] const FederateOptions& options() const noexcept { return options_; }
  [[nodiscard]] const Clock& clock() const noexcept { return *clock_; }
  /// Since construction.
  [[nodiscard]] std::chrono::nanoseconds elapsed() const noexcept { return clock_->now() - begun_; }
  /// LanLink::report(); empty over a link of the caller's.
  [[nodiscard]] std::vector<std::string> link_report() const;
  /// What there is to tell of datagrams that the scene's key does not open, since the last call.
  [[nodiscard]] std::vector<Notice> take_sealing_notices();

 private:
  [[nodiscard]] std::unique_ptr<RollCall> call_roll(Link& link, const PeerOptions& own);
  struct Life {
    std::uint32_t epoch;
    aoim::ChainLink secret;
  };
  void join(Link& link, std::uint16_t site, const Life& life, ModelGuest* guest);
  [[nodiscard]] Link& sealed(Link& link, std::uint16_t site);

  FederateOptions options_;
  SteadyClock steady_;
  const Clock* clock_;
  std::unique_ptr<LanLink> lan_;
  std::unique_ptr<SealedLink> sealed_;  // null where the scene names no key
  std::unique_ptr<Peer> peer_;
  std::unique_ptr<PeerThreads> threads_;
  std::chrono::nanoseconds begun_{0};
  bool resigned_ = false;
};

}  // namespace reckon::peer
