// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/captures/audio_encoding.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "reckon/pdu/codec/siso_names.hpp"

namespace reckon::tools {
namespace {

constexpr unsigned kClassShift = 14;

std::int16_t mu_law(const std::byte* octets) noexcept {
  return mu_law_sample(std::to_integer<std::uint8_t>(octets[0]));
}
std::int16_t pcm_8(const std::byte* octets) noexcept {
  return static_cast<std::int16_t>((std::to_integer<int>(octets[0]) - 128) * 256);
}
template <int kHigh>
std::int16_t pcm_16(const std::byte* octets) noexcept {
  return static_cast<std::int16_t>(std::to_integer<unsigned>(octets[kHigh]) << 8U |
                                   std::to_integer<unsigned>(octets[1 - kHigh]));
}

constexpr std::array<AudioEncoding, 4> kEncodings{
    {{1, 1, mu_law}, {4, 2, pcm_16<0>}, {5, 1, pcm_8}, {100, 2, pcm_16<1>}}};

}  // namespace

void AudioEncoding::decode(std::span<const std::byte> octets,
                           std::vector<std::int16_t>& samples) const {
  samples.resize(octets.size() / sample_octets);
  for (std::size_t i = 0; i < samples.size(); ++i)
    samples[i] = sample(octets.data() + i * sample_octets);
}

const AudioEncoding* audio_encoding(std::uint16_t encoding_scheme) noexcept {
  // The class of encoded audio is 0, so the scheme equals the type.
  const auto* found = std::ranges::find(kEncodings, encoding_scheme, &AudioEncoding::type);
  return found == kEncodings.end() ? nullptr : found;
}

std::string encoding_text(std::uint16_t encoding_scheme) {
  const std::uint32_t kind = encoding_scheme >> kClassShift;
  const std::string_view name = kind > 0
                                    ? siso_name(pdu::SisoTable::encoding_class, kind)
                                    : siso_name(pdu::SisoTable::encoding_type, encoding_scheme);
  return name.empty() ? fmt::format("audio encoding {}", encoding_scheme) : std::string(name);
}

}  // namespace reckon::tools
