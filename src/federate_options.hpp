// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// How a program takes part in an exercise.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "reckon/peer/network/unicast_peers.hpp"
#include "reckon/peer/scene/scene_holder.hpp"
#include "reckon/peer/world/peer_device.hpp"

namespace reckon::peer {

class DatagramTap;
class ServoThread;

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
  /// one (scene_file.hpp); a scene of defaults has a radius of 2 m, see dis_exercise() for
  /// vehicles.
  SceneHolder scene;
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
  /// Receives what becomes of each datagram, see DatagramBalance; outlives the federate.
  DatagramTap* tap = nullptr;
};

}  // namespace reckon::peer
