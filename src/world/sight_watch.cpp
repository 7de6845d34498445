// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/world/sight_watch.hpp"

#include <algorithm>
#include <cmath>

#include "reckon/pdu/seconds.hpp"

namespace reckon::peer {

using std::chrono::nanoseconds;

void SightWatch::push() {
  by_way_.push(nanoseconds(0));
  by_time_.push(nanoseconds::max());
}

void SightWatch::erase(std::size_t place) noexcept {
  by_way_.erase(place);
  by_time_.erase(place);
}

void SightWatch::note_update(std::size_t place, double withdrawn, double spare, bool moves,
                             nanoseconds now) noexcept {
  // a row that lacks less than a millimetre is still within sight
  by_way_.set(place, of_way(withdrawn + spare) + nanoseconds(1));
  by_time_.set(place, moves ? now + kLatest : nanoseconds::max());
}

nanoseconds SightWatch::of_way(double metres) noexcept {
  constexpr double kMost = 9e15;  // [mm] in 63 bits, with a margin of a thousand
  return nanoseconds(static_cast<std::int64_t>(std::floor(std::min(1000.0 * metres, kMost))));
}

void SightWatch::set(std::size_t place, double withdrawn, double step, const Sight& sight,
                     nanoseconds now) noexcept {
  by_way_.set(place, of_way(withdrawn + std::max(sight.spare, step)) + nanoseconds(1));
  if (!(sight.speed > 0.0)) return by_time_.set(place, nanoseconds::max());
  const double least = pdu::to_seconds(kSoonest), most = pdu::to_seconds(kLatest);
  const double calm = std::clamp(sight.spare / (sight.speed + kSpareSpeed), least, most);
  by_time_.set(place, now + pdu::from_seconds(calm));
}

}  // namespace reckon::peer
