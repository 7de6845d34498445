// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tests/fuzz/peers/trial.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "reckon/pdu/seconds.hpp"
#include "reckon/tests/fuzz/peers/claim_watch.hpp"
#include "reckon/tests/fuzz/peers/cut_watch.hpp"
#include "reckon/tests/fuzz/peers/event_log.hpp"
#include "reckon/tests/fuzz/peers/event_name.hpp"
#include "reckon/tests/fuzz/peers/forger.hpp"
#include "reckon/tests/fuzz/search/agenda.hpp"

namespace reckon::fuzz {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr nanoseconds kUtc = seconds(1'800'000'000);
constexpr nanoseconds kArrival = milliseconds(500);  // of datagrams under way when the faults end
constexpr nanoseconds kProbe = seconds(12), kEnd = milliseconds(14'300);
constexpr nanoseconds kLook = milliseconds(50);
constexpr nanoseconds kEcho = std::chrono::microseconds(50);
constexpr nanoseconds kNap = milliseconds(1200);  // shorter ones need not be noticed
constexpr nanoseconds kCalmDelay = milliseconds(1);

enum class What : std::uint8_t {
  start,
  kill,
  wake,
  arrive,
  fault,
  fault_end,
  forge,
  look,
  look_at_cut
};

struct Event {
  What what;
  std::size_t which;  ///< host, life or fault
  SharedDatagram datagram;
};

class Trial {
 public:
  Trial(const Plan& plan, bool keep_log)
      : plan_(plan),
        keep_log_(keep_log),
        calm_(plan.faults_end + kArrival),
        watch_(plan, lives_, calm_, calm_ + kProbe),
        cuts_(plan, lives_),
        claims_(plan, lives_),
        dice_(mixed(plan.seed, 2)),
        clocks_(plan.hosts.size(), kUtc) {
    lives_.reserve(4 * plan.hosts.size() + 64);
  }

  Outcome run();

 private:
  void plan_ahead();
  void at(nanoseconds when, What what, std::size_t which, SharedDatagram datagram = {}) {
    agenda_.add(when, {what, which, std::move(datagram)});
  }
  void happen(const Event& event);
  void begin_fault(std::size_t which);
  void end_fault(std::size_t which);
  void forge(std::size_t which);
  void start(std::size_t host);
  void kill(std::size_t host, bool politely);
  void wake_up(std::size_t life);
  [[nodiscard]] std::size_t living(std::size_t host) const noexcept;
  [[nodiscard]] bool is_cut(std::size_t from, std::size_t to) const noexcept;
  void send(PeerDatagram datagram);
  void carry(const SharedDatagram& datagram, std::size_t to);
  void arrive(std::size_t life, const SharedDatagram& datagram);
  void receive(std::size_t life, const PeerDatagram& datagram);
  void step(std::size_t life);
  [[nodiscard]] bool is_a_life(std::uint32_t epoch) const noexcept {
    return std::any_of(lives_.begin(), lives_.end(),
                       [epoch](const Life& life) { return life.epoch == epoch; });
  }
  void take_events(std::size_t life, const PeerDatagram* cause);
  void note(std::uint64_t value) noexcept { hash_ = (hash_ ^ value) * 0x100000001b3ULL; }
  template <typename... T>
  void tell(std::size_t life, fmt::format_string<T...> format, T&&... values);

  const Plan& plan_;
  bool keep_log_;
  nanoseconds now_{}, calm_;
  std::vector<Life> lives_;
  Watch watch_;
  CutWatch cuts_;
  ClaimWatch claims_;
  Dice dice_;
  std::vector<nanoseconds> clocks_;  ///< of the hosts: UTC - now
  std::vector<std::size_t> active_;  ///< faults
  std::vector<std::uint32_t> forged_count_;
  Agenda<Event> agenda_;
  std::uint64_t hash_ = 0xcbf29ce484222325ULL, received_ = 0;
  EventLog log_;
};

template <typename... T>
void Trial::tell(std::size_t life, fmt::format_string<T...> format, T&&... values) {
  if (!keep_log_) return;
  const std::string who =
      life == kNobody ? "" : fmt::format("peer {} {:08x} ", lives_[life].host, lives_[life].epoch);
  log_.add(life, fmt::format("{:9.4f} {}{}", pdu::to_seconds(now_), who,
                             fmt::format(format, std::forward<T>(values)...)));
}

Outcome Trial::run() {
  plan_ahead();
  const nanoseconds end = calm_ + kEnd;
  while (!watch_.finding() && agenda_.next() <= end) {
    const auto entry = agenda_.take();
    now_ = entry.at;
    happen(entry.event);
  }
  return {watch_.finding(), hash_, received_,
          keep_log_ ? log_.lines(watch_.finding()) : std::vector<std::string>()};
}

void Trial::plan_ahead() {
  for (std::size_t i = 0; i < plan_.at_first; ++i) at(plan_.hosts[i].start, What::start, i);
  for (std::size_t i = 0; i < plan_.faults.size(); ++i) {
    at(plan_.faults[i].at, What::fault, i);
    at(plan_.faults[i].until, What::fault_end, i);
    if (cuts_.concerns(plan_.faults[i])) {
      at(plan_.faults[i].at + cuts_.patience(), What::look_at_cut, i);
    }
  }
  forged_count_.assign(plan_.faults.size(), 0);
  if (plan_.probe == Probe::newcomers) {
    for (std::size_t i = plan_.at_first; i < plan_.hosts.size(); ++i) {
      at(calm_ + kProbe, What::start, i);
    }
  } else {
    const nanoseconds down = milliseconds(100) + nanoseconds(mixed(plan_.seed, 6) % 2'500'000'000);
    at(calm_ + kProbe - down, What::kill, plan_.probed);
    at(calm_ + kProbe, What::start, plan_.probed);
  }
  for (nanoseconds look = calm_; look <= calm_ + kEnd; look += kLook) at(look, What::look, 0);
}

void Trial::happen(const Event& event) {
  switch (event.what) {
    case What::start:
      return start(event.which);
    case What::kill:
      return kill(event.which, false);
    case What::wake:
      if (lives_[event.which].wake == now_) step(event.which);
      return;
    case What::arrive:
      return arrive(event.which, event.datagram);
    case What::fault:
      return begin_fault(event.which);
    case What::fault_end:
      return end_fault(event.which);
    case What::forge:
      return forge(event.which);
    case What::look:
      return watch_.look(now_);
    case What::look_at_cut:
      return cuts_.look(event.which, now_,
                        [this](std::size_t life, std::size_t other, std::string sentence) {
                          watch_.report(11, now_, life, other, std::move(sentence));
                        });
  }
}

// --------------------------------------------------------------------------------------- faults

std::size_t Trial::living(std::size_t host) const noexcept {
  for (std::size_t i = lives_.size(); i-- > 0;) {
    if (lives_[i].host == host && lives_[i].alive) return i;
  }
  return kNobody;
}

void Trial::start(std::size_t host) {
  if (living(host) != kNobody) return;
  const std::size_t life = lives_.size();
  Life& born = lives_.emplace_back();
  born.host = host;
  born.epoch = static_cast<std::uint32_t>(mixed(plan_.seed, 4, life * 1000 + host)) | 1;
  const std::size_t port = plan_.hosts[host].keeps_port ? host : life + kMostPeers;
  born.from = address_of(0, 0, static_cast<std::uint8_t>(host / 4),
                         static_cast<std::uint16_t>(40'000 + port));
  born.born = born.id_since = now_;
  born.peer = std::make_unique<SimulatedPeer>(plan_, host, born.epoch, now_, clocks_[host]);
  born.ids.push_back(born.peer->id());
  tell(life, "starts as {}:{}", born.peer->id().site, born.peer->id().application);
  step(life);
}

void Trial::kill(std::size_t host, bool politely) {
  const std::size_t life = living(host);
  if (life == kNobody) return;
  if (politely && !lives_[life].frozen) {
    lives_[life].peer->leave(now_, [&](aoim::GroupIndex group, std::span<const std::byte> octets) {
      send({{{octets.begin(), octets.end()}, group, lives_[life].from}, life, lives_[life].epoch});
    });
    lives_[life].left = true;
  }
  tell(life, "{}", lives_[life].left ? "leaves" : "is killed");
  lives_[life].alive = false;
  lives_[life].ended = now_;
}

void Trial::begin_fault(std::size_t which) {
  const Fault& fault = plan_.faults[which];
  cuts_.see_begin(which, now_);
  active_.push_back(which);
  const std::size_t life = living(fault.peer);
  tell(kNobody, "begins: {}", text_of(fault));
  if (is_forgery(fault.kind)) at(now_, What::forge, which);
  switch (fault.kind) {
    case FaultKind::kill:
    case FaultKind::restart:
      return kill(fault.peer, false);
    case FaultKind::depart:
      return kill(fault.peer, true);
    case FaultKind::pause:
      if (life == kNobody || lives_[life].frozen) return;
      lives_[life].frozen = true;
      lives_[life].frozen_at = now_;
      return;
    case FaultKind::clock_step:
      clocks_[fault.peer] += fault.step;
      if (life != kNobody) lives_[life].peer->set_clock(clocks_[fault.peer]);
      return;
    default:
      return;
  }
}

void Trial::end_fault(std::size_t which) {
  const Fault& fault = plan_.faults[which];
  std::erase(active_, which);
  tell(kNobody, "ends: {}", text_of(fault));
  if (fault.kind == FaultKind::restart || fault.kind == FaultKind::depart) start(fault.peer);
  if (fault.kind == FaultKind::pause) {
    const std::size_t life = living(fault.peer);
    if (life != kNobody && lives_[life].frozen) wake_up(life);
  }
}

// The loop reads its socket, then continues.
void Trial::wake_up(std::size_t life) {
  lives_[life].frozen = false;
  const nanoseconds nap = now_ - lives_[life].frozen_at;
  lives_[life].slept += nap;
  if (nap > kNap) lives_[life].slept_long += nap;
  tell(life, "wakes up with {} datagrams", lives_[life].held.size());
  for (const SharedDatagram& datagram : std::exchange(lives_[life].held, {})) {
    if (!watch_.finding()) receive(life, *datagram);
  }
  step(life);
}

void Trial::forge(std::size_t which) {
  const Fault& fault = plan_.faults[which];
  if (now_ >= fault.until) return;
  at(now_ + fault.interval, What::forge, which);
  const std::size_t victim = living(fault.peer);
  if (victim == kNobody) return;
  for (std::size_t i = 0; i < forged_at_once(fault.kind); ++i) {
    send(forged(fault, lives_[victim], forged_count_[which]++, now_ + kUtc));
  }
}

// -------------------------------------------------------------------------------------- network

bool Trial::is_cut(std::size_t from, std::size_t to) const noexcept {
  return std::any_of(active_.begin(), active_.end(),
                     [&](std::size_t which) { return cuts(plan_.faults[which], from, to); });
}

void Trial::send(PeerDatagram datagram) {
  if (datagram.sender != kNobody) datagram.announces = announced_in(datagram.octets);
  const auto shared = std::make_shared<const PeerDatagram>(std::move(datagram));
  for (std::size_t i = 0; i < lives_.size(); ++i) {
    if (lives_[i].alive) carry(shared, i);
  }
}

void Trial::carry(const SharedDatagram& datagram, std::size_t to) {
  const std::size_t sender = datagram->sender;
  const auto arrives = [&](nanoseconds after) {
    const nanoseconds when = now_ + after;
    at(now_ < calm_ ? std::min(when, std::max(calm_, now_)) : when, What::arrive, to, datagram);
  };
  if (sender == to) return arrives(kEcho);
  if (now_ >= plan_.faults_end || sender == kNobody) return arrives(kCalmDelay);
  if (is_cut(lives_[sender].host, lives_[to].host)) return;
  const auto delay = [this] {
    return plan_.line.delay +
           pdu::from_seconds(plan_.line.jitter * dice_.unit() * pdu::to_seconds(plan_.line.delay));
  };
  if (!dice_.chance(plan_.line.loss)) arrives(delay());
  if (dice_.chance(plan_.line.duplicates)) arrives(delay());
}

void Trial::arrive(std::size_t life, const SharedDatagram& datagram) {
  Life& to = lives_[life];
  if (!to.alive) return;
  if (to.frozen) {
    if (to.held.size() < kSocket) to.held.push_back(datagram);
    return;
  }
  if (!to.peer->is_joined(datagram->group)) return;
  receive(life, *datagram);
  step(life);
}

void Trial::receive(std::size_t life, const PeerDatagram& datagram) {
  ++received_;
  Life& to = lives_[life];
  const bool listed = to.peer->lists(datagram.epoch, datagram.from);
  const std::uint64_t counted = to.peer->counted();
  const aoim::Incoming incoming =
      to.peer->receive(datagram.group, datagram.octets, now_, datagram.from);
  if (!listed && to.peer->counted() != counted) watch_.see_counted_stranger(life, datagram, now_);
  note(static_cast<std::uint64_t>(now_.count()));
  note(datagram.epoch + static_cast<std::uint64_t>(incoming.verdict));
  // Of the stranger's datagrams only those with forged epochs count.
  const bool named = datagram.sender != kNobody || !is_a_life(datagram.epoch);
  if (named) {
    const bool known = to.peer->find(datagram.epoch) != nullptr;
    to.note_heard(datagram.epoch, now_, known && incoming.verdict == aoim::IncomingVerdict::use,
                  datagram.announces.has_value());
  }
  watch_.see_received(life, datagram, incoming, now_);
  claims_.see_received(life, datagram, now_);
  take_events(life, &datagram);
}

void Trial::step(std::size_t life) {
  Life& own = lives_[life];
  if (!own.alive || own.frozen) return;
  own.peer->step(now_, [&](aoim::GroupIndex group, std::span<const std::byte> octets) {
    send({{{octets.begin(), octets.end()}, group, own.from}, life, own.epoch});
  });
  take_events(life, nullptr);
  watch_.see_step(life, now_);
  const nanoseconds next = std::max(own.peer->next(now_), now_ + std::chrono::microseconds(1));
  if (own.wake == next) return;
  own.wake = next;
  at(next, What::wake, life);
}

void Trial::take_events(std::size_t life, const PeerDatagram* cause) {
  Life& own = lives_[life];
  for (const aoim::PresenceEvent& event : own.peer->take_events()) {
    const auto kind = static_cast<std::uint64_t>(event.kind);
    note(kind << 32 | event.announced.epoch);
    tell(life, "{} {}:{} {:08x}", name_of(event.kind), event.peer().site, event.peer().application,
         event.announced.epoch);
    watch_.see_event(life, event, cause, now_);
    cuts_.see_event(life, event, now_);
    claims_.see_event(life, event);
    if (event.kind != aoim::PresenceEventKind::identity_changed) continue;
    own.ids.push_back(event.peer());
    own.id_since = now_;
  }
  claims_.look(life, now_, [&](std::size_t other, std::string sentence) {
    watch_.report(12, now_, life, other, std::move(sentence));
  });
}

}  // namespace

Outcome try_out(const Plan& plan, bool keep_log) { return Trial(plan, keep_log).run(); }

}  // namespace reckon::fuzz
