// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/exercise/exercise.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <random>
#include <stdexcept>
#include <thread>

#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/joined_peer.hpp"
#include "reckon/peer/scene/belongings.hpp"

namespace reckon::tools {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr std::size_t kTraceSteps = 4096;  // capacity for recorded steps until collect()
// Capacity for updates of remote hands: half a second of two hands at 125 Hz each.
constexpr std::size_t kContactSets = 128;
constexpr std::size_t kBodySteps = 65'536;  // of all bodies
constexpr std::size_t kLoopSteps = 16'384;  // of one peer: 20 ms of passes 5 us after one another
constexpr nanoseconds kCollect = milliseconds(20);
constexpr nanoseconds kTick = milliseconds(1);  // simulated time: all peers read the network
constexpr std::uint16_t kSite = 1;

// Limit of the steps taken from one hand at once during a run, several times the number that
// kCollect produces. A host that cannot keep up always finds more; the limit lets the run end.
std::size_t most_steps(nanoseconds period) {
  return static_cast<std::size_t>(6 * kCollect / period) + 8;
}

}  // namespace

struct Exercise::Member {
  SimulatedHands hands;
  std::unique_ptr<peer::JoinedPeer> joined;
  std::size_t first_hand = 0;              // in hands_
  std::vector<peer::EntityTrack> tracks;   // of its entities without a hand, in scene order
  pdu::SimulationAddress address;          // as of the last collect()
  std::unique_ptr<peer::LoopRing> stages;  // with trace_loops
  bool awake = false;                      // simulated time: has work at this instant
};

/// One device of a member.
struct Exercise::Hand {
  Member& member;
  std::size_t peer = 0, device = 0;
  nanoseconds period{0};
  nanoseconds due{0};  // simulated time
  std::unique_ptr<haptics::TraceRing> ring;
  std::unique_ptr<haptics::ContactRing> contacts;
};

Exercise::Exercise(const peer::SceneFile& scene, const ExerciseOptions& options)
    : options_(options),
      manual_(std::chrono::seconds(1), std::chrono::hours(1)),
      real_(options.plugins) {
  if (options.peers < 1 || options.peers > 64) {
    throw std::invalid_argument(fmt::format("{} peers: choose 1 to 64", options.peers));
  }
  if (options.simulated_time) {
    peer::SimulatedNetworkOptions network;
    network.links = options.peers;
    network.seed = scene.impairment.seed;
    network_ = std::make_unique<peer::SimulatedNetwork>(network, manual_);
    network_->impair(scene.impairment.law);
  } else {
    servo_ = std::make_unique<peer::ServoThread>(steady_);
  }
  const std::uint32_t epoch = options.epoch != 0 ? options.epoch : std::random_device{}() | 1u;
  for (std::size_t i = 0; i < options.peers; ++i)
    add_member(scene, epoch + static_cast<std::uint32_t>(i));
  std::vector<std::size_t> peers;
  for (const Hand& hand : hands_) peers.push_back(hand.peer);
  measurement_ = std::make_unique<DemoMeasurement>(std::move(peers), scene.hand);
  begun_ = now();
  next_tick_ = begun_ + kTick;
  for (Hand& hand : hands_) hand.due = begun_ + hand.period;
  for (auto& member : members_) member->joined->run();
}

Exercise::~Exercise() { stop(); }

void Exercise::add_member(const peer::SceneFile& scene, std::uint32_t epoch) {
  const std::size_t index = members_.size();
  Member& member = *members_.emplace_back(std::make_unique<Member>());
  const auto number = static_cast<std::uint32_t>(index + 1);
  member.hands = make_simulated_hands(
      scene, number, index < options_.scripts.size() ? options_.scripts[index] : nullptr);
  if (!options_.simulated_time) real_.plug_in(scene, number, member.hands.wired);
  peer::FederateOptions own;
  own.name = fmt::format("HAND{}", number);
  own.scene = scene;
  own.interface = options_.iface;
  own.scene_peer = number;
  own.devices = member.hands.wired;
  own.site = kSite;
  // Over the LAN a plain DIS program takes the next free one.
  if (options_.simulated_time || !scene.network.interop)
    own.application = static_cast<std::uint16_t>(number);
  own.transfer = options_.transfer;
  own.force_stop = options_.force_stop;
  own.record_shown = options_.measure;
  own.receiver = index;
  own.impairment_changes = options_.impairment_changes;
  own.servo = servo_.get();
  own.even_if_slow = options_.even_if_slow;
  own.body_pace = options_.body_pace;
  if (options_.simulated_time) {
    own.loops = peer::FederateLoops::by_hand;
    member.joined = std::make_unique<peer::JoinedPeer>(own, network_->link(index), manual_, epoch);
  } else {
    own.loops = peer::FederateLoops::threads;
    member.joined = std::make_unique<peer::JoinedPeer>(own);
  }
  add_hands(index);
  if (options_.trace_loops) {
    member.stages = std::make_unique<peer::LoopRing>(kLoopSteps);
    member.joined->peer().trace_loop(member.stages.get());
  }
  if (options_.measure) member.tracks = peer::tracks_of(peer::entities_of(scene, number));
}

void Exercise::add_hands(std::size_t index) {
  Member& member = *members_[index];
  peer::Peer& peer = member.joined->peer();
  if (options_.trace_bodies && index == 0 && peer.bodies() != nullptr) {
    bodies_ = std::make_unique<haptics::BodyRing>(kBodySteps);
    peer.bodies()->trace(bodies_.get());
  }
  member.first_hand = hands_.size();
  for (std::size_t device = 0; device < member.hands.wired.size(); ++device) {
    Hand& hand =
        hands_.emplace_back(Hand{member, index, device, peer.servo_period_of(device), {}, {}, {}});
    if (options_.trace_contacts) {
      hand.contacts = std::make_unique<haptics::ContactRing>(kContactSets);
      peer.trace_contacts(hand.contacts.get(), device);
    }
    if (!options_.measure) continue;
    hand.ring = std::make_unique<haptics::TraceRing>(kTraceSteps);
    peer.trace(hand.ring.get(), device);
  }
}

std::size_t Exercise::hands() const noexcept { return hands_.size(); }

double Exercise::raw_rate() const noexcept {
  double rate = 0.0;
  for (const Hand& hand : hands_) rate += 1.0 / pdu::to_seconds(hand.period);
  return rate;
}

peer::Peer& Exercise::peer(std::size_t index) noexcept { return members_[index]->joined->peer(); }

void Exercise::change_impairment(const peer::ImpairmentLaw& law) {
  for (const auto& member : members_) member->joined->change_impairment(law);
}

std::span<const PointerHand> Exercise::pointers(std::size_t index) const noexcept {
  return members_[index]->hands.pointers;
}

std::vector<std::string> Exercise::device_notices() {
  std::vector<std::string> all = real_.take_notices();
  for (const auto& member : members_)
    for (std::string& sentence : member->hands.take_notices()) all.push_back(std::move(sentence));
  return all;
}

haptics::ContactRing* Exercise::contacts(std::size_t peer, std::size_t device) noexcept {
  return hands_[members_[peer]->first_hand + device].contacts.get();
}

const peer::Clock& Exercise::clock() const noexcept {
  if (options_.simulated_time) return manual_;
  return steady_;
}

const peer::PeerView& Exercise::view(std::size_t index) const noexcept {
  return members_[index]->joined->peer().views().read();
}

nanoseconds Exercise::now() const noexcept {
  return options_.simulated_time ? manual_.now() : steady_.now();
}

nanoseconds Exercise::elapsed() const noexcept { return now() - begun_; }

void Exercise::run(nanoseconds span) {
  if (options_.simulated_time) {
    run_simulated(span);
  } else {
    run_threads(span);
  }
}

void Exercise::run_threads(nanoseconds span) {
  const nanoseconds end = steady_.now() + span;
  for (nanoseconds now = steady_.now(); now < end; now = steady_.now()) {
    std::this_thread::sleep_for(std::min(kCollect, end - now));
    collect(false);
  }
}

void Exercise::run_simulated(nanoseconds span) {
  const nanoseconds end = manual_.now() + span;
  nanoseconds next_collect = manual_.now() + kCollect;
  while (manual_.now() < end) {
    manual_.advance(next_instant() - manual_.now());
    pass_instant(manual_.now());
    if (manual_.now() < next_collect) continue;
    next_collect += kCollect;
    collect(true);
  }
  collect(true);
}

// The next tick or an earlier servo step.
nanoseconds Exercise::next_instant() const noexcept {
  nanoseconds next = next_tick_;
  for (const Hand& hand : hands_) next = std::min(next, hand.due);
  return next;
}

// Members without work at this instant are skipped: in real time their threads would sleep.
void Exercise::pass_instant(nanoseconds now) {
  const bool is_tick = now >= next_tick_;
  if (is_tick) next_tick_ += kTick;
  for (auto& member : members_) member->awake = is_tick;
  for (const Hand& hand : hands_) hand.member.awake |= hand.due <= now;
  for (auto& member : members_) {
    peer::Peer& peer = member->joined->peer();
    if (member->awake && peer.read_step(now) > 0) peer.model_step(now, manual_.utc_now());
  }
  step_servos(now);
  for (auto& member : members_) {
    if (!member->awake) continue;
    member->joined->peer().model_step(now, manual_.utc_now());
    member->joined->peer().write_step();
  }
}

void Exercise::step_servos(nanoseconds now) {
  const nanoseconds begin = options_.time_servo ? steady_.now() : nanoseconds(0);
  for (Hand& hand : hands_) {
    if (hand.due > now) continue;
    hand.member.joined->peer().servo_step_of(hand.device, now);
    hand.due += hand.period;
  }
  if (options_.time_servo) servo_steps_.add(steady_.now() - begin);
}

double Exercise::servo_step_ns() const noexcept {
  const auto all = static_cast<double>(servo_steps_.percentile(0.5).count());
  return all / static_cast<double>(members_.size());
}

void Exercise::collect(bool all) {
  std::vector<pdu::EntityId> ids(hands_.size());
  for (auto& member : members_) {
    auto& views = member->joined->peer().views();
    views.update();
    const peer::PeerView& view = views.read();
    member->address = view.own.simulation();
    for (std::size_t i = 0; i < view.hand_count; ++i) {
      ids[member->first_hand + i] = view.hands[i].id;
      measurement_->set_device(member->first_hand + i, view.hands[i].stiffness);
    }
  }
  measurement_->set_ids(ids);
  collect_bodies();
  collect_stages();
  if (!options_.measure) return;
  std::size_t most_shown = hands_.empty() ? most_steps(std::chrono::milliseconds(1)) : 0;
  for (std::size_t i = 0; i < hands_.size(); ++i) {
    const std::size_t most = all ? kTraceSteps : most_steps(hands_[i].period);
    collect_steps(i, most);
    most_shown = std::max(most_shown, most);
  }
  for (auto& member : members_) {
    const std::size_t remote = member->joined->peer().views().read().entities;
    collect_shown(*member, all ? kTraceSteps * (remote + 1) : most_shown * (remote + 1));
  }
  measurement_->evaluate();
}

void Exercise::collect_bodies() {
  haptics::BodyStep step;
  while (bodies_ && bodies_->pop(step))
    if (body_sink_) body_sink_(step);
}

void Exercise::collect_stages() {
  peer::LoopStep step;
  for (std::size_t i = 0; i < members_.size(); ++i) {
    peer::LoopRing* ring = members_[i]->stages.get();
    while (ring != nullptr && ring->pop(step))
      if (stage_sink_) stage_sink_(i, step);
  }
}

void Exercise::collect_steps(std::size_t index, std::size_t most) {
  const Hand& hand = hands_[index];
  haptics::ServoSnapshot step;
  for (std::size_t taken = 0; taken < most && hand.ring->pop(step); ++taken) {
    measurement_->add_step(index, step);
    if (sink_) sink_(hand.peer, hand.device, step);
  }
}

void Exercise::collect_shown(Member& member, std::size_t most) {
  auto& shown = member.joined->peer().shown();
  for (std::size_t taken = 0; taken < most; ++taken) {
    const peer::ShownSample* sample = shown.front();
    if (sample == nullptr) break;
    take_shown(*sample);
    shown.pop();
  }
}

// Entities are numbered from 1: first the hands, then the others.
void Exercise::take_shown(const peer::ShownSample& sample) {
  const auto owner = std::find_if(members_.begin(), members_.end(), [&](const auto& member) {
    return member->address == sample.id.simulation();
  });
  if (owner == members_.end() || sample.id.entity == 0) return;
  Member& member = **owner;
  const std::size_t hands = member.hands.wired.size(), place = sample.id.entity - 1u;
  const nanoseconds set_out = member.joined->peer().views().read().set_out;
  if (place < hands) {
    measurement_->add_shown(member.first_hand + place, sample);
  } else if (place - hands < member.tracks.size() && set_out >= nanoseconds(0)) {
    const double time = pdu::to_seconds(sample.time - set_out);
    measurement_->add_shown_entity(sample, member.tracks[place - hands].at(time).position);
  }
}

void Exercise::stop() {
  if (stopped_) return;
  stopped_ = true;
  for (auto& member : members_) member->joined->stop_loops();
  collect(true);
  for (auto& member : members_) member->joined->resign();
}

ServoReport Exercise::servo_report() const {
  ServoReport report;
  for (const auto& member : members_) {
    if (member->joined->threads() != nullptr) report.add(*member->joined->threads());
  }
  return report;
}

std::uint64_t Exercise::unmeasured_steps() const noexcept {
  std::uint64_t sum = 0;
  for (const Hand& hand : hands_) sum += hand.ring ? hand.ring->refused() : 0;
  return sum;
}

std::uint64_t Exercise::total(std::string_view counter) const {
  std::uint64_t sum = 0;
  for (const auto& member : members_) {
    const peer::Counter* found = member->joined->peer().counters().find(counter);
    if (found != nullptr) sum += found->value();
  }
  return sum;
}

nanoseconds Exercise::remote_seen() const noexcept {
  nanoseconds latest{0};
  for (const auto& member : members_) {
    const nanoseconds seen = member->joined->peer().views().read().first_remote;
    if (seen < nanoseconds(0)) return seen;
    latest = std::max(latest, seen);
  }
  return latest;
}

std::vector<ReceivedNotice> Exercise::take_notices() {
  std::vector<ReceivedNotice> notices;
  for (auto& member : members_) {
    const pdu::SimulationAddress own = member->joined->peer().views().read().own.simulation();
    for (const peer::Notice& notice : member->joined->take_sealing_notices())
      notices.push_back({own, notice});
    auto& ring = member->joined->peer().notices();
    while (const peer::Notice* notice = ring.front()) {
      notices.push_back({own, *notice});
      ring.pop();
    }
  }
  return notices;
}

}  // namespace reckon::tools
