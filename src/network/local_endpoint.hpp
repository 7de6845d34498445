// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The own unicast endpoint of a link, which changes where the interface does. Private to the
// network.
#pragma once

#include <mutex>

#include "reckon/peer/network/link.hpp"

namespace reckon::peer {

/// Written by the reading thread alone, read by any.
class LocalEndpoint {
 public:
  /// The reading thread.
  void set(const IpEndpoint& endpoint) {
    const std::lock_guard lock(mutex_);
    endpoint_ = endpoint;
  }
  /// The reading thread, which takes no lock: nobody else writes.
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
