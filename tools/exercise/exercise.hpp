// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Runs several peers in one process: on loopback multicast in real time, or over a simulated
// network in simulated time. Used by the demo, the tests and the studies.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/haptics/devices/haptic_device.hpp"
#include "reckon/haptics/devices/simulated_device.hpp"
#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/counters/duty_cycle.hpp"
#include "reckon/peer/network/link.hpp"
#include "reckon/peer/network/simulated_network.hpp"
#include "reckon/peer/peer.hpp"
#include "reckon/peer/peer_threads.hpp"
#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/peer/threads/servo_thread.hpp"
#include "reckon/tools/exercise/measurement.hpp"
#include "reckon/tools/exercise/notice_digest.hpp"
#include "reckon/tools/exercise/real_devices.hpp"
#include "reckon/tools/exercise/servo_report.hpp"
#include "reckon/tools/exercise/simulated_hand.hpp"

namespace reckon::tools {

/// What to run.
struct ExerciseOptions {
  std::size_t peers = 2;
  std::string iface = "lo";  ///< real time: interface of all peers
  /// No sockets and no waiting: runs as fast as the host can. Every servo steps exactly at the
  /// period of its device, followed by its model loop as in real time; all peers step each 1 ms.
  bool simulated_time = false;
  bool transfer = true;             ///< energy is transferred on demand
  bool measure = true;              ///< compare the peers with one another
  std::uint32_t epoch = 0;          ///< 0 = drawn at random
  bool impairment_changes = false;  ///< real time: change_impairment() may be called
  bool trace_contacts = false;      ///< fill contacts()
  bool trace_bodies = false;        ///< call the sink of on_body()
  bool trace_loops = false;         ///< call the sink of on_stage()
  /// Scripts that move the hands, one per peer, instead of the scene's operators; the operators'
  /// impedances still hold them.
  std::vector<haptics::HandScript> scripts = {};
  bool even_if_slow = false;                 ///< real time: see FederateOptions
  std::optional<double> body_pace;           ///< see FederateOptions
  haptics::ForceStop* force_stop = nullptr;  ///< of all hands; outlives the exercise; null:
                                             ///< none
  bool time_servo = false;                   ///< simulated time: measure the duration of servo
                                             ///< steps
  std::vector<std::string> plugins = {};     ///< real time: driver files that may be loaded
};

/// A few peers in one process. Driven by one thread.
class Exercise {
 public:
  /// Builds the peers and announces them. Each peer receives through the impairment of `scene`;
  /// hands use the scene's operators in turn.
  /// @throws the exceptions of its parts, with value and remedy.
  Exercise(const peer::SceneFile& scene, const ExerciseOptions& options);
  ~Exercise();

  /// Lets `span` pass: waits in real time, computes in simulated time. Collects the measurements.
  void run(std::chrono::nanoseconds span);
  /// Ends the loops and resigns the peers. run() must not follow.
  void stop();

  [[nodiscard]] std::size_t size() const noexcept { return members_.size(); }
  /// Number of devices of all peers.
  [[nodiscard]] std::size_t hands() const noexcept;
  [[nodiscard]] peer::Peer& peer(std::size_t index) noexcept;
  /// The hands of a peer that follow pointers; valid as long as the exercise.
  [[nodiscard]] std::span<const PointerHand> pointers(std::size_t index) const noexcept;
  /// With trace_contacts: the contact sets that the servo of a device receives; else null. One
  /// reader, within the sink of on_step() or after run().
  [[nodiscard]] haptics::ContactRing* contacts(std::size_t peer, std::size_t device) noexcept;
  /// The clock of the peers.
  [[nodiscard]] const peer::Clock& clock() const noexcept;
  /// Sets the network impairment of all peers from now on, see JoinedPeer::change_impairment(). One
  /// thread, any.
  void change_impairment(const peer::ImpairmentLaw& law);
  /// Newest view of a peer, as of the last run().
  [[nodiscard]] const peer::PeerView& view(std::size_t index) const noexcept;
  [[nodiscard]] std::chrono::nanoseconds elapsed() const noexcept;
  [[nodiscard]] const DemoMeasurement& measurement() const noexcept { return *measurement_; }
  [[nodiscard]] ServoReport servo_report() const;
  /// Servo steps missing from measurement() because the host had no time to collect them.
  [[nodiscard]] std::uint64_t unmeasured_steps() const noexcept;
  /// Median time of one servo step of one peer, including its simulated device [ns]; 0 without
  /// time_servo.
  [[nodiscard]] double servo_step_ns() const noexcept;
  /// Sum of a counter over all peers.
  [[nodiscard]] std::uint64_t total(std::string_view counter) const;
  /// Longest time until a peer showed its first remote entity; negative while one has shown none.
  [[nodiscard]] std::chrono::nanoseconds remote_seen() const noexcept;
  /// Notices of all peers since the last call.
  [[nodiscard]] std::vector<ReceivedNotice> take_notices();
  /// Notices of real devices, and of simulated ones that could not follow, since the last call.
  [[nodiscard]] std::vector<std::string> device_notices();
  /// Updates per second if each hand were sent at each step of its servo.
  [[nodiscard]] double raw_rate() const noexcept;
  /// Arguments: peer, device (both numbered from 0), step.
  using StepSink = std::function<void(std::size_t, std::size_t, const haptics::ServoSnapshot&)>;
  /// Called for each recorded servo step of every device; see `demo --trace`.
  void on_step(StepSink sink) { sink_ = std::move(sink); }
  using BodySink = std::function<void(const haptics::BodyStep&)>;
  /// With trace_bodies: called for each recorded step of a body of the first peer.
  void on_body(BodySink sink) { body_sink_ = std::move(sink); }
  /// Arguments: peer (numbered from 0), step.
  using StageSink = std::function<void(std::size_t, const peer::LoopStep&)>;
  /// With trace_loops: called for each recorded stage of the model loop of every peer.
  void on_stage(StageSink sink) { stage_sink_ = std::move(sink); }

 private:
  struct Member;
  struct Hand;
  void add_member(const peer::SceneFile& scene, std::uint32_t epoch);
  void add_hands(std::size_t index);
  [[nodiscard]] std::chrono::nanoseconds now() const noexcept;
  void run_threads(std::chrono::nanoseconds span);
  void run_simulated(std::chrono::nanoseconds span);
  [[nodiscard]] std::chrono::nanoseconds next_instant() const noexcept;
  void pass_instant(std::chrono::nanoseconds now);
  void step_servos(std::chrono::nanoseconds now);
  void collect(bool all);
  void collect_bodies();
  void collect_stages();
  void collect_steps(std::size_t index, std::size_t most);
  void collect_shown(Member& member, std::size_t most);
  void take_shown(const peer::ShownSample& sample);

  ExerciseOptions options_;
  peer::SteadyClock steady_;
  peer::ManualClock manual_;
  std::unique_ptr<peer::SimulatedNetwork> network_;
  RealDevices real_;                          // of all members
  std::unique_ptr<peer::ServoThread> servo_;  // of all members
  std::vector<Hand> hands_;                   // of all members, in their order
  std::vector<std::unique_ptr<Member>> members_;
  std::unique_ptr<DemoMeasurement> measurement_;
  StepSink sink_;
  BodySink body_sink_;
  StageSink stage_sink_;
  std::unique_ptr<haptics::BodyRing> bodies_;  // of the first peer, with trace_bodies
  peer::DurationHistogram servo_steps_;        // of all members together
  std::chrono::nanoseconds begun_{0};
  std::chrono::nanoseconds next_tick_{0};  // simulated time
  bool stopped_ = false;
};

}  // namespace reckon::tools
