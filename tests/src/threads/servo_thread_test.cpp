// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/threads/servo_thread.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <ctime>
#include <memory>
#include <string>
#include <vector>

#include "reckon/peer/threads/awake_processors.hpp"

namespace reckon::peer {
namespace {

using namespace std::chrono_literals;
using std::chrono::nanoseconds;

const SteadyClock kClock;

// Counts the calls of one servo and wakes the test after `wanted` calls.
struct Counted {
  explicit Counted(nanoseconds period, int wanted = 1) : duty(period), enough(wanted) {}

  [[nodiscard]] Servo servo() {
    return {duty.period(),
            [this](nanoseconds now) {
              in_order = in_order && now >= last;
              last = now;
              if (++steps == enough) reached.notify();
            },
            [this] { told = steps.load(); },
            {},
            &duty};
  }
  void wait() {
    while (steps < enough) reached.wait(nanoseconds::max());
  }

  DutyCycle duty;
  int enough;
  std::atomic<int> steps{0}, told{0};
  nanoseconds last{0};
  bool in_order = true;
  WakeSignal reached;
};

TEST(ServoThread, StepsEachServoAtItsOwnPeriod) {
  ServoThread thread(kClock);
  Counted quick(500us, 400), slow(4ms, 40);
  const std::size_t first = thread.add(quick.servo());
  const std::size_t second = thread.add(slow.servo());
  quick.wait();
  slow.wait();
  thread.remove(first);
  thread.remove(second);
  // Periods with a step and missed periods add up to all periods.
  const auto periods = [](const Counted& c) {
    return static_cast<double>(c.duty.steps() + c.duty.missed()) *
           static_cast<double>(c.duty.period().count());
  };
  EXPECT_TRUE(quick.in_order);
  EXPECT_TRUE(slow.in_order);
  EXPECT_GE(periods(quick), 160e6 * 0.9);
  EXPECT_LE(slow.duty.steps(), quick.duty.steps());
  EXPECT_EQ(quick.duty.steps(), static_cast<std::uint64_t>(quick.steps));
}

TEST(ServoThread, CallsNothingOfAServoThatWasRemoved) {
  ServoThread thread(kClock);
  Counted stays(300us, 300);
  const std::size_t other = thread.add(stays.servo());
  for (int life = 0; life < 50; ++life) {
    auto goes = std::make_unique<Counted>(200us, 1 + life % 3);
    const std::size_t number = thread.add(goes->servo());
    if (life % 2 == 0) goes->wait();
    thread.remove(number);
    const int steps = goes->steps;
    EXPECT_EQ(goes->duty.steps(), static_cast<std::uint64_t>(steps));
    goes.reset();  // a sanitizer would detect a call now
  }
  stays.wait();
  thread.remove(other);
}

TEST(ServoThread, ReportsAfterTheStep) {
  ServoThread thread(kClock);
  Counted servo(500us, 100);
  const std::size_t number = thread.add(servo.servo());
  servo.wait();
  thread.remove(number);
  EXPECT_GE(servo.told, 99 - 1);
  EXPECT_LE(servo.told, servo.steps);
}

TEST(ServoThread, ServesManyAndRefusesOneTooMany) {
  ServoThread thread(kClock);
  std::vector<std::unique_ptr<Counted>> servos;
  std::vector<std::size_t> numbers;
  for (std::size_t i = 0; i < ServoThread::kMostServos; ++i) {
    servos.push_back(std::make_unique<Counted>(50ms));
    numbers.push_back(thread.add(servos.back()->servo()));
  }
  Counted other(50ms);
  EXPECT_THROW(static_cast<void>(thread.add(other.servo())), std::runtime_error);
  for (auto& servo : servos) servo->wait();
  for (const std::size_t number : numbers) thread.remove(number);
  EXPECT_EQ(thread.add(other.servo()), 0u);
  other.wait();
  thread.remove(0);
}

Servo computing(std::atomic<int>& steps, nanoseconds period, nanoseconds span) {
  Servo servo;
  servo.period = period;
  servo.step = [&steps, span](nanoseconds begin) {
    while (kClock.now() - begin < span) {
    }
    ++steps;
  };
  return servo;
}

TEST(OrdinaryPulse, DetectsStarvationByMissedBeatsAndCpuTime) {
  EXPECT_FALSE(starves_ordinary_threads(499ms, 499ms, 500ms));
  EXPECT_TRUE(starves_ordinary_threads(500ms, 50ms, 500ms));
  EXPECT_FALSE(starves_ordinary_threads(500ms, 49ms, 500ms)) << "others take the time";
  EXPECT_FALSE(starves_ordinary_threads(8s, 1ms, 500ms)) << "the process was stopped";
}

// The clock is advanced by hand while the process computes. Without a beat the pulse would report
// starvation for ever.
TEST(OrdinaryPulse, GoesOnWhereOrdinaryThreadsRun) {
  ManualClock clock;
  const OrdinaryPulse pulse(clock, 10ms);
  for (int i = 0; i < 5; ++i) {
    clock.advance(10ms);
    const std::clock_t begin = std::clock();
    while (std::clock() - begin < CLOCKS_PER_SEC / 200) {  // half of the silence, above a tenth
    }
    for (int turn = 0; pulse.starves(clock.now()) && turn < 500'000; ++turn) {
      std::this_thread::yield();
    }
    ASSERT_FALSE(pulse.starves(clock.now())) << i;
  }
}

// Steps without a pause, one thread per core, at a priority above all threads that could stop them.
TEST(ServoThread, GivesThePriorityUpWhereOrdinaryThreadsStarve) {
  std::atomic<int> steps{0};
  std::vector<std::unique_ptr<ServoThread>> threads;
  const unsigned cores = std::thread::hardware_concurrency();
  for (unsigned i = 0; i < cores; ++i) {
    threads.push_back(
        std::make_unique<ServoThread>(kClock, ServoThreadOptions{.starvation = 100ms}));
  }
  if (!threads.front()->real_time()) GTEST_SKIP() << "needs the right to SCHED_FIFO";
  for (auto& thread : threads) {  // two, so that one is always due
    for (int i = 0; i < 2; ++i) static_cast<void>(thread->add(computing(steps, 100us, 150us)));
  }
  const auto gave_up = [](const auto& thread) { return !thread->real_time(); };
  while (std::none_of(threads.begin(), threads.end(), gave_up) && steps < 1'000'000) {
    std::this_thread::yield();
  }
  const auto first = std::find_if(threads.begin(), threads.end(), gave_up);
  ASSERT_NE(first, threads.end());
  EXPECT_NE((*first)->describe().find("gave SCHED_FIFO up: it starved other threads"),
            std::string::npos);
  const int before = steps;
  while (steps < before + 10) std::this_thread::yield();  // they are still served
  for (auto& thread : threads) {
    for (const std::size_t servo : {0u, 1u}) thread->remove(servo);
  }
}

// Stopped in the third step, as by a debugger: no beat came for long, but no other thread ran
// either.
TEST(ServoThread, KeepsThePriorityWhereTheProcessWasStopped) {
  ManualClock clock;
  ServoThread thread(clock);
  if (!thread.real_time()) GTEST_SKIP() << "needs the right to SCHED_FIFO";
  const std::string before = thread.describe();
  DutyCycle duty(1ms);
  std::atomic<int> steps{0};
  WakeSignal told;
  Servo servo;
  servo.duty = &duty;
  servo.is_urgent = [] { return false; };  // spinning would count as CPU time of the process
  servo.step = [&](nanoseconds) {
    if (steps == 2) clock.advance(60s);
  };
  servo.tell = [&] {  // the thread has judged itself since the last step
    ++steps;
    told.notify();
  };
  const std::size_t number = thread.add(std::move(servo));
  for (int step = 1; step <= 10; ++step) {
    clock.advance(1ms);
    while (steps < step) told.wait(nanoseconds::max());
  }
  thread.remove(number);
  EXPECT_EQ(duty.missed(), 59'999u) << "the next is due as it ends";
  EXPECT_EQ(thread.describe(), before);
}

TEST(ServoThread, DescribesItsScheduling) {
  const ServoThread plain(kClock, {.real_time = false});
  EXPECT_FALSE(plain.real_time());
  EXPECT_EQ(plain.describe(), "SCHED_OTHER as requested, wakes when a step is due");
  const ServoThread thread(kClock);
  std::string granted = "SCHED_FIFO 50, wakes 100 us early and spins near touchable objects";
  if (AwakeProcessors::is_allowed()) granted += "; processors stay awake then";
  EXPECT_EQ(thread.describe(),
            thread.real_time()
                ? granted
                : "no real-time privilege (see reckon doctor), wakes when a step is due");
}

}  // namespace
}  // namespace reckon::peer
