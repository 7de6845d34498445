// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tests/fuzz/leaders/trial.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <tuple>

#include "reckon/pdu/bundle.hpp"
#include "reckon/pdu/reckon/cell_snapshot.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/tests/fuzz/leaders/forger.hpp"
#include "reckon/tests/fuzz/leaders/watch.hpp"
#include "reckon/tests/fuzz/search/agenda.hpp"
#include "reckon/tests/fuzz/search/dice.hpp"

namespace reckon::fuzz::leaders {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr nanoseconds kLook = milliseconds(50), kBegin = seconds(100), kChangeGap = seconds(1);
// When the calm begins, the scene leader receives no last map of another leader for this time.
constexpr nanoseconds kMapsUnheard = milliseconds(900);

// The datagram with PDUs of no type in place of maps; its other PDUs are received.
std::shared_ptr<const Datagram> without_maps(const std::shared_ptr<const Datagram>& datagram) {
  constexpr std::ptrdiff_t kPduType = 2;  // offset in a PDU header
  const auto changed = std::make_shared<Datagram>(*datagram);
  for (const pdu::BundledPdu& bundled : pdu::BundleReader(datagram->octets)) {
    if (bundled.header.pdu_type != pdu::PduType::group_map) continue;
    changed->octets[static_cast<std::size_t>(bundled.bytes.data() - datagram->octets.data() +
                                             kPduType)] = std::byte{0};
  }
  return changed;
}

struct Delivery {
  std::size_t to = 0;
  std::shared_ptr<const Datagram> datagram;
  std::optional<nanoseconds> came{};  ///< when it arrived at a socket
};

class Trial {
 public:
  Trial(const Plan& plan, bool keep_log)
      : plan_(plan),
        keep_log_(keep_log),
        dice_(mixed(plan.seed, 3)),
        watch_(plan),
        places_(plan.hosts.size()) {
    for (std::size_t i = 0; i < places_.size(); ++i) places_[i].clock = plan.hosts[i].clock;
  }

  Outcome run() {
    nanoseconds look{}, change = seconds(4);
    bool killed = false;
    while (now_ < plan_.end && !outcome_.finding) {
      now_ = next(look);
      if (now_ >= change) {
        change_states();
        change = now_ + kChangeGap;
      }
      befall();
      if (!killed && now_ >= plan_.kill) {
        killed = true;
        kill_a_leader();
      }
      deliver();
      for (std::size_t i = 0; i < places_.size(); ++i) step(i);
      if (now_ < look && !somebody_woke()) continue;
      look = now_ + kLook;
      outcome_.finding = watch_.look(places_, now_);
    }
    return outcome_;
  }

 private:
  nanoseconds next(nanoseconds look) const {
    nanoseconds next = std::min({look, plan_.end, kill_at()});
    next = std::min(next, deliveries_.next());
    if (fault_ < plan_.faults.size()) next = std::min(next, plan_.faults[fault_].at);
    for (std::size_t i = 0; i < places_.size(); ++i) {
      const Place& place = places_[i];
      if (place.lives == 0) next = std::min(next, plan_.hosts[i].start);
      if (place.host) next = std::min(next, std::max(place.awake, steps_[i]));
    }
    for (const auto& [at, host] : returns_) next = std::min(next, at);
    return std::max(next, now_);
  }
  [[nodiscard]] nanoseconds kill_at() const noexcept {
    return now_ < plan_.kill ? plan_.kill : nanoseconds::max();
  }

  [[nodiscard]] bool somebody_woke() const noexcept {
    return std::any_of(places_.begin(), places_.end(), [this](const Place& place) {
      return place.host && place.awake == now_ && place.asleep < now_;
    });
  }

  void log(std::string text) {
    if (keep_log_) outcome_.log.push_back(fmt::format("{:9.4f}  {}", pdu::to_seconds(now_), text));
  }

  static void disturb(Place& place, nanoseconds until) {
    place.disturbed = std::max(place.disturbed, until);
  }

  void start(std::size_t i) {
    Place& place = places_[i];
    if (i + 1 == places_.size()) watch_.newcomer_starts(places_);
    const auto epoch = static_cast<std::uint32_t>(mixed(plan_.seed, i, ++place.lives) | 1);
    place.host = std::make_unique<SimulatedHost>(plan_, i, epoch, place.clock + kBegin, now_);
    place.asleep = place.awake = now_;
    disturb(place, now_);
    steps_[i] = now_;
    log(fmt::format("host {} starts as {:x}", i, epoch));
  }

  // Executes the starts and faults that are due.
  void befall() {
    for (std::size_t i = 0; i < places_.size(); ++i) {
      if (places_[i].lives == 0 && now_ >= plan_.hosts[i].start) start(i);
    }
    for (std::size_t k = returns_.size(); k-- > 0;) {
      if (now_ < returns_[k].first) continue;
      const std::size_t host = returns_[k].second;
      returns_.erase(returns_.begin() + static_cast<std::ptrdiff_t>(k));
      if (!places_[host].host) start(host);
    }
    for (; fault_ < plan_.faults.size() && now_ >= plan_.faults[fault_].at; ++fault_) {
      befall(plan_.faults[fault_]);
    }
    std::erase_if(splits_, [&](const Fault& split) {
      if (now_ < split.until) return false;
      for (Place& place : places_) disturb(place, now_);
      return true;
    });
  }

  // The awake scene leader; the fault's host if there is none.
  [[nodiscard]] std::size_t befallen(const Fault& fault) const {
    if (!is_of_leader(fault.kind)) return fault.host;
    const auto leading = std::find_if(places_.begin(), places_.end(), [&](const Place& place) {
      return place.host && now_ >= place.awake && place.host->role().leads(aoim::kWholeScene);
    });
    return leading == places_.end() ? fault.host
                                    : static_cast<std::size_t>(leading - places_.begin());
  }

  void befall(Fault fault) {
    fault.host = befallen(fault);
    Place& place = places_[fault.host];
    if (!place.host) return;
    log(text_of(fault));
    switch (fault.kind) {
      case FaultKind::kill:
        place.host.reset();
        return;
      case FaultKind::leader_depart:
        say_goodbye(fault.host);
        [[fallthrough]];
      case FaultKind::restart:
      case FaultKind::leader_restart:
        place.host.reset();
        returns_.emplace_back(fault.until, fault.host);
        return;
      case FaultKind::depart:
        say_goodbye(fault.host);
        place.host.reset();
        return;
      case FaultKind::pause:
      case FaultKind::leader_pause:
        if (now_ >= place.awake) place.asleep = now_;
        place.awake = std::max(place.awake, fault.until);
        disturb(place, place.awake);
        return;
      case FaultKind::split:
        splits_.push_back(fault);
        for (Place& other : places_) disturb(other, fault.until);
        return;
      case FaultKind::clock_step:
        place.clock += fault.step;
        place.host->set_clock(place.clock + kBegin);
        return;
      case FaultKind::move:
        place.host->move(fault.place);
        return;
      default:
        return forge(fault, *place.host);
    }
  }

  void say_goodbye(std::size_t i) {
    if (now_ >= places_[i].awake) places_[i].host->say_goodbye(now_, sink(i));
  }

  void forge(const Fault& fault, const SimulatedHost& victim) {
    for (const Datagram& datagram : forged(fault, victim)) {
      const auto shared = std::make_shared<const Datagram>(datagram);
      for (std::size_t to = 0; to < places_.size(); ++to) {
        deliveries_.add(now_ + milliseconds(1), {to, shared});
      }
    }
  }

  void change_states() {
    if (now_ >= plan_.calm + seconds(6)) return;
    // The last time all hosts do it, and no datagram is lost.
    const double share = now_ >= plan_.calm + seconds(5) ? 1.0 : 0.5;
    for (Place& place : places_) {
      if (place.host && dice_.chance(share)) place.host->change();
    }
  }

  // Kills the leader of a cell that others are in.
  void kill_a_leader() {
    std::vector<std::size_t> leaders;
    for (std::size_t i = 0; i < places_.size(); ++i) {
      if (!places_[i].host) continue;
      const SimulatedHost& host = *places_[i].host;
      if (host.role().leads(host.cell()) || host.role().leads(aoim::kWholeScene))
        leaders.push_back(i);
    }
    if (leaders.empty()) return;
    const std::size_t victim = leaders[dice_.below(leaders.size())];
    log(fmt::format("host {} is killed in the calm", victim));
    places_[victim].host.reset();
  }

  [[nodiscard]] bool are_apart(std::size_t a, std::size_t b) const noexcept {
    return std::any_of(splits_.begin(), splits_.end(), [&](const Fault& split) {
      return (split.side >> a & 1) != (split.side >> b & 1);
    });
  }

  struct Sink {
    Trial* trial;
    std::size_t from;
    void operator()(aoim::GroupIndex group, std::span<const std::byte> octets) const {
      trial->send(from, group, octets);
    }
  };
  Sink& sink(std::size_t from) {
    sink_ = {this, from};
    return sink_;
  }

  void send(std::size_t from, aoim::GroupIndex group, std::span<const std::byte> octets) {
    const auto source = address_of(9, 0, static_cast<std::uint8_t>(from),
                                   static_cast<std::uint16_t>(4000 + places_[from].lives));
    const auto datagram =
        std::make_shared<const Datagram>(Datagram{{octets.begin(), octets.end()}, group, source});
    const bool calm = now_ >= plan_.calm;
    for (std::size_t to = 0; to < places_.size(); ++to) {
      if (are_apart(from, to)) continue;
      const int copies = !calm && dice_.chance(plan_.line.duplicates) ? 2 : 1;
      for (int copy = 0; copy < copies; ++copy) {
        if (to != from && !calm && dice_.chance(plan_.line.loss)) continue;
        if (to != from && loses_part(to, *datagram)) continue;
        const double late = 1.0 + (calm ? 0.0 : plan_.line.jitter * dice_.unit());
        const auto delay = pdu::from_seconds(late * pdu::to_seconds(plan_.line.delay));
        const bool unheard = loses_maps(from, to);
        deliveries_.add(now_ + delay, {to, unheard ? without_maps(datagram) : datagram});
      }
    }
  }

  // Without this, the loss would occur once in thousands of seeds; now it occurs in many.
  [[nodiscard]] bool loses_maps(std::size_t from, std::size_t to) const {
    if (!plan_.loses_maps || now_ < plan_.calm || now_ >= plan_.calm + kMapsUnheard) return false;
    const auto leads = [](const Place& place) {
      return place.host && place.host->role().leads(aoim::kWholeScene);
    };
    return leads(places_[to]) && !leads(places_[from]);
  }

  // Drops half of the snapshot parts to the newcomer of the calm, each part once: a repeated part
  // arrives.
  bool loses_part(std::size_t to, const Datagram& datagram) {
    if (to + 1 != places_.size() || !places_[to].host) return false;
    bool loses = false;
    for (const pdu::BundledPdu& bundled : pdu::BundleReader(datagram.octets)) {
      pdu::CellSnapshot part;
      if (bundled.header.pdu_type != pdu::PduType::cell_snapshot) continue;
      if (pdu::decode(bundled.bytes, part) != pdu::DecodeError::none) continue;
      // A host that follows the newcomer's beacon is also a newcomer to its cell, and gets its own
      // introduction.
      const std::uint16_t serial = plan_.beacons ? part.serial : 0;
      const auto say = [&](std::uint16_t of) {
        return said_.emplace(part.epoch, part.column, part.row, of, part.part).second;
      };
      const bool first = say(0), again = serial == 0 ? !first : !say(serial);
      if (again) watch_.note_said_again(part);
      loses = loses || (plan_.loses_parts && first && dice_.chance(0.5));
    }
    return loses;
  }

  void deliver() {
    while (deliveries_.next() <= now_) {
      auto entry = deliveries_.take();
      Delivery& delivery = entry.event;
      const Datagram& datagram = *delivery.datagram;
      Place& place = places_[delivery.to];
      if (!place.host || !place.host->hears(datagram.group)) continue;
      if (now_ < place.awake) {
        if (place.waiting++ >= kSocket) continue;
        delivery.came = delivery.came.value_or(entry.at);
        entry.at = place.awake;
        deliveries_.put_back(std::move(entry));
        continue;
      }
      place.waiting = 0;
      ++outcome_.received;
      outcome_.hash = mixed(outcome_.hash, datagram.octets.size(), delivery.to);
      place.host->receive(datagram.group, datagram.octets, now_, datagram.from,
                          delivery.came.value_or(now_));
      watch_.note(place, now_);
      steps_[delivery.to] = std::min(steps_[delivery.to], place.host->next(now_));
    }
  }

  void step(std::size_t i) {
    Place& place = places_[i];
    if (!place.host || now_ < place.awake || now_ < steps_[i]) return;
    place.host->step(now_, sink(i));
    watch_.note(place, now_);
    steps_[i] = std::max(place.host->next(now_), now_ + std::chrono::microseconds(100));
    if (!keep_log_) return;
    const std::uint32_t led = place.host->role().leader(place.host->cell());
    const std::uint32_t root = place.host->role().leader(aoim::kWholeScene);
    const auto said = std::make_pair(led, root);
    if (std::exchange(told_[i], said) == said) return;
    log(fmt::format("host {} in cell {} {}: led by {:x}, scene by {:x}", i, place.host->cell().q,
                    place.host->cell().r, led, root));
  }

  const Plan& plan_;
  bool keep_log_;
  Dice dice_;
  Watch watch_;
  std::vector<Place> places_;
  std::array<nanoseconds, kMostHosts + 1> steps_{};
  std::array<std::pair<std::uint32_t, std::uint32_t>, kMostHosts + 1> told_{};
  Agenda<Delivery> deliveries_;
  std::vector<Fault> splits_;
  std::vector<std::pair<nanoseconds, std::size_t>> returns_;
  std::set<std::tuple<std::uint32_t, std::int32_t, std::int32_t, std::uint16_t, std::uint16_t>>
      said_;  ///< snapshot parts on their way to the newcomer of the calm
  std::size_t fault_ = 0;
  nanoseconds now_{};
  Sink sink_{};
  Outcome outcome_;
};

}  // namespace

Outcome try_out(const Plan& plan, bool keep_log) { return Trial(plan, keep_log).run(); }

}  // namespace reckon::fuzz::leaders
