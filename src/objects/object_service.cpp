// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/objects/object_service.hpp"

#include <algorithm>
#include <chrono>

#include "reckon/peer/threads/thread_name.hpp"

namespace reckon::peer {
namespace {

constexpr std::chrono::nanoseconds kLongestSleep = std::chrono::seconds(1);

}  // namespace

ObjectService::ObjectService(Link& link, const Clock& clock, const SceneFile& scene,
                             std::size_t pool_size, const ObjectExchangeOptions& options)
    : link_(link), clock_(clock), exchange_(link, clock, options) {
  const auto objects = package_of(scene);
  for (const auto& object : objects) exchange_.serve(object);
  pdu::ObjectOffer offer;
  offer.scene_hash = scene.hash;
  offer.manifest = objects.front()->hash();
  offer.size = objects.front()->layout().size();
  offer.pool_size = static_cast<std::uint16_t>(pool_size);
  const std::string name = scene.path.filename().string();
  std::copy_n(name.begin(), std::min(name.size(), offer.name.size()), offer.name.begin());
  exchange_.offer(offer);
  thread_ = std::thread([this] { run(); });
  name_thread(thread_.native_handle(), "rk-objects");
}

ObjectService::~ObjectService() {
  ends_.store(true, std::memory_order_relaxed);
  link_.wake();
  thread_.join();
}

void ObjectService::run() {
  while (!ends_.load(std::memory_order_relaxed)) {
    exchange_.step();
    const auto wait = std::min(kLongestSleep, exchange_.next_step() - clock_.now());
    if (wait.count() > 0) static_cast<void>(link_.wait(wait));
  }
}

}  // namespace reckon::peer
