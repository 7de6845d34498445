// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/captures/stamp_order.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

namespace reckon::tools {

bool StampOrder::is_later(const Held& a, const Held& b) noexcept {
  return std::tie(a.datagram.time, a.number) > std::tie(b.datagram.time, b.number);
}

void StampOrder::add(const peer::SourceDatagram& datagram) {
  heap_.push_back({datagram,
                   {datagram.bytes.begin(), datagram.bytes.end()},
                   {datagram.captured.begin(), datagram.captured.end()},
                   std::string(datagram.interface),
                   number_++});
  std::ranges::push_heap(heap_, is_later);
  newest_ = std::max(newest_, datagram.time);
  while (heap_.size() > kMost || newest_ - heap_.front().datagram.time >= kHold) write_oldest();
}

void StampOrder::flush() {
  while (!heap_.empty()) write_oldest();
}

void StampOrder::write_oldest() {
  std::ranges::pop_heap(heap_, is_later);
  Held oldest = std::move(heap_.back());
  heap_.pop_back();
  oldest.datagram.bytes = oldest.bytes;
  oldest.datagram.captured = oldest.captured;
  oldest.datagram.interface = oldest.interface;
  write_(oldest.datagram);
}

}  // namespace reckon::tools
