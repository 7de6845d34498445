// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Assembles a peer and joins an exercise: link, identity, settings of the scene, and the threads of
// its loops. Federate is built on it. The verbs of the program use the peer directly.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/federate_options.hpp"
#include "reckon/peer/loops/notice.hpp"
#include "reckon/peer/network/lan_link.hpp"
#include "reckon/peer/network/link.hpp"
#include "reckon/peer/peer.hpp"
#include "reckon/peer/peer_threads.hpp"
#include "reckon/peer/sealing/sealed_link.hpp"

namespace reckon::peer {

class ApplicationHold;
class ObjectService;
class RollCall;

/// A peer that has joined. Its link is open after construction. Its loops do not run before run(),
/// so peer() can be prepared. One thread calls all functions.
///
///   JoinedPeer joined(options);
///   joined.run();
///   while (more) look_at(joined.peer().views());
///   joined.resign();
class JoinedPeer {
 public:
  /// Joins over UDP multicast with a random epoch. @param guest is called in each pass and may use
  /// RemoteEntities::take_changes(); must outlive this; may be null. @throws
  /// SceneFileError, KeyFileError, RandomSourceError, StepTooDear, std::invalid_argument,
  /// std::runtime_error or std::system_error with the value and the remedy.
  explicit JoinedPeer(const FederateOptions& options, ModelGuest* guest = nullptr);
  /// The same with a link and a clock of the caller, which must outlive it.
  /// @param epoch identifies this run of the peer: not 0, and different for each run
  JoinedPeer(const FederateOptions& options, Link& link, const Clock& clock, std::uint32_t epoch,
             ModelGuest* guest = nullptr);
  ~JoinedPeer();
  JoinedPeer(const JoinedPeer&) = delete;
  JoinedPeer& operator=(const JoinedPeer&) = delete;

  /// Starts the threads if the options ask for them; may be called again after stop_loops().
  /// @throws std::system_error with the remedy
  void run();
  /// Without threads: one pass of each loop, at the clock's time.
  void pass() noexcept;
  /// Ends the threads. Their statistics remain until the next run().
  void stop_loops() noexcept;
  /// Gives its bodies to other peers, before stop_loops(). Waits until they have them, at most for
  /// 1.5 s; not at all if this peer is alone. Does nothing if the caller steps the loops, or has
  /// given the link: use Peer::begin_leaving(). Only the first call has an effect.
  void leave_bodies() noexcept;
  /// Calls leave_bodies() and stop_loops(), deactivates all own entities, and announces the end of
  /// the peer. Its application is free for others after that. A second call does nothing.
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
  /// Changes the impairment of the datagrams that this peer receives. By one thread, any, while it
  /// runs.
  /// caller, std::invalid_argument with law.problem()
  void change_impairment(const ImpairmentLaw& law);
  /// LanLink::report(); empty with a link of the caller.
  [[nodiscard]] std::vector<std::string> link_report() const;
  /// Reports of datagrams that the scene's key does not open, since the last call.
  [[nodiscard]] std::vector<Notice> take_sealing_notices();

 private:
  [[nodiscard]] std::unique_ptr<RollCall> call_roll(Link& link, const PeerOptions& own);
  struct Life {
    std::uint32_t epoch;
    aoim::ChainLink secret;
  };
  void check_step_cost();
  void join(Link& link, std::uint16_t site, const Life& life, ModelGuest* guest);
  [[nodiscard]] std::uint16_t application(std::uint16_t site);
  [[nodiscard]] SealedLinkOptions sealing(const GroupAddress& base, std::uint16_t site) const;
  [[nodiscard]] Link& sealed(Link& link, std::uint16_t site);
  void offer_scene();

  FederateOptions options_;
  SteadyClock steady_;
  const Clock* clock_;
  std::unique_ptr<LanLink> lan_;
  std::unique_ptr<ApplicationHold> hold_;  // in plain DIS on a LAN
  std::unique_ptr<SealedLink> sealed_;     // null if the scene has no key
  std::unique_ptr<Peer> peer_;
  std::unique_ptr<PeerThreads> threads_;
  std::unique_ptr<LanLink> objects_lan_;  // null unless the scene is offered; the next two likewise
  std::unique_ptr<SealedLink> objects_sealed_;
  std::unique_ptr<ObjectService> objects_;
  pdu::SimulationAddress own_;
  std::chrono::nanoseconds begun_{0};
  bool runs_ = false;  // on threads
  bool has_given_ = false, resigned_ = false;
};

}  // namespace reckon::peer
