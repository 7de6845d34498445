// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What must hold of peers whatever befalls them, checked as it happens. "Calm" begins when all
// faults have ended and what was under way has arrived.
//
//   I1  2 s into the calm, and ever after, the ids of the living differ and each lists all others;
//       3 s where somebody has slept; 5 s where two have held one id for 2 s out of each other's
//       hearing, one wants the id of a life that ended on another host in the last 4.5 s (and
//       as long as anybody has slept), or a stranger spoke in the name of a peer. A newcomer in
//       the calm is in by 2 s, a new life by 1 s
//   I2  from then on nobody is renamed but who came after
//   I3  a life heard within 0.5 s, or 2.4 s where it has spoken since the other came, is not taken
//       for restarted, one heard within the patience not for
//       timed out, one that has not said good-bye to its id not for departed, unless one at another
//       address that was listed under it before takes it back; one that has is no newcomer for a
//       second
//   I4  nobody is listed longer than the patience after the last datagram of it
//   I5  tables stay within their bounds, the next step is not long past
//   I6  an entity in reach is shown one heartbeat after I1, to a newcomer 2 s after its start; then
//       nothing is shown whose owner is not listed under that id
//   I7  sequence verdicts and counts are those of the sets of numbers that arrived; only numbers of
//       those listed are counted, and what a life says is not too old for a stranger's leap
//   I8  the same seed runs the same (checked by whoever runs it)
//   I9  a forged datagram in the name of a life whose source is known is not used and ends no life;
//       an id that most of the others believe is not given up to a stranger
//   I10 no storms: at most 12 announcements in any second, 8 in 5 s of calm, 6 renames of a life
//   I11 of a cut in one direction both ends are told (CutWatch)
//   I12 a number that is given up goes at once to one that waits for it (ClaimWatch)
//   I13 what stands in reach of a peer that has jumped elsewhere is shown to it a second later,
//   where
//       it was not heard before
#pragma once

#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "reckon/tests/fuzz/peers/life.hpp"
#include "reckon/tests/fuzz/search/seeded_simulation.hpp"

namespace reckon::fuzz {

/// An id held so long is not given up to a stranger.
inline constexpr nanoseconds kHeld = std::chrono::seconds(2);

/// "7:1".
[[nodiscard]] inline std::string name(aoim::PeerId id) {
  return std::to_string(id.site) + ':' + std::to_string(id.application);
}

/// With the lives that it concerns.
struct LivesFinding : Finding {
  std::size_t life = kNobody, other = kNobody;
};

/// Stands beside a trial and looks at its lives.
class Watch {
 public:
  Watch(const Plan& plan, const std::vector<Life>& lives, nanoseconds calm, nanoseconds probe)
      : plan_(plan), lives_(lives), calm_(calm), probe_(probe) {}

  void see_event(std::size_t life, const aoim::PresenceEvent& event, const PeerDatagram* cause,
                 nanoseconds now);
  void see_received(std::size_t life, const PeerDatagram& datagram, const aoim::Incoming& incoming,
                    nanoseconds now);
  void see_step(std::size_t life, nanoseconds now);
  /// A number was counted of one that is not listed, or of itself.
  void see_counted_stranger(std::size_t life, const PeerDatagram& datagram, nanoseconds now);
  /// To be called every 50 ms.
  void look(nanoseconds now);
  /// Keeps the first that is reported.
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
  using Numbering = std::tuple<std::size_t, std::size_t, std::uint16_t>;  ///< to, of, group
  std::map<Numbering, std::uint32_t> highest_;
  /// Since when a life lists an epoch under an id, also where it was taken for over meanwhile.
  std::map<std::tuple<std::size_t, std::uint32_t, aoim::PeerId>, nanoseconds> listed_;
  std::optional<LivesFinding> finding_;
};

}  // namespace reckon::fuzz
