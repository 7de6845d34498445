// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Invariants of peers under all faults, checked as they happen. "Calm" begins when all faults have
// ended and all delayed datagrams have arrived.
//
//   I1  from 2 s into the calm on, the ids of live peers differ and each lists all others: after
//       3 s if a peer has slept; after 5 s if two have held one id for 2 s while cut off from each
//       other, if one requests the id of a life that ended on another host in the last 4.5 s (plus
//       the longest sleep), or if a stranger has sent in the name of a peer. In the calm a newcomer
//       is listed after 2 s, a new life after 1 s
//   I2  from then on only newcomers are renamed
//   I3  a life received within 0.5 s, or 2.4 s if it has sent since the other came, is not taken
//       for restarted; a life received within the patience is not taken for timed out; a life that
//       has not given up its id is not taken for departed, unless one at another address that was
//       listed under the id before takes it back; a departed life is no newcomer for a second
//   I4  no life is listed longer than the patience after its last datagram
//   I5  tables stay within their bounds, and the next step is not long overdue
//   I6  an entity in reach is shown one heartbeat after I1, to a newcomer 2 s after its start; then
//       no entity is shown whose owner is not listed under that id
//   I7  sequence verdicts and counts equal those of the sets of received numbers; only numbers of
//       listed lives are counted, and a stranger's leap does not make a life's datagrams too old
//   I8  the same seed runs the same (checked by the caller)
//   I9  a forged datagram in the name of a life whose source is known is not used and ends no life;
//       an id that most of the others believe is not given up to a stranger
//   I10 no storms: at most 12 announcements in any second, 8 in 5 s of calm, 6 renames of a life
//   I11 both ends of a cut in one direction report it (CutWatch)
//   I12 a number that is given up goes at once to a peer that waits for it (ClaimWatch)
//   I13 an entity in reach of a peer that has jumped elsewhere is shown to it a second later, even
//       if the peer did not receive its group before
#pragma once

#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "reckon/tests/fuzz/peers/life.hpp"
#include "reckon/tests/fuzz/search/seeded_simulation.hpp"

namespace reckon::fuzz {

/// An id held this long is not given up to a stranger.
inline constexpr nanoseconds kHeld = std::chrono::seconds(2);

/// "7:1".
[[nodiscard]] inline std::string name(aoim::PeerId id) {
  return std::to_string(id.site) + ':' + std::to_string(id.application);
}

/// A finding with the lives that it concerns.
struct LivesFinding : Finding {
  std::size_t life = kNobody, other = kNobody;
};

/// Observes a trial and checks its lives.
class Watch {
 public:
  Watch(const Plan& plan, const std::vector<Life>& lives, nanoseconds calm, nanoseconds probe)
      : plan_(plan), lives_(lives), calm_(calm), probe_(probe) {}

  void see_event(std::size_t life, const aoim::PresenceEvent& event, const PeerDatagram* cause,
                 nanoseconds now);
  void see_received(std::size_t life, const PeerDatagram& datagram, const aoim::Incoming& incoming,
                    nanoseconds now);
  void see_step(std::size_t life, nanoseconds now);
  /// A number was counted for a life that is not listed, or for itself.
  void see_counted_stranger(std::size_t life, const PeerDatagram& datagram, nanoseconds now);
  /// Call it every 50 ms.
  void look(nanoseconds now);
  /// Keeps the first report.
  void report(int invariant, nanoseconds now, std::size_t life, std::size_t other,
              std::string sentence);

  [[nodiscard]] const std::optional<LivesFinding>& finding() const noexcept { return finding_; }

 private:
  struct Pace {
    std::int64_t second = -1;
    std::uint64_t at_second = 0, at_calm = 0;
  };
  [[nodiscard]] std::size_t life_of(std::uint32_t epoch) const noexcept;
  [[nodiscard]] bool is_newcomer(const Life& life) const noexcept { return life.born > calm_; }
  void see_end(std::size_t life, const aoim::PresenceEvent& event, nanoseconds now);
  [[nodiscard]] bool has_answered(std::size_t life, std::uint32_t old_epoch,
                                  std::uint32_t young_epoch, nanoseconds now) const noexcept;
  void see_farewell(std::size_t life, const aoim::PresenceEvent& event, nanoseconds now);
  void see_too_old(std::size_t life, const PeerDatagram& datagram, const aoim::Incoming& incoming,
                   nanoseconds now);
  void see_rename(std::size_t life, const aoim::PresenceEvent& event, nanoseconds now);
  void see_forged(std::size_t life, const PeerDatagram& datagram, const aoim::Incoming& incoming,
                  nanoseconds now);
  void check_listed(std::size_t life, nanoseconds now);
  void check_bounds(std::size_t life, nanoseconds now);
  void check_counts(std::size_t life, nanoseconds now);
  void check_pace(std::size_t life, nanoseconds now);
  void check_agreement(nanoseconds now, nanoseconds young);
  void check_shown(nanoseconds now);
  void check_shown_by(std::size_t life, nanoseconds now);
  void check_restart(nanoseconds now);
  void check_jumped(nanoseconds now);
  [[nodiscard]] bool is_believed(std::size_t life, aoim::PeerId id, nanoseconds now) const noexcept;
  [[nodiscard]] nanoseconds settling() const noexcept;
  [[nodiscard]] bool has_old_dispute() const noexcept;
  [[nodiscard]] bool has_legacy() const noexcept;

  const Plan& plan_;
  const std::vector<Life>& lives_;
  nanoseconds calm_, probe_, settle_ = std::chrono::seconds(2);
  std::vector<Pace> paces_;
  struct Farewell {
    std::size_t to, of;
    aoim::PeerId id;
    nanoseconds at;
  };
  std::vector<Farewell> farewells_;
  using Numbering = std::tuple<std::size_t, std::size_t, std::uint16_t>;  ///< to, from, group
  std::map<Numbering, std::uint32_t> highest_;
  /// Since when a life lists an epoch under an id, including times when it took the epoch for
  /// ended.
  std::map<std::tuple<std::size_t, std::uint32_t, aoim::PeerId>, nanoseconds> listed_;
  std::optional<LivesFinding> finding_;
};

}  // namespace reckon::fuzz
