// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/image_files/pgm_reader.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>

namespace reckon::haptics {
namespace {

constexpr std::string_view kBlanks = " \t\n\v\f\r";
constexpr std::uint32_t kMostWhite = 65535;

[[noreturn]] void refuse(const std::string& why) { throw std::invalid_argument(why); }

/// The numbers of a file, one after the other.
class PgmNumbers {
 public:
  explicit PgmNumbers(std::string_view bytes) : rest_(bytes) {}

  /// std::nullopt: the next token is no whole number below 2^32.
  std::optional<std::uint32_t> next() {
    skip_blanks();
    std::uint32_t value = 0;
    const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
    if (error != std::errc()) return std::nullopt;
    rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
    return value;
  }
  /// Data after the single blank that ends the header.
  [[nodiscard]] std::string_view raster() const {
    const bool parted = !rest_.empty() && kBlanks.find(rest_.front()) != std::string_view::npos;
    if (!parted) refuse("has no blank after its greatest value; export the picture again");
    return rest_.substr(1);
  }
  [[nodiscard]] std::size_t left() const { return rest_.size(); }

 private:
  // A comment goes from # to the end of its line.
  void skip_blanks() {
    while (true) {
      rest_.remove_prefix(std::min(rest_.find_first_not_of(kBlanks), rest_.size()));
      if (rest_.empty() || rest_.front() != '#') return;
      rest_.remove_prefix(std::min(rest_.find_first_of("\n\r"), rest_.size()));
    }
  }

  std::string_view rest_;
};

std::uint32_t header_number(PgmNumbers& numbers, std::string_view what) {
  const auto value = numbers.next();
  if (!value) refuse("has no " + std::string(what) + " in its header; export the picture again");
  return *value;
}

void check_left(std::size_t left, std::size_t needed) {
  if (left >= needed) return;
  refuse("ends early: its pixels need " + std::to_string(needed) + " octets and " +
         std::to_string(left) + " exist; export the picture again");
}

float grey(std::uint32_t value, std::uint32_t white, std::size_t index, std::size_t width) {
  if (value <= white) return static_cast<float>(value) / static_cast<float>(white);
  refuse("row " + std::to_string(index / width + 1) + ", column " +
         std::to_string(index % width + 1) + ": " + std::to_string(value) +
         " is above its greatest value " + std::to_string(white) + "; export the picture again");
}

void read_octets(std::string_view raster, std::uint32_t white, GreyImage& out) {
  const std::size_t pixels = out.width * out.height, deep = white > 255 ? 2 : 1;
  check_left(raster.size(), deep * pixels);
  out.pixels.resize(pixels);
  const auto octet = [&](std::size_t at) { return static_cast<unsigned char>(raster[at]); };
  for (std::size_t i = 0; i < pixels; ++i) {
    const std::uint32_t value =
        deep == 1 ? octet(i) : static_cast<std::uint32_t>(octet(2 * i) << 8 | octet(2 * i + 1));
    out.pixels[i] = grey(value, white, i, out.width);
  }
}

void read_text(PgmNumbers& numbers, std::uint32_t white, GreyImage& out) {
  const std::size_t pixels = out.width * out.height;
  check_left(numbers.left(), 2 * pixels);  // a blank and a digit at least
  out.pixels.resize(pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    const auto value = numbers.next();
    if (!value)
      refuse("row " + std::to_string(i / out.width + 1) + ", column " +
             std::to_string(i % out.width + 1) + ": not a number; export the picture again");
    out.pixels[i] = grey(*value, white, i, out.width);
  }
}

}  // namespace

bool is_pgm(std::string_view bytes) noexcept {
  return bytes.starts_with("P2") || bytes.starts_with("P5");
}

GreyImage read_pgm(std::string_view bytes) {
  PgmNumbers numbers(bytes.substr(2));
  GreyImage out;
  out.width = header_number(numbers, "width");
  out.height = header_number(numbers, "height");
  check_pixels(out.width, out.height);
  const std::uint32_t white = header_number(numbers, "greatest value");
  if (white == 0 || white > kMostWhite)
    refuse("has " + std::to_string(white) + " as its greatest value: give 1 to 65535");
  if (bytes[1] == '5') {
    read_octets(numbers.raster(), white, out);
  } else {
    read_text(numbers, white, out);
  }
  return out;
}

}  // namespace reckon::haptics
