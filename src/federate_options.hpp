// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Options with which a program joins an exercise.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "reckon/peer/network/unicast_peers.hpp"
#include "reckon/peer/scene/scene_holder.hpp"
#include "reckon/peer/world/peer_device.hpp"

namespace reckon::haptics {
class ForceStop;
}

namespace reckon::peer {

class DatagramTap;
class ServoThread;

/// The thread on which the loops run.
enum class FederateLoops : std::uint8_t {
  in_step,  ///< step() runs one pass of each on the caller's thread; also for simulated time
  threads,  ///< the federate has threads; step() only calls back. Needed for haptic devices
  by_hand,  ///< the caller steps the loops of peer() in its own order, for several peers in one
            ///< simulated time; step() only calls back
};

/// Options of a federate.
struct FederateOptions {
  std::string name = "federate";  ///< of the peer, and marking of its first hand
  /// The scene: origin, cells, radius of interest, groups, impairment. load_scene_file() of
  /// scene_file.hpp reads one. A default scene has a radius of 2 m; use dis_exercise() for
  /// vehicles.
  SceneHolder scene;
  std::string interface;  ///< name, address or index; empty: from the scene, else chosen
  FederateLoops loops = FederateLoops::in_step;
  /// The federate owns the scene's [[entity]] tables with this `peer`; 0: none. They follow their
  /// tracks.
  std::uint32_t scene_peer = 0;
  std::vector<PeerDevice> devices;  ///< haptic devices that move hands; at most kMaxDevices
  /// Replaces scene_peer and devices: peers agree on their numbers over the LAN, which takes a
  /// second, and this function makes the devices of the agreed number. With a link of the caller or
  /// in an interop scene the number is 1.
  std::function<std::vector<PeerDevice>(std::uint32_t scene_peer)> deal;
  /// Site of the entity IDs. Absent: from the host's address, or 1 with a link of the caller.
  std::optional<std::uint16_t> site;
  /// Application of the entity IDs, 1 to 65534. In an interop scene (plain DIS) it is never
  /// changed, and joining fails if another program of this host has it; absent: the smallest free
  /// one. In other scenes peers settle a conflict of IDs by taking the next free one; absent: 1 at
  /// first.
  std::optional<std::uint16_t> application;
  /// Joins although this host cannot make a servo step of the scene within its period, and reports
  /// that as a notice. If this is false, joining a LAN with devices throws StepTooDear in this
  /// case.
  bool even_if_slow = false;
  /// Pace of the scene's bodies, see haptics::BodyWorld::set_pace(). Absent: on a LAN with devices
  /// it is measured, which takes 20 ms; else 1.
  std::optional<double> body_pace;
  /// The software stop of its hands, shared with other federates of the program; must outlive the
  /// federate. Null: one of its own.
  haptics::ForceStop* force_stop = nullptr;
  bool transfer = true;       ///< give energy on demand; otherwise no hand can push another
  bool record_shown = false;  ///< fill Peer::shown() at every model step
  /// Stream of the random impairment of the scene: peers with different numbers lose different
  /// datagrams.
  std::uint64_t receiver = 0;
  /// The impairment may change while it runs: JoinedPeer::change_impairment(). Ignored with a link
  /// of the caller.
  bool impairment_changes = false;
  /// The thread that runs the servos, shared with other peers; must outlive the federate. Null: the
  /// federate makes one.
  ServoThread* servo = nullptr;
  /// For networks without multicast: the hosts that receive each datagram, see parse_peers(). This
  /// host may be in the list. Empty: the list of the scene, else multicast. Ignored with a link of
  /// the caller.
  std::vector<NamedPeer> peers;
  /// With threads on a LAN with multicast: offers the files of the scene to peers that lack them.
  bool offers_scene = false;
  /// Receives the fate of each datagram, see DatagramBalance; must outlive the federate.
  DatagramTap* tap = nullptr;
};

}  // namespace reckon::peer
