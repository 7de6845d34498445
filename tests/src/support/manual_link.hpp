// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A link whose received datagrams a test supplies. It loses none and never ends a wait by itself.
#pragma once

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include "reckon/peer/network/link.hpp"

namespace reckon::test {

/// For any threads. wait() ignores any timeout but zero: an event must wake it.
class ManualLink final : public peer::Link {
 public:
  /// A datagram arrives, without a sender address by default.
  void put(const peer::GroupAddress& group, std::vector<std::byte> octets,
           const peer::IpEndpoint& sender = {}) {
    const std::lock_guard lock(mutex_);
    waiting_.push_back({group, std::move(octets), sender});
    changed_.notify_all();
  }
  [[nodiscard]] std::size_t waiting() const {
    const std::lock_guard lock(mutex_);
    return waiting_.size();
  }
  [[nodiscard]] std::vector<peer::GroupAddress> joined() const {
    const std::lock_guard lock(mutex_);
    return joined_;
  }
  /// How many joins were made.
  [[nodiscard]] std::size_t joins() const {
    const std::lock_guard lock(mutex_);
    return joins_;
  }
  /// Blocks until there were this many joins and sent datagrams, and no datagram is unread. Returns
  /// false after a long time-out.
  [[nodiscard]] bool settled(std::size_t joins, std::size_t sent) const {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, std::chrono::seconds(30),
                             [&] { return joins_ >= joins && sent_ >= sent && waiting_.empty(); });
  }
  /// From now on sent datagrams arrive at `other`, in order.
  void connect(ManualLink& other) {
    const std::lock_guard lock(mutex_);
    other_ = &other;
  }
  /// The thread of the last receive().
  [[nodiscard]] std::thread::id reader() const {
    const std::lock_guard lock(mutex_);
    return reader_;
  }
  /// How often a thread waited here; polls do not count.
  [[nodiscard]] std::size_t waits() const {
    const std::lock_guard lock(mutex_);
    return waits_;
  }

  bool send(const peer::IpEndpoint& to, std::span<const std::byte> octets) noexcept override {
    ManualLink* other = nullptr;
    {
      const std::lock_guard lock(mutex_);
      ++sent_;
      other = other_;
      changed_.notify_all();
    }
    if (other != nullptr) other->put(to, {octets.begin(), octets.end()});
    return true;
  }
  std::size_t receive(std::span<peer::Datagram> out) noexcept override {
    const std::lock_guard lock(mutex_);
    taken_.clear();
    reader_ = std::this_thread::get_id();
    const std::size_t count = std::min(out.size(), waiting_.size());
    for (std::size_t i = 0; i < count; ++i) {
      taken_.push_back(std::move(waiting_.front()));
      waiting_.pop_front();
      const Waiting& taken = taken_.back();
      out[i] = {taken.group, taken.sender, {}, std::chrono::nanoseconds::max()};  // of now
    }
    for (std::size_t i = 0; i < count; ++i) out[i].bytes = taken_[i].octets;
    changed_.notify_all();
    return count;
  }
  std::error_code join(const peer::GroupAddress& group) noexcept override {
    const std::lock_guard lock(mutex_);
    joined_.push_back(group);
    ++joins_;
    changed_.notify_all();
    return {};
  }
  void leave(const peer::GroupAddress& group) noexcept override {
    const std::lock_guard lock(mutex_);
    std::erase(joined_, group);
  }
  bool wait(std::chrono::nanoseconds timeout) noexcept override {
    std::unique_lock lock(mutex_);
    if (timeout > std::chrono::nanoseconds(0)) {
      ++waits_;
      changed_.wait(lock, [&] { return woken_ || !waiting_.empty(); });
    }
    return std::exchange(woken_, false) || !waiting_.empty();
  }
  void wake() noexcept override {
    const std::lock_guard lock(mutex_);
    woken_ = true;
    changed_.notify_all();
  }
  [[nodiscard]] peer::IpEndpoint local_endpoint() const noexcept override {
    return peer::IpEndpoint::v4(0x7f000001u, 40'000);
  }
  [[nodiscard]] std::size_t max_payload() const noexcept override { return 1372; }
  [[nodiscard]] peer::LinkStatistics statistics() const noexcept override { return {}; }

 private:
  struct Waiting {
    peer::GroupAddress group;
    std::vector<std::byte> octets;
    peer::IpEndpoint sender;
  };
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  std::deque<Waiting> waiting_;
  std::vector<Waiting> taken_;
  std::vector<peer::GroupAddress> joined_;
  std::size_t sent_ = 0, waits_ = 0, joins_ = 0;
  bool woken_ = false;
  ManualLink* other_ = nullptr;
  std::thread::id reader_;
};

}  // namespace reckon::test
