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
#include "reckon/peer/settings/aoim_config.hpp"

namespace reckon::bench {

/// Time before counting begins [s]: longer than a round of introductions.
inline constexpr double kWarmUp = 3;

/// Equal for all rows of a table, except `design` and `seconds`.
struct ScaleSetting {
  std::size_t peers = 64;  ///< 1 .. 65,534; entities are dealt out evenly, neighbours together
  CrowdPlan crowd{kMixedGait, 6400};  ///< at least one entity a peer, 65,534 at most
  double radius = 200;                ///< of interest [m], around each entity
  double rate = 30;                   ///< ticks a second, for send decisions and looks
  double seconds = 5;                 ///< measured time, after kWarmUp
  deadreckon::Thresholds thresholds;
  double heartbeat = 55;  ///< [s]
  double hold = 0.005;    ///< of a bundle [s]
  bool converges = true;  ///< shown poses converge to the prediction; else they snap
  /// For a quad-tree, cell_size is the shortest side of a cell.
  aoim::GridConfig grid;
  peer::QuadTreeConfig tree;    ///< with the scheme quad_tree; see divide_by_crowd()
  peer::ImpairmentLaw network;  ///< to each receiver, in a simulated network
  double join = 0.02;           ///< from the call to the first datagram, in a simulated network [s]
  std::uint64_t seed = 1;
  std::uint16_t port = 3000;                               ///< UDP, of real processes
  ScaleDesign design = design_of(kMechanisms.size() - 1);  ///< mechanisms of its peers
};

/// @throws UsageError with the remedy for an invalid number of peers or of their entities
void check_scale_setting(const ScaleSetting& setting);

/// The cells of the exercise, as in a scene.
[[nodiscard]] peer::AoimConfig scale_cells(const ScaleSetting& setting);
/// Divides the square around the crowd into cells of the quad-tree by the crowd's start positions.
/// For set-up; up to some seconds.
void divide_by_crowd(ScaleSetting& setting);
/// Whether all cells share one group (a pool of 1): traffic then grows as without areas of
/// interest. Contact and near groups are off then, as they need a group for each cell.
[[nodiscard]] bool shares_one_group(const ScaleSetting& setting) noexcept;
/// Whether each cell that has entities at the start has a group of its own. For set-up.
[[nodiscard]] bool groups_suffice(const ScaleSetting& setting);
/// Mean number of entities of a peer.
[[nodiscard]] double entities_a_peer(const ScaleSetting& setting) noexcept;
/// Whether both have as many entities a peer, within 5 %.
[[nodiscard]] bool are_alike(const ScaleSetting& a, const ScaleSetting& b) noexcept;
/// The channels of a setting.
struct ScaleChannels {
  std::vector<aoim::Channel> rows;
  std::size_t near_rows = 0;  ///< with groups of their own
};
/// The default channels up to the row that contains the radius, with groups for the near rows. If
/// these groups are too many, if there is no near row, or with shares_one_group(): all default
/// channels, without groups.
[[nodiscard]] ScaleChannels scale_channels(const ScaleSetting& setting);
/// Compressed form of states: the residual against the prediction. With near groups, which only
/// some peers receive: the difference from the last key state.
[[nodiscard]] pdu::CompressedForm scale_compression(const ScaleSetting& setting);

/// The entities of a peer, neighbours in the plane.
struct OwnedRange {
  std::uint32_t first = 0, end = 0;
};
[[nodiscard]] OwnedRange owned_by(const ScaleSetting& setting, std::size_t peer) noexcept;

/// Origin of the plane: latitude and longitude [rad], height [m].
inline constexpr std::array kScaleOrigin{0.85, 0.15, 500.0};

}  // namespace reckon::bench
