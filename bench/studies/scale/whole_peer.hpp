// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A whole peer of an exercise of the study, over any link. It owns its share of the crowd. The
// study compares the remote entities that it shows with their true positions.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string_view>
#include <vector>

#include "reckon/bench/studies/scale/crowd.hpp"
#include "reckon/bench/studies/scale/setting.hpp"
#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/federate_options.hpp"
#include "reckon/peer/network/link.hpp"
#include "reckon/peer/scene/scene_file.hpp"

namespace reckon::bench {

/// The scene of the whole peers of an exercise.
[[nodiscard]] peer::SceneFile scale_scene(const ScaleSetting& setting);

/// Whether a peer takes part at an instant. `settling`: shortly before or after it joins or leaves,
/// when other peers may show its entities or not.
enum class Attendance : std::uint8_t { absent, settling, present };
using AttendanceLaw = std::function<Attendance(std::size_t peer, double time)>;

/// An entity must be shown this long after it enters the radius [s].
inline constexpr double kShownWithin = 1;

/// Counts of one or several whole peers.
struct WholeCounts {
  double seconds = 0;  ///< measured time of one peer
  std::uint64_t peers = 0;
  std::uint64_t updates = 0, datagrams = 0, octets = 0;  ///< sent; with headers of UDP and IPv4
  std::uint64_t heard_updates = 0, heard_datagrams = 0, heard_octets = 0;
  std::uint64_t wanted = 0;   ///< updates used: of entities within the radius, or shown
  std::uint64_t joins = 0;    ///< of groups
  std::uint64_t passes = 0;   ///< of the model loops
  std::uint64_t lost = 0;     ///< datagrams missing in their senders' numbering
  std::uint64_t dropped = 0;  ///< by the kernel
  std::uint64_t foreign = 0;  ///< datagrams of groups that the peer had not joined, or joined
                              ///< on another interface
  std::uint64_t looks = 0;    ///< entities within the radius, each at each look
  std::uint64_t unseen = 0;   ///< of `looks`, not shown
  std::uint64_t overdue = 0;  ///< of `unseen`, within the radius for longer than kShownWithin
  std::uint64_t ghosts = 0;   ///< shown though their owner is absent, each at each look
  std::uint64_t known = 0;    ///< entities in the tables at the end
  std::uint64_t groups = 0;   ///< joined at the end
  double cpu = 0;             ///< time of the peers' work, with system calls of a real link [s]

  void add(const WholeCounts& other) noexcept;
};

/// THE list of integer counts, with their keys in the lines of hosts.
struct WholeSum {
  std::string_view name;
  std::uint64_t WholeCounts::*of;
};
inline constexpr std::array kWholeSums{
    WholeSum{"peers", &WholeCounts::peers},
    WholeSum{"updates", &WholeCounts::updates},
    WholeSum{"datagrams", &WholeCounts::datagrams},
    WholeSum{"octets", &WholeCounts::octets},
    WholeSum{"heard_updates", &WholeCounts::heard_updates},
    WholeSum{"heard_datagrams", &WholeCounts::heard_datagrams},
    WholeSum{"heard_octets", &WholeCounts::heard_octets},
    WholeSum{"wanted", &WholeCounts::wanted},
    WholeSum{"joins", &WholeCounts::joins},
    WholeSum{"passes", &WholeCounts::passes},
    WholeSum{"lost", &WholeCounts::lost},
    WholeSum{"dropped", &WholeCounts::dropped},
    WholeSum{"foreign", &WholeCounts::foreign},
    WholeSum{"looks", &WholeCounts::looks},
    WholeSum{"unseen", &WholeCounts::unseen},
    WholeSum{"overdue", &WholeCounts::overdue},
    WholeSum{"ghosts", &WholeCounts::ghosts},
    WholeSum{"known", &WholeCounts::known},
    WholeSum{"groups", &WholeCounts::groups},
};

/// Samples behind percentiles.
struct WholeSamples {
  std::vector<float> pose;       ///< shown against true position [m]
  std::vector<float> discovery;  ///< from entering the radius until shown [s]

  void add(const WholeSamples& other);
};

/// One thread. Joins at construction, resigns at destruction.
class WholePeer {
 public:
  /// @param link, clock outlive it @param begin of the exercise, by the clock
  /// @param epoch of this federate, never used twice @throws as Federate does
  WholePeer(const ScaleSetting& setting, std::size_t peer, peer::Link& link,
            const peer::Clock& clock, std::chrono::nanoseconds begin, std::uint32_t epoch,
            peer::FederateLoops loops, AttendanceLaw attendance = {});
  ~WholePeer();

  /// Sets its own entities to their states at `time` [s since begin], sends due updates, and reads
  /// arrived datagrams. @param crowd at `time`
  void step(double time, Crowd& crowd);
  /// Without threads: whether the model loop of a live peer would pass now.
  [[nodiscard]] bool is_due();
  /// Sends due datagrams and reads arrived ones, between two steps.
  void serve();
  /// Compares shown with true positions.
  void look(double time, Crowd& crowd);
  /// Resets the counts.
  void begin_counting(double time);

  [[nodiscard]] WholeCounts counts(double time);
  [[nodiscard]] const WholeSamples& samples() const noexcept;

 private:
  struct MeasuredFederate;
  std::unique_ptr<MeasuredFederate> measured_;
};

}  // namespace reckon::bench
