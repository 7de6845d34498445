// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/exercise/exercise.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <random>
#include <stdexcept>
#include <thread>

#include "reckon/peer/network/impaired_link.hpp"
#include "reckon/peer/network/udp_multicast.hpp"
#include "reckon/peer/scene/belongings.hpp"
#include "reckon/tools/exercise/simulated_hand.hpp"

namespace reckon::tools {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr std::size_t kTraceSteps = 4096;  // recorded steps that may wait for collect()
constexpr nanoseconds kCollect = milliseconds(20);
constexpr std::uint16_t kSite = 1;

}  // namespace

std::string servo_text(const peer::PeerThreads& threads) {
  if (threads.servo() == nullptr) return "none: no device";
  return threads.servo()->describe() + (threads.memory_locked() ? "; memory locked" : "");
}

struct Exercise::Member {
  SimulatedHands hands;
  std::unique_ptr<peer::Link> real_link;
  std::unique_ptr<peer::Link> impaired;
  peer::Link* link = nullptr;
  std::unique_ptr<peer::Peer> peer;
  std::unique_ptr<haptics::TraceRing> ring;
  std::unique_ptr<peer::PeerThreads> threads;
};

Exercise::Exercise(const peer::SceneFile& scene, const ExerciseOptions& options)
    : scene_(scene), options_(options), manual_(std::chrono::seconds(1), std::chrono::hours(1)) {
  if (options.peers < 1 || options.peers > 64) {
    throw std::invalid_argument(
        fmt::format("{} peers: between 1 and 64 can be run", options.peers));
  }
  build_links();
  std::uint32_t epoch = options.epoch != 0 ? options.epoch : std::random_device{}() | 1u;
  measurement_ = std::make_unique<DemoMeasurement>(options.peers, scene.hand);
  for (std::size_t i = 0; i < options.peers; ++i) {
    Member& member = *members_[i];
    const auto number = static_cast<std::uint32_t>(i + 1);
    member.hands = make_simulated_hands(scene, number);
    if (member.hands.wired.empty()) measurement_->leave_out(i);
    peer::PeerOptions own;
    own.name = fmt::format("HAND{}", i + 1);
    own.site = kSite;
    own.application = static_cast<std::uint16_t>(i + 1);
    own.epoch = epoch++;
    own.transfer = options.transfer;
    own.record_shown = options.measure;
    own.entities = peer::entities_of(scene, number);
    member.peer = std::make_unique<peer::Peer>(scene, own, *member.link, member.hands.wired);
    if (options.measure) {
      member.ring = std::make_unique<haptics::TraceRing>(kTraceSteps);
      member.peer->trace(member.ring.get());
    }
  }
  const peer::Clock& clock =
      options.simulated_time ? static_cast<const peer::Clock&>(manual_) : steady_;
  begun_ = clock.now();
  for (auto& member : members_) member->peer->start(clock.now());
  if (options.simulated_time) return;
  servo_ = std::make_unique<peer::ServoThread>(steady_);
  peer::PeerThreadsOptions threads;
  threads.servo = servo_.get();
  for (auto& member : members_) {
    member->threads = std::make_unique<peer::PeerThreads>(*member->peer, steady_, threads);
  }
}

Exercise::~Exercise() { stop(); }

void Exercise::build_links() {
  if (options_.simulated_time) {
    peer::SimulatedNetworkOptions network;
    network.links = options_.peers;
    network.seed = scene_.impairment.seed;
    network_ = std::make_unique<peer::SimulatedNetwork>(network, manual_);
    network_->impair(scene_.impairment.law);
  }
  for (std::size_t i = 0; i < options_.peers; ++i) {
    auto member = std::make_unique<Member>();
    if (options_.simulated_time) {
      member->link = &network_->link(i);
    } else {
      peer::UdpMulticastOptions udp;
      udp.interface = options_.iface;
      udp.ipv6 = scene_.network.group.is_v6;
      udp.ttl = scene_.network.ttl;
      member->real_link = std::make_unique<peer::UdpMulticast>(udp, steady_);
      member->link = member->real_link.get();
      if (!scene_.impairment.law.is_perfect()) {
        peer::ImpairedLinkOptions impaired;
        impaired.law = scene_.impairment.law;
        impaired.seed = scene_.impairment.seed;
        impaired.receiver = i;
        impaired.start = steady_.now();
        member->impaired =
            std::make_unique<peer::ImpairedLink>(*member->real_link, impaired, steady_);
        member->link = member->impaired.get();
      }
    }
    members_.push_back(std::move(member));
  }
}

std::size_t Exercise::hands() const noexcept {
  std::size_t sum = 0;
  for (const auto& member : members_) sum += member->hands.wired.size();
  return sum;
}

peer::Peer& Exercise::peer(std::size_t index) noexcept { return *members_[index]->peer; }

const peer::PeerView& Exercise::view(std::size_t index) const noexcept {
  return members_[index]->peer->views().read();
}

nanoseconds Exercise::elapsed() const noexcept {
  return (options_.simulated_time ? manual_.now() : steady_.now()) - begun_;
}

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
    collect();
  }
}

void Exercise::run_simulated(nanoseconds span) {
  const nanoseconds end = manual_.now() + span;
  for (std::uint64_t step = 1; manual_.now() < end; ++step) {
    manual_.advance(milliseconds(1));
    const nanoseconds now = manual_.now();
    for (auto& member : members_) member->peer->servo_step(now);
    for (auto& member : members_) {
      member->peer->read_step(now);
      if (step % 2 == 0) member->peer->model_step(now, manual_.utc_now());
      member->peer->write_step();
    }
    if (step % 20 == 0) collect();
  }
  collect();
}

void Exercise::collect() {
  std::vector<pdu::EntityId> ids;
  for (auto& member : members_) {
    member->peer->views().update();
    ids.push_back(member->peer->views().read().own);
  }
  measurement_->set_ids(ids);
  if (!options_.measure) return;

  haptics::ServoSnapshot step;
  for (std::size_t i = 0; i < members_.size(); ++i) {
    while (members_[i]->ring->pop(step)) {
      measurement_->add_step(i, step);
      if (sink_) sink_(i, step);
    }
    auto& shown = members_[i]->peer->shown();
    while (const peer::ShownSample* sample = shown.front()) {
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
  for (auto& member : members_) {
    if (member->threads) member->threads->stop();
  }
  collect();
  for (auto& member : members_) {
    if (!member->peer) continue;
    if (options_.simulated_time) {
      member->peer->stop(manual_.now(), manual_.utc_now());
    } else {
      member->peer->stop(steady_.now(), steady_.utc_now());
    }
  }
}

ServoReport Exercise::servo_report() const {
  ServoReport report;
  for (const auto& member : members_) {
    if (!member->threads) continue;
    const peer::DutyCycle& duty = member->threads->servo_duty();
    const peer::Percentiles late = peer::percentiles(duty.lateness());
    report.lateness.p50 = std::max(report.lateness.p50, late.p50);
    report.lateness.p99 = std::max(report.lateness.p99, late.p99);
    report.lateness.p999 = std::max(report.lateness.p999, late.p999);
    report.lateness.max = std::max(report.lateness.max, late.max);
    report.steps += duty.steps();
    report.missed += duty.missed();
    report.thread = servo_text(*member->threads);
  }
  return report;
}

std::uint64_t Exercise::total(std::string_view counter) const {
  std::uint64_t sum = 0;
  for (const auto& member : members_) {
    const peer::Counter* found = member->peer->counters().find(counter);
    if (found != nullptr) sum += found->value();
  }
  return sum;
}

nanoseconds Exercise::remote_seen() const noexcept {
  nanoseconds latest{0};
  for (const auto& member : members_) {
    const nanoseconds seen = member->peer->views().read().first_remote;
    if (seen < nanoseconds(0)) return seen;
    latest = std::max(latest, seen);
  }
  return latest;
}

std::vector<HeardNotice> Exercise::take_notices() {
  std::vector<HeardNotice> notices;
  for (auto& member : members_) {
    auto& ring = member->peer->notices();
    while (const peer::Notice* notice = ring.front()) {
      notices.push_back({member->peer->views().read().own.simulation(), *notice});
      ring.pop();
    }
  }
  return notices;
}

}  // namespace reckon::tools
