// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The own unicast endpoint of a link, which changes with the interface. Private to the network.
#pragma once

#include <mutex>

#include "reckon/peer/network/link.hpp"

namespace reckon::peer {

/// Only the reading thread writes it; any thread may read it.
class LocalEndpoint {
 public:
  /// For the reading thread.
  void set(const IpEndpoint& endpoint) {
    const std::lock_guard lock(mutex_);
    endpoint_ = endpoint;
  }
  /// For the reading thread, which takes no lock because no other thread writes.
  [[nodiscard]] const IpEndpoint& value() const noexcept { return endpoint_; }
  /// Any thread.
  [[nodiscard]] IpEndpoint copy() const noexcept {
    const std::lock_guard lock(mutex_);
    return endpoint_;
  }

 private:
  mutable std::mutex mutex_;
  IpEndpoint endpoint_;
};

}  // namespace reckon::peer
