// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// One exercise of the study, and what is counted of it.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "reckon/aoim/cells/cell_partition.hpp"
#include "reckon/aoim/interest/channel_table.hpp"
#include "reckon/bench/studies/scale/crowd.hpp"
#include "reckon/bench/studies/scale/mechanisms.hpp"
#include "reckon/bench/studies/tracks/track.hpp"
#include "reckon/deadreckon/motion/geocentric.hpp"
#include "reckon/deadreckon/sending/send_rules.hpp"
#include "reckon/pdu/codec/enumerations.hpp"
#include "reckon/peer/counters/duty_cycle.hpp"
#include "reckon/peer/counters/error_histogram.hpp"
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
  double rate = 30;          ///< ticks a second: decisions to send, and looks at what is shown
  double seconds = 5;        ///< measured, after warm_up
  double warm_up = kWarmUp;  ///< [s]; of processes always kWarmUp
  deadreckon::Thresholds thresholds;
  double heartbeat = 55;       ///< [s]
  double first_heartbeat = 1;  ///< silence after which a change is said again, as peers do [s]
  bool converges = true;  ///< what witnesses show, to what they predict, as peers do; else at once
  bool fresh = false;   ///< all is told first at the start; else as if the exercise had lasted long
  double hold = 0.005;  ///< of a bundle [s]
  /// Of a quad-tree its cell size is what no cell's side is shorter than.
  aoim::GridConfig grid;
  peer::QuadTreeConfig tree;     ///< with the scheme quad_tree; see divide_by_crowd()
  peer::ImpairmentLaw network;   ///< towards each receiver
  double join = 0.02;            ///< from the call until the first datagram can come [s]
  std::uint64_t scene_hash = 0;  ///< that peers announce
  std::size_t witnesses = 64;  ///< peers whose picture of the world is looked at; the others alike
  std::uint64_t seed = 1;
  std::uint16_t port = 3000;  ///< UDP, of real processes
  /// Of whole peers; what comes before areas they always do.
  ScaleDesign whole = design_of(kMechanisms.size() - 1);
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
/// The channels of a setting.
struct ScaleChannels {
  std::vector<aoim::Channel> rows;
  std::size_t near_rows = 0;  ///< that have groups

  /// The near rows that have groups.
  [[nodiscard]] std::span<const aoim::Channel> near() const noexcept {
    return audiences().first(near_rows);
  }
  /// Of the rows that are not kept, where they have groups; else none.
  [[nodiscard]] std::span<const aoim::Channel> audiences() const noexcept {
    return near_rows == 0 ? std::span<const aoim::Channel>() : std::span(rows).last(near_rows + 1);
  }
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

/// What one row counted: sums over `seconds` and all peers, unless said otherwise.
struct ScaleCounts {
  double seconds = 0;
  std::size_t peers = 0, entities = 0, witnesses = 0;

  std::uint64_t updates = 0;    ///< Entity States sent
  std::uint64_t datagrams = 0;  ///< sent, those of control too
  std::uint64_t octets = 0;     ///< sent, with headers of UDP and IPv4
  std::uint64_t control = 0;    ///< datagrams sent that hold announcements and memberships alone
  // Delivered to a program: group joined, not the sender's own.
  std::uint64_t heard_updates = 0, heard_datagrams = 0, heard_octets = 0;
  std::uint64_t joins = 0;   ///< groups joined
  std::uint64_t groups = 0;  ///< joined by all together at the end

  // Of the witnesses together.
  std::uint64_t wanted = 0;     ///< updates sent of entities within the radius, by others
  std::uint64_t missed = 0;     ///< of those, the group was not joined (yet)
  std::uint64_t lost = 0;       ///< of those, the network lost
  std::uint64_t looks = 0;      ///< entities within the radius, each at each tick
  std::uint64_t unseen = 0;     ///< of those, not shown
  peer::Spread pose;            ///< shown against true [m], of those shown
  peer::Percentiles discovery;  ///< from coming into the radius until shown

  // CPU of this process in the library's code, of all peers together [s].
  double send_cpu = 0;      ///< decide, encode, bundle
  double interest_cpu = 0;  ///< foci and subscription
  double receive_cpu = 0;   ///< by receive_cpu(); of the kernel too
};

}  // namespace reckon::bench
