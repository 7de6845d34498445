// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/image_files/png_data.hpp"

#define ZLIB_CONST  // declares zlib's input as const
#include <zlib.h>

#include <array>
#include <cstddef>
#include <stdexcept>

namespace reckon::haptics {
namespace {

constexpr std::size_t kFirstChunk = 8;   // the header chunk, after the signature
constexpr std::size_t kAroundData = 12;  // length and type before the data, a checksum after it

std::size_t number_at(std::string_view bytes, std::size_t at) {
  std::size_t value = 0;
  for (std::size_t i = 0; i < 4; ++i)
    value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

/// Upper bound of the size of the picture's rows, interlaced or not.
std::size_t most_unpacked(std::string_view bytes) {
  constexpr std::size_t kChannels[] = {1, 1, 3, 1, 2, 1, 4, 1};  // by colour type
  const std::size_t width = number_at(bytes, 16), height = number_at(bytes, 20);
  const std::size_t depth = static_cast<unsigned char>(bytes[24]);
  const std::size_t channels = kChannels[static_cast<unsigned char>(bytes[25]) % 8];
  return 2 * height * (width * depth * channels / 8 + 2) + 1024;
}

/// Unpacks data without storing it.
class Unpacked {
 public:
  explicit Unpacked(std::size_t most) : most_(most) { inflateInit(&stream_); }
  Unpacked(const Unpacked&) = delete;
  Unpacked& operator=(const Unpacked&) = delete;
  ~Unpacked() { inflateEnd(&stream_); }

  /// @return whether more may follow
  bool take(std::string_view packed) {
    stream_.next_in = reinterpret_cast<const Bytef*>(packed.data());
    stream_.avail_in = static_cast<uInt>(packed.size());
    std::array<Bytef, 65536> room;
    do {
      stream_.next_out = room.data();
      stream_.avail_out = static_cast<uInt>(room.size());
      if (inflate(&stream_, Z_NO_FLUSH) != Z_OK) return false;
      if (stream_.total_out > most_)
        throw std::invalid_argument("has more data than its pixels need; export the picture again");
    } while (stream_.avail_out == 0);
    return true;
  }

 private:
  z_stream stream_{};
  std::size_t most_;
};

}  // namespace

void check_png_data(std::string_view bytes) {
  Unpacked unpacked(most_unpacked(bytes));
  bool goes_on = true;
  for (std::size_t at = kFirstChunk; goes_on && at + kAroundData <= bytes.size();) {
    const std::string_view rest = bytes.substr(at + 8);
    const std::string_view data = rest.substr(0, number_at(bytes, at));
    if (bytes.substr(at + 4, 4) == "IDAT") goes_on = unpacked.take(data);
    at += data.size() + kAroundData;
  }
}

}  // namespace reckon::haptics
