// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// One exercise of the study.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "reckon/aoim/cells/cell_partition.hpp"
#include "reckon/aoim/interest/channel_table.hpp"
#include "reckon/bench/studies/scale/crowd.hpp"
#include "reckon/bench/studies/scale/mechanisms.hpp"
#include "reckon/bench/studies/tracks/track.hpp"
#include "reckon/deadreckon/motion/geocentric.hpp"
#include "reckon/deadreckon/sending/send_rules.hpp"
#include "reckon/pdu/codec/enumerations.hpp"
#include "reckon/peer/network/impairment.hpp"
#include "reckon/peer/scene/peer_config.hpp"

namespace reckon::bench {

/// Simulated before anything is counted [s]: longer than a round of introductions.
inline constexpr double kWarmUp = 3;

/// The same for all rows of a table.
struct ScaleSetting {
  std::size_t peers = 64;  ///< 1 .. 65,534; entities are dealt out evenly, neighbours together
  CrowdPlan crowd{kMixedGait, 6400};  ///< at least one entity a peer, 65,534 at most
  double radius = 200;                ///< of interest [m], about each entity
  double rate = 30;    ///< ticks a second: decisions to send, and looks at what is shown
  double seconds = 5;  ///< measured, after kWarmUp
  deadreckon::Thresholds thresholds;
  double heartbeat = 55;  ///< [s]
  double hold = 0.005;    ///< of a bundle [s]
  bool converges = true;  ///< what is shown, to what is predicted; else it is that at once
  /// Of a quad-tree its cell size is what no cell's side is shorter than.
  aoim::GridConfig grid;
  peer::QuadTreeConfig tree;    ///< with the scheme quad_tree; see divide_by_crowd()
  peer::ImpairmentLaw network;  ///< towards each receiver, of a simulated network
  double join = 0.02;           ///< from the call until the first datagram can come there [s]
  std::uint64_t seed = 1;
  std::uint16_t port = 3000;                               ///< UDP, of real processes
  ScaleDesign design = design_of(kMechanisms.size() - 1);  ///< what its peers do
};

/// @throws UsageError where the peers cannot have so many entities, with the remedy
void check_scale_setting(const ScaleSetting& setting);

/// What a scene of it says of cells.
[[nodiscard]] peer::AoimConfig scale_cells(const ScaleSetting& setting);
/// Divides the square around the crowd by where it is at the start. For set-up, up to some seconds.
void divide_by_crowd(ScaleSetting& setting);
/// Whether all cells are one group (a pool of 1): what grows without areas of interest. Contact and
/// near groups, which need a group of each cell, are off then.
[[nodiscard]] bool shares_one_group(const ScaleSetting& setting) noexcept;
/// Whether each cell that has entities at the start has a group of its own. For set-up.
[[nodiscard]] bool groups_suffice(const ScaleSetting& setting);
/// Entities of a peer, on average.
[[nodiscard]] double entities_a_peer(const ScaleSetting& setting) noexcept;
/// Whether both have as many entities a peer, within 5 %.
[[nodiscard]] bool are_alike(const ScaleSetting& a, const ScaleSetting& b) noexcept;
/// The channels of a setting.
struct ScaleChannels {
  std::vector<aoim::Channel> rows;
  std::size_t near_rows = 0;  ///< that have groups
};
/// The usual ones as far as the radius reaches, the row that holds its end being the last, with
/// groups for the near rows; where these would be too many, there is none or shares_one_group(),
/// all, without groups.
[[nodiscard]] ScaleChannels scale_channels(const ScaleSetting& setting);
/// The form that states are compressed in: what is not predicted, or where near groups are heard by
/// some alone, what differs from the last key.
[[nodiscard]] pdu::CompressedForm scale_compression(const ScaleSetting& setting);

/// The entities of a peer, neighbours in the plane.
struct OwnedRange {
  std::uint32_t first = 0, end = 0;
};
[[nodiscard]] OwnedRange owned_by(const ScaleSetting& setting, std::size_t peer) noexcept;

/// Where the origin of the plane stands, latitude and longitude [rad], height [m].
inline constexpr std::array kScaleOrigin{0.85, 0.15, 500.0};

}  // namespace reckon::bench
