// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Pictures of the viewer: octets of a page and CPU time of a picture, as differences beside whole
// pictures, in turn at each tick, of vehicles in circles with an update a second; `turning` ones
// are dead reckoned with acceleration and rotation, so that each picture differs. Each picture of
// the first 5 s is first read by a reader and compared with the whole one.
#include <benchmark/benchmark.h>
#include <time.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "reckon/pdu/pdu_types.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/pdu/timestamp.hpp"
#include "reckon/peer/capture/datagram_source.hpp"
#include "reckon/tests/support/capture_builder.hpp"
#include "reckon/tests/tools/support/picture_reader.hpp"
#include "reckon/tools/viewer/view_server.hpp"
#include "reckon/tools/viewer/view_stage.hpp"

namespace {

using namespace reckon;
using std::chrono::nanoseconds;

constexpr nanoseconds kStart = std::chrono::seconds(1'700'000'000);
constexpr double kCircle = 200, kSpeed = 10, kHeartbeat = 4;  // [m], [m/s], [s]

/// @param turns it is dead reckoned with its acceleration and rotation (RVW), else uniformly (FPW)
pdu::EntityState vehicle(std::uint16_t number, double t, bool moves, bool turns) {
  const double angle = (moves ? kSpeed / kCircle * t : 0.0) + 2.4 * number;
  const double speed = moves ? kSpeed : 0;
  pdu::EntityState pdu;
  pdu.header.timestamp = pdu::to_dis_timestamp(kStart + pdu::from_seconds(t), true);
  pdu.entity_id = {1, 2, number};
  pdu.entity_type.kind = pdu::EntityKind::platform;
  pdu.entity_type.domain = pdu::EntityDomain::land;
  pdu.dead_reckoning.algorithm = pdu::DeadReckoningAlgorithm::fpw;
  pdu.location = {6'378'137.0, 500.0 * (number % 100) + kCircle * std::cos(angle),
                  500.0 * (number / 100) + kCircle * std::sin(angle)};
  pdu.linear_velocity = {0, static_cast<float>(-speed * std::sin(angle)),
                         static_cast<float>(speed * std::cos(angle))};
  if (moves && turns) {
    const double pull = kSpeed * kSpeed / kCircle;
    pdu.dead_reckoning.algorithm = pdu::DeadReckoningAlgorithm::rvw;
    pdu.dead_reckoning.linear_acceleration = {0, static_cast<float>(-pull * std::cos(angle)),
                                              static_cast<float>(-pull * std::sin(angle))};
    pdu.dead_reckoning.angular_velocity = {static_cast<float>(kSpeed / kCircle), 0, 0};
  }
  pdu.orientation = {0, -1.5707964F, static_cast<float>(std::remainder(angle, 6.283185307))};
  return pdu;
}

/// An exercise that is stepped by a tick of pages.
class Exercise {
 public:
  Exercise(std::uint16_t entities, double moving, bool turns)
      : entities_(entities), moving_(static_cast<std::uint16_t>(moving * entities)), turns_(turns) {
    options_.history.span = std::chrono::seconds(2);
    stage = std::make_unique<tools::ViewStage>(options_);
  }
  void tick() {
    const double before = time_;
    time_ += pdu::to_seconds(tools::ViewServer::kTick);
    for (std::uint16_t i = 1; i <= entities_; ++i) {
      const bool moves = i <= moving_;
      const double every = moves ? 1 : kHeartbeat, first = i * 0.61803398875 * every;
      if (std::floor((time_ + first) / every) > std::floor((before + first) / every) || before == 0)
        send(i, moves);
    }
    stage->pass(kStart + pdu::from_seconds(time_));
  }

  std::unique_ptr<tools::ViewStage> stage;

 private:
  void send(std::uint16_t number, bool moves) {
    octets_.clear();
    test::append_pdu(octets_, vehicle(number, time_, moves, turns_));
    peer::SourceDatagram datagram;
    datagram.time = kStart + pdu::from_seconds(time_);
    datagram.bytes = octets_;
    (void)stage->take(datagram);
  }
  tools::StageOptions options_;
  std::uint16_t entities_, moving_;
  bool turns_;
  double time_ = 0;
  test::Octets octets_;
};

double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// A page that draws each picture at once.
struct Page {
  Page(tools::ViewStage& the_stage, bool stores) : stage(the_stage), watcher(stage.admit(false)) {
    if (stores) watcher->pictures.store();
  }
  ~Page() { stage.leave(*watcher); }
  void take() {
    picture.reset();
    for (;;) {
      const double begin = thread_seconds();
      const auto message = stage.next_message(*watcher);
      const double spent = thread_seconds() - begin;
      if (!message) return;
      if (message->opcode == tools::WebSocketOpcode::text) continue;
      picture = message->payload;
      octets += static_cast<double>(picture->size());
      microseconds.push_back(1e6 * spent);
      stage.heed(*watcher, tools::DrawnRequest{watcher->under_way.back()});
    }
  }
  void forget() {
    octets = 0;
    microseconds.clear();
  }
  [[nodiscard]] double share(double part) {
    std::ranges::sort(microseconds);
    return microseconds[static_cast<std::size_t>(part *
                                                 static_cast<double>(microseconds.size() - 1))];
  }
  tools::ViewStage& stage;
  std::unique_ptr<tools::Watcher> watcher;
  std::shared_ptr<const std::string> picture;
  double octets = 0;
  std::vector<double> microseconds;
};

double value_at(const std::string& octets, std::size_t place, auto value) {
  std::memcpy(&value, octets.data() + place, sizeof value);
  return static_cast<double>(value);
}

/// Largest distance of a shown position from the whole picture [m].
double error_of(const std::string& whole, const std::string& read) {
  double most = 0;
  for (std::size_t at = tools::kPictureHead; at < whole.size(); at += tools::kEntityOctets) {
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto shown = [&](const std::string& picture) {
        return value_at(picture, at + 8 + 8 * k, 0.0) + value_at(picture, at + 40 + 4 * k, 0.0F);
      };
      sum += std::pow(shown(whole) - shown(read), 2);
    }
    most = std::max(most, std::sqrt(sum));
  }
  return most;
}

void Pictures(benchmark::State& state) {
  Exercise exercise(static_cast<std::uint16_t>(state.range(0)),
                    static_cast<double>(state.range(1)) / 100, state.range(2) != 0);
  Page first(*exercise.stage, true), whole(*exercise.stage, true), page(*exercise.stage, false);
  tools::reading::PictureReader reader;
  double error = 0;
  for (int i = 0; i < 150; ++i) {
    exercise.tick();
    for (Page* one : {&first, &whole, &page}) one->take();
    if (!page.picture) continue;
    const std::string read = reader.take(*page.picture);
    if (!whole.picture || read.size() != whole.picture->size())
      return state.SkipWithError("the reader has another picture");
    error = std::max(error, error_of(*whole.picture, read));
  }
  if (!(error < 0.001)) return state.SkipWithError("a shown position is wrong by 1 mm or more");
  whole.forget();
  page.forget();
  std::size_t ticks = 0;
  for ([[maybe_unused]] auto _ : state) {
    exercise.tick();
    first.take();  // what pages share
    for (Page* one : ++ticks % 2 == 0 ? std::array{&whole, &page} : std::array{&page, &whole})
      one->take();
  }
  const double seconds = static_cast<double>(ticks) * pdu::to_seconds(tools::ViewServer::kTick);
  state.counters["whole_kB_s"] = whole.octets / seconds / 1e3;
  state.counters["kB_s"] = page.octets / seconds / 1e3;
  state.counters["whole_us"] = whole.share(0.5);
  state.counters["us"] = page.share(0.5);
  state.counters["us_p10"] = page.share(0.1);
  state.counters["us_p90"] = page.share(0.9);
  state.counters["error_mm"] = 1e3 * error;
}
BENCHMARK(Pictures)
    ->ArgsProduct({{100, 1000, 10000}, {10, 100}, {0, 1}})
    ->ArgNames({"entities", "moving", "turning"})
    ->Iterations(600)
    ->Unit(benchmark::kMicrosecond);

}  // namespace
