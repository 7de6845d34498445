// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Makes a simulated device, held by an operator of the scene file.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "reckon/haptics/devices/mapped_device.hpp"
#include "reckon/haptics/devices/pointer_device.hpp"
#include "reckon/haptics/devices/simulated_device.hpp"
#include "reckon/peer/peer.hpp"
#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/tools/exercise/admittance_hand.hpp"
#include "reckon/tools/exercise/pointer_recorder.hpp"

namespace reckon::tools {

/// Operator `number` (from 1) as it holds a hand; see make_simulated_hand.
[[nodiscard]] peer::OperatorConfig operator_of(const peer::SceneFile& scene, std::uint32_t number);

/// Start position of operator `number` [m] in S: of a trace the end of its approach, of a sweep the
/// middle. @throws std::runtime_error for a trace that cannot be read, with FILE:LINE
[[nodiscard]] Eigen::Vector3d begin_of(const peer::SceneFile& scene, std::uint32_t number);

/// The hand of operator `index`. A scene with fewer operators reuses them from the first, a little
/// aside; a scene without operators gets hands at rest above its origin. @param script moves the
/// hand in S instead of the operator, whose impedance still holds it; none: the operator does.
/// @throws std::runtime_error for a trace that cannot be read, with FILE:LINE.
[[nodiscard]] std::unique_ptr<haptics::SimulatedDevice> make_simulated_hand(
    const peer::SceneFile& scene, std::size_t index, const haptics::HandScript& script = nullptr);

/// Positions of its tool's probes [m], as in haptics::ServoConfig.
[[nodiscard]] std::vector<Eigen::Vector3d> probes_of(const peer::DeviceConfig& device);

/// Mapping from the handle to the hand.
[[nodiscard]] haptics::HandMapping mapping_of(const peer::DeviceConfig& device);

/// One device of a scene, with its limits and its delay, held by its operator as above (numbered
/// from 1). The operator moves in S: the servo also needs mapping_of(), `device.position` and
/// `device.orientation`. The device holds a force for 1.5 servo periods, 10 ms at most, and then
/// drops it. A pointer's device follows its pointer unless there is a script. @throws as above.
[[nodiscard]] std::unique_ptr<haptics::SimulatedDevice> make_simulated_device(
    const peer::SceneFile& scene, const peer::DeviceConfig& device,
    const haptics::HandScript& script = nullptr);

/// The same for a device with a virtual mass. @throws as above.
[[nodiscard]] std::unique_ptr<AdmittanceHand> make_admittance_hand(
    const peer::SceneFile& scene, const peer::DeviceConfig& device,
    const haptics::HandScript& script = nullptr);

/// The one of the two that `device` asks for. @throws as above.
[[nodiscard]] std::unique_ptr<haptics::HapticDevice> make_held_device(
    const peer::SceneFile& scene, const peer::DeviceConfig& device);

/// One device of a scene that follows a pointer, regardless of its `source`; it follows its
/// operator while no pointer is active. @throws as above.
[[nodiscard]] std::unique_ptr<haptics::PointerDevice> make_pointer_device(
    const peer::SceneFile& scene, const peer::DeviceConfig& device);

/// A hand that follows a pointer of a page or a program. It refers to the device, which outlives
/// it.
struct PointerHand {
  std::size_t device = 0;  ///< of the peer, from 0
  haptics::PointerInbox* inbox = nullptr;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();                 ///< [m], origin of frame D in S
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< v_S = q * v_D
  PointerRecorder* recorder = nullptr;  ///< receives the same samples, for a second device;
                                        ///< null: none
  std::size_t held = 0;                 ///< index in SimulatedHands::devices, from 0

  /// Moves the hand to a point of S [m]; see haptics::PointerInbox::put for the thread.
  bool lead(const Eigen::Vector3d& p_S, bool grabs = false) const noexcept {
    return put({orientation.conjugate() * (p_S - origin), true, grabs});
  }
  void release() const noexcept { static_cast<void>(put({{}, false, false})); }

 private:
  bool put(const haptics::PointerSample& sample) const noexcept {
    if (recorder != nullptr) recorder->put(sample);
    return inbox->put(sample);
  }
};

/// The devices of one peer, and their placement in the scene.
struct SimulatedHands {
  std::vector<std::unique_ptr<haptics::SimulatedDevice>> devices;
  std::vector<std::unique_ptr<AdmittanceHand>> admittance;     ///< not among `devices`
  std::vector<std::unique_ptr<haptics::MappedDevice>> mapped;  ///< wrap the devices that have
                                                               ///< a mapping
  std::vector<peer::PeerDevice> wired;  ///< all devices in scene order, or their mapping
                                        ///< wrappers
  std::vector<PointerHand> pointers;    ///< the pointer devices among `devices`

  /// Notices since the last call, of devices that could not follow. One thread, any.
  [[nodiscard]] std::vector<std::string> take_notices();
};

/// All devices of peer `peer` (from 1) by devices_of(), maybe none; moved by the script if there is
/// one. @throws as above.
[[nodiscard]] SimulatedHands make_simulated_hands(const peer::SceneFile& scene, std::uint32_t peer,
                                                  const haptics::HandScript& script = nullptr);

/// Opens every mesh and every trace that `hands` hands need, so that a bad file is reported before
/// anything starts. @throws std::runtime_error or std::invalid_argument with the file, the place
/// and the remedy.
void check_files(const peer::SceneFile& scene, std::size_t hands);

/// Replaces the first object's shape by the mesh in `file`, centred there and scaled to the same
/// size (0.2 m if the object is no mesh). @throws std::runtime_error if there is no object or
/// the mesh cannot be read.
void put_mesh(peer::SceneFile& scene, const std::filesystem::path& file);

/// Makes all hands follow the recorded trace in `file`, side by side so that they touch. The trace
/// is scaled and moved to pass through the top of the first object.
void put_trace(peer::SceneFile& scene, const std::filesystem::path& file);

}  // namespace reckon::tools
