// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The peer of `reckon peer`, with its hands.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "reckon/peer/joined_peer.hpp"
#include "reckon/tools/command_line/command_line.hpp"
#include "reckon/tools/exercise/entity_events.hpp"
#include "reckon/tools/exercise/real_devices.hpp"
#include "reckon/tools/exercise/scene_options.hpp"
#include "reckon/tools/exercise/simulated_hand.hpp"
#include "reckon/tools/exercise/stop_control.hpp"
#include "reckon/tools/verbs/join_scene.hpp"
#include "reckon/tools/verbs/page_address.hpp"

namespace reckon::tools {

struct PeerVerbOptions {
  SceneOptions scene;
  DeviceChoice device;
  std::string name;
  std::optional<std::uint64_t> operator_number;
  std::optional<std::uint64_t> application;
  std::optional<std::chrono::nanoseconds> duration;
  bool json = false;
  bool events = false;
  bool felt = false;
  std::optional<std::chrono::nanoseconds> balance;
  std::string to;
  std::string follow;
  JoinPlace join;  ///< group empty: the scene is given
  ViewSwitch view;
  std::string metrics, log;
};

/// Whether the peer gets its number in the scene from the other peers.
[[nodiscard]] bool asks_for_number(const peer::SceneFile& scene, const PeerVerbOptions& options);

/// The peer for `options`, with its simulated hands, and the reports of its link.
class RunningPeer {
 public:
  RunningPeer(const peer::SceneFile& scene, const PeerVerbOptions& options, const Console& console,
              EntityEvents& events, peer::DatagramTap* tap);
  void stop() { joined_.resign(); }
  [[nodiscard]] std::chrono::nanoseconds elapsed() const { return joined_.elapsed(); }
  [[nodiscard]] std::chrono::nanoseconds now() const { return joined_.clock().now(); }
  [[nodiscard]] peer::Peer& peer() { return joined_.peer(); }
  [[nodiscard]] std::vector<peer::Notice> sealing_notices() {
    return joined_.take_sealing_notices();
  }
  [[nodiscard]] const peer::PeerThreads& threads() const { return *joined_.threads(); }
  /// Sentences about the interface that a drawn table must not hide.
  [[nodiscard]] std::vector<std::string> link_warnings() const;
  /// Notices of its devices and of the software stop.
  [[nodiscard]] std::vector<std::string> device_notices();
  void press_stop_key() { stop_.press_key(now()); }
  /// Its hands that a page may move.
  [[nodiscard]] const std::vector<PointerHand>& pointers() const { return hands_.pointers; }

 private:
  static peer::FederateOptions federate_options(const peer::SceneFile& scene,
                                                const PeerVerbOptions& options,
                                                SimulatedHands& hands, RealDevices& real,
                                                peer::DatagramTap* tap, haptics::ForceStop& stop);

  StopControl stop_;      // before the devices
  SimulatedHands hands_;  // before the peer, which creates them while it joins
  RealDevices real_;      // the same
  peer::JoinedPeer joined_;
};

/// Joins. @throws UsageError, EnvironmentError
[[nodiscard]] std::unique_ptr<RunningPeer> joined_peer(const peer::SceneFile& scene,
                                                       const PeerVerbOptions& options,
                                                       const Console& console, EntityEvents& events,
                                                       peer::DatagramTap* tap);

}  // namespace reckon::tools
