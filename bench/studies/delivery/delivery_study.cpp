// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/delivery/delivery_study.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "reckon/bench/statistics/quantile.hpp"
#include "reckon/bench/studies/frame/fields.hpp"
#include "reckon/bench/studies/frame/study.hpp"
#include "reckon/bench/studies/sweep/values.hpp"
#include "reckon/pdu/management/comment.hpp"
#include "reckon/pdu/management/datum.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/federate.hpp"
#include "reckon/peer/network/simulated_network.hpp"
#include "reckon/peer/peer.hpp"
#include "reckon/peer/scene/scene_file.hpp"

namespace reckon::bench {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;

constexpr nanoseconds kStep = microseconds(250);
constexpr nanoseconds kDelay = microseconds(100);  // of a local network
constexpr nanoseconds kJoining = seconds(2), kLast = seconds(6);
constexpr nanoseconds kEach = milliseconds(20);  // an assured interaction, and one by best effort
constexpr std::size_t kOctets = 64;              // of an interaction
constexpr std::size_t kDatums = (kOctets - pdu::kFixedSize<pdu::Comment>) / sizeof(std::uint64_t);

peer::SceneFile field() {
  peer::SceneFile scene;
  scene.name = "delivery";
  scene.hash = peer::scene_hash(scene);
  return scene;
}

// A hand on a circle of 10 cm, once in a second.
peer::EntityTruth hand_on_circle(nanoseconds now, std::size_t number) {
  constexpr double kCircle = 0.1, kTurns = 2.0 * std::numbers::pi;  // [m], [rad/s]
  const double angle = kTurns * pdu::to_seconds(now) + static_cast<double>(number);
  const Eigen::Vector3d out(std::cos(angle), std::sin(angle), 0.0);
  peer::EntityTruth truth;
  truth.position = kCircle * out;
  truth.velocity = kCircle * kTurns * Eigen::Vector3d(-out.y(), out.x(), 0.0);
  return truth;
}

struct SeenPose {
  std::uint64_t updates = 0;
  nanoseconds since{};
};

class DeliveryRun {
 public:
  DeliveryRun(const DeliveryOptions& options, bool sends)
      : options_(options),
        sends_(sends),
        clock_(seconds(1), std::chrono::hours(1)),
        network_({.links = kReceivers + 1, .seed = options.seed}, clock_) {
    peer::ImpairmentLaw law;
    law.delay = kDelay;
    law.loss = options.loss;
    network_.impair(law);
    for (std::size_t i = 0; i <= kReceivers; ++i) join(i);
  }

  Deliveries run() {
    for (const nanoseconds end = clock_.now() + kJoining; clock_.now() < end;) step();
    const nanoseconds begin = clock_.now(), end = begin + options_.length;
    for (nanoseconds next = begin; clock_.now() < end + kLast; step()) {
      if (clock_.now() < end) look_at_ages();
      if (!sends_ || clock_.now() < next || clock_.now() >= end) continue;
      next += kEach / 2;
      send(numbers_.size() % 2 == 0 ? peer::Delivery::assured : peer::Delivery::best_effort);
    }
    return results();
  }

 private:
  void join(std::size_t i) {
    peer::FederateOptions own;
    own.scene = field();
    own.application = static_cast<std::uint16_t>(i + 1);
    federates_[i] = std::make_unique<peer::Federate>(own, network_.link(i), clock_,
                                                     static_cast<std::uint32_t>(i + 1));
    peer::Federate& federate = *federates_[i];
    federate.publish(peer::EntityClass{});
    federate.subscribe(peer::EntityClass{});
    federate.publish<pdu::Comment>();
    federate.subscribe<pdu::Comment>([this, i](const pdu::Comment& comment) { take(i, comment); });
    peer::EntityDescription description;
    description.type = {pdu::EntityKind::life_form, pdu::EntityDomain::land};
    description.dead_reckoning = peer::DeadReckoningConfig{};
    handles_[i] = federate.register_object(description, hand_on_circle(clock_.now(), i));
  }

  void step() {
    clock_.advance(kStep);
    for (std::size_t i = 0; i <= kReceivers; ++i) {
      federates_[i]->update_attributes(handles_[i], hand_on_circle(clock_.now(), i));
      federates_[i]->step();
    }
  }

  void send(peer::Delivery delivery) {
    std::array<std::byte, kDatums * sizeof(std::uint64_t)> octets{};
    const pdu::FixedDatum number{0, static_cast<std::uint32_t>(numbers_.size())};
    static_cast<void>(pdu::store_record(number, octets));
    pdu::Comment comment;
    comment.originating_entity_id = federates_[0]->id_of(handles_[0]);
    comment.fixed_datums = octets;
    federates_[0]->send(comment, delivery);
    numbers_.push_back({clock_.now(), {}});
  }

  void take(std::size_t i, const pdu::Comment& comment) {
    pdu::FixedDatum number;
    if (i == 0 || !pdu::load_record(comment.fixed_datums, number)) return;
    if (number.value >= numbers_.size()) return;
    Sent& sent = numbers_[number.value];
    if (number.value % 2 == 0 && sent.taken[i - 1]++ == 0)
      delays_ms_.push_back(1e3 * pdu::to_seconds(clock_.now() - sent.at));
    else if (number.value % 2 == 1)
      ++best_effort_;
  }

  void look_at_ages() {
    for (std::size_t i = 1; i <= kReceivers; ++i) {
      const auto seen = federates_[i]->find(federates_[0]->id_of(handles_[0]));
      if (!seen) continue;
      SeenPose& pose = poses_[i - 1];
      if (seen->updates() != pose.updates) pose = {seen->updates(), clock_.now()};
      ages_ms_.push_back(1e3 * pdu::to_seconds(clock_.now() - pose.since));
    }
  }

  Deliveries results() {
    Deliveries out;
    out.loss = options_.loss;
    for (std::size_t i = 0; i < numbers_.size(); i += 2) {
      ++out.sent;
      for (const int count : numbers_[i].taken) {
        out.missed += count == 0 ? 1 : 0;
        out.doubled += count > 1 ? 1 : 0;
      }
    }
    out.p50_ms = quantile(delays_ms_, 0.5);
    out.p99_ms = quantile(delays_ms_, 0.99);
    out.max_ms = quantile(delays_ms_, 1.0);
    out.age_p99_ms = quantile(ages_ms_, 0.99);
    if (out.sent == 0) return out;
    const peer::Counters& counters = federates_[0]->peer().counters();
    out.transmissions = static_cast<double>(counters.find("assured_out")->value() +
                                            counters.find("assured_repeats")->value()) /
                        static_cast<double>(out.sent);
    const auto possible = static_cast<double>((numbers_.size() - out.sent) * kReceivers);
    out.best_effort_lost = 1.0 - static_cast<double>(best_effort_) / possible;
    return out;
  }

  struct Sent {
    nanoseconds at{};
    std::array<int, kReceivers> taken{};
  };
  DeliveryOptions options_;
  bool sends_;
  peer::ManualClock clock_;
  peer::SimulatedNetwork network_;
  std::array<std::unique_ptr<peer::Federate>, kReceivers + 1> federates_;
  std::array<peer::ObjectHandle, kReceivers + 1> handles_;
  std::vector<Sent> numbers_;  // by the number in the interaction; even ones are assured
  std::vector<double> delays_ms_, ages_ms_;
  std::array<SeenPose, kReceivers> poses_;
  std::size_t best_effort_ = 0;
};

Fields fields_of(const Deliveries& row) {
  const auto ms = [](double value) { return fmt::format("{:.2f}", value); };
  const auto percent = [](double share) { return fmt::format("{:.1f} %", 100.0 * share); };
  return Fields("delivery")
      .value("loss", row.loss)
      .value("sent", row.sent)
      .value("missed", row.missed)
      .value("doubled", row.doubled)
      .value("p50_ms", row.p50_ms)
      .value("p99_ms", row.p99_ms)
      .value("max_ms", row.max_ms)
      .value("transmissions", row.transmissions)
      .value("best_effort_lost", row.best_effort_lost)
      .value("pose_age_p99_ms", row.age_p99_ms)
      .value("pose_age_without_p99_ms", row.age_without_p99_ms)
      .cell("LOSS", percent(row.loss))
      .cell("MISSED", fmt::format("{}", row.missed))
      .cell("P50 ms", ms(row.p50_ms))
      .cell("P99 ms", ms(row.p99_ms))
      .cell("MAX ms", ms(row.max_ms))
      .cell("TRANSMISSIONS", ms(row.transmissions))
      .cell("BEST EFFORT LOST", percent(row.best_effort_lost))
      .cell("POSE AGE P99 ms", fmt::format("{:.1f}", row.age_p99_ms))
      .cell("WITHOUT", fmt::format("{:.1f}", row.age_without_p99_ms));
}

class DeliveryStudy final : public Study {
 public:
  std::vector<Flag> flags() override {
    return {{"--losses", &losses_, "delivery: shares of lost datagrams (0,20%,30%)"}};
  }

  StudyOutput run(const StudyCall&) override {
    if (!shared_.files.empty()) throw tools::UsageError("bench delivery takes no FILE: remove it");
    std::vector<Deliveries> rows;
    for (const double loss : read_values(losses_, {"", 0, 0.9}, "--losses"))
      rows.push_back(measure_deliveries({loss, shared_.span(), shared_.first_seed()}));
    const std::string sentence = fmt::format(
        "Interactions of {} octets to {} receivers, one assured and one by best effort each {} ms; "
        "delay {} ms, simulated time.\n",
        kOctets, kReceivers, kEach / milliseconds(1), 1e3 * pdu::to_seconds(kDelay));
    return {.out = lines_of(shared_.json, rows, fields_of) + (shared_.json ? "" : sentence),
            .csv = csv_of(rows, fields_of)};
  }

 private:
  std::string losses_ = "0,20%,30%";
};

}  // namespace

Deliveries measure_deliveries(const DeliveryOptions& options) {
  Deliveries found = DeliveryRun(options, true).run();
  found.age_without_p99_ms = DeliveryRun(options, false).run().age_p99_ms;
  return found;
}

std::unique_ptr<Study> delivery_study() { return std::make_unique<DeliveryStudy>(); }

}  // namespace reckon::bench
