// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Any octets as an image: it has the number of pixels stated in its header, each from black to
// white, or is refused with a sentence. The heap stays within the needs of the largest image.
#include <algorithm>
#include <stdexcept>
#include <string_view>

#include "reckon/haptics/image_files/image_file.hpp"
#include "reckon/tests/fuzz/fuzz_target.hpp"

namespace reckon::fuzz {
namespace {

// Pixels as numbers and as octets, and libpng's own buffers.
constexpr std::size_t kMostHeap = haptics::kMostPixels * haptics::kMostPixels * 12 + (32 << 20);

}  // namespace

void check(std::span<const std::byte> input) {
  const std::string_view bytes = text_of(input);
  const HeapMeter meter;
  try {
    const haptics::GreyImage image = haptics::decode_image(bytes);
    require(image.pixels.size() == image.width * image.height, "pixels are missing");
    require(std::ranges::all_of(image.pixels, [](float p) { return p >= 0 && p <= 1; }),
            "a pixel that is neither black nor white nor between them");
    const bool is_text = bytes.starts_with("P2");
    require(!bytes.starts_with("P") || image.pixels.size() * (is_text ? 2 : 1) <= bytes.size(),
            "more pixels than octets");
  } catch (const std::invalid_argument& error) {
    require(std::string_view(error.what()).size() > 10, "refused without a sentence");
    require(!bytes.starts_with("P") || meter.peak() <= 4 * bytes.size() + 4096,
            "a PGM picture that is refused takes memory for pixels it has not");
  }
  require(meter.peak() <= kMostHeap, "more heap than the largest picture takes");
}

}  // namespace reckon::fuzz
