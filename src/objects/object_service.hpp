// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Offers the files of a scene to peers that lack them: a thread with a link of its own, apart from
// the loops of the peer.
#pragma once

#include <atomic>
#include <memory>
#include <thread>

#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/network/link.hpp"
#include "reckon/peer/objects/object_exchange.hpp"
#include "reckon/peer/objects/scene_package.hpp"

namespace reckon::peer {

/// Serves until it is destroyed. Its thread `rk-objects` sleeps while nobody asks.
class ObjectService {
 public:
  /// Reads and hashes the files. @param link, clock outlive this; exclusive use of the link
  /// @throws std::runtime_error as package_of(), std::invalid_argument, std::system_error
  ObjectService(Link& link, const Clock& clock, const SceneFile& scene, std::size_t pool_size,
                const ObjectExchangeOptions& options);
  ~ObjectService();
  ObjectService(const ObjectService&) = delete;
  ObjectService& operator=(const ObjectService&) = delete;

 private:
  void run();

  Link& link_;
  const Clock& clock_;
  ObjectExchange exchange_;
  std::atomic<bool> ends_{false};
  std::thread thread_;
};

}  // namespace reckon::peer
