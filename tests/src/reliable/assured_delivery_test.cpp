// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// One sender and several receivers over a network with loss, jitter, copies and disorder, in
// simulated time. A check follows each delivery, report and transmission; planted faults show that
// the checks find what they are for.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "reckon/peer/reliable/acknowledged_set.hpp"
#include "reckon/peer/reliable/received_set.hpp"

namespace reckon::peer {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;

enum class Fault {
  none,
  doubled_delivery,     // a duplicate is delivered
  acknowledged_unheld,  // a receipt has the bit of the record before, too
  no_receipts,
  no_repeats,
  lost_addressee,  // a repeat omits an addressee
  wrong_acknowledger,
  restart_unnoticed,  // a restarted receiver keeps its epoch
  kept_epoch,         // a restarted sender keeps its epoch
  lost_verdict,
  leave_not_reported,
  early_give_up,
  late_repeats,
  far_number_taken,
  last
};

// Whether the receiver refuses this record.
bool is_refused(std::uint64_t tag) { return tag % 11 == 3; }

class Exchange final : private AssuredReports {
 public:
  Exchange(std::uint32_t seed, double loss, Fault fault)
      : fault_(fault), loss_(loss), random_(seed), first_(0U - 40U + seed % 80) {
    restart_sender();
    for (std::size_t i = 0; i < 2 + seed % 4; ++i) {
      receivers_.push_back(std::make_unique<Receiver>());
      receivers_.back()->epoch = next_epoch_++;
      receivers_.back()->is_deaf = seed % 5 == 0 && i == 0;
    }
  }

  // The first fault that was found; empty if there is none.
  std::string run() {
    for (now_ = nanoseconds(0); now_ < milliseconds(8000) && found_.empty();
         now_ += microseconds(500))
      step();
    if (found_.empty()) check_end();
    return found_;
  }

 private:
  struct Receiver {
    std::uint32_t epoch = 0;
    bool is_here = true, is_deaf = false;
    ReceivedSet set{64};
    std::map<std::uint64_t, int> taken;  // by tag
  };
  struct Sent {
    std::uint32_t sequence = 0;
    nanoseconds begun{};
    std::set<std::uint32_t> open;  // addressees without a report
    int transmissions = 0;
  };
  struct Packet {
    std::uint32_t to = 0, from = 0, sequence = 0;
    std::uint64_t tag = 0;
    bool is_receipt = false, is_addressed = true;
    pdu::AssuredReceipt receipt;
  };

  void fail(const std::string& what) {
    if (found_.empty()) found_ = what + " at " + std::to_string(now_ / milliseconds(1)) + " ms";
  }
  double any() { return std::uniform_real_distribution<>(0, 1)(random_); }

  void restart_sender() {
    sender_ = std::make_unique<AcknowledgedSet>(16, first_);
    if (fault_ != Fault::kept_epoch || epoch_ == 0) epoch_ = next_epoch_++;
    sent_.clear();
  }

  void step() {
    if (now_ < milliseconds(2500)) act();
    sender_->give_up(now_ + (fault_ == Fault::early_give_up ? milliseconds(2000) : nanoseconds(0)),
                     *this);
    for (DueRecord due; sender_->take_due(now_, due);) transmit(due);
    const auto end = on_the_way_.upper_bound(now_);
    for (auto at = on_the_way_.begin(); at != end; ++at) arrive(at->second);
    on_the_way_.erase(on_the_way_.begin(), end);
    for (const auto& receiver : receivers_) acknowledge(*receiver);
    if (sender_->in_flight() > AcknowledgedSet::kMostInFlight) fail("too many are in flight");
  }

  // Sends, leaves and restarts at random.
  void act() {
    if (any() < 0.15) send_record();
    if (any() < 0.0005) restart_sender();
    for (const auto& receiver : receivers_) {
      if (receiver->is_here && any() < 0.0002) leave(*receiver);
    }
  }

  void send_record() {
    const std::uint64_t tag = ++tags_;
    std::vector<std::uint32_t> addressees;
    for (const auto& receiver : receivers_) {
      if (receiver->is_here && any() < 0.9) addressees.push_back(receiver->epoch);
    }
    const std::vector<std::byte> octets(8 + tag % 1000, static_cast<std::byte>(tag));
    const auto sequence = sender_->add({.octets = octets, .tag = tag}, addressees, now_);
    if (!sequence) return;
    sent_[tag] = {*sequence, now_, {addressees.begin(), addressees.end()}, 0};
  }

  void leave(Receiver& receiver) {
    const std::uint32_t before = receiver.epoch;
    receiver.is_here = any() < 0.5;
    if (fault_ != Fault::restart_unnoticed) receiver.epoch = next_epoch_++;
    receiver.set = ReceivedSet(64);
    receiver.taken.clear();
    if (fault_ != Fault::leave_not_reported && fault_ != Fault::restart_unnoticed)
      sender_->drop(before, *this);
  }

  void transmit(const DueRecord& due) {
    const auto known = sent_.find(due.content.tag);
    if (known == sent_.end()) return fail("an unknown record is sent");
    Sent& sent = known->second;
    if (due.is_first != (sent.transmissions == 0)) fail("the first transmission is not the first");
    ++sent.transmissions;
    const std::set<std::uint32_t> missing(due.missing.begin(), due.missing.end());
    if (missing != sent.open) fail("a record is not addressed to those that lack it");
    if (!due.is_first && fault_ == Fault::no_repeats) return;
    check_time(now_ - sent.begun +
               (fault_ == Fault::late_repeats ? milliseconds(4) : nanoseconds(0)));
    const bool omits = !due.is_first && fault_ == Fault::lost_addressee;
    for (const auto& receiver : receivers_) {
      const bool is_addressed = missing.contains(receiver->epoch);
      if (omits && receiver->epoch == *missing.begin()) continue;
      post({receiver->epoch, epoch_, due.sequence, due.content.tag, false, is_addressed, {}});
    }
  }

  void check_time(nanoseconds age) {
    nanoseconds best = nanoseconds::max();
    for (const milliseconds time : AcknowledgedSet::kRepeats)
      best = std::min(best, std::chrono::abs(age - time));
    for (milliseconds late{392}; late < milliseconds(5000); late += milliseconds(200))
      best = std::min(best, std::chrono::abs(age - late));
    if (best > microseconds(500)) fail("a transmission is not on the schedule");
  }

  void post(const Packet& packet) {
    for (int copies = any() < 0.1 ? 2 : 1; copies > 0; --copies) {
      if (any() < loss_) continue;
      const double delay_ms = 0.1 + 2.0 * any() + (any() < 0.05 ? 30.0 * any() : 0.0);
      on_the_way_.emplace(now_ + nanoseconds(static_cast<std::int64_t>(1e6 * delay_ms)), packet);
    }
  }

  void arrive(const Packet& packet) {
    if (packet.is_receipt) {
      if (packet.to != epoch_) return;
      const bool wrong = fault_ == Fault::wrong_acknowledger && receivers_.size() > 1;
      const std::uint32_t from =
          wrong ? receivers_[random_() % receivers_.size()]->epoch : packet.from;
      return sender_->acknowledge(from, packet.sequence, packet.receipt, *this);
    }
    for (const auto& receiver : receivers_) {
      if (receiver->is_here && !receiver->is_deaf && receiver->epoch == packet.to)
        take(*receiver, packet);
    }
  }

  void take(Receiver& receiver, const Packet& packet) {
    if (!packet.is_addressed) return receiver.set.follow(packet.from, packet.sequence, now_);
    const AssuredNovelty novelty = receiver.set.take(packet.from, packet.sequence, now_);
    const bool delivers =
        novelty == AssuredNovelty::fresh ||
        (fault_ == Fault::doubled_delivery && novelty == AssuredNovelty::duplicate);
    if (delivers && ++receiver.taken[packet.tag] > 1) fail("a record is delivered twice");
    const bool refuses = is_refused(packet.tag) && fault_ != Fault::lost_verdict;
    if (novelty == AssuredNovelty::fresh && refuses)
      receiver.set.refuse(packet.from, packet.sequence);
    if (novelty == AssuredNovelty::refused && packet.from == epoch_)
      fail("a genuine record is refused");
    receiver.set.owe(packet.from, false);
    forge(receiver, packet);
  }

  void forge(Receiver& receiver, const Packet& packet) {
    if (any() > 0.02) return;
    const std::uint32_t far =
        packet.sequence + 1000 + static_cast<std::uint32_t>(random_() % 100'000);
    if (receiver.set.take(packet.from, far, now_) != AssuredNovelty::refused)
      fail("a far number is taken");
    if (fault_ == Fault::far_number_taken) {
      for (std::uint32_t at = packet.sequence; at != far; at = std::min(at + 256, far))
        receiver.set.follow(packet.from, std::min(at + 256, far), now_);
    }
  }

  void acknowledge(Receiver& receiver) {
    for (DueReceipt due; receiver.set.take_receipt(due);) {
      if (fault_ == Fault::no_receipts) continue;
      if (fault_ == Fault::acknowledged_unheld) {
        for (std::uint8_t& octet : due.receipt.received)
          octet = static_cast<std::uint8_t>(octet | octet << 1);
      }
      post({due.epoch, receiver.epoch, due.highest, 0, true, true, due.receipt});
    }
  }

  void settle(const AssuredReport& report) noexcept override {
    const auto known = sent_.find(report.tag);
    if (known == sent_.end() || known->second.open.erase(report.peer) != 1)
      return fail("a report of nothing that is open");
    if (report.is_last != known->second.open.empty()) fail("the last report is not the last");
    const auto receiver = std::ranges::find_if(
        receivers_, [&](const auto& one) { return one->epoch == report.peer; });
    const bool stays = receiver != receivers_.end() && (*receiver)->is_here;
    const bool holds = stays && (*receiver)->taken.contains(report.tag);
    if (report.outcome == AssuredOutcome::left && stays)
      fail("a peer that stays is said to have left");
    if (report.outcome == AssuredOutcome::gave_up) {
      if (!stays) fail("a peer that left is given up");
      if (stays && !(*receiver)->is_deaf) fail("a peer that stays is given up");
      if (now_ - known->second.begun < AcknowledgedSet::kGiveUp) fail("a record is given up early");
    }
    if (report.outcome > AssuredOutcome::refused) return;
    if (stays && !holds) fail("an acknowledged record is not held");
    if ((report.outcome == AssuredOutcome::refused) != is_refused(report.tag))
      fail("a verdict is not that of the receiver");
  }

  void check_end() {
    if (sender_->in_flight() > 0) fail("records stay in flight");
    for (const auto& [tag, sent] : sent_) {
      if (!sent.open.empty()) fail("an addressee has no report");
    }
  }

  Fault fault_;
  double loss_;
  std::mt19937 random_;
  std::uint32_t first_, epoch_ = 0, next_epoch_ = 100;
  std::uint64_t tags_ = 0;
  nanoseconds now_{};
  std::unique_ptr<AcknowledgedSet> sender_;
  std::vector<std::unique_ptr<Receiver>> receivers_;
  std::map<std::uint64_t, Sent> sent_;
  std::multimap<nanoseconds, Packet> on_the_way_;
  std::string found_;
};

TEST(AssuredDelivery, LosesAndDoublesNothingAtAnyLoss) {
  for (std::uint32_t seed = 1; seed <= 60; ++seed) {
    const double loss = 0.4 * (seed % 9) / 8.0;
    EXPECT_EQ(Exchange(seed, loss, Fault::none).run(), "") << "seed " << seed << ", loss " << loss;
  }
}

TEST(AssuredDelivery, ChecksFindEachPlantedFault) {
  for (int fault = 1; fault < static_cast<int>(Fault::last); ++fault) {
    std::string found;
    for (std::uint32_t seed = 1; seed <= 30 && found.empty(); ++seed)
      found = Exchange(seed, 0.3, static_cast<Fault>(fault)).run();
    EXPECT_NE(found, "") << "fault " << fault;
  }
}

}  // namespace
}  // namespace reckon::peer
