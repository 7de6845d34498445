// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/bodies/ode_calls.hpp"

#include <array>
#include <cstddef>
#include <memory>
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

/// A step posts some ten calls; the pool grows to what the largest step took.
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

/// Blocks of memory, each used again where it is large enough.
class Blocks {
 public:
  void* take(std::size_t size) {
    for (Block& block : blocks_) {
      if (block.used || block.size < size) continue;
      block.used = true;
      return block.memory.get();
    }
    blocks_.push_back({std::make_unique<std::byte[]>(2 * size), 2 * size, true});
    return blocks_.back().memory.get();
  }
  void give_back(const void* memory) noexcept {
    for (Block& block : blocks_)
      if (block.memory.get() == memory) block.used = false;
  }

 private:
  struct Block {
    std::unique_ptr<std::byte[]> memory;
    std::size_t size;
    bool used;
  };
  std::vector<Block> blocks_;
};

thread_local Calls calls;
thread_local Blocks blocks;

// Any address does: there is one thread, and nothing to lock or to wait for.
char nothing = 0;

void run(Call* call) {
  Call* const releases = call->releases;
  const bool good =
      call->function(call->context, call->index, reinterpret_cast<dCallReleaseeID>(call)) != 0;
  if (!good && call->fault != nullptr) *call->fault = 1;
  calls.give_back(call);
  if (releases != nullptr && --releases->waits_for == 0) run(releases);
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
void post(dThreadingImplementationID, int* fault, dCallReleaseeID* out,
          ddependencycount_t waits_for, dCallReleaseeID releases, dCallWaitID,
          dThreadedCallFunction* function, void* context, dcallindex_t index, const char*) {
  Call* const call = calls.take();
  *call = {
      function, context, index, static_cast<long>(waits_for), reinterpret_cast<Call*>(releases),
      fault,    nullptr};
  if (fault != nullptr) *fault = 0;
  if (out != nullptr) *out = reinterpret_cast<dCallReleaseeID>(call);
  if (waits_for == 0) run(call);
}
void change_count(dThreadingImplementationID, dCallReleaseeID target, ddependencychange_t change) {
  Call* const call = reinterpret_cast<Call*>(target);
  call->waits_for += static_cast<long>(change);
  if (call->waits_for == 0) run(call);
}
unsigned one_thread(dThreadingImplementationID) { return 1; }
int have_room(dThreadingImplementationID, ddependencycount_t) { return 1; }

void* allocate(dsizeint size) { return blocks.take(size); }
void* shrink(void* memory, dsizeint, dsizeint) { return memory; }
void release(void* memory, dsizeint) { blocks.give_back(memory); }

const dThreadingFunctionsInfo kCalls{sizeof(kCalls), make_locks, free_locks, lock, lock,
                                     make_wait,      reset_wait, reset_wait, post, change_count,
                                     wait,           one_thread, have_room};
const dWorldStepMemoryFunctionsInfo kMemory{sizeof(kMemory), allocate, shrink, release};

}  // namespace

void keep_within_thread(dWorldID world) {
  dWorldSetStepThreadingImplementation(world, &kCalls,
                                       reinterpret_cast<dThreadingImplementationID>(&nothing));
  dWorldSetStepMemoryManager(world, &kMemory);
}

}  // namespace reckon::haptics
