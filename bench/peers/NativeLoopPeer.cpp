// SPDX-License-Identifier: MIT
// The two loops as strong as the machine at hand allows: six arrays of bounds, this file compiled for the processor it
// is built on (-O3 -march=native), and with AVX-512 sixteen boxes a step and compressed stores.
#include <algorithm>
#include <array>

#ifdef __AVX512F__
#include <immintrin.h>
#endif

#include "Peer.h"

namespace allpairs::bench {

namespace {

constexpr std::size_t kLanes = 16;

/// The boxes as six arrays, padded with boxes that overlap nothing to a multiple of the lanes.
class Bounds {
 public:
  explicit Bounds(std::span<const float> rows)
      : m_count(rows.size() / 6),
        m_stride((m_count + 2 * kLanes - 1) / kLanes * kLanes),
        m_values(std::make_unique_for_overwrite<float[]>(6 * m_stride)) {
    for (std::size_t bound = 0; bound < 6; ++bound) {
      float* const column = m_values.get() + bound * m_stride;
      for (std::size_t i = 0; i < m_count; ++i) column[i] = rows[6 * i + bound];
      const float nowhere =
          bound < 3 ? std::numeric_limits<float>::infinity() : -std::numeric_limits<float>::infinity();
      std::fill(column + m_count, column + m_stride, nowhere);
    }
  }

  [[nodiscard]] std::size_t count() const { return m_count; }
  [[nodiscard]] const float* operator[](std::size_t bound) const { return m_values.get() + bound * m_stride; }

 private:
  std::size_t m_count;
  std::size_t m_stride;
  std::unique_ptr<float[]> m_values;
};

/// Pairs in memory that is not written before it is used, with room made for a whole row at a time.
class PairBuffer {
 public:
  Pair* roomFor(std::size_t more) {
    if (m_size + more > m_capacity) grow(m_size + more);
    return m_pairs.get() + m_size;
  }
  void setEnd(const Pair* end) { m_size = static_cast<std::size_t>(end - m_pairs.get()); }
  [[nodiscard]] std::span<const Pair> pairs() const { return {m_pairs.get(), m_size}; }

 private:
  void grow(std::size_t least) {
    m_capacity = std::max(2 * m_capacity, least);
    auto larger = std::make_unique_for_overwrite<Pair[]>(m_capacity);
    std::copy_n(m_pairs.get(), m_size, larger.get());
    m_pairs = std::move(larger);
  }

  std::unique_ptr<Pair[]> m_pairs;
  std::size_t m_size = 0;
  std::size_t m_capacity = 0;
};

#ifdef __AVX512F__

/// Box i against boxes from, from + 1, ... sixteen at a time; writes the pairs at `end` and gives the new end.
Pair* crossRow(const Bounds& bounds, std::uint32_t i, Pair* end) {
  __m512 box[6];
  for (std::size_t bound = 0; bound < 6; ++bound) box[bound] = _mm512_set1_ps(bounds[bound][i]);
  const __m512i lane = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
  for (std::size_t j = i + 1; j < bounds.count(); j += kLanes) {
    __mmask16 hit = 0xFFFF;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      hit = _mm512_mask_cmp_ps_mask(hit, _mm512_loadu_ps(bounds[axis] + j), box[axis + 3], _CMP_LE_OQ);
      hit = _mm512_mask_cmp_ps_mask(hit, _mm512_loadu_ps(bounds[axis + 3] + j), box[axis], _CMP_GE_OQ);
    }
    if (hit == 0) continue;
    const __m512i partners = _mm512_add_epi32(lane, _mm512_set1_epi32(static_cast<int>(j)));
    const __m512i packed = _mm512_maskz_compress_epi32(hit, partners);
    const __m512i high = _mm512_slli_epi64(_mm512_cvtepu32_epi64(_mm512_castsi512_si256(packed)), 32);
    const __m512i first = _mm512_set1_epi64(static_cast<long long>(i));
    _mm512_storeu_si512(end, _mm512_or_si512(high, first));
    const auto hits = static_cast<unsigned>(__builtin_popcount(hit));
    if (hits > 8) {
      const __m512i rest = _mm512_slli_epi64(_mm512_cvtepu32_epi64(_mm512_extracti64x4_epi64(packed, 1)), 32);
      _mm512_storeu_si512(end + 8, _mm512_or_si512(rest, first));
    }
    end += hits;
  }
  return end;
}

#else

/// Box i against all boxes after it: a row of answers that compilers vectorise, then the pairs from the answers.
Pair* crossRow(const Bounds& bounds, std::uint32_t i, Pair* end) {
  std::array<std::uint8_t, kLanes> hit{};
  for (std::size_t j = i + 1; j < bounds.count(); j += kLanes) {
    unsigned any = 0;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const std::size_t k = j + lane;
      const bool both = (bounds[0][k] <= bounds[3][i]) & (bounds[3][k] >= bounds[0][i]) &
                        (bounds[1][k] <= bounds[4][i]) & (bounds[4][k] >= bounds[1][i]) &
                        (bounds[2][k] <= bounds[5][i]) & (bounds[5][k] >= bounds[2][i]);
      hit[lane] = both;
      any |= hit[lane];
    }
    if (any == 0) continue;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      *end = {i, static_cast<std::uint32_t>(j + lane)};
      end += hit[lane];
    }
  }
  return end;
}

#endif

class NativeLoop final : public Search {
 public:
  std::span<const Pair> find(std::span<const float> rows) override {
    const Bounds bounds(rows);
    const auto count = static_cast<std::uint32_t>(bounds.count());
    for (std::uint32_t i = 0; i < count; ++i) {
      m_buffer.setEnd(crossRow(bounds, i, m_buffer.roomFor(count - i + kLanes)));
    }
    return m_buffer.pairs();
  }

 private:
  PairBuffer m_buffer;
};

}  // namespace

Peer nativeLoopPeer() {
#ifdef __AVX512F__
  const std::string setting = "AVX-512, compressed stores";
#else
  const std::string setting = "vectorised by the compiler";
#endif
  constexpr std::size_t kMostBoxes = 20000;
  return {.name = "native loop",
          .version = "",
          .settings = {{setting, [] { return std::make_unique<NativeLoop>(); }, kMostBoxes}}};
}

}  // namespace allpairs::bench
