// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/image_files/image_file.hpp"

#include <png.h>

#include <cstdint>
#include <stdexcept>
#include <string>
#include <system_error>

#include "reckon/haptics/image_files/pgm_reader.hpp"
#include "reckon/haptics/image_files/png_data.hpp"
#include "reckon/haptics/input_files/input_file.hpp"
#include "reckon/haptics/input_files/load_budget.hpp"

namespace reckon::haptics {
namespace {

/// Frees libpng's image, even if a check throws.
struct PngImage {
  png_image png{};
  PngImage() { png.version = PNG_IMAGE_VERSION; }
  PngImage(const PngImage&) = delete;
  PngImage& operator=(const PngImage&) = delete;
  ~PngImage() { png_image_free(&png); }

  [[noreturn]] void refuse() const {
    throw std::invalid_argument(std::string("is not a readable PNG picture (") + png.message +
                                "); export it again");
  }
};

GreyImage read_png(std::string_view bytes) {
  PngImage image;
  if (png_image_begin_read_from_memory(&image.png, bytes.data(), bytes.size()) == 0) image.refuse();
  const std::size_t width = image.png.width, height = image.png.height;
  check_pixels(width, height);
  check_png_data(bytes);
  // 8-bit values are used as stored, without gamma: a height is not a brightness.
  const bool deep = (image.png.format & PNG_FORMAT_FLAG_LINEAR) != 0;
  image.png.format = deep ? PNG_FORMAT_LINEAR_Y : PNG_FORMAT_GRAY;
  GreyImage out{width, height, std::vector<float>(width * height)};
  const png_color black{0, 0, 0};
  const auto read = [&](auto& pixels, float white) {
    if (png_image_finish_read(&image.png, &black, pixels.data(), 0, nullptr) == 0) image.refuse();
    for (std::size_t i = 0; i < pixels.size(); ++i)
      out.pixels[i] = static_cast<float>(pixels[i]) / white;
  };
  if (deep) {
    std::vector<std::uint16_t> pixels(width * height);
    read(pixels, 65535.0F);
  } else {
    std::vector<std::uint8_t> pixels(width * height);
    read(pixels, 255.0F);
  }
  return out;
}

std::string read_octets(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error))
    throw std::invalid_argument("does not exist; give the path relative to the scene file");
  return read_input_file(file, kMostImageOctets);
}

}  // namespace

void check_pixels(std::size_t width, std::size_t height) {
  if (width >= kLeastPixels && height >= kLeastPixels && width <= kMostPixels &&
      height <= kMostPixels)
    return LoadBudget::take(LoadWork::pixels, width * height);
  throw std::invalid_argument("has " + std::to_string(width) + " x " + std::to_string(height) +
                              " pixels: give 4 to 4096 along each edge");
}

GreyImage decode_image(std::string_view bytes) {
  if (is_pgm(bytes)) return read_pgm(bytes);
  if (bytes.starts_with("\x89PNG")) return read_png(bytes);
  throw std::invalid_argument("is neither a PNG picture nor a PGM one (P2, P5); give one of them");
}

GreyImage read_image(const std::filesystem::path& file) {
  const LoadBudget budget;
  try {
    return decode_image(read_octets(file));
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(file.string() + ": " + error.what());
  }
}

}  // namespace reckon::haptics
