// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A whole peer of an exercise of the study, over any link: it owns its share of the crowd, and what
// it shows of the others is held against where they truly are.
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
#include "reckon/peer/network/link.hpp"
#include "reckon/peer/scene/scene_file.hpp"

namespace reckon::bench {

/// The scene in which the whole peers of an exercise meet.
[[nodiscard]] peer::SceneFile scale_scene(const ScaleSetting& setting);

/// Whether a peer takes part at an instant; `settling` a moment before and after its coming and
/// going, when others need not show it and may.
enum class Attendance : std::uint8_t { absent, settling, present };
using AttendanceLaw = std::function<Attendance(std::size_t peer, double time)>;

/// An entity that came within the radius so long ago [s] is to be shown.
inline constexpr double kShownWithin = 1;

/// What whole peers counted; those of several add up.
struct WholeCounts {
  double seconds = 0;  ///< of one
  std::uint64_t peers = 0;
  std::uint64_t updates = 0, datagrams = 0, octets = 0;  ///< sent; with headers of UDP and IPv4
  std::uint64_t heard_updates = 0, heard_datagrams = 0, heard_octets = 0;
  std::uint64_t wanted = 0;   ///< updates that were used: of what is within the radius, or is shown
  std::uint64_t joins = 0;    ///< of groups
  std::uint64_t lost = 0;     ///< datagrams missing in their senders' numbering
  std::uint64_t dropped = 0;  ///< by the kernel
  std::uint64_t foreign = 0;  ///< datagrams of groups that the peer had not joined, or joined
                              ///< on another interface
  std::uint64_t looks = 0;    ///< entities within the radius, each at each look
  std::uint64_t unseen = 0;   ///< of those, not shown
  std::uint64_t overdue = 0;  ///< of those, within the radius for longer than kShownWithin
  std::uint64_t ghosts = 0;   ///< shown though their owner is absent, each at each look
  std::uint64_t known = 0;    ///< entities in the tables at the end
  std::uint64_t groups = 0;   ///< joined at the end
  double cpu = 0;             ///< of the peers' work, with the kernel's part where it has one [s]

  void add(const WholeCounts& other) noexcept;
};

/// THE list of what is a number of things, with the names under which processes tell them.
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
  std::vector<float> pose;       ///< shown against true [m]
  std::vector<float> discovery;  ///< from coming into the radius until shown [s]

  void add(const WholeSamples& other);
};

/// One thread. Joins at construction, says good-bye at destruction.
class WholePeer {
 public:
  /// @param link, clock outlive it @param begin of the exercise, by the clock
  /// @param epoch of this life, never the same twice @throws what Federate throws
  WholePeer(const ScaleSetting& setting, std::size_t peer, peer::Link& link,
            const peer::Clock& clock, std::chrono::nanoseconds begin, std::uint32_t epoch,
            AttendanceLaw attendance = {});
  ~WholePeer();

  /// Tells where its own are at `time` [s since begin], sends, and takes what has arrived.
  /// @param crowd as it is then
  void step(double time, Crowd& crowd);
  /// Sends what is due, and takes what has arrived, between two steps.
  void serve();
  /// Compares what is shown with what is true.
  void look(double time, Crowd& crowd);
  /// From here on it is counted.
  void begin_counting(double time);

  [[nodiscard]] WholeCounts counts(double time);
  [[nodiscard]] const WholeSamples& samples() const noexcept;

 private:
  struct MeasuredFederate;
  std::unique_ptr<MeasuredFederate> measured_;
};

}  // namespace reckon::bench
