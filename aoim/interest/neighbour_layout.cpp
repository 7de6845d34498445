// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/interest/neighbour_layout.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace reckon::aoim {

std::int64_t NeighbourLayout::index(double x, double per_unit) noexcept {
  constexpr double kMost = 1LL << 40;
  const double cells = std::clamp(x * per_unit, -kMost, kMost);
  const auto whole = static_cast<std::int64_t>(cells);
  return whole - (cells < static_cast<double>(whole) ? 1 : 0);
}

NeighbourLayout::Span NeighbourLayout::span_of(double x, double range, double per_unit,
                                               std::size_t count) {
  // More than what rounding takes.
  const double wide = range + 1e-15 * (std::abs(x) + range);
  const Span span{index(x - wide, per_unit), index(x + wide, per_unit)};
  const auto most = static_cast<std::int64_t>(count);
  if (span.last - span.first + 1 >= most) return {0, most - 1};
  return span;
}

void NeighbourLayout::plan(std::size_t count, double reach, double drift) {
  reach_ = reach;
  drift_ = drift;
  // Two that hear each other stood at most this far apart; a little more for what rounding takes.
  const double apart = 1.0001 * (reach + 2.0 * drift);
  per_y_ = static_cast<double>(kRowsUp) / apart;
  per_x_ = static_cast<double>(kColumnsOut) / apart;
  // Square all in all, and so large that no two cells are neighbours both ways round.
  const std::size_t cells = std::bit_ceil(std::max<std::size_t>(count, 64));
  rows_ = std::max<std::size_t>(8, std::size_t{1} << ((std::bit_width(cells) - 3) / 2));
  columns_ = std::max<std::size_t>(32, cells / rows_);
  starts_.assign(rows_ * columns_ + 1, 0);
}

void NeighbourLayout::sort_cells(std::size_t count) {
  count_ = count;
  std::exclusive_scan(starts_.begin(), starts_.end(), starts_.begin(), 0U);
  next_.assign(starts_.begin(), starts_.end() - 1);
  const std::size_t padded = count_ + kLanes;
  for (auto* column : {&x_, &y_, &z_, &squared_, &anchor_x_, &anchor_y_}) column->resize(padded);
  entity_.resize(padded);
}

void NeighbourLayout::put(std::uint32_t entity, const Position& anchor) {
  const std::size_t slot = next_[cell_of(anchor)]++;
  entity_[slot] = entity;
  anchor_x_[slot] = anchor.x;
  anchor_y_[slot] = anchor.y;
}

void NeighbourLayout::add_row(std::int64_t row, std::int64_t first, std::int64_t last,
                              Block& block) const {
  const std::size_t from = cell_at(row, first), to = cell_at(row, last);
  if (from <= to) return block.add(starts_[from], starts_[to + 1]);
  block.add(starts_[from], starts_[cell_at(row, -1) + 1]);
  block.add(starts_[cell_at(row, 0)], starts_[to + 1]);
}

template <typename Visit>
void NeighbourLayout::for_each_block(Visit&& visit) const {
  for (std::size_t cell = 0; cell < rows_ * columns_; ++cell) {
    if (starts_[cell] == starts_[cell + 1]) continue;
    const auto row = static_cast<std::int64_t>(cell / columns_);
    const auto column = static_cast<std::int64_t>(cell % columns_);
    Block block;
    block.begin = starts_[cell];
    block.end = block.own_end = starts_[cell + 1];
    add_row(row, column + 1, column + kColumnsOut, block);
    // What follows the cell at once is one run with the rest of it.
    if (block.count > 0 && block.runs[0].first == block.end) {
      block.own_end = block.runs[0].last;
      block.runs[0] = block.runs[--block.count];
    }
    for (std::int64_t up = 1; up <= kRowsUp; ++up) {
      add_row(row + up, column - kColumnsOut, column + kColumnsOut, block);
    }
    visit(block);
  }
}

template <typename Compare>
void NeighbourLayout::for_each_run(const Block& block, Compare&& compare) {
  for (std::size_t slot = block.begin; slot < block.end; ++slot) {
    if (slot + 1 < block.own_end) compare(slot, Run{slot + 1, block.own_end});
    for (std::size_t i = 0; i < block.count; ++i) compare(slot, block.runs[i]);
  }
}

void NeighbourLayout::count_bits() {
  std::size_t words = 0;
  for_each_block([&](const Block& block) {
    for_each_run(block, [&](std::size_t, const Run& run) {
      words += (run.last - run.first + kLanes - 1) / kLanes;
    });
  });
  bits_.resize(words);
}

void NeighbourLayout::clear_bits() {
  count_bits();
  std::fill(bits_.begin(), bits_.end(), std::uint16_t{0});
}

void NeighbourLayout::take_back(std::vector<HearingChange>& changes) const {
  const std::uint16_t* bits = bits_.data();
  for_each_block([&](const Block& block) {
    for_each_run(block, [&](std::size_t slot, const Run& run) {
      for (std::size_t first = run.first; first < run.last; first += kLanes) {
        note(slot, first, *bits++, 0, changes);
      }
    });
  });
}

void NeighbourLayout::set_bits(SimdLevel level) {
  count_bits();
  compare_all(level, nullptr);
}

void NeighbourLayout::compare(SimdLevel level, std::vector<HearingChange>& changes) {
  compare_all(level, &changes);
}

void NeighbourLayout::note(std::size_t slot, std::size_t first, unsigned before, unsigned now,
                           std::vector<HearingChange>& changes) const {
  for (unsigned left = before ^ now; left != 0; left &= left - 1) {
    const auto bit = static_cast<unsigned>(std::countr_zero(left));
    const std::uint32_t own = entity_[slot], other = entity_[first + bit % kLanes];
    const bool heard = (now >> bit & 1U) != 0;
    if (bit < kLanes) {
      changes.push_back({own, other, heard});
    } else {
      changes.push_back({other, own, heard});
    }
  }
}

std::uint16_t* NeighbourLayout::compare_scalar(const Block& block, std::uint16_t* bits,
                                               std::vector<HearingChange>* changes) const {
  for_each_run(block, [&](std::size_t slot, const Run& run) {
    for (std::size_t first = run.first; first < run.last; first += kLanes) {
      unsigned now = 0;
      for (std::size_t lane = 0; lane < std::min(kLanes, run.last - first); ++lane) {
        const std::size_t i = first + lane;
        const double dx = x_[i] - x_[slot], dy = y_[i] - y_[slot], dz = z_[i] - z_[slot];
        const double squared = dx * dx + dy * dy + dz * dz;
        now |= (squared <= squared_[slot] ? 1U : 0U) << lane;
        now |= (squared <= squared_[i] ? 1U : 0U) << (lane + kLanes);
      }
      if (changes != nullptr && now != *bits) note(slot, first, *bits, now, *changes);
      *bits++ = static_cast<std::uint16_t>(now);
    }
  });
  return bits;
}

#if defined(__x86_64__)
// The same sums in the same order, and no fused ones: the same bits.
__attribute__((target("avx512f"))) std::uint16_t* NeighbourLayout::compare_avx512(
    const Block& block, std::uint16_t* bits, std::vector<HearingChange>* changes) const {
  const double *xs = x_.data(), *ys = y_.data(), *zs = z_.data(), *squares = squared_.data();
  for (std::size_t slot = block.begin; slot < block.end; ++slot) {
    const __m512d x = _mm512_set1_pd(xs[slot]), y = _mm512_set1_pd(ys[slot]),
                  z = _mm512_set1_pd(zs[slot]), own = _mm512_set1_pd(squares[slot]);
    Run run{slot + 1, block.own_end};
    for (std::size_t next = 0;; run = block.runs[next++]) {
      for (std::size_t first = run.first; first < run.last; first += kLanes) {
        const __m512d dx = _mm512_sub_pd(_mm512_loadu_pd(xs + first), x);
        const __m512d dy = _mm512_sub_pd(_mm512_loadu_pd(ys + first), y);
        const __m512d dz = _mm512_sub_pd(_mm512_loadu_pd(zs + first), z);
        const __m512d squared = _mm512_add_pd(
            _mm512_add_pd(_mm512_mul_pd(dx, dx), _mm512_mul_pd(dy, dy)), _mm512_mul_pd(dz, dz));
        const auto valid =
            static_cast<__mmask8>(0xFFU >> (kLanes - std::min(kLanes, run.last - first)));
        const unsigned hears = _mm512_mask_cmp_pd_mask(valid, squared, own, _CMP_LE_OQ);
        const unsigned heard =
            _mm512_mask_cmp_pd_mask(valid, squared, _mm512_loadu_pd(squares + first), _CMP_LE_OQ);
        const unsigned now = hears | heard << kLanes;
        if (now != *bits) {
          if (changes != nullptr) note(slot, first, *bits, now, *changes);
          *bits = static_cast<std::uint16_t>(now);
        }
        ++bits;
      }
      if (next == block.count) break;
    }
  }
  return bits;
}
#endif

void NeighbourLayout::compare_all(SimdLevel level, std::vector<HearingChange>* changes) {
  std::uint16_t* bits = bits_.data();
#if defined(__x86_64__)
  if (std::min(level, best_simd_level()) == SimdLevel::avx512) {
    for_each_block([&](const Block& block) { bits = compare_avx512(block, bits, changes); });
    return;
  }
#endif
  static_cast<void>(level);
  for_each_block([&](const Block& block) { bits = compare_scalar(block, bits, changes); });
}

std::size_t NeighbourLayout::memory() const noexcept {
  return 4 * (starts_.capacity() + next_.capacity() + entity_.capacity()) + 2 * bits_.capacity() +
         6 * sizeof(double) * x_.capacity();
}

}  // namespace reckon::aoim
