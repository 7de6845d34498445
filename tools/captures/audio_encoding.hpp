// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The supported audio encodings of Signal PDUs (SISO-REF-010 UID 271).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace reckon::tools {

/// A sample of ITU-T G.711 mu-law as 16 bits: sign, 3 bits of exponent e and 4 of mantissa m, all
/// inverted; the magnitude is 4 ((2 m + 33) 2^e - 33).
[[nodiscard]] constexpr std::int16_t mu_law_sample(std::uint8_t octet) noexcept {
  const int bits = ~octet & 0xFF;
  const int magnitude = 4 * (((2 * (bits & 0xF) + 33) << ((bits >> 4) & 7)) - 33);
  return static_cast<std::int16_t>((bits & 0x80) != 0 ? -magnitude : magnitude);
}

/// An encoding: samples of whole octets.
struct AudioEncoding {
  std::uint16_t type;         ///< SISO-REF-010 UID 271
  std::size_t sample_octets;  ///< 1 or 2
  std::int16_t (*sample)(const std::byte* octets) noexcept;

  /// Replaces `samples` by the decoded octets; an incomplete last sample is left out.
  void decode(std::span<const std::byte> octets, std::vector<std::int16_t>& samples) const;
};

/// 8-bit mu-law (1), 16-bit PCM big endian (4) and little endian (100), 8-bit unsigned PCM (5).
/// @param encoding_scheme of a Signal PDU: class in 2 bits, type in 14
/// @return null if it is no audio, or an unsupported type
[[nodiscard]] const AudioEncoding* audio_encoding(std::uint16_t encoding_scheme) noexcept;

/// "8-bit mu-law (ITU-T G.711)"; the class if it is no audio: "Raw Binary Data".
[[nodiscard]] std::string encoding_text(std::uint16_t encoding_scheme);

}  // namespace reckon::tools
