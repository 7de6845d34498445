// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/network/simulated_network.hpp"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <vector>

#include "reckon/peer/network/delay_queue.hpp"

namespace reckon::peer {
namespace {

using std::chrono::nanoseconds;

constexpr std::uint32_t kFirstAddress = 0xc6120001;  // 198.18.0.1, the range for benchmarks
constexpr std::uint16_t kPort = 3000;

}  // namespace

// One link of the hub.
class SimulatedNetwork::Port final : public Link {
 public:
  Port(Hub& hub, std::size_t number, const SimulatedNetworkOptions& options);

  bool send(const IpEndpoint& to, std::span<const std::byte> bytes) noexcept override;
  std::size_t receive(std::span<Datagram> out) noexcept override;
  std::error_code join(const GroupAddress& group) noexcept override;
  void leave(const GroupAddress& group) noexcept override;
  bool wait(nanoseconds timeout) noexcept override;
  void wake() noexcept override { woken_.store(true, std::memory_order_relaxed); }
  [[nodiscard]] IpEndpoint local_endpoint() const noexcept override { return endpoint_; }
  [[nodiscard]] std::size_t max_payload() const noexcept override;
  [[nodiscard]] LinkStatistics statistics() const noexcept override { return statistics_; }

  [[nodiscard]] bool hears(const IpEndpoint& to, nanoseconds now) const noexcept;
  [[nodiscard]] std::uint64_t arrived_after_leaving() const noexcept { return left_; }
  void take_in(const Port& sender, const Fate& fate, const IpEndpoint& to,
               std::span<const std::byte> bytes, nanoseconds now) noexcept;
  [[nodiscard]] const DelayQueue& queue() const noexcept { return queue_; }

 private:
  Hub& hub_;
  std::size_t number_;
  IpEndpoint endpoint_;
  DelayQueue queue_;
  struct Joined {
    GroupAddress group;
    nanoseconds open{0};  // received from then on
  };
  [[nodiscard]] std::vector<Joined>::const_iterator find(const GroupAddress& group) const noexcept;

  std::vector<Joined> groups_;  // sorted
  std::size_t max_groups_;
  std::uint64_t left_ = 0;
  std::atomic<bool> woken_{false};
  LinkStatistics statistics_;
};

// All links of the network, and the law of each direction.
struct SimulatedNetwork::Hub {
  // The direction from one link to another.
  struct Direction {
    Impairment impairment;
    std::uint64_t next_sequence{0};
  };

  Hub(const SimulatedNetworkOptions& asked, const Clock& steady);
  void distribute(std::size_t sender, const IpEndpoint& to,
                  std::span<const std::byte> bytes) noexcept;
  Direction& direction(std::size_t sender, std::size_t receiver) noexcept {
    return directions[receiver * options.links + sender];
  }

  SimulatedNetworkOptions options;
  const Clock& clock;
  nanoseconds start;
  std::vector<std::unique_ptr<Port>> ports;
  std::vector<Direction> directions;
};

SimulatedNetwork::Hub::Hub(const SimulatedNetworkOptions& asked, const Clock& steady)
    : options(asked), clock(steady), start(steady.now()) {
  for (std::size_t i = 0; i < asked.links; ++i) {
    ports.push_back(std::make_unique<Port>(*this, i, asked));
  }
  directions.resize(asked.links * asked.links, Direction{Impairment({}, 0)});
}

void SimulatedNetwork::Hub::distribute(std::size_t sender, const IpEndpoint& to,
                                       std::span<const std::byte> bytes) noexcept {
  const nanoseconds now = clock.now();
  for (std::size_t receiver = 0; receiver < ports.size(); ++receiver) {
    if (receiver == sender && !options.deliver_own) continue;
    if (!ports[receiver]->hears(to, now)) continue;
    Direction& way = direction(sender, receiver);
    const Fate fate = way.impairment.decide(sender, way.next_sequence++, now - start);
    ports[receiver]->take_in(*ports[sender], fate, to, bytes, now);
  }
}

SimulatedNetwork::Port::Port(Hub& hub, std::size_t number, const SimulatedNetworkOptions& options)
    : hub_(hub),
      number_(number),
      endpoint_(IpEndpoint::v4(kFirstAddress + static_cast<std::uint32_t>(number), kPort)),
      queue_(options.datagrams_in_flight, options.max_payload),
      max_groups_(options.max_groups) {
  groups_.reserve(max_groups_);
}

bool SimulatedNetwork::Port::send(const IpEndpoint& to, std::span<const std::byte> bytes) noexcept {
  if (bytes.size() > max_payload()) {
    ++statistics_.too_big;
    ++statistics_.send_errors;
    return false;
  }
  ++statistics_.sent;
  statistics_.sent_bytes += bytes.size();
  hub_.distribute(number_, to, bytes);
  return true;
}

// Place of the group, or the place to insert it.
std::vector<SimulatedNetwork::Port::Joined>::const_iterator SimulatedNetwork::Port::find(
    const GroupAddress& group) const noexcept {
  return std::ranges::lower_bound(groups_, group, {}, &Joined::group);
}

bool SimulatedNetwork::Port::hears(const IpEndpoint& to, nanoseconds now) const noexcept {
  if (to == endpoint_) return true;
  const auto place = find(to);
  return place != groups_.end() && place->group == to && place->open <= now;
}

void SimulatedNetwork::Port::take_in(const Port& sender, const Fate& fate, const IpEndpoint& to,
                                     std::span<const std::byte> bytes, nanoseconds now) noexcept {
  if (fate.copies == 0) ++statistics_.lost_by_law;
  if (fate.copies == 2) ++statistics_.duplicated_by_law;
  for (std::size_t copy = 0; copy < fate.copies; ++copy) {
    const bool held = queue_.push(now + fate.delay[copy], to, sender.endpoint_, bytes);
    if (!held) ++statistics_.queue_overflows;
  }
}

std::size_t SimulatedNetwork::Port::receive(std::span<Datagram> out) noexcept {
  queue_.release();
  const nanoseconds now = hub_.clock.now();
  std::size_t count = 0;
  while (const std::size_t came = queue_.pop_due(now, out.subspan(count))) {
    const auto first = out.begin() + static_cast<std::ptrdiff_t>(count);
    const auto end =
        std::remove_if(first, first + static_cast<std::ptrdiff_t>(came),
                       [&](const Datagram& datagram) { return !hears(datagram.group, now); });
    const auto kept = static_cast<std::size_t>(end - first);
    left_ += came - kept;
    count += kept;
  }
  statistics_.received += count;
  for (const Datagram& datagram : out.first(count)) {
    statistics_.received_bytes += datagram.bytes.size();
  }
  return count;
}

std::error_code SimulatedNetwork::Port::join(const GroupAddress& group) noexcept {
  if (!group.is_multicast()) {
    ++statistics_.join_errors;
    return std::make_error_code(std::errc::invalid_argument);
  }
  const auto place = find(group);
  if (place != groups_.end() && place->group == group) return {};
  if (groups_.size() == max_groups_) {
    ++statistics_.join_errors;
    return std::make_error_code(std::errc::value_too_large);
  }
  groups_.insert(place, {group, hub_.clock.now() + hub_.options.join_delay});
  ++statistics_.joins;
  return {};
}

void SimulatedNetwork::Port::leave(const GroupAddress& group) noexcept {
  const auto place = find(group);
  if (place == groups_.end() || place->group != group) return;
  groups_.erase(place);
  ++statistics_.leaves;
}

bool SimulatedNetwork::Port::wait(nanoseconds) noexcept {
  const bool woken = woken_.exchange(false, std::memory_order_relaxed);
  return woken || queue_.next_due() <= hub_.clock.now();
}

std::size_t SimulatedNetwork::Port::max_payload() const noexcept {
  return hub_.options.max_payload;
}

SimulatedNetwork::SimulatedNetwork(const SimulatedNetworkOptions& options, const Clock& clock)
    : hub_(std::make_unique<Hub>(options, clock)) {}

SimulatedNetwork::~SimulatedNetwork() = default;

Link& SimulatedNetwork::link(std::size_t index) noexcept {
  assert(index < hub_->ports.size());
  return *hub_->ports[index];
}

void SimulatedNetwork::impair(const ImpairmentLaw& law) {
  for (std::size_t sender = 0; sender < hub_->ports.size(); ++sender) {
    for (std::size_t receiver = 0; receiver < hub_->ports.size(); ++receiver) {
      impair(sender, receiver, law);
    }
  }
}

void SimulatedNetwork::impair(std::size_t sender, std::size_t receiver, const ImpairmentLaw& law) {
  assert(sender < hub_->ports.size() && receiver < hub_->ports.size());
  const std::uint64_t seed = direction_seed(hub_->options.seed, receiver);
  hub_->direction(sender, receiver).impairment = Impairment(law, seed);
}

std::size_t SimulatedNetwork::in_flight() const noexcept {
  std::size_t sum = 0;
  for (const auto& port : hub_->ports) sum += port->queue().size();
  return sum;
}

std::uint64_t SimulatedNetwork::arrived_after_leaving() const noexcept {
  std::uint64_t sum = 0;
  for (const auto& port : hub_->ports) sum += port->arrived_after_leaving();
  return sum;
}

nanoseconds SimulatedNetwork::next_arrival() const noexcept {
  nanoseconds first = nanoseconds::max();
  for (const auto& port : hub_->ports) first = std::min(first, port->queue().next_due());
  return first;
}

}  // namespace reckon::peer
