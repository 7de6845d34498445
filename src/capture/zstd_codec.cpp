// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/capture/zstd_codec.hpp"

#include <algorithm>
#include <new>

namespace reckon::peer {
namespace {

/// 1 to 19, default 3: measured on captures in docs/record_and_replay.md; higher levels take
/// several times the time for a few percent.
constexpr int kLevel = 3;
constexpr int kMaxWindowLog = 27;

/// The magic numbers of RFC 8878, 3.1: frames, and skippable frames.
constexpr std::uint32_t kFrameMagic = 0xfd2fb528;
constexpr std::uint32_t kSkippableMagic = 0x184d2a50;
/// Minimum size of a frame header [octets].
constexpr std::size_t kFrameHeader = 5;
constexpr std::size_t kBlockHeader = 3;

}  // namespace

ZstdCompressor::ZstdCompressor() : context_(ZSTD_createCCtx(), ZSTD_freeCCtx) {
  if (!context_) throw std::bad_alloc();
  ZSTD_CCtx_setParameter(context_.get(), ZSTD_c_compressionLevel, kLevel);
  ZSTD_CCtx_setParameter(context_.get(), ZSTD_c_checksumFlag, 1);
}

void ZstdCompressor::compress(std::span<const std::byte> raw, bool end_frame,
                              std::vector<std::byte>& out) {
  ZSTD_inBuffer in{raw.data(), raw.size(), 0};
  const ZSTD_EndDirective directive = end_frame ? ZSTD_e_end : ZSTD_e_flush;
  for (std::size_t left = 1; left != 0;) {
    const std::size_t begin = out.size();
    out.resize(begin + ZSTD_CStreamOutSize());
    ZSTD_outBuffer piece{out.data() + begin, out.size() - begin, 0};
    left = ZSTD_compressStream2(context_.get(), &piece, &in, directive);
    out.resize(begin + piece.pos);
    if (ZSTD_isError(left) != 0) throw std::bad_alloc();  // no other error is possible here
  }
}

void ZstdCompressor::reset() { ZSTD_CCtx_reset(context_.get(), ZSTD_reset_session_only); }

ZstdDecompressor::ZstdDecompressor()
    : context_(ZSTD_createDCtx(), ZSTD_freeDCtx), step_(kFrameHeader) {
  if (!context_) throw std::bad_alloc();
  ZSTD_DCtx_setParameter(context_.get(), ZSTD_d_windowLogMax, kMaxWindowLog);
}

std::size_t ZstdDecompressor::decompress(std::span<const std::byte>& in,
                                         std::span<std::byte> out) noexcept {
  if (!error_.empty()) return 0;
  // One block at a time, because a call that ends in an error discards its decompressed output.
  ZSTD_inBuffer from{in.data(), std::min(in.size(), step_), 0};
  ZSTD_outBuffer to{out.data(), out.size(), 0};
  const std::size_t left = ZSTD_decompressStream(context_.get(), &to, &from);
  in = in.subspan(from.pos);
  if (ZSTD_isError(left) != 0) {
    error_ = ZSTD_getErrorName(left);
    return to.pos;
  }
  if (from.pos == 0 && to.pos == 0) return 0;  // called at the end: no new frame begins
  inside_ = left != 0;
  step_ = inside_ ? left : kFrameHeader;
  // libzstd expects the next block's header together with this one's end.
  if (inside_ && left > kBlockHeader) step_ -= kBlockHeader;
  if (!inside_) ++frames_;
  return to.pos;
}

bool begins_zstd(std::span<const std::byte> octets) noexcept {
  if (octets.size() < 4) return false;
  std::uint32_t magic = 0;
  for (std::size_t i = 4; i-- > 0;) magic = magic << 8 | std::to_integer<std::uint32_t>(octets[i]);
  return magic == kFrameMagic || (magic & 0xfffffff0U) == kSkippableMagic;
}

}  // namespace reckon::peer
