// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A peer that takes bodies of a scene, pushes some, and gives them away, at random times:
//   owners_process SCENE INTERFACE NUMBER SECONDS RATE
// NUMBER: its number in the scene, and its seed; RATE: bodies that it asks for a second, in the
// first SECONDS. It ends at SIGTERM. Each line of its log begins with CLOCK_MONOTONIC [ns], one
// clock for all processes of a host:
//   begin BODY VERSION     it simulates the body; no later than its first step
//   end BODY X Y Z VX VY VZ  it does not any more, no earlier than its last step; the last state
//   owns BODY, yields BODY   the same for what its protocol allows
//   knows BODY EPOCH VERSION the owner by its table, while that is whole
//   state BODY X Y Z VX VY VZ  of a simulated body, when it leaves the path of the last state by
//                            0.2 mm; before it, the state of the pass before
//   pose BODY X Y Z          shown, after each 4 mm
//   jump BODY EXCESS CHANGE SINCE X Y Z
//                            the pose does not follow from that of the last pass, which is X Y Z:
//                            excess distance, change of velocity, time between both passes [ms]
//   gone BODY                not shown any more
//   slept SINCE              time of the pass before; it got no processor time for long
//   final BODY X Y Z, count NAME NUMBER  at the end
// Lengths in mm, velocities in mm/s.
#include <fmt/format.h>

#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/joined_peer.hpp"
#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/peer/world/shared_bodies.hpp"

namespace {

using namespace reckon;
using namespace std::chrono_literals;
using std::chrono::nanoseconds;

constexpr nanoseconds kSlept = 200ms;  // between two passes
constexpr nanoseconds kGivesUp = 3s;   // without the body
constexpr double kLogged = 4e-3;       // [m], between two poses
constexpr double kLeastJump = 0.5e-3;  // [m]
constexpr double kStated = 0.2e-3;     // [m], off the path of the last state
constexpr double kStep = 1e-3;         // [s], of the simulation

std::atomic<bool> stopped{false};

class Owner final : public peer::ModelGuest {
 public:
  Owner(peer::JoinedPeer& joined, std::uint32_t seed, double rate, nanoseconds until)
      : joined_(joined), random_(seed), rate_(rate), until_(until), bodies_(world().size()) {
    for (std::size_t i = 0; i < bodies_.size(); ++i) bodies_[i].home = world()[i].position;
  }

  void begin_pass(peer::ModelLoop& loop) noexcept override {
    const nanoseconds now = loop.pass().now;
    for (std::size_t i = 0; i < bodies_.size(); ++i) wish(loop, i, now);
  }
  void receive(const pdu::PduHeader&, std::span<const std::byte>,
               const peer::InteractionSender&) noexcept override {}
  void end_pass(peer::ModelLoop& loop) noexcept override {
    const nanoseconds now = loop.pass().now, ended = joined_.clock().now();
    if (last_ > 0ns && now - last_ > kSlept) log(ended, "slept {}", last_.count());
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      note_owner(loop.ownership(), i, now, ended);
      note_pose(loop, i, now, pdu::to_seconds(now - last_));
    }
    last_ = now;
    last_end_ = ended;
    std::fflush(stdout);
  }
  void close() {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      log(last_end_, "final {} {}", i, text_of(bodies_[i].shown.position));
    }
    for (const char* name : {"bodies_granted", "bodies_taken", "bodies_adopted", "bodies_released",
                             "ownership_refused", "bodies_stale", "worlds_merged"})
      log(last_end_, "count {} {}", name, joined_.peer().counters().find(name)->value());
    const peer::LinkStatistics link = joined_.peer().link().statistics();
    log(last_end_, "count received {}", link.received);
    log(last_end_, "count lost_by_law {}", link.lost_by_law);
  }

 private:
  struct Body {
    bool wanted = false, simulated = false, owned = false;
    nanoseconds until{0};  // of the wish
    bool held = false;     // the wish is granted
    bool is_remote = false;
    Eigen::Vector3d home;
    peer::Tenure known;
    haptics::ObjectMotion shown;
    Eigen::Vector3d logged = Eigen::Vector3d::Constant(1e9);
    haptics::ObjectMotion stated;
    nanoseconds stated_at{-1};  // -1: none since the simulation began
  };

  template <typename... Arguments>
  static void log(nanoseconds time, fmt::format_string<const Arguments&...> text,
                  const Arguments&... arguments) {
    fmt::print("{} {}\n", time.count(), fmt::format(text, arguments...));
  }

  [[nodiscard]] static std::string text_of(const Eigen::Vector3d& lengths) {
    return fmt::format("{:.2f} {:.2f} {:.2f}", 1e3 * lengths.x(), 1e3 * lengths.y(),
                       1e3 * lengths.z());
  }
  [[nodiscard]] std::span<const haptics::BodyState> world() const {
    return joined_.peer().bodies()->states();
  }
  [[nodiscard]] nanoseconds draw(nanoseconds most) {
    return nanoseconds(std::uniform_int_distribution<nanoseconds::rep>(0, most.count())(random_));
  }

  void wish(peer::ModelLoop& loop, std::size_t number, nanoseconds now) {
    Body& body = bodies_[number];
    if (!body.wanted) {
      const double share =
          rate_ * pdu::to_seconds(now - last_) / static_cast<double>(bodies_.size());
      if (last_ == 0ns || now > until_ || std::uniform_real_distribution<>(0, 1)(random_) > share)
        return;
      loop.ownership().acquire(number);
      body.wanted = true;
      body.until = now + kGivesUp;
    } else if (!body.held && body.simulated) {
      body.held = true;
      body.until = now + draw(300ms);
      if (random_() % 2 == 0) push(loop, number);
    } else if (now > body.until) {
      loop.ownership().divest(number);
      body.wanted = body.held = false;
    }
  }

  // A hop of some centimetres, on average towards its place in the scene.
  void push(peer::ModelLoop& loop, std::size_t number) {
    std::uniform_real_distribution<> part(-1, 1);
    haptics::BodyOrder order{haptics::BodyAct::push, static_cast<std::uint32_t>(number)};
    order.point = world()[number].position;
    const Eigen::Vector3d away = order.point - bodies_[number].home;
    const Eigen::Vector3d velocity(0.3 * part(random_) - away.x(), 0.3 * part(random_) - away.y(),
                                   0.6 + 0.3 * part(random_));
    order.impulse = 0.05 * velocity;
    static_cast<void>(loop.ownership().order(order));
  }

  void note_owner(const peer::OwnershipStage& owners, std::size_t number, nanoseconds now,
                  nanoseconds ended) {
    Body& body = bodies_[number];
    const peer::Ownership& protocol = owners.protocol();
    const peer::Tenure& known = protocol.is_informed() ? protocol.tenure(number) : body.known;
    if (known.owner != body.known.owner || known.version != body.known.version)
      log(ended, "knows {} {} {}", number, known.owner, known.version);
    body.known = known;
    if (const bool simulates = !world()[number].carried; simulates != body.simulated) {
      if (simulates)
        log(now, "begin {} {}", number, protocol.tenure(number).version);
      else
        log(last_end_, "end {} {} {}", number, text_of(body.shown.position),
            text_of(body.shown.velocity));
      body.simulated = simulates;
    }
    if (const bool owns = owners.owns(number); owns != body.owned) {
      log(owns ? ended : last_end_, "{} {}", owns ? "owns" : "yields", number);
      body.owned = owns;
    }
  }

  void note_pose(peer::ModelLoop& loop, std::size_t number, nanoseconds now, double since) {
    Body& body = bodies_[number];
    const peer::RemoteEntity* row = loop.remote().find(peer::body_id(number));
    if (body.is_remote && !body.simulated && row == nullptr) log(now, "gone {}", number);
    const bool was_remote = body.is_remote;
    body.is_remote = !body.simulated && row != nullptr;
    const haptics::ObjectMotion was = body.shown;
    body.shown = world()[number];
    if (body.is_remote) body.shown = peer::motion_of(row->shown(now));
    const haptics::ObjectMotion& is = body.shown;
    // Half of the change of velocity, and the part of a step that is not simulated yet.
    const double change = (is.velocity - was.velocity).norm();
    const double step = was_remote && body.is_remote ? 0.0 : kStep;
    const double allowed = 0.5 * since * change + step * is.velocity.norm();
    const Eigen::Vector3d follows = was.position + 0.5 * since * (was.velocity + is.velocity);
    const double excess = (is.position - follows).norm() - allowed;
    note_state(number, was, now);
    const bool jumps = last_ > 0ns && excess > kLeastJump;
    if (jumps)
      log(now, "jump {} {:.2f} {:.2f} {:.2f} {}", number, 1e3 * excess, 1e3 * change, 1e3 * since,
          text_of(was.position));
    if (!jumps && (is.position - body.logged).norm() < kLogged) return;
    log(now, "pose {} {}", number, text_of(is.position));
    body.logged = is.position;
  }

  // Logs the state of the pass before as well, so that a knock lies between two logged states.
  void note_state(std::size_t number, const haptics::ObjectMotion& was, nanoseconds now) {
    Body& body = bodies_[number];
    if (!body.simulated) body.stated_at = -1ns;
    if (!body.simulated) return;
    const bool is_first = body.stated_at < 0ns;
    const Eigen::Vector3d follows =
        body.stated.position + pdu::to_seconds(now - body.stated_at) * body.stated.velocity;
    if (!is_first && (body.shown.position - follows).norm() < kStated) return;
    if (!is_first && body.stated_at < last_) log_state(number, was, last_);
    log_state(number, body.shown, now);
    body.stated = body.shown;
    body.stated_at = now;
  }
  static void log_state(std::size_t number, const haptics::ObjectMotion& motion, nanoseconds time) {
    log(time, "state {} {} {}", number, text_of(motion.position), text_of(motion.velocity));
  }

  peer::JoinedPeer& joined_;
  std::mt19937 random_;
  double rate_;
  nanoseconds until_;                  // it asks for bodies
  nanoseconds last_{0}, last_end_{0};  // begin and end of the pass before
  std::vector<Body> bodies_;
};

int run(char** words) {
  const auto number = static_cast<std::uint32_t>(std::atoi(words[3]));
  peer::FederateOptions options;
  options.scene = peer::load_scene_file(words[1]);
  options.interface = words[2];
  options.application = static_cast<std::uint16_t>(number);
  options.scene_peer = number;
  options.receiver = number;
  options.loops = peer::FederateLoops::threads;
  peer::JoinedPeer joined(options);
  Owner owner(joined, number, std::atof(words[5]),
              joined.clock().now() + pdu::from_seconds(std::atof(words[4])));
  joined.peer().model().set_guest(&owner);
  joined.run();
  // A pass each millisecond, so that it sees each jump.
  while (!stopped) {
    std::this_thread::sleep_for(1ms);
    joined.threads()->wake();
  }
  joined.stop_loops();
  owner.close();
  joined.resign();
  return 0;
}

}  // namespace

int main(int count, char** words) try {
  std::signal(SIGTERM, [](int) { stopped = true; });
  if (count == 6) return run(words);
  std::fputs("usage: owners_process SCENE INTERFACE NUMBER SECONDS RATE\n", stderr);
  return 2;
} catch (const std::exception& error) {
  fmt::print(stderr, "{}\n", error.what());
  return 1;
}
