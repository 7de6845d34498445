// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Some peers of a large exercise whose picture of the world is kept: what they are sent, what they
// miss, how far off what they show is. What everybody hears alike is counted elsewhere, once.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

#include "reckon/aoim/groups/group_index.hpp"
#include "reckon/aoim/interest/interest.hpp"
#include "reckon/bench/studies/scale/setting.hpp"
#include "reckon/deadreckon/motion/kinematic_state.hpp"
#include "reckon/peer/counters/duty_cycle.hpp"
#include "reckon/peer/counters/error_histogram.hpp"
#include "reckon/peer/network/impairment.hpp"

namespace reckon::bench {

/// An update as it left.
struct SentUpdate {
  std::uint32_t sender = 0;  ///< peer
  std::uint32_t entity = 0;
  aoim::GroupIndex group;
  std::uint64_t datagram = 0;  ///< number of its datagram, of all: what is lost is lost together
  double time = 0;             ///< of its truth [s]
  double left = 0;             ///< when it went onto the network [s]
  std::size_t pool = 0;        ///< of its group: 0 of cells, then those of near rows
};

/// What a listener to `group` knows of an entity already.
struct HeardBefore {
  aoim::GroupIndex group;
  deadreckon::KinematicState state;  ///< now
};

/// One thread. Times [s] since the start.
class Witnesses {
 public:
  /// @param owned by peer. Witnesses are spread evenly over the peers. @throws
  /// std::invalid_argument for a network that cannot be.
  /// @param near rows that have groups
  Witnesses(const ScaleSetting& setting, std::span<const OwnedRange> owned,
            std::span<const aoim::Channel> near = {});
  ~Witnesses();

  [[nodiscard]] std::size_t size() const noexcept;
  /// Forgets what was counted so far.
  void begin_counting();

  /// The index of this peer's witness, or size().
  [[nodiscard]] std::size_t witness_of(std::uint32_t peer) const noexcept;
  /// A group can be heard from `from` on; for ever, until leave. The base group always is.
  void join(std::size_t witness, aoim::GroupIndex group, double from);
  /// What is shown by what came by a near group goes back to what came by those behind it.
  /// @param pool that the group is of
  void leave(std::size_t witness, aoim::GroupIndex group, std::size_t pool = 0);
  /// What its exact test keeps.
  void set_foci(std::size_t witness, std::span<const aoim::Focus> foci);

  /// Every second or so: finds who may come within reach before the next call. `reach` [m] on top
  /// of the radius. Who is new and in a group that is heard was heard before: as `heard` says.
  void gather(double time, const Crowd& crowd, double reach,
              const std::function<HeardBefore(std::uint32_t entity)>& heard);
  /// Whether any witness could care: then send() is to be told.
  [[nodiscard]] bool is_near(std::uint32_t entity) const noexcept;
  /// An update whose state, as decoded, is `state`.
  void send(const SentUpdate& update, const deadreckon::KinematicState& state);
  /// Takes what has arrived by `time`, and looks at what is shown then.
  void look(double time, Crowd& crowd);

  /// Fills in the witnesses' share of the counts.
  void report(ScaleCounts& counts) const;

 private:
  struct Witness;
  struct Observations;
  std::unique_ptr<Observations> observations_;
};

}  // namespace reckon::bench
