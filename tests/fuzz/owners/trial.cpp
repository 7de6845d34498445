// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tests/fuzz/owners/trial.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <variant>

#include "reckon/pdu/seconds.hpp"
#include "reckon/tests/fuzz/search/agenda.hpp"
#include "reckon/tests/fuzz/search/dice.hpp"

namespace reckon::fuzz::owners {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

struct Step {
  std::size_t peer;
};
struct Arrive {
  std::size_t peer;
  std::uint32_t to, from;  // epochs
  std::size_t message;     // in the store
  std::size_t record;      // of an assured one, or kNoRecord
};
constexpr std::size_t kNoRecord = ~std::size_t{0};
// A transmission of an assured message is due.
struct Repeat {
  std::size_t record;
};
// Its acknowledgement has arrived.
struct Acknowledged {
  std::size_t record;
};
struct Yielded {
  std::size_t peer;
  std::uint32_t epoch, transaction;
};
struct TouchChange {
  std::size_t touch;
  bool begins;
};
struct FaultChange {
  std::size_t fault;
  bool begins;
};
struct Heal {};
struct UsersWord {};
using Event = std::variant<Step, Arrive, Repeat, Acknowledged, Yielded, TouchChange, FaultChange,
                           Heal, UsersWord>;

class Trial {
 public:
  Trial(const Plan& plan, bool keep_log)
      : plan_(plan), dice_(mixed(plan.seed, 78)), keep_log_(keep_log) {
    owners_.reserve(plan.peers);  // the protocols keep references
    for (std::size_t i = 0; i < plan.peers; ++i) {
      owners_.emplace_back(plan, i);
      owners_.back().begin(static_cast<std::uint32_t>(i));
    }
    outcome_.is_calm = plan.faults.empty() && plan.line.late == 0.0;
    loss_ = plan.line.loss;
  }

  Outcome run() {
    Watch watch(plan_, owners_, outcome_, audit_);
    watch_ = &watch;
    for (std::size_t i = 0; i < owners_.size(); ++i)
      agenda_.add(dice_.between({}, milliseconds(200)), Step{i});
    for (std::size_t i = 0; i < plan_.touches.size(); ++i) {
      agenda_.add(plan_.touches[i].from, TouchChange{i, true});
      agenda_.add(plan_.touches[i].to, TouchChange{i, false});
    }
    for (std::size_t i = 0; i < plan_.faults.size(); ++i) {
      agenda_.add(plan_.faults[i].at, FaultChange{i, true});
      agenda_.add(plan_.faults[i].until, FaultChange{i, false});
    }
    agenda_.add(kHealed, Heal{});
    agenda_.add(kHealed + seconds(5), UsersWord{});
    Nanoseconds looked{0};
    while (agenda_.next() <= kEnd && !outcome_.finding) {
      auto entry = agenda_.take();
      now_ = entry.at;
      std::visit([this](const auto& event) { happen(event); }, entry.event);
      if (now_ - looked >= milliseconds(10)) {
        looked = now_;
        watch.look_closely(now_);
      } else if (has_changed_) {
        watch.look(now_);
      }
      has_changed_ = false;
    }
    if (!outcome_.finding) watch.look_at_end(now_);
    if (keep_log_) note_states();
    for (const SimulatedOwner& owner : owners_) {
      outcome_.hand_overs += owner.protocol().counts().taken;
      outcome_.adoptions += owner.protocol().counts().adopted;
    }
    return std::move(outcome_);
  }

 private:
  void happen(const Step& step) {
    SimulatedOwner& owner = owners_[step.peer];
    agenda_.add(now_ + dice_.between(plan_.step / 2, plan_.step), step);
    if (!owner.runs()) return;
    owner.protocol().step(now_);
    flush(step.peer);
    if (owner.protocol().has_left())
      note(fmt::format("peer {} has left", step.peer)), owner.set_up(false);
  }
  void happen(const Arrive& arrival) {
    SimulatedOwner& owner = owners_[arrival.peer];
    const auto& [message, sent] = store_[arrival.message];
    if (!owner.runs() || owner.epoch() != arrival.to) return;
    if (arrival.record != kNoRecord) {
      Record& record = records_[arrival.record];
      if (const auto delay = transit(record.to, record.from, false))
        agenda_.add(now_ + *delay, Acknowledged{arrival.record});
      // A copy is rarely taken twice: the protocol must stand it.
      const bool is_again = std::exchange(record.is_taken, true);
      if (is_again && !dice_.chance(plan_.line.doubled)) return;
    }
    ++outcome_.received;
    outcome_.hash = mixed(outcome_.hash, arrival.from, message.index() + now_.count());
    owner.protocol().receive(arrival.from, message, now_);
    if (std::holds_alternative<peer::Round>(message))
      audit_.note_round(arrival.to, arrival.from, sent);
    has_changed_ = true;
    flush(arrival.peer);
  }
  // The times of AcknowledgedSet.
  void happen(const Repeat& repeat) {
    Record& record = records_[repeat.record];
    const SimulatedOwner& from = owners_[record.from];
    const Nanoseconds age = now_ - record.begun;
    const bool is_current =
        from.epoch() == record.from_epoch && owners_[record.to].epoch() == record.to_epoch;
    if (record.is_acknowledged || !is_current || age > seconds(5)) return;
    agenda_.add(now_ + std::clamp<Nanoseconds>(age, milliseconds(3), milliseconds(200)), repeat);
    if (from.runs()) carry(record.from, record.to, record.message, repeat.record);
  }
  void happen(const Acknowledged& acknowledged) {
    records_[acknowledged.record].is_acknowledged = true;
  }
  void happen(const Yielded& yielded) {
    SimulatedOwner& owner = owners_[yielded.peer];
    if (!owner.is_up() || owner.epoch() != yielded.epoch) return;
    if (!owner.runs()) return agenda_.add(now_ + milliseconds(10), yielded);
    owner.protocol().yielded(yielded.transaction, now_);
    flush(yielded.peer);
  }
  void happen(const TouchChange& change) {
    const Touch& touch = plan_.touches[change.touch];
    SimulatedOwner& owner = owners_[touch.peer];
    if (now_ >= kHealed && change.begins) return;
    if (!owner.runs()) {
      if (!change.begins) owner.touch(touch.object, false);
    } else {
      owner.touch(touch.object, change.begins);
    }
    if (owner.runs() || !change.begins)
      watch_->note_touch(touch, change.begins && owner.runs(), now_);
    flush(touch.peer);
  }
  void happen(const FaultChange& change) {
    const Fault& fault = plan_.faults[change.fault];
    SimulatedOwner& owner = owners_[fault.peer];
    note(fmt::format("{}{}", change.begins ? "" : "end of ", text_of(fault)));
    switch (fault.kind) {
      case FaultKind::crash:
      case FaultKind::restart:
        if (change.begins) return owner.set_up(false);
        if (!owner.is_up()) restart(fault.peer);
        return;
      case FaultKind::pause:
        return owner.set_paused(change.begins);
      case FaultKind::leave:
        if (change.begins) return owner.protocol().leave();
        owner.set_up(false);
        restart(fault.peer);
        return;
      case FaultKind::partition:
      case FaultKind::one_way:
      case FaultKind::deaf:
      case FaultKind::choke:
      case FaultKind::mute:
      case FaultKind::bridge:
        if (change.begins) return cuts_.push_back(fault);
        std::erase_if(cuts_, [&](const Fault& cut) {
          return cut.at == fault.at && cut.kind == fault.kind && cut.peer == fault.peer;
        });
    }
  }
  void happen(const Heal&) {
    cuts_.clear();
    loss_ = std::min(loss_, 0.3);
    for (std::size_t i = 0; i < owners_.size(); ++i) {
      owners_[i].set_paused(false);
      if (!owners_[i].is_up()) restart(i);
    }
  }
  // In a world that lacks a majority for ever, or whose gifts nobody knows any more, the user of
  // the most senior voter goes on alone.
  void happen(const UsersWord&) {
    for (std::size_t i = 0; i < owners_.size(); ++i) {
      const auto& acts = owners_[i].protocol().acts();
      const peer::Roll& roll = acts.decided().roll;
      const auto lives = [&](const peer::Voter& voter) {
        return std::ranges::any_of(owners_, [&](const SimulatedOwner& owner) {
          return owner.epoch() == voter.epoch && owner.runs();
        });
      };
      const bool is_known = std::ranges::any_of(owners_, [&](const SimulatedOwner& owner) {
        return owner.runs() && owner.protocol().is_informed() &&
               owner.protocol().world() == owners_[i].protocol().world();
      });
      const bool has_majority =
          is_known && roll.is_majority(lives) && acts.newest().roll.is_majority(lives);
      if (!owners_[i].runs() || !acts.exists() || has_majority) continue;
      const auto first = std::ranges::find_if(roll.voters(), lives);
      if (first != roll.voters().end() && first->epoch != owners_[i].epoch()) continue;
      note(fmt::format("peer {} goes alone", i));
      return owners_[i].protocol().go_alone(static_cast<std::uint32_t>(10 + pdu::to_seconds(now_)),
                                            now_);
    }
  }
  void restart(std::size_t peer) {
    owners_[peer].begin(static_cast<std::uint32_t>(10 + pdu::to_seconds(now_)));
    audit_.note_start(peer);
    for (std::size_t i = 0; i < plan_.objects; ++i) {
      if (owners_[peer].is_busy(i)) owners_[peer].touch(i, true);
    }
  }

  [[nodiscard]] bool is_cut(std::size_t from, std::size_t to, bool is_round) const {
    return std::ranges::any_of(cuts_, [&](const Fault& cut) {
      if (cut.kind == FaultKind::one_way) return cut.peer == from && cut.other == to;
      if (cut.kind == FaultKind::deaf) return cut.peer == to;
      if (cut.kind == FaultKind::mute) return cut.peer == from;
      if (cut.kind == FaultKind::bridge && (cut.peer == from || cut.peer == to)) return false;
      if (cut.kind == FaultKind::choke) return !is_round && (cut.peer == from || cut.peer == to);
      return ((cut.side >> from ^ cut.side >> to) & 1U) != 0;
    });
  }

  void flush(std::size_t peer) {
    SimulatedOwner& owner = owners_[peer];
    audit_.note(peer, now_);
    for (const peer::OwnershipEvent& event : owner.protocol().events()) {
      has_changed_ = true;
      if (keep_log_) note(text_of_event(peer, event));
      if (event.kind == peer::OwnershipEvent::Kind::yield)
        agenda_.add(now_ + dice_.between({}, milliseconds(3)),
                    Yielded{peer, owner.epoch(), event.transaction});
    }
    owner.protocol().clear_events();
    for (const peer::OutgoingMessage& out : owner.protocol().outgoing()) {
      store_.push_back({out.message, now_});
      for (std::size_t to = 0; to < owners_.size(); ++to) {
        if (to == peer || (out.to != 0 && out.to != owners_[to].epoch())) continue;
        if (out.is_assured) {
          records_.push_back(
              {peer, to, owner.epoch(), owners_[to].epoch(), store_.size() - 1, now_});
          happen(Repeat{records_.size() - 1});
        } else {
          carry(peer, to, store_.size() - 1, kNoRecord);
        }
      }
    }
    owner.protocol().clear_outgoing();
  }
  // The delay of a datagram; nothing if it is lost.
  [[nodiscard]] std::optional<Nanoseconds> transit(std::size_t from, std::size_t to,
                                                   bool is_round) {
    if (is_cut(from, to, is_round) || dice_.chance(loss_)) return {};
    Nanoseconds delay = dice_.between(plan_.line.least, plan_.line.most);
    if (dice_.chance(plan_.line.late)) delay += dice_.between({}, seconds(4));
    return delay;
  }
  void carry(std::size_t from, std::size_t to, std::size_t message, std::size_t record) {
    const bool is_round = std::holds_alternative<peer::Round>(store_[message].message);
    const int copies = dice_.chance(plan_.line.doubled) ? 2 : 1;
    for (int i = 0; i < copies; ++i) {
      if (const auto delay = transit(from, to, is_round))
        agenda_.add(now_ + *delay,
                    Arrive{to, owners_[to].epoch(), owners_[from].epoch(), message, record});
    }
  }
  static std::string text_of_event(std::size_t peer, const peer::OwnershipEvent& event) {
    static constexpr const char* kKinds[] = {"gains", "loses", "yields", "merges"};
    std::string objects;
    for (std::size_t i = 0; i < event.objects.size(); ++i) {
      if (event.objects[i]) objects += fmt::format(" {}", i);
    }
    return fmt::format("peer {} {}{} (cause {}, peer {}, transaction {})", peer,
                       kKinds[static_cast<std::size_t>(event.kind)], objects,
                       static_cast<int>(event.cause), event.peer, event.transaction);
  }
  void note_states() {
    for (std::size_t i = 0; i < owners_.size(); ++i) {
      const peer::Ownership& protocol = owners_[i].protocol();
      const peer::ActBook& acts = protocol.acts();
      std::string voters;
      for (const peer::Voter& voter : acts.newest().roll.voters())
        voters += fmt::format(" {}", voter.epoch);
      note(fmt::format("peer {} ({}){}: world {}, act {}{}, voters{}, {}, table {:08x}", i,
                       owners_[i].epoch(), owners_[i].runs() ? "" : " stopped",
                       protocol.world().founder, acts.decided().number,
                       acts.pending() == nullptr ? "" : " and a pending one", voters,
                       protocol.has_lease(now_) ? "lease" : "no lease", protocol.table().hash()));
      for (std::size_t object = 0; object < plan_.objects; ++object)
        note(fmt::format("  object {}: {:x} of {}{}", object, protocol.tenure(object).version,
                         protocol.tenure(object).owner,
                         protocol.owns(object, now_) ? ", owned" : ""));
    }
  }
  void note(std::string line) {
    if (keep_log_) outcome_.log.push_back(fmt::format("{:8.4f} {}", pdu::to_seconds(now_), line));
  }

  const Plan& plan_;
  Dice dice_;
  bool keep_log_;
  Outcome outcome_;
  std::vector<SimulatedOwner> owners_;
  Audit audit_{plan_, owners_, outcome_};
  Watch* watch_ = nullptr;
  Agenda<Event> agenda_;
  struct Stored {
    peer::OwnershipMessage message;
    Nanoseconds sent;
  };
  std::deque<Stored> store_;
  struct Record {
    std::size_t from, to;
    std::uint32_t from_epoch, to_epoch;
    std::size_t message;
    Nanoseconds begun;
    bool is_taken = false, is_acknowledged = false;
  };
  std::deque<Record> records_;
  std::vector<Fault> cuts_;
  double loss_ = 0.0;
  bool has_changed_ = false;
  Nanoseconds now_{0};
};

}  // namespace

Outcome try_out(const Plan& plan, bool keep_log) { return Trial(plan, keep_log).run(); }

}  // namespace reckon::fuzz::owners
