// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/interest/overlap_kernel.hpp"

#include <algorithm>
#include <bit>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace reckon::bench {
namespace {

template <std::size_t D>
std::size_t overlap_scalar(const RegionColumns<D>& updates, std::size_t first, std::size_t count,
                           const Region<D>& subscription, std::uint32_t place, RegionPair* out) {
  std::size_t found = 0;
  for (std::size_t i = first; i < first + count; ++i) {
    unsigned both = 1;
    for (std::size_t axis = 0; axis < D; ++axis) {
      both &= static_cast<unsigned>(updates.lower[axis][i] < subscription.upper[axis]) &
              static_cast<unsigned>(subscription.lower[axis] < updates.upper[axis][i]);
    }
    // Every pair is written and kept only if it overlaps: no branch to mispredict.
    out[found] = {place, updates.place[i]};
    found += both;
  }
  return found;
}

#if defined(__x86_64__)
static_assert(sizeof(RegionPair) == 8, "a pair is one 64-bit lane");

// For each mask of four 64-bit lanes: the 32-bit halves that move to the front.
constexpr auto kCompress = [] {
  std::array<std::array<std::uint32_t, 8>, 16> table{};
  for (unsigned mask = 0; mask < 16; ++mask) {
    std::size_t to = 0;
    for (unsigned lane = 0; lane < 4; ++lane) {
      if ((mask >> lane & 1U) == 0) continue;
      table[mask][to++] = 2 * lane;
      table[mask][to++] = 2 * lane + 1;
    }
  }
  return table;
}();

template <std::size_t D>
__attribute__((target("avx2"))) std::size_t overlap_avx2(const RegionColumns<D>& updates,
                                                         std::size_t first, std::size_t count,
                                                         const Region<D>& subscription,
                                                         std::uint32_t place, RegionPair* out) {
  const __m256i own = _mm256_set1_epi64x(place);
  RegionPair* end = out;
  for (std::size_t done = 0; done < count; done += 4) {
    const std::size_t i = first + done;
    __m256d both = _mm256_castsi256_pd(_mm256_set1_epi64x(-1));
    for (std::size_t axis = 0; axis < D; ++axis) {
      const __m256d begins = _mm256_cmp_pd(_mm256_loadu_pd(updates.lower[axis] + i),
                                           _mm256_set1_pd(subscription.upper[axis]), _CMP_LT_OQ);
      const __m256d ends = _mm256_cmp_pd(_mm256_set1_pd(subscription.lower[axis]),
                                         _mm256_loadu_pd(updates.upper[axis] + i), _CMP_LT_OQ);
      both = _mm256_and_pd(both, _mm256_and_pd(begins, ends));
    }
    auto mask = static_cast<unsigned>(_mm256_movemask_pd(both));
    mask &= 0xFU >> (4 - std::min<std::size_t>(4, count - done));
    const __m128i places = _mm_loadu_si128(reinterpret_cast<const __m128i*>(updates.place + i));
    const __m256i pairs =
        _mm256_or_si256(_mm256_slli_epi64(_mm256_cvtepu32_epi64(places), 32), own);
    const __m256i order =
        _mm256_loadu_si256(reinterpret_cast<const __m256i*>(kCompress[mask].data()));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(end), _mm256_permutevar8x32_epi32(pairs, order));
    end += std::popcount(mask);
  }
  return static_cast<std::size_t>(end - out);
}

template <std::size_t D>
__attribute__((target("avx512f,popcnt"))) std::size_t overlap_avx512(
    const RegionColumns<D>& updates, std::size_t first, std::size_t count,
    const Region<D>& subscription, std::uint32_t place, RegionPair* out) {
  const __m512i own = _mm512_set1_epi64(place);
  RegionPair* end = out;
  for (std::size_t done = 0; done < count; done += 8) {
    const std::size_t i = first + done;
    auto mask = static_cast<__mmask8>(0xFFU >> (8 - std::min<std::size_t>(8, count - done)));
    for (std::size_t axis = 0; axis < D; ++axis) {
      mask = _mm512_mask_cmp_pd_mask(mask, _mm512_loadu_pd(updates.lower[axis] + i),
                                     _mm512_set1_pd(subscription.upper[axis]), _CMP_LT_OQ);
      mask = _mm512_mask_cmp_pd_mask(mask, _mm512_loadu_pd(updates.upper[axis] + i),
                                     _mm512_set1_pd(subscription.lower[axis]), _CMP_GT_OQ);
    }
    const __m256i places = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(updates.place + i));
    const __m512i wide = _mm512_maskz_cvtepu32_epi64(0xFF, places);
    const __m512i pairs = _mm512_or_si512(_mm512_maskz_slli_epi64(0xFF, wide, 32), own);
    // A compressing store to memory is slow on some processors; to a register it is fast on all.
    _mm512_storeu_si512(end, _mm512_maskz_compress_epi64(mask, pairs));
    end += std::popcount(static_cast<unsigned>(mask));
  }
  return static_cast<std::size_t>(end - out);
}
#endif

}  // namespace

SimdLevel best_simd_level() noexcept {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f")) return SimdLevel::avx512;
  if (__builtin_cpu_supports("avx2")) return SimdLevel::avx2;
#endif
  return SimdLevel::scalar;
}

template <std::size_t D>
OverlapKernel<D> overlap_kernel(SimdLevel level) noexcept {
#if defined(__x86_64__)
  switch (std::min(level, best_simd_level())) {
    case SimdLevel::avx512:
      return overlap_avx512<D>;
    case SimdLevel::avx2:
      return overlap_avx2<D>;
    case SimdLevel::scalar:
      break;
  }
#else
  static_cast<void>(level);
#endif
  return overlap_scalar<D>;
}

template OverlapKernel<1> overlap_kernel<1>(SimdLevel) noexcept;
template OverlapKernel<2> overlap_kernel<2>(SimdLevel) noexcept;
template OverlapKernel<3> overlap_kernel<3>(SimdLevel) noexcept;

}  // namespace reckon::bench
