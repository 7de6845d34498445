// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/contact/contact_run.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>

#include "reckon/haptics/servo/servo_loop.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/network/link.hpp"
#include "reckon/tools/exercise/exercise.hpp"
#include "reckon/tools/exercise/simulated_hand.hpp"

namespace reckon::bench {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kTenth = 100;  // servo steps

/// Collects the steps of all peers, which arrive peer by peer.
class Recorder {
 public:
  Recorder(tools::Exercise& exercise, ContactRun& run)
      : exercise_(exercise), run_(run), record_(run.record), taken_(run.record.hands) {}

  void add(std::size_t hand, const haptics::ServoSnapshot& step) {
    if (hand >= record_.hands) return;
    const std::size_t hands = record_.hands, row = taken_[hand]++;
    if (row == run_.packets.size() * kTenth)
      run_.packets.push_back(static_cast<double>(exercise_.total("datagrams_out")));
    if (record_.positions.size() < (row + 1) * hands) {
      record_.positions.resize((row + 1) * hands, Vector3d::Zero());
      record_.forces.resize((row + 1) * hands * hands, Vector3d::Zero());
    }
    record_.positions[row * hands + hand] = step.device;
    for (std::size_t c = 0; c < step.count; ++c) {
      for (std::size_t other = 0; other < hands; ++other) {
        if (other != hand && exercise_.view(other).own == step.contacts[c].id)
          record_.forces[(row * hands + hand) * hands + other] = step.contacts[c].force;
      }
    }
  }

  /// Removes steps that not all peers have made.
  void finish() {
    const std::size_t steps = *std::min_element(taken_.begin(), taken_.end());
    record_.positions.resize(steps * record_.hands);
    record_.forces.resize(steps * record_.hands * record_.hands);
  }

 private:
  tools::Exercise& exercise_;
  ContactRun& run_;
  ContactRecord& record_;
  std::vector<std::size_t> taken_;
};

/// Force on one sphere from another of the same radius [N].
Vector3d spring_force(const Vector3d& from_other, double reach, double stiffness) {
  const double distance = from_other.norm();
  if (!(distance < reach) || distance == 0) return Vector3d::Zero();
  return stiffness * (reach - distance) / distance * from_other;
}

}  // namespace

double stiffest_hand(const peer::SceneFile& scene) {
  const auto device = tools::make_simulated_device(scene, {});
  return haptics::ServoLoop(*device, haptics::EffectPlan(), {}).remote_stiffness_limit();
}

ContactRun run_contact(const peer::SceneFile& scene, std::size_t peers,
                       const std::vector<haptics::HandScript>& scripts, double seconds,
                       std::size_t recorded, const std::function<bool(double)>& go_on) {
  tools::ExerciseOptions options;
  options.peers = peers;
  options.simulated_time = true;
  options.epoch = 1;
  options.scripts = scripts;
  options.time_servo = true;
  tools::Exercise exercise(scene, options);
  ContactRun run;
  run.record.hands = recorded > 0 ? recorded : peers;
  run.seconds = seconds;
  Recorder recorder(exercise, run);
  exercise.on_step([&](std::size_t peer, std::size_t device, const auto& step) {
    if (device == 0) recorder.add(peer, step);
  });
  // In slices that end where a whole run collects its steps, so that the result is the same.
  constexpr std::chrono::milliseconds kSlice(100);
  const std::chrono::nanoseconds end = pdu::from_seconds(seconds);
  for (std::chrono::nanoseconds done{0}; done < end; done += kSlice) {
    if (go_on && !go_on(std::chrono::duration<double>(done) / end)) break;
    exercise.run(std::min<std::chrono::nanoseconds>(kSlice, end - done));
  }
  recorder.finish();
  const auto rate = [&](std::string_view counter) {
    return static_cast<double>(exercise.total(counter)) / seconds;
  };
  run.packets_per_s = rate("datagrams_out");
  run.octets_per_s = rate("octets_out") + peer::kUdpIpv4Headers * run.packets_per_s;
  run.for_force_per_s = rate("sent_force");
  run.servo_step_ns = exercise.servo_step_ns();
  return run;
}

ContactRecord run_twins(const peer::SceneFile& scene, double stiffness,
                        const std::vector<haptics::HandScript>& scripts, double seconds) {
  ContactRecord record;
  record.hands = scripts.size();
  std::vector<std::unique_ptr<haptics::SimulatedDevice>> devices;
  for (std::size_t hand = 0; hand < record.hands; ++hand)
    devices.push_back(tools::make_simulated_hand(scene, hand, scripts[hand]));
  const auto steps = static_cast<std::size_t>(std::lround(seconds * 1e3));
  for (std::size_t step = 0; step < steps; ++step) {
    const std::chrono::milliseconds now(step + 1);
    for (const auto& device : devices) record.positions.push_back(device->read(now).position);
    for (std::size_t hand = 0; hand < record.hands; ++hand) {
      Vector3d sum = Vector3d::Zero();
      for (std::size_t other = 0; other < record.hands; ++other) {
        const Vector3d apart = record.position(step, hand) - record.position(step, other);
        record.forces.push_back(spring_force(apart, 2 * scene.hand.radius, stiffness));
        sum += record.forces.back();
      }
      devices[hand]->write(sum, now);
    }
  }
  return record;
}

}  // namespace reckon::bench
