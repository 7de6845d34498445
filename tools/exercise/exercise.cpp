// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/exercise/exercise.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <random>
#include <stdexcept>
#include <thread>

#include "reckon/peer/joined_peer.hpp"
#include "reckon/tools/exercise/simulated_hand.hpp"

namespace reckon::tools {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;

// Steps of one hand taken at once while it runs, several times what comes in kCollect: on a host
// that cannot keep up there is always more, and the end has to come all the same.
constexpr std::size_t kMostSteps = 128;
constexpr std::size_t kTraceSteps = 4096;  // recorded steps that may wait for collect()
constexpr nanoseconds kCollect = milliseconds(20);
constexpr nanoseconds kSimulatedStep = milliseconds(1);
constexpr std::uint16_t kSite = 1;

}  // namespace

std::string servo_text(const peer::PeerThreads& threads) {
  if (threads.servo() == nullptr) return "none: no device";
  return threads.servo()->describe() + (threads.memory_locked() ? "; memory locked" : "");
}

struct Exercise::Member {
  SimulatedHands hands;
  std::unique_ptr<haptics::TraceRing> ring;
  std::unique_ptr<peer::JoinedPeer> joined;
};

Exercise::Exercise(const peer::SceneFile& scene, const ExerciseOptions& options)
    : options_(options), manual_(std::chrono::seconds(1), std::chrono::hours(1)) {
  if (options.peers < 1 || options.peers > 64) {
    throw std::invalid_argument(
        fmt::format("{} peers: between 1 and 64 can be run", options.peers));
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
  measurement_ = std::make_unique<DemoMeasurement>(options.peers, scene.hand);
  const std::uint32_t epoch = options.epoch != 0 ? options.epoch : std::random_device{}() | 1u;
  for (std::size_t i = 0; i < options.peers; ++i) {
    add_member(scene, epoch + static_cast<std::uint32_t>(i));
  }
  begun_ = now();
  for (auto& member : members_) member->joined->run();
}

Exercise::~Exercise() { stop(); }

void Exercise::add_member(const peer::SceneFile& scene, std::uint32_t epoch) {
  const std::size_t index = members_.size();
  Member& member = *members_.emplace_back(std::make_unique<Member>());
  const auto number = static_cast<std::uint32_t>(index + 1);
  member.hands =
      make_simulated_hands(scene, number, options_.simulated_time ? kSimulatedStep : nanoseconds(0),
                           index < options_.scripts.size() ? options_.scripts[index] : nullptr);
  if (member.hands.wired.empty()) measurement_->leave_out(index);
  peer::FederateOptions own;
  own.name = fmt::format("HAND{}", number);
  own.scene = scene;
  own.interface = options_.iface;
  own.scene_peer = number;
  own.devices = member.hands.wired;
  own.site = kSite;
  own.application = static_cast<std::uint16_t>(number);
  own.transfer = options_.transfer;
  own.record_shown = options_.measure;
  own.receiver = index;
  own.servo = servo_.get();
  if (options_.simulated_time) {
    own.loops = peer::FederateLoops::by_hand;
    member.joined = std::make_unique<peer::JoinedPeer>(own, network_->link(index), manual_, epoch);
  } else {
    own.loops = peer::FederateLoops::threads;
    member.joined = std::make_unique<peer::JoinedPeer>(own);
  }
  if (!options_.measure) return;
  member.ring = std::make_unique<haptics::TraceRing>(kTraceSteps);
  member.joined->peer().trace(member.ring.get());
}

std::size_t Exercise::hands() const noexcept {
  std::size_t sum = 0;
  for (const auto& member : members_) sum += member->hands.wired.size();
  return sum;
}

peer::Peer& Exercise::peer(std::size_t index) noexcept { return members_[index]->joined->peer(); }

const peer::PeerView& Exercise::view(std::size_t index) const noexcept {
  return members_[index]->joined->peer().views().read();
}

nanoseconds Exercise::now() const noexcept {
  return options_.simulated_time ? manual_.now() : steady_.now();
}

nanoseconds Exercise::elapsed() const noexcept { return now() - begun_; }

void Exercise::on_step(std::function<void(std::size_t, const haptics::ServoSnapshot&)> sink) {
  sink_ = std::move(sink);
}

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
    collect(kMostSteps);
  }
}

void Exercise::run_simulated(nanoseconds span) {
  const nanoseconds end = manual_.now() + span;
  for (std::uint64_t step = 1; manual_.now() < end; ++step) {
    manual_.advance(kSimulatedStep);
    const nanoseconds now = manual_.now();
    for (auto& member : members_) {
      peer::Peer& peer = member->joined->peer();
      if (peer.read_step(now) > 0) peer.model_step(now, manual_.utc_now());
    }
    step_servos(now);
    for (auto& member : members_) {
      member->joined->peer().model_step(now, manual_.utc_now());
      member->joined->peer().write_step();
    }
    if (step % 20 == 0) collect(kMostSteps);
  }
  collect(kMostSteps);
}

void Exercise::step_servos(nanoseconds now) {
  const nanoseconds begin = options_.time_servo ? steady_.now() : nanoseconds(0);
  for (auto& member : members_) member->joined->peer().servo_step(now);
  if (options_.time_servo) servo_steps_.add(steady_.now() - begin);
}

double Exercise::servo_step_ns() const noexcept {
  const auto all = static_cast<double>(servo_steps_.percentile(0.5).count());
  return all / static_cast<double>(members_.size());
}

void Exercise::collect(std::size_t most_steps) {
  std::vector<pdu::EntityId> ids;
  for (auto& member : members_) {
    member->joined->peer().views().update();
    const peer::PeerView& view = member->joined->peer().views().read();
    if (view.hand_count > 0) measurement_->set_device(ids.size(), view.hands[0].stiffness);
    ids.push_back(view.own);
  }
  measurement_->set_ids(ids);
  if (!options_.measure) return;

  haptics::ServoSnapshot step;
  for (std::size_t i = 0; i < members_.size(); ++i) {
    haptics::TraceRing& ring = *members_[i]->ring;
    for (std::size_t taken = 0; taken < most_steps && ring.pop(step); ++taken) {
      measurement_->add_step(i, step);
      if (sink_) sink_(i, step);
    }
    // Each of its steps shows the others' hands.
    const std::size_t most_shown = most_steps * members_.size();
    auto& shown = members_[i]->joined->peer().shown();
    for (std::size_t taken = 0; taken < most_shown; ++taken) {
      const peer::ShownSample* sample = shown.front();
      if (sample == nullptr) break;
      const auto owner = std::find(ids.begin(), ids.end(), sample->id);
      if (owner != ids.end()) {
        measurement_->add_shown(static_cast<std::size_t>(owner - ids.begin()), *sample);
      }
      shown.pop();
    }
  }
  measurement_->evaluate();
}

void Exercise::stop() {
  if (stopped_) return;
  stopped_ = true;
  for (auto& member : members_) member->joined->stop_loops();
  collect(kTraceSteps);
  for (auto& member : members_) member->joined->resign();
}

ServoReport Exercise::servo_report() const {
  ServoReport report;
  for (const auto& member : members_) {
    const peer::PeerThreads* threads = member->joined->threads();
    if (threads == nullptr) continue;
    const peer::DutyCycle& duty = threads->servo_duty();
    const peer::Percentiles late = peer::percentiles(duty.lateness());
    report.lateness.p50 = std::max(report.lateness.p50, late.p50);
    report.lateness.p99 = std::max(report.lateness.p99, late.p99);
    report.lateness.p999 = std::max(report.lateness.p999, late.p999);
    report.lateness.max = std::max(report.lateness.max, late.max);
    report.steps += duty.steps();
    report.missed += duty.missed();
    report.thread = servo_text(*threads);
  }
  return report;
}

std::uint64_t Exercise::unmeasured_steps() const noexcept {
  std::uint64_t sum = 0;
  for (const auto& member : members_) sum += member->ring ? member->ring->refused() : 0;
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

std::vector<HeardNotice> Exercise::take_notices() {
  std::vector<HeardNotice> notices;
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
