// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/interest/border_kernel.hpp"

#include <algorithm>
#include <bit>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace reckon::bench {
namespace {

// Written as "not below and not above", so that NaN counts as between.
bool is_between(float squared, float least, float most) noexcept {
  return !(squared < least) && !(squared > most);
}

template <bool kSame>
bool is_named(const BorderColumns& c, std::uint32_t slot, std::uint32_t i) noexcept {
  const float dx = c.x[i] - c.x[slot], dy = c.y[i] - c.y[slot], dz = c.z[i] - c.z[slot];
  const float squared = dx * dx + dy * dy + dz * dz;
  if constexpr (kSame) return is_between(squared, c.least_of_all, c.most_of_all);
  return is_between(squared, c.least[slot], c.most[slot]) ||
         is_between(squared, c.least[i], c.most[i]);
}

template <bool kSame>
std::size_t border_scalar(const BorderColumns& columns, std::uint32_t slot, const SlotRun* runs,
                          std::size_t run_count, SlotPairs out) {
  std::size_t found = 0;
  for (std::size_t r = 0; r < run_count; ++r) {
    for (std::uint32_t i = runs[r].first; i < runs[r].last; ++i) {
      // Every pair is written, and `found` advances only if it is named: no branch to mispredict.
      out.own[found] = slot;
      out.other[found] = i;
      found += is_named<kSame>(columns, slot, i) ? 1U : 0U;
    }
  }
  return found;
}

#if defined(__x86_64__)
// The same sums in the same order without fused operations, so that it names the same slots.
template <bool kSame>
__attribute__((target("avx2"))) std::size_t border_avx2(const BorderColumns& c, std::uint32_t slot,
                                                        const SlotRun* runs, std::size_t run_count,
                                                        SlotPairs out) {
  const __m256 x = _mm256_set1_ps(c.x[slot]), y = _mm256_set1_ps(c.y[slot]),
               z = _mm256_set1_ps(c.z[slot]);
  const __m256 least = _mm256_set1_ps(kSame ? c.least_of_all : c.least[slot]);
  const __m256 most = _mm256_set1_ps(kSame ? c.most_of_all : c.most[slot]);
  std::size_t found = 0;
  for (std::size_t r = 0; r < run_count; ++r) {
    for (std::uint32_t i = runs[r].first; i < runs[r].last; i += 8) {
      const __m256 dx = _mm256_sub_ps(_mm256_loadu_ps(c.x + i), x);
      const __m256 dy = _mm256_sub_ps(_mm256_loadu_ps(c.y + i), y);
      const __m256 dz = _mm256_sub_ps(_mm256_loadu_ps(c.z + i), z);
      const __m256 squared = _mm256_add_ps(
          _mm256_add_ps(_mm256_mul_ps(dx, dx), _mm256_mul_ps(dy, dy)), _mm256_mul_ps(dz, dz));
      __m256 named = _mm256_and_ps(_mm256_cmp_ps(squared, least, _CMP_NLT_UQ),
                                   _mm256_cmp_ps(squared, most, _CMP_NGT_UQ));
      if constexpr (!kSame) {
        named = _mm256_or_ps(
            named, _mm256_and_ps(_mm256_cmp_ps(squared, _mm256_loadu_ps(c.least + i), _CMP_NLT_UQ),
                                 _mm256_cmp_ps(squared, _mm256_loadu_ps(c.most + i), _CMP_NGT_UQ)));
      }
      const std::uint32_t lanes = std::min(8U, runs[r].last - i);
      unsigned left = static_cast<unsigned>(_mm256_movemask_ps(named)) & ((1U << lanes) - 1U);
      for (; left != 0; left &= left - 1) {
        out.own[found] = slot;
        out.other[found++] = i + static_cast<std::uint32_t>(std::countr_zero(left));
      }
    }
  }
  return found;
}

// For sixteen slots from i on, of which `valid` are in the run.
template <bool kSame>
__attribute__((target("avx512f"), always_inline)) inline __mmask16 named_avx512(
    const BorderColumns& c, std::size_t i, __mmask16 valid, __m512 x, __m512 y, __m512 z,
    __m512 least, __m512 most) {
  const __m512 dx = _mm512_sub_ps(_mm512_loadu_ps(c.x + i), x);
  const __m512 dy = _mm512_sub_ps(_mm512_loadu_ps(c.y + i), y);
  const __m512 dz = _mm512_sub_ps(_mm512_loadu_ps(c.z + i), z);
  const __m512 squared = _mm512_add_ps(_mm512_add_ps(_mm512_mul_ps(dx, dx), _mm512_mul_ps(dy, dy)),
                                       _mm512_mul_ps(dz, dz));
  const __mmask16 own = _mm512_mask_cmp_ps_mask(
      _mm512_mask_cmp_ps_mask(valid, squared, least, _CMP_NLT_UQ), squared, most, _CMP_NGT_UQ);
  if constexpr (kSame) return own;
  const __mmask16 other = _mm512_mask_cmp_ps_mask(
      _mm512_mask_cmp_ps_mask(valid, squared, _mm512_loadu_ps(c.least + i), _CMP_NLT_UQ), squared,
      _mm512_loadu_ps(c.most + i), _CMP_NGT_UQ);
  return static_cast<__mmask16>(own | other);
}

template <bool kSame>
__attribute__((target("avx512f"))) std::size_t border_avx512(const BorderColumns& c,
                                                             std::uint32_t slot,
                                                             const SlotRun* runs,
                                                             std::size_t run_count, SlotPairs out) {
  const __m512 x = _mm512_set1_ps(c.x[slot]), y = _mm512_set1_ps(c.y[slot]),
               z = _mm512_set1_ps(c.z[slot]);
  const __m512 least = _mm512_set1_ps(kSame ? c.least_of_all : c.least[slot]);
  const __m512 most = _mm512_set1_ps(kSame ? c.most_of_all : c.most[slot]);
  const __m512i count = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
  std::size_t found = 0;
  // A compressing store to memory is slow on some processors; to a register it is fast on all.
  const auto put = [&](std::uint32_t first, __mmask16 named)
      __attribute__((target("avx512f"), always_inline)) {
    const __m512i slots = _mm512_add_epi32(_mm512_set1_epi32(static_cast<int>(first)), count);
    _mm512_storeu_si512(out.other + found, _mm512_maskz_compress_epi32(named, slots));
    found += static_cast<std::size_t>(std::popcount(static_cast<unsigned>(named)));
  };
  for (std::size_t r = 0; r < run_count; ++r) {
    // Two groups at once: most runs are shorter than that, and so no branch depends on their
    // length.
    for (std::uint32_t i = runs[r].first; i < runs[r].last; i += 32) {
      const unsigned valid = 0xFFFFFFFFU >> (32U - std::min(32U, runs[r].last - i));
      put(i, named_avx512<kSame>(c, i, static_cast<__mmask16>(valid), x, y, z, least, most));
      put(i + 16, named_avx512<kSame>(c, i + 16, static_cast<__mmask16>(valid >> 16), x, y, z,
                                      least, most));
    }
  }
  const __m512i own = _mm512_set1_epi32(static_cast<int>(slot));
  // The first group is written unconditionally, so that no branch depends on `found`.
  _mm512_storeu_si512(out.own, own);
  for (std::size_t i = 16; i < found; i += 16) _mm512_storeu_si512(out.own + i, own);
  return found;
}
#endif

template <bool kSame>
BorderKernel kernel_of(SimdLevel level) noexcept {
#if defined(__x86_64__)
  switch (std::min(level, best_simd_level())) {
    case SimdLevel::avx512:
      return border_avx512<kSame>;
    case SimdLevel::avx2:
      return border_avx2<kSame>;
    case SimdLevel::scalar:
      break;
  }
#else
  static_cast<void>(level);
#endif
  return border_scalar<kSame>;
}

}  // namespace

BorderKernel border_kernel(SimdLevel level, bool same_for_all) noexcept {
  return same_for_all ? kernel_of<true>(level) : kernel_of<false>(level);
}

}  // namespace reckon::bench
