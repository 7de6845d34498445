// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Datagrams of any octets from few sources, on any group, between steps of any length, as input of
// the area of interest manager. Its tables stay within bounds, it allocates no heap once it runs,
// its datagrams read back, and its next step is due in time.
#include <algorithm>
#include <array>
#include <chrono>

#include "reckon/aoim/area_of_interest_manager.hpp"
#include "reckon/tests/fuzz/fuzz_target.hpp"
#include "reckon/tests/fuzz/sound_step.hpp"

namespace reckon::fuzz {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr std::size_t kCapacity = 8, kTracked = 32, kPool = 12;
constexpr std::size_t kHead = 6;  // octets before each datagram: kind, group, source, time, length

aoim::QuadTree tree() {
  aoim::QuadTreeConfig square;
  square.side = 200.0;
  square.pool = kPool;
  const std::array cells{aoim::CellId{2, 2}, aoim::CellId{3, 1}};
  return aoim::QuadTree::of_cells(square, cells);
}

aoim::LocaleMap rooms() {
  return aoim::LocaleMap({{{0, 0, 0}, 0.0, 30, 30, {1}}, {{60, 0, 0}, 0.5, 30, 30, {0}}});
}

// A cell scheme, chosen by the first octet of a session.
aoim::AreaOfInterestConfig config(unsigned scheme) {
  aoim::AreaOfInterestConfig config;
  if (scheme % 3 == 1) config.cells.emplace(tree());
  if (scheme % 3 == 2) config.cells.emplace(rooms());
  config.grid.cell_size = 50.0;
  config.grid.pool = kPool;
  config.presence.capacity = kCapacity;
  config.tracked = kTracked;
  return config;
}

pdu::Presence own() {
  pdu::Presence own;
  own.simulation = {7, 1};
  own.epoch = 1;
  own.started = 100;
  return own;
}

class Session {
 public:
  explicit Session(unsigned scheme) : aoim_(config(scheme), own()) {
    look(0.0);
    aoim_.start(now_);
    step_soundly(aoim_, kPool, now_);
  }

  void operate(std::span<const std::byte> head, std::span<const std::byte> octets) {
    const auto at = [&](std::size_t i) { return std::to_integer<unsigned>(head[i]); };
    now_ += milliseconds(at(3) < 200 ? at(3) : (at(3) - 199) * 100);
    aoim::SourceAddress from;
    from.port = static_cast<std::uint16_t>(at(2) % 8);
    const aoim::GroupIndex group{static_cast<std::uint16_t>(at(1) % (kPool + 2))};
    static_cast<void>(aoim_.receive(group, octets, now_, from));
    for (const aoim::PresenceEvent& event : aoim_.take_events()) {
      require(event.announced.epoch != 0, "an event concerns nobody");
    }
    if (at(0) % 4 == 1) look(10.0 * at(2));
    if (at(0) % 4 != 0) step_soundly(aoim_, kPool, now_);
    const pdu::EntityId entity{7, 1, 1};
    static_cast<void>(aoim_.must_send(aoim::kCellTier, entity, {}, {{}, group}, now_));
    static_cast<void>(aoim_.sight().judge({10.0 * at(2), 0.0, 0.0}, 0.0, 1, false));
    require(aoim_.presence().peers().size() <= kCapacity, "the table of peers has no bound");
    require(aoim_.sequences().size() <= kTracked, "the table of senders has no bound");
  }

 private:
  void look(double x) {
    const aoim::Focus focus{{x, 0.0, 0.0}, 0.0, 60.0};
    static_cast<void>(aoim_.listen(aoim::kCellTier, std::span(&focus, 1), now_));
  }

  nanoseconds now_ = std::chrono::seconds(10);
  aoim::AreaOfInterestManager aoim_;
};

}  // namespace

void check(std::span<const std::byte> input) {
  Session session(input.empty() ? 0 : std::to_integer<unsigned>(input[0]) / 4);
  const HeapMeter heap;
  while (input.size() >= kHead) {
    const auto head = input.first(kHead);
    const std::size_t length = pdu::load_big_endian<std::uint16_t>(head.data() + 4);
    input = input.subspan(kHead);
    const auto octets = input.first(std::min(length, input.size()));
    session.operate(head, octets);
    input = input.subspan(octets.size());
  }
  require(heap.allocations() == 0, "the manager took heap");
}

}  // namespace reckon::fuzz
