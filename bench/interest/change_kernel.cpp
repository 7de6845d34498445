// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/interest/change_kernel.hpp"

#include <algorithm>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace reckon::bench {
namespace {

constexpr unsigned kHere = 1, kThere = 2;  // bits: receives at that tick

// One direction of a pair: writes its change, if there is one.
template <ChangeTold kTold>
std::uint64_t* put(std::uint64_t* out, unsigned hears, std::uint32_t observer,
                   std::uint32_t entity) noexcept {
  constexpr bool kBoth = kTold == ChangeTold::both;
  // Every key is written, and the output advances only at a change: no branch to mispredict.
  *out = HearingChanges::key(observer, entity,
                             kBoth ? (hears & kHere) != 0 : kTold == ChangeTold::began);
  return out + (hears == kHere || (kBoth && hears == kThere) ? 1 : 0);
}

template <ChangeTold kTold>
std::uint64_t* put_both(const ChangeColumns& c, std::uint32_t a, std::uint32_t b, unsigned a_hears,
                        unsigned b_hears, std::uint64_t* out) noexcept {
  const auto changed = [](unsigned hears) { return (hears & 1U) ^ (hears >> 1U); };
  if ((changed(a_hears) | changed(b_hears)) == 0) return out;
  if (c.apart[a] != Apart::no || c.apart[b] != Apart::no) return out;
  out = put<kTold>(out, a_hears, c.entity[a], c.entity[b]);
  return put<kTold>(out, b_hears, c.entity[b], c.entity[a]);
}

template <ChangeTold kTold>
std::uint64_t* changes_scalar(const ChangeColumns& c, const std::uint32_t* own,
                              const std::uint32_t* other, std::size_t count, std::uint64_t* out) {
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t a = own[i], b = other[i];
    const Hearer &a_there = c.there[c.link[a]], &b_there = c.there[c.link[b]];
    const double squared = squared_distance(c.here[a].position, c.here[b].position);
    const double squared_there = squared_distance(a_there.position, b_there.position);
    const auto hears = [&](const Hearer& here, const Hearer& there) {
      return (here.hears(squared) ? kHere : 0U) | (there.hears(squared_there) ? kThere : 0U);
    };
    out = put_both<kTold>(c, a, b, hears(c.here[a], a_there), hears(c.here[b], b_there), out);
  }
  return out;
}

#if defined(__x86_64__)
// The same sums in the same order without fused operations, so that it writes the same keys. `here`
// is in the lower lane, `there` in the upper.
template <ChangeTold kTold>
__attribute__((target("avx2"))) std::uint64_t* changes_avx2(const ChangeColumns& c,
                                                            const std::uint32_t* own,
                                                            const std::uint32_t* other,
                                                            std::size_t count, std::uint64_t* out) {
  static_assert(sizeof(Hearer) == 4 * sizeof(double) && offsetof(Hearer, squared_radius) == 24);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t a = own[i], b = other[i];
    const __m256d a_here = _mm256_loadu_pd(&c.here[a].position.x);
    const __m256d b_here = _mm256_loadu_pd(&c.here[b].position.x);
    const __m256d a_there = _mm256_loadu_pd(&c.there[c.link[a]].position.x);
    const __m256d b_there = _mm256_loadu_pd(&c.there[c.link[b]].position.x);
    const __m256d here = _mm256_sub_pd(b_here, a_here), there = _mm256_sub_pd(b_there, a_there);
    const __m256d here2 = _mm256_mul_pd(here, here), there2 = _mm256_mul_pd(there, there);
    const __m256d x_z = _mm256_unpacklo_pd(here2, there2), y = _mm256_unpackhi_pd(here2, there2);
    const __m128d squared =
        _mm_add_pd(_mm_add_pd(_mm256_castpd256_pd128(x_z), _mm256_castpd256_pd128(y)),
                   _mm256_extractf128_pd(x_z, 1));
    const __m128d a_radius = _mm256_extractf128_pd(_mm256_unpackhi_pd(a_here, a_there), 1);
    const __m128d b_radius = _mm256_extractf128_pd(_mm256_unpackhi_pd(b_here, b_there), 1);
    out = put_both<kTold>(
        c, a, b, static_cast<unsigned>(_mm_movemask_pd(_mm_cmple_pd(squared, a_radius))),
        static_cast<unsigned>(_mm_movemask_pd(_mm_cmple_pd(squared, b_radius))), out);
  }
  return out;
}
#endif

template <ChangeTold kTold>
ChangeKernel kernel_of(SimdLevel level) noexcept {
#if defined(__x86_64__)
  if (std::min(level, best_simd_level()) != SimdLevel::scalar) return changes_avx2<kTold>;
#else
  static_cast<void>(level);
#endif
  return changes_scalar<kTold>;
}

}  // namespace

ChangeKernel change_kernel(SimdLevel level, ChangeTold told) noexcept {
  switch (told) {
    case ChangeTold::began:
      return kernel_of<ChangeTold::began>(level);
    case ChangeTold::ceased:
      return kernel_of<ChangeTold::ceased>(level);
    case ChangeTold::both:
      break;
  }
  return kernel_of<ChangeTold::both>(level);
}

}  // namespace reckon::bench
