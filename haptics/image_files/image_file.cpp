// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/image_files/image_file.hpp"

#include <png.h>

#include <cstdint>
#include <stdexcept>
#include <string>

namespace reckon::haptics {
namespace {

/// Frees what libpng holds, also when a check throws.
struct PngImage {
  png_image png{};
  PngImage() { png.version = PNG_IMAGE_VERSION; }
  PngImage(const PngImage&) = delete;
  PngImage& operator=(const PngImage&) = delete;
  ~PngImage() { png_image_free(&png); }
};

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& why) {
  throw std::invalid_argument(file.string() + ": " + why);
}

}  // namespace

GreyImage read_image(const std::filesystem::path& file) {
  PngImage image;
  const auto fault = [&] {
    return std::string("is no PNG picture that can be read (") + image.png.message + ")";
  };
  if (png_image_begin_read_from_file(&image.png, file.c_str()) == 0) refuse(file, fault());
  const std::size_t width = image.png.width, height = image.png.height;
  if (width < kLeastPixels || height < kLeastPixels || width > kMostPixels || height > kMostPixels)
    refuse(file, "has " + std::to_string(width) + " x " + std::to_string(height) +
                     " pixels: give 4 to 4096 along each edge");
  // 8 bits are brightness as stored, without the gamma of a screen: a height is no light.
  const bool deep = (image.png.format & PNG_FORMAT_FLAG_LINEAR) != 0;
  image.png.format = deep ? PNG_FORMAT_LINEAR_Y : PNG_FORMAT_GRAY;
  GreyImage out{width, height, std::vector<float>(width * height)};
  const png_color black{0, 0, 0};
  const auto read = [&](auto& pixels, float white) {
    if (png_image_finish_read(&image.png, &black, pixels.data(), 0, nullptr) == 0)
      refuse(file, fault());
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

}  // namespace reckon::haptics
