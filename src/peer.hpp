// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// One peer: the entities that it owns, the haptic devices that move some of them, the state table
// of remote entities, and the loops. Each loop is a step function. PeerThreads gives each a thread;
// tests and simulated time call all of them in one thread. Programs use Federate, or JoinedPeer for
// access to the loops.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "reckon/deadreckon/motion/geocentric.hpp"
#include "reckon/haptics/devices/haptic_device.hpp"
#include "reckon/haptics/exchange/force_stop.hpp"
#include "reckon/haptics/exchange/servo_types.hpp"
#include "reckon/haptics/exchange/spsc_ring.hpp"
#include "reckon/haptics/exchange/triple_buffer.hpp"
#include "reckon/peer/counters/counters.hpp"
#include "reckon/peer/loops/datagram_ring.hpp"
#include "reckon/peer/loops/model_loop.hpp"
#include "reckon/peer/loops/network_read_loop.hpp"
#include "reckon/peer/loops/network_write_loop.hpp"
#include "reckon/peer/loops/peer_hooks.hpp"
#include "reckon/peer/network/link.hpp"
#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/peer/world/peer_device.hpp"
#include "reckon/peer/world/peer_view.hpp"

namespace reckon::haptics {
class BodyWorld;
class EffectPlan;
class ServoLoop;
}  // namespace reckon::haptics

namespace reckon::haptics {
class PressingHands;
}  // namespace reckon::haptics

namespace reckon::peer {

/// Settings of a peer besides its scene.
struct PeerOptions {
  std::string name = "hand";       ///< of the peer, and marking of its first hand
  std::uint16_t site = 1;          ///< first number of its entities' IDs
  std::uint16_t application = 1;   ///< second number; the next free one is taken in a conflict
  std::uint32_t epoch = 1;         ///< random at every start of a process; never 0
  aoim::ChainLink chain_secret{};  ///< random secret with which this epoch proves its identity
  std::uint32_t started = 0;       ///< UTC second of that start; the older peer keeps a disputed ID
  std::uint8_t scene_peer = 0;     ///< its number in the scene, from 1; 0: none
  /// The first peer of a scene owns its bodies at once. False: it first looks for 1.2 s whether
  /// other peers own them.
  bool founds = true;
  /// Requests a body when a hand touches it; false: before the touch. For comparison.
  bool requests_at_touch = false;
  /// Energy that a hand of another peer may put into the bodies here beyond the energy which its
  /// peer states [J]. A large value disables the ledgers, for comparison.
  double body_loan = 0.02;
  bool transfer = true;  ///< give energy on demand
  std::chrono::nanoseconds servo_period = std::chrono::milliseconds(1);
  std::vector<EntityConfig> entities = {};  ///< owned besides its hands, see entities_of()
  bool record_shown = false;                ///< fill shown() at every model step
  bool record_changes = false;              ///< for RemoteEntities::take_changes()
  /// Size of each ring of datagrams between the model loop and the network [octets], at least 64
  /// KiB. 2 MiB hold 5,400 typical updates, or a stall of 110 ms at 50,000 a second; then the
  /// kernel's buffer fills. Memory is used as the ring fills.
  std::size_t datagram_ring = std::size_t{2} << 20;
  std::vector<NamedHooks> mechanisms = {};  ///< of the program, see PeerHooks
  DatagramTap* tap = nullptr;  ///< receives the fate of each datagram; outlives the peer
  /// The software stop of its hands, shared with other peers of a program; outlives the peer. Null:
  /// one of its own.
  haptics::ForceStop* force_stop = nullptr;
};

/// A peer. Construction allocates everything; the steps allocate nothing. servo_step, read_step,
/// model_step and write_step belong to one thread each (or all to one).
class Peer {
 public:
  /// @param scene, link, devices outlive the peer. @param devices at most kMaxDevices, also none.
  /// @throws std::invalid_argument, SceneFileError or std::runtime_error with the value and the
  /// remedy.
  Peer(const SceneFile& scene, const PeerOptions& options, Link& link,
       std::span<const PeerDevice> devices);
  /// The same with one device at the scene's origin.
  Peer(const SceneFile& scene, const PeerOptions& options, Link& link,
       haptics::HapticDevice& device);
  ~Peer();

  Peer(const Peer&) = delete;
  Peer& operator=(const Peer&) = delete;

  /// Joins the base group and announces itself at the next model step.
  void start(std::chrono::nanoseconds now);

  /// Runs the force loops of all due devices, one after the other. Never waits on the network: each
  /// loop reads its newest contact set.
  void servo_step(std::chrono::nanoseconds now) noexcept;
  /// Period of its calls: the shortest period of a device.
  [[nodiscard]] std::chrono::nanoseconds servo_period() const noexcept { return servo_period_; }
  /// The force loop of one device, numbered from 0, due or not. For callers that step each device
  /// at its own period, servo_period_of().
  void servo_step_of(std::size_t device, std::chrono::nanoseconds now) noexcept;
  [[nodiscard]] std::chrono::nanoseconds servo_period_of(std::size_t device) const noexcept {
    return servo_due_[device].period;
  }
  /// Whether a late servo_step() could be felt; servo thread.
  [[nodiscard]] bool has_near_servo() noexcept;
  /// Whether model_step() has to process the last servo_step()s now. A resting hand with nothing
  /// near is checked 100 times a second. Servo thread.
  [[nodiscard]] bool take_servo_news() noexcept;
  /// Reads datagrams from the link while the ring has room. Returns their number.
  std::size_t read_step(std::chrono::nanoseconds now) noexcept { return read_.step(now); }
  /// One pass of the model loop. `utc` is the same instant as `now`.
  void model_step(std::chrono::nanoseconds now, std::chrono::nanoseconds utc) noexcept {
    const bool is_leaving = words_.leaves.load(std::memory_order_relaxed);
    if (is_leaving) model_.ownership().leave();
    model_.step(now, utc);
    if (is_leaving) words_.has_left.store(model_.ownership().has_left(), std::memory_order_release);
    if (words_.goes_alone.load(std::memory_order_relaxed) && words_.goes_alone.exchange(false))
      model_.ownership().go_alone();
  }
  /// Sends what the model loop bundled. Returns datagrams sent.
  std::size_t write_step() noexcept { return write_.step(); }

  // Conditions on which the threads of the loops wake each other. Any thread may call these, except
  // next_step(), which belongs to the model loop.

  /// When model_step() is due if no datagram arrives and no servo steps.
  [[nodiscard]] std::chrono::nanoseconds next_step() const noexcept { return model_.next_step(); }
  /// Whether there is a device, so that servo_step() has to be called.
  [[nodiscard]] bool has_devices() const noexcept { return !servos_.empty(); }
  [[nodiscard]] std::size_t devices() const noexcept { return servos_.size(); }
  /// The plan of the servos; null without devices.
  [[nodiscard]] const haptics::EffectPlan* plan() const noexcept;
  /// Whether more datagrams are pending for model_step().
  [[nodiscard]] bool has_inbound() const noexcept {
    return !inbound_.empty() || (urgent_ && !urgent_->empty());
  }
  /// Whether write_step() has something to send.
  [[nodiscard]] bool has_outbound() const noexcept { return !outbound_.empty(); }
  /// Whether read_step() has a group to join or leave.
  [[nodiscard]] bool has_group_commands() const noexcept { return !commands_.empty(); }
  /// Whether the last read_step() left datagrams in the link because the ring was full; read
  /// thread.
  [[nodiscard]] bool is_reading_held_up() const noexcept { return read_.is_full(); }

  /// Whether the last read_step() took a datagram whose delay can be felt; read thread.
  [[nodiscard]] bool has_taken_felt() const noexcept { return read_.has_taken_felt(); }

  /// Whether arriving updates may be felt, so that their delay matters: a body is within reach of a
  /// hand or a moving body of this peer; model thread.
  [[nodiscard]] bool has_near() const noexcept { return model_.has_near(); }

  /// Whether peers wait for answers of this one; model thread.
  [[nodiscard]] bool is_prompt(std::chrono::nanoseconds now) const noexcept {
    return model_.is_prompt(now);
  }

  /// Ends the peer: sends a last Entity State with the deactivated bit for each entity, and
  /// announces the end. The loops must have stopped.
  void stop(std::chrono::nanoseconds now, std::chrono::nanoseconds utc) noexcept;
  /// Gives its bodies to other peers, from the next model_step() on. Step on until has_left(), at
  /// most for Ownership::kLeaving, before stop(). Any thread.
  void begin_leaving() noexcept { words_.leaves.store(true, std::memory_order_relaxed); }
  /// Whether begin_leaving() was called and no other peer waits for this one. Any thread.
  [[nodiscard]] bool has_left() const noexcept {
    return words_.has_left.load(std::memory_order_acquire);
  }

  /// The software stop: takes the force off all its hands while it is pressed, from the next servo
  /// step of each hand on. Any thread, and signal handlers.
  [[nodiscard]] haptics::ForceStop& force_stop() noexcept { return *force_stop_; }

  /// Goes on without the peers that are not received, by the user's word: see
  /// OwnershipStage::go_alone(). Any thread; the next pass of the model loop does it.
  void go_alone() noexcept { words_.goes_alone.store(true); }

  /// Newest view of the peer; one reader thread.
  [[nodiscard]] haptics::TripleBuffer<PeerView>& views() noexcept { return model_.views(); }
  /// With record_shown: every shown pose; one reader thread.
  [[nodiscard]] haptics::SpscRing<ShownSample>& shown() noexcept { return shown_; }
  /// The scene's bodies, or null; their published() has one reader thread.
  [[nodiscard]] haptics::BodyWorld* bodies() noexcept { return bodies_.get(); }
  /// Records every step of the servo of one device, numbered from 0, into `ring`; call while no
  /// loop runs.
  void trace(haptics::TraceRing* ring, std::size_t device = 0) noexcept;
  /// Records the contact sets of one servo into `ring`, each that differs from the previous one;
  /// call while no loop runs. The model loop writes them, without work for the servo.
  void trace_contacts(haptics::ContactRing* ring, std::size_t device = 0) noexcept {
    model_.trace_contacts(ring, device);
  }
  /// Records each stage of each pass of the model loop into `ring`; call while no loop runs.
  void trace_loop(LoopRing* ring) noexcept { model_.trace(ring); }

  [[nodiscard]] const ModelLoop& model() const noexcept { return model_; }
  /// The owned entities; for the thread of model_step(), or while no loop runs.
  [[nodiscard]] ModelLoop& model() noexcept { return model_; }
  [[nodiscard]] const Counters& counters() const noexcept { return counters_; }
  [[nodiscard]] Counters& counters() noexcept { return counters_; }
  [[nodiscard]] pdu::EntityId own_id() const noexcept { return model_.own_id(); }
  [[nodiscard]] const SceneFile& scene() const noexcept { return scene_; }
  [[nodiscard]] const deadreckon::LocalFrame& frame() const noexcept { return frame_; }
  [[nodiscard]] Link& link() noexcept { return link_; }
  /// Notices for the user (another scene, a changed ID, a group that could not be joined),
  /// oldest first; one reader thread.
  [[nodiscard]] haptics::SpscRing<Notice>& notices() noexcept { return model_.notices(); }

 private:
  struct Pressed {
    std::shared_ptr<const haptics::EffectPlan> plan;  // of the servos and of others; or null
    std::unique_ptr<haptics::PressingHands> others;   // null: no other peer can press a body
    std::unique_ptr<SteppedBodies> handless;          // null: servos step the bodies
  };
  void add_hands(const PeerOptions& options, std::span<const PeerDevice> devices);
  [[nodiscard]] Pressed pressed_of(const PeerOptions& options,
                                   std::span<const PeerDevice> devices) const;
  [[nodiscard]] bool sends_bodies() const noexcept { return bodies_ != nullptr && owns_; }

  const SceneFile& scene_;
  Link& link_;
  deadreckon::LocalFrame frame_;
  GroupPool pool_;
  Counters counters_;
  haptics::SpscRing<GroupCommand> commands_;
  DatagramRing inbound_;
  std::unique_ptr<DatagramRing> urgent_;  // of the urgent tier, if the scene has one
  DatagramRing outbound_;
  haptics::SpscRing<ShownSample> shown_;
  haptics::ForceStop own_stop_;
  haptics::ForceStop* force_stop_;
  bool owns_;                                   // the bodies, from the start
  haptics::Scene felt_;                         // as this peer begins to move it
  std::shared_ptr<BodyMover> mover_;            // of the bodies of other peers
  std::shared_ptr<haptics::BodyWorld> bodies_;  // of the servos, which share it
  Pressed pressed_;
  std::vector<std::unique_ptr<haptics::ServoLoop>> servos_;
  std::chrono::nanoseconds servo_period_;
  struct ServoDue {
    std::chrono::nanoseconds period, time{0};
  };
  std::vector<ServoDue> servo_due_;
  struct Words {
    std::atomic<bool> leaves{false}, has_left{false}, goes_alone{false};
  };
  Words words_;  // to and from the model loop
  NetworkReadLoop read_;
  NetworkWriteLoop write_;
  ModelLoop model_;
};

}  // namespace reckon::peer
