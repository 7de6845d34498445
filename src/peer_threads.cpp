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

#include "reckon/peer/threads/thread_name.hpp"

namespace reckon::peer {
namespace {

using std::chrono::microseconds;
using std::chrono::nanoseconds;

constexpr int kPriority = ServoThread::kPriority - 10;

// Interval at which the reader tries again to join a refused group.
constexpr nanoseconds kRetry = std::chrono::seconds(1);
// Least time from a step of the model loop to its next deadline, so that a permanently due deadline
// cannot occupy a core.
constexpr nanoseconds kLeastSleep = microseconds(100);
// After a pass of the model loop longer than kLongPass, for example when bodies crowd a hand, a
// loop of real-time priority rests for the same time, so that it takes at most half of a core. The
// rest is at most kLongestRest.
constexpr nanoseconds kLongPass = microseconds(500);
constexpr nanoseconds kLongestRest = std::chrono::milliseconds(50);
constexpr std::size_t kMostTogether = 512;  // datagrams
// If notifications of the model loop come at least this often, they come from the servo of a moving
// hand. Arrivals then wait for the next of them.
constexpr nanoseconds kPace = microseconds(1500);
// The reader thread reads for this time after a body was near, or after more had arrived than a
// pass takes.
constexpr nanoseconds kUrgent = std::chrono::seconds(1);

bool may_lock_memory() noexcept {
  rlimit limit{};
  if (getrlimit(RLIMIT_MEMLOCK, &limit) == 0 && limit.rlim_cur == RLIM_INFINITY) return true;
  __user_cap_header_struct header{_LINUX_CAPABILITY_VERSION_3, 0};
  std::array<__user_cap_data_struct, _LINUX_CAPABILITY_U32S_3> data{};
  return syscall(SYS_capget, &header, data.data()) == 0 &&
         (data[CAP_TO_INDEX(CAP_IPC_LOCK)].effective & CAP_TO_MASK(CAP_IPC_LOCK)) != 0;
}

// With a limit, locking would make later allocations fail. With MCL_ONFAULT, reserved tables take
// no memory until it is used.
bool lock_memory() noexcept {
  return may_lock_memory() && mlockall(MCL_CURRENT | MCL_FUTURE | MCL_ONFAULT) == 0;
}

}  // namespace

PeerThreads::PeerThreads(Peer& peer, const Clock& clock, const PeerThreadsOptions& options)
    : peer_(peer),
      clock_(clock),
      options_(options),
      duty_(peer.servo_period()),
      read_times_(peer.servo_period()),
      model_times_(peer.servo_period()),
      write_times_(peer.servo_period()),
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
  // Several peers of one process have different application numbers.
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
                       [this] {
                         if (peer_.take_servo_news()) wake();
                       },
                       [this] { return peer_.has_near_servo(); }, &duty_});
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

void PeerThreads::wake() noexcept {
  news_.notify();
  std::atomic_thread_fence(std::memory_order_seq_cst);
  if (at_link_.load(std::memory_order_relaxed)) peer_.link().wake();
}

// Sleeps at the link until something arrives. While the ring is full, it sleeps until there is
// room, and the kernel keeps the arrivals.
void PeerThreads::run_read(Priority& priority) noexcept {
  while (!stop_.load(std::memory_order_relaxed)) {
    leave_time(priority);
    LinkReader reads = reads_.load(std::memory_order_acquire);
    if (reads == LinkReader::asked_back) {
      reads_.store(reads = LinkReader::model, std::memory_order_release);
      news_.notify();  // the model loop may sleep elsewhere than at the link
    }
    if (reads == LinkReader::model) {
      room_.wait(nanoseconds::max());
      continue;
    }
    const nanoseconds begun = clock_.now();
    const bool any = peer_.read_step(begun) > 0;
    if (any) announce_arrivals();
    read_times_.record(begun, clock_.now());
    if (peer_.is_reading_held_up()) {
      room_.wait(nanoseconds::max());
    } else {
      peer_.link().wait(kRetry);
    }
  }
}

// Arrivals that cannot be felt wait for the servo's next step if each step notifies the model loop.
// The model loop waits at most kPace for that.
void PeerThreads::announce_arrivals() noexcept {
  std::atomic_thread_fence(std::memory_order_seq_cst);
  if (peer_.has_taken_felt() || !paced_.load(std::memory_order_relaxed)) news_.notify();
}

void PeerThreads::run_model(Priority& priority) noexcept {
  while (!stop_.load(std::memory_order_relaxed)) {
    leave_time(priority);
    const nanoseconds begun = clock_.now();
    const std::size_t taken = reads_in_model_loop() ? read_in_model_loop(begun) : 0;
    peer_.model_step(begun, clock_.utc_now());
    const nanoseconds ended = clock_.now(), took = ended - begun;
    send_out();
    model_times_.record(begun, clock_.now());
    if (peer_.has_near() || peer_.has_inbound()) urgent_until_ = ended + kUrgent;
    choose_reader(ended);
    // The rest is for the kernel's thread that delivers datagrams, which has ordinary priority.
    if (priority && priority->held() && took > kLongPass)
      std::this_thread::sleep_for(std::min(took, kLongestRest));
    std::atomic_thread_fence(std::memory_order_seq_cst);
    if (!peer_.has_inbound()) wait_for_work(begun, taken);
  }
}

// Returns the number of datagrams.
std::size_t PeerThreads::read_in_model_loop(nanoseconds now) noexcept {
  const bool due = now >= next_look_ || peer_.has_group_commands() || peer_.is_reading_held_up();
  if (!peer_.link().wait(nanoseconds(0)) && !due) return 0;
  next_look_ = now + kRetry;
  std::size_t taken = 0;
  do {
    taken += peer_.read_step(now);
  } while (!peer_.is_reading_held_up() && taken < kMostTogether &&
           peer_.link().wait(nanoseconds(0)));
  return taken;
}

void PeerThreads::send_out() noexcept {
  if (!peer_.has_outbound()) return;
  if (!reads_in_model_loop()) return ready_.notify();
  const std::unique_lock own(sending_, std::try_to_lock);
  own ? static_cast<void>(peer_.write_step()) : ready_.notify();
}

void PeerThreads::choose_reader(nanoseconds now) noexcept {
  const LinkReader reads = reads_.load(std::memory_order_acquire);
  const bool urgent = now < urgent_until_;
  if (urgent && reads == LinkReader::model) {
    reads_.store(LinkReader::reader, std::memory_order_release);
  } else if (!urgent && reads == LinkReader::reader) {
    reads_.store(LinkReader::asked_back, std::memory_order_release);
    peer_.link().wake();
  }
  if (reads != LinkReader::model || urgent) room_.notify();
  if (reads == LinkReader::reader && peer_.has_group_commands()) peer_.link().wake();
}

void PeerThreads::wait_for_work(nanoseconds begun, std::size_t taken) noexcept {
  const nanoseconds now = clock_.now();
  const nanoseconds until = std::max(peer_.next_step(), now + kLeastSleep);
  const nanoseconds collects = begun + (peer_.is_prompt(now) ? kPrompt : kTogether);
  const nanoseconds together = std::min(std::max(collects, now + kLeastSleep), until);
  const bool paced = paced_.load(std::memory_order_relaxed);
  const nanoseconds of_servo = paced ? std::min(until, now + kPace) : until;
  if (!reads_in_model_loop()) {
    note_pace(news_.wait(of_servo - now));
  } else if (taken > 1) {
    news_.wait(together - now);  // collects further datagrams
  } else if (paced) {
    note_pace(news_.wait(of_servo - now));
  } else {
    wait_at_link(std::min(until - now, kRetry), together);
  }
}

// An arrival soon after the last pass waits for others. A notification that ended the wait is taken,
// else it would cause a second pass.
void PeerThreads::wait_at_link(nanoseconds timeout, nanoseconds together) noexcept {
  at_link_.store(true, std::memory_order_relaxed);
  std::atomic_thread_fence(std::memory_order_seq_cst);
  bool news = news_.wait(nanoseconds(0));
  const bool ended = !news && peer_.link().wait(timeout);
  at_link_.store(false, std::memory_order_relaxed);
  const nanoseconds now = clock_.now();
  if (ended) news = news_.wait(std::max(together - now, nanoseconds(0)));
  note_pace(news);
}

// The servo's steps pace the model loop as long as each of them notifies it.
void PeerThreads::note_pace(bool news) noexcept {
  const nanoseconds now = clock_.now();
  paced_.store(news && now - last_news_ < kPace, std::memory_order_relaxed);
  if (news) last_news_ = now;
}

void PeerThreads::run_write(Priority& priority) noexcept {
  while (!stop_.load(std::memory_order_relaxed)) {
    leave_time(priority);
    {
      const std::lock_guard own(sending_);
      const nanoseconds begun = clock_.now();
      peer_.write_step();
      write_times_.record(begun, clock_.now());
    }
    ready_.wait(nanoseconds::max());
  }
}

// Each thread checks for itself: a thread that ran while others starved gives up its priority.
void PeerThreads::leave_time(Priority& priority) noexcept {
  if (priority && priority->starves_others(clock_.now())) priority->give_up();
}

}  // namespace reckon::peer
