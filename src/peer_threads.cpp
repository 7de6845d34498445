// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/peer_threads.hpp"

#include <fmt/format.h>
#include <linux/capability.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <system_error>

#include "reckon/peer/thread_name.hpp"

namespace reckon::peer {
namespace {

using std::chrono::microseconds;
using std::chrono::nanoseconds;

constexpr int kPriority = ServoThread::kPriority - 10;

// The reader looks so often whether a group that was refused can be joined by now.
constexpr nanoseconds kRetry = std::chrono::seconds(1);
// A deadline of the model loop may come no sooner than this after a step, so that one which is
// always due cannot take a core.
constexpr nanoseconds kLeastSleep = microseconds(100);
// After a pass of the model loop that took longer, as where bodies crowd a hand, a loop of
// real-time priority rests for as long, so that it takes half a core at most; but no longer than
// the second.
constexpr nanoseconds kLongPass = microseconds(500);
constexpr nanoseconds kLongestRest = std::chrono::milliseconds(50);

bool may_lock_memory() noexcept {
  rlimit limit{};
  if (getrlimit(RLIMIT_MEMLOCK, &limit) == 0 && limit.rlim_cur == RLIM_INFINITY) return true;
  __user_cap_header_struct header{_LINUX_CAPABILITY_VERSION_3, 0};
  std::array<__user_cap_data_struct, _LINUX_CAPABILITY_U32S_3> data{};
  return syscall(SYS_capget, &header, data.data()) == 0 &&
         (data[CAP_TO_INDEX(CAP_IPC_LOCK)].effective & CAP_TO_MASK(CAP_IPC_LOCK)) != 0;
}

// Under a limit it would make later allocations fail. On fault: tables that are reserved for what
// may come take no memory before it comes.
bool lock_memory() noexcept {
  return may_lock_memory() && mlockall(MCL_CURRENT | MCL_FUTURE | MCL_ONFAULT) == 0;
}

}  // namespace

PeerThreads::PeerThreads(Peer& peer, const Clock& clock, const PeerThreadsOptions& options)
    : peer_(peer),
      clock_(clock),
      options_(options),
      duty_(peer.servo_period()),
      memory_locked_(options.lock_memory && lock_memory()),
      felt_(peer.has_devices()),
      servo_(options.servo) {
  try {
    start();
  } catch (const std::system_error& error) {
    stop();
    throw std::system_error(error.code(),
                            "a thread of the peer cannot be started; raise ulimit -u (or ulimit "
                            "-v), or pids.max of its control group, or run fewer peers");
  } catch (...) {
    stop();
    throw;
  }
}

void PeerThreads::start() {
  // Several peers of one process differ by their applications.
  const auto named = [number = peer_.own_id().application](std::string_view loop) {
    return fmt::format("rk-{} {}", loop, number);
  };
  if (felt_ && servo_ == nullptr) {
    options_.own_servo.name = named("servo");
    own_servo_ = std::make_unique<ServoThread>(clock_, options_.own_servo);
    servo_ = own_servo_.get();
  }
  const auto running = [&](std::string_view name, void (PeerThreads::*loop)(Priority&) noexcept) {
    std::thread thread([this, loop] {
      Priority priority;
      if (felt_ && options_.real_time && servo_->pulse() != nullptr) {
        priority.emplace(kPriority, *servo_->pulse());
      }
      (this->*loop)(priority);
    });
    name_thread(thread.native_handle(), named(name));
    return thread;
  };
  read_ = running("read", &PeerThreads::run_read);
  write_ = running("write", &PeerThreads::run_write);
  model_ = running("model", &PeerThreads::run_model);
  if (!felt_) return;
  seat_ = servo_->add({peer_.servo_period(), [this](nanoseconds now) { peer_.servo_step(now); },
                       [this] { news_.notify(); }, &duty_});
}

void PeerThreads::stop() noexcept {
  if (seat_) servo_->remove(*seat_);
  seat_.reset();
  if (own_servo_) own_servo_->stop();
  stop_ = true;
  peer_.link().wake();
  for (WakeSignal* signal : {&news_, &room_, &ready_}) signal->notify();
  for (std::thread* thread : {&model_, &read_, &write_}) {
    if (thread->joinable()) thread->join();
  }
}

// Sleeps at the link until something arrives, or, while the ring is full, until there is room; the
// kernel keeps what arrives meanwhile.
void PeerThreads::run_read(Priority& priority) noexcept {
  while (!stop_.load(std::memory_order_relaxed)) {
    leave_time(priority);
    if (peer_.read_step(clock_.now()) > 0) news_.notify();
    if (peer_.is_reading_held_up()) {
      room_.wait(nanoseconds::max());
    } else {
      peer_.link().wait(kRetry);
    }
  }
}

void PeerThreads::run_model(Priority& priority) noexcept {
  while (!stop_.load(std::memory_order_relaxed)) {
    leave_time(priority);
    const nanoseconds begun = clock_.now();
    peer_.model_step(begun, clock_.utc_now());
    const nanoseconds took = clock_.now() - begun;
    room_.notify();
    if (peer_.has_outbound()) ready_.notify();
    if (peer_.has_group_commands()) peer_.link().wake();
    // The kernel's own thread, which delivers what arrives, is an ordinary one.
    if (priority && priority->held() && took > kLongPass)
      std::this_thread::sleep_for(std::min(took, kLongestRest));
    if (peer_.has_inbound()) continue;
    const nanoseconds next = peer_.next_step(), now = clock_.now();
    news_.wait(next > now + kLeastSleep ? next - now : kLeastSleep);
  }
}

void PeerThreads::run_write(Priority& priority) noexcept {
  while (!stop_.load(std::memory_order_relaxed)) {
    leave_time(priority);
    peer_.write_step();
    ready_.wait(nanoseconds::max());
  }
}

// Each thread judges for itself: of many, those that ran while others starved give way.
void PeerThreads::leave_time(Priority& priority) noexcept {
  if (priority && priority->starves_others(clock_.now())) priority->give_up();
}

}  // namespace reckon::peer
