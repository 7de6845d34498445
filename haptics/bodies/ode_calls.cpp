// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/bodies/ode_calls.hpp"

#include <cassert>
#include <cstddef>
#include <new>
#include <utility>
#include <vector>

namespace reckon::haptics {
namespace {

/// A posted call: it runs when all that it depends on has run.
struct Call {
  dThreadedCallFunction* function = nullptr;
  void* context = nullptr;
  dcallindex_t index = 0;
  long waits_for = 0;
  Call* releases = nullptr;
  int* fault = nullptr;
  Call* next_free = nullptr;
};

/// A step posts about ten calls; the pool grows to the need of the largest step.
class Calls {
 public:
  Call* take() {
    if (free_ == nullptr) {
      all_.push_back(std::make_unique<Call>());
      return all_.back().get();
    }
    Call* const call = free_;
    free_ = call->next_free;
    return call;
  }
  void give_back(Call* call) noexcept {
    call->next_free = free_;
    free_ = call;
  }

 private:
  std::vector<std::unique_ptr<Call>> all_;
  Call* free_ = nullptr;
};

/// Memory blocks, each reused if it is large enough. ODE frees a block without its owner, so each
/// block begins with a header.
class Blocks {
 public:
  void* take(std::size_t size) {
    for (const auto& block : blocks_) {
      Head& head = head_of(block.get() + sizeof(Head));
      if (head.used || head.size < size) continue;
      head.used = true;
      return block.get() + sizeof(Head);
    }
    blocks_.push_back(std::make_unique<std::byte[]>(sizeof(Head) + 2 * size));
    std::byte* const block = blocks_.back().get();
    new (block) Head{2 * size, true};
    return block + sizeof(Head);
  }
  static void give_back(void* memory) noexcept { head_of(memory).used = false; }

 private:
  struct alignas(std::max_align_t) Head {
    std::size_t size;
    bool used;
  };
  static Head& head_of(void* memory) noexcept {
    return *std::launder(reinterpret_cast<Head*>(static_cast<std::byte*>(memory) - sizeof(Head)));
  }
  std::vector<std::unique_ptr<std::byte[]>> blocks_;
};

}  // namespace

struct StepHost::Store {
  Calls calls;
  Blocks blocks;
};

namespace {

// ODE's requests for memory do not name a world: it is the one that this thread steps.
thread_local Blocks* stepped = nullptr;

// A dummy address: with one thread there is nothing to lock or to wait for.
char nothing = 0;

Calls& calls_of(dThreadingImplementationID calls) noexcept {
  return *reinterpret_cast<Calls*>(calls);
}

void run(Calls& calls, Call* call) {
  Call* const releases = call->releases;
  const bool good =
      call->function(call->context, call->index, reinterpret_cast<dCallReleaseeID>(call)) != 0;
  if (!good && call->fault != nullptr) *call->fault = 1;
  calls.give_back(call);
  if (releases != nullptr && --releases->waits_for == 0) run(calls, releases);
}

dMutexGroupID make_locks(dThreadingImplementationID, dmutexindex_t, const char* const*) {
  return reinterpret_cast<dMutexGroupID>(&nothing);
}
void free_locks(dThreadingImplementationID, dMutexGroupID) {}
void lock(dThreadingImplementationID, dMutexGroupID, dmutexindex_t) {}
dCallWaitID make_wait(dThreadingImplementationID) {
  return reinterpret_cast<dCallWaitID>(&nothing);
}
void reset_wait(dThreadingImplementationID, dCallWaitID) {}
void wait(dThreadingImplementationID, int* status, dCallWaitID, const dThreadedWaitTime*,
          const char*) {
  if (status != nullptr) *status = 1;
}
void post(dThreadingImplementationID own, int* fault, dCallReleaseeID* out,
          ddependencycount_t waits_for, dCallReleaseeID releases, dCallWaitID,
          dThreadedCallFunction* function, void* context, dcallindex_t index, const char*) {
  Call* const call = calls_of(own).take();
  *call = {
      function, context, index, static_cast<long>(waits_for), reinterpret_cast<Call*>(releases),
      fault,    nullptr};
  if (fault != nullptr) *fault = 0;
  if (out != nullptr) *out = reinterpret_cast<dCallReleaseeID>(call);
  if (waits_for == 0) run(calls_of(own), call);
}
void change_count(dThreadingImplementationID own, dCallReleaseeID target,
                  ddependencychange_t change) {
  Call* const call = reinterpret_cast<Call*>(target);
  call->waits_for += static_cast<long>(change);
  if (call->waits_for == 0) run(calls_of(own), call);
}
unsigned one_thread(dThreadingImplementationID) { return 1; }
int have_room(dThreadingImplementationID, ddependencycount_t) { return 1; }

void* allocate(dsizeint size) {
  assert(stepped != nullptr);
  return stepped->take(size);
}
void* shrink(void* memory, dsizeint, dsizeint) { return memory; }
void release(void* memory, dsizeint) { Blocks::give_back(memory); }

const dThreadingFunctionsInfo kCalls{sizeof(kCalls), make_locks, free_locks, lock, lock,
                                     make_wait,      reset_wait, reset_wait, post, change_count,
                                     wait,           one_thread, have_room};
const dWorldStepMemoryFunctionsInfo kMemory{sizeof(kMemory), allocate, shrink, release};

/// Scope in which this thread steps the world that uses these blocks.
class Stepping {
 public:
  explicit Stepping(Blocks& blocks) noexcept : outer_(std::exchange(stepped, &blocks)) {}
  ~Stepping() { stepped = outer_; }
  Stepping(const Stepping&) = delete;
  Stepping& operator=(const Stepping&) = delete;

 private:
  Blocks* const outer_;
};

}  // namespace

StepHost::StepHost() : store_(std::make_unique<Store>()) {}
StepHost::~StepHost() = default;

void StepHost::serve(dWorldID world) {
  dWorldSetStepThreadingImplementation(
      world, &kCalls, reinterpret_cast<dThreadingImplementationID>(&store_->calls));
  dWorldSetStepMemoryManager(world, &kMemory);
}

void StepHost::step(dWorldID world, double dt) noexcept {
  const Stepping scope(store_->blocks);
  dWorldStep(world, dt);
}

void StepHost::quick_step(dWorldID world, double dt) noexcept {
  const Stepping scope(store_->blocks);
  dWorldQuickStep(world, dt);
}

}  // namespace reckon::haptics
