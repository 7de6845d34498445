// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Frames of pcapng files (draft-ietf-opsawg-pcapng) with any number of interfaces, of different
// link types, snapshot lengths and clocks; libpcap supports only one of each.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <stdexcept>
#include <utility>
#include <vector>

#include "reckon/peer/capture/frame_reader.hpp"
#include "reckon/peer/capture/pcapng_blocks.hpp"

namespace reckon::peer {
namespace {

using std::chrono::nanoseconds;

constexpr std::size_t kBlockOverhead = 12;
constexpr std::size_t kMaxBlock = std::size_t{16} << 20;  // as in libpcap
constexpr std::size_t kPiece = std::size_t{1} << 16;      // octets per read
constexpr std::size_t kMaxInterfaces = 65536;
constexpr std::size_t kLongestName = 64;  // of an interface; longer names are dropped

constexpr std::size_t padded(std::size_t length) { return (length + 3) & ~std::size_t{3}; }

/// The clock of an interface.
struct Resolution {
  std::uint64_t units{1'000'000};  ///< per second
  std::int64_t offset{0};          ///< [s] to add
};

/// Sets the clock from if_tsresol; false if the number of units exceeds 64 bits.
bool set_resolution(std::uint8_t code, Resolution& out) {
  const unsigned power = code & 0x7fU;
  const bool is_binary = (code & 0x80U) != 0;
  if (power > (is_binary ? 63U : 19U)) return false;
  out.units = 1;
  for (unsigned i = 0; i < power; ++i) out.units *= is_binary ? 2 : 10;
  return true;
}

nanoseconds time_of(std::uint64_t stamp, const Resolution& resolution) {
  constexpr std::uint64_t kNano = 1'000'000'000;
  constexpr auto kMost = std::uint64_t{1} << 61;
  const auto second = static_cast<std::int64_t>(std::min(stamp / resolution.units, kMost));
  std::uint64_t rest = stamp % resolution.units;
  std::uint64_t units = resolution.units;
  // Reduces the bits so that the product fits into 64; the lost part is below a nanosecond.
  if (units > kNano && units % kNano == 0) {
    rest /= units / kNano;
    units = kNano;
  }
  while (units > (std::uint64_t{1} << 33)) {
    units /= 2;
    rest /= 2;
  }
  const auto half = static_cast<std::int64_t>(kMost);
  return bounded_time(second + std::clamp(resolution.offset, -half, half),
                      static_cast<std::int64_t>(std::min(rest * kNano / units, kNano - 1)));
}

struct Interface {
  std::uint16_t link_type;
  std::uint32_t snap_length;  ///< 0: no limit
  Resolution resolution;
  std::string name;
};

class PcapngFrames final : public FrameReader {
 public:
  /// Reads up to the first interface.  @throws std::runtime_error if there is none.
  PcapngFrames(std::unique_ptr<std::FILE, decltype(&std::fclose)> file, bool grows)
      : file_(std::move(file)), grows_(grows) {
    Block block;
    while (interfaces_.empty()) {
      const FrameEvent event = read_block(block);
      if (event == FrameEvent::damaged) throw std::runtime_error(problem_);
      if (event != FrameEvent::frame)
        throw std::runtime_error("it ends before its first interface is described");
      if (is_packet(block.type))
        throw std::runtime_error("a packet before the first interface is described");
      if (!take_description(block)) throw std::runtime_error(problem_);
    }
    link_type_ = interfaces_.front().link_type;
  }

  FrameEvent next(CapturedFrame& out) override {
    Block block;
    while (true) {
      const FrameEvent event = read_block(block);
      if (event != FrameEvent::frame) return event;
      if (is_packet(block.type))
        return take_packet(block, out) ? FrameEvent::frame : FrameEvent::damaged;
      if (!take_description(block)) return FrameEvent::damaged;
    }
  }

  std::string problem() const override { return problem_; }
  std::uint16_t link_type() const noexcept override { return link_type_; }
  std::string_view interface_name() const noexcept override {
    return captured_on_ < interfaces_.size() ? interfaces_[captured_on_].name : std::string_view();
  }

 private:
  /// A block without its two length fields; `body` is in buffer_.
  struct Block {
    std::uint32_t type{0};
    std::span<const std::byte> body;
  };

  static bool is_packet(std::uint32_t type) {
    return type == kEnhancedPacket || type == kSimplePacket || type == kObsoletePacket;
  }

  template <typename T>
  [[nodiscard]] T number(std::span<const std::byte> octets, std::size_t at) const {
    std::array<std::byte, sizeof(T)> bytes;
    std::copy_n(octets.begin() + static_cast<std::ptrdiff_t>(at), sizeof(T), bytes.begin());
    if (is_swapped_) std::reverse(bytes.begin(), bytes.end());
    T value;
    std::memcpy(&value, bytes.data(), sizeof value);
    return value;
  }

  FrameEvent read_block(Block& out);
  bool read_into_buffer(std::size_t count);
  FrameEvent at_end(off_t begin, std::size_t held, std::size_t wanted);
  bool fail(std::string problem) {
    problem_ = std::move(problem);
    return false;
  }
  bool read_byte_order();
  bool take_description(const Block& block);
  bool take_interface(std::span<const std::byte> body);
  bool take_option(std::uint16_t code, std::span<const std::byte> value, Interface& interface);
  bool take_packet(const Block& block, CapturedFrame& out);

  std::unique_ptr<std::FILE, decltype(&std::fclose)> file_;
  bool grows_;
  bool is_swapped_{false};
  std::vector<Interface> interfaces_;  ///< of this section
  std::size_t captured_on_ = 0;        ///< interface of the last frame
  nanoseconds latest_{};               ///< time of the previous frame, used for a simple packet
  std::uint16_t link_type_{0};
  std::vector<std::byte> buffer_;
  std::string problem_;
};

// Appends to the buffer; false at the end of the file. Memory grows with the octets present, not
// with the value of a length field.
bool PcapngFrames::read_into_buffer(std::size_t count) {
  while (count > 0) {
    const std::size_t held = buffer_.size();
    const std::size_t piece = std::min(count, kPiece);
    buffer_.resize(held + piece);
    const std::size_t got = std::fread(buffer_.data() + held, 1, piece, file_.get());
    buffer_.resize(held + got);
    if (got < piece) return false;
    count -= piece;
  }
  return true;
}

// Handles an end of file after `held` of `wanted` octets of the block that begins at `begin`.
FrameEvent PcapngFrames::at_end(off_t begin, std::size_t held, std::size_t wanted) {
  if (grows_ && step_back(file_.get(), begin)) return FrameEvent::nothing_yet;
  if (held == 0) return FrameEvent::end;
  fail(fmt::format("truncated: only {} of {} octets of a block", held, wanted));
  return FrameEvent::damaged;
}

bool PcapngFrames::read_byte_order() {
  is_swapped_ = false;
  const auto magic = number<std::uint32_t>(buffer_, 8);
  is_swapped_ = magic != kByteOrderMagic;
  if (is_swapped_ && number<std::uint32_t>(buffer_, 8) != kByteOrderMagic)
    return fail(
        fmt::format("a section header with {:#010x} instead of the byte-order magic", magic));
  interfaces_.clear();
  return true;
}

// Returns `frame` if there is a block.
FrameEvent PcapngFrames::read_block(Block& out) {
  const off_t begin = grows_ ? ftello(file_.get()) : 0;
  buffer_.clear();
  if (!read_into_buffer(8)) return at_end(begin, buffer_.size(), kBlockOverhead);
  out.type = number<std::uint32_t>(buffer_, 0);
  std::size_t least = kBlockOverhead;
  if (out.type == kSectionHeader) {  // the same in both byte orders
    least = 28;
    if (!read_into_buffer(4)) return at_end(begin, buffer_.size(), least);
    if (!read_byte_order()) return FrameEvent::damaged;
  }
  const std::size_t length = number<std::uint32_t>(buffer_, 4);
  if (length < least || length % 4 != 0 || length > kMaxBlock) {
    fail(fmt::format("a block of type {} has a length of {}", out.type, length));
    return FrameEvent::damaged;
  }
  if (!read_into_buffer(length - buffer_.size())) return at_end(begin, buffer_.size(), length);
  if (number<std::uint32_t>(buffer_, length - 4) != length) {
    fail(fmt::format("a block of type {} has a length of {} and, at its end, of {}", out.type,
                     length, number<std::uint32_t>(buffer_, length - 4)));
    return FrameEvent::damaged;
  }
  out.body = std::span(buffer_).subspan(8, length - kBlockOverhead);
  return FrameEvent::frame;
}

bool PcapngFrames::take_description(const Block& block) {
  if (block.type == kInterfaceDescription) return take_interface(block.body);
  if (block.type != kSectionHeader) return true;
  const auto version = number<std::uint16_t>(block.body, 4);
  return version == 1 || fail(fmt::format("pcapng version {} is not supported", version));
}

bool PcapngFrames::take_interface(std::span<const std::byte> body) {
  if (body.size() < 8) return fail("an interface description of less than 20 octets");
  if (interfaces_.size() == kMaxInterfaces)
    return fail(fmt::format("a section describes more than {} interfaces", kMaxInterfaces));
  Interface interface {
    number<std::uint16_t>(body, 0), number<std::uint32_t>(body, 4), {}, {}
  };
  for (auto rest = body.subspan(8); rest.size() >= 4;) {
    const auto code = number<std::uint16_t>(rest, 0);
    const std::size_t length = number<std::uint16_t>(rest, 2);
    if (code == 0) break;
    if (4 + padded(length) > rest.size())
      return fail(fmt::format("option {} of an interface is longer than its block", code));
    if (!take_option(code, rest.subspan(4, length), interface)) return false;
    rest = rest.subspan(4 + padded(length));
  }
  interfaces_.push_back(interface);
  return true;
}

bool PcapngFrames::take_option(std::uint16_t code, std::span<const std::byte> value,
                               Interface& interface) {
  constexpr std::uint16_t kName = 2;
  constexpr std::uint16_t kTimeResolution = 9;
  constexpr std::uint16_t kTimeOffset = 14;
  if (code == kName && value.size() <= kLongestName)
    interface.name.assign(reinterpret_cast<const char*>(value.data()), value.size());
  if (code == kTimeResolution && value.size() == 1) {
    const auto resolution = std::to_integer<std::uint8_t>(value[0]);
    return set_resolution(resolution, interface.resolution) ||
           fail(fmt::format("an interface with a time resolution of {:#04x}", resolution));
  }
  if (code == kTimeOffset && value.size() == 8)
    interface.resolution.offset = number<std::int64_t>(value, 0);
  return true;
}

bool PcapngFrames::take_packet(const Block& block, CapturedFrame& out) {
  const std::span<const std::byte> body = block.body;
  const bool is_simple = block.type == kSimplePacket;
  const std::size_t head = is_simple ? 4 : 20;
  if (body.size() < head) return fail(fmt::format("a packet block of {} octets", body.size() + 12));
  std::size_t id = 0;
  if (block.type == kEnhancedPacket) id = number<std::uint32_t>(body, 0);
  if (block.type == kObsoletePacket) id = number<std::uint16_t>(body, 0);
  if (id >= interfaces_.size())
    return fail(
        fmt::format("a packet of interface {}, but {} are described", id, interfaces_.size()));
  const Interface& interface = interfaces_[id];
  std::size_t held = 0;
  if (is_simple) {
    out.on_wire = number<std::uint32_t>(body, 0);
    const std::size_t most = interface.snap_length == 0 ? out.on_wire : interface.snap_length;
    held = std::min({out.on_wire, most, body.size() - head});
    out.time = latest_;
  } else {
    held = number<std::uint32_t>(body, 12);
    out.on_wire = number<std::uint32_t>(body, 16);
    const std::uint64_t stamp =
        std::uint64_t{number<std::uint32_t>(body, 4)} << 32 | number<std::uint32_t>(body, 8);
    out.time = latest_ = time_of(stamp, interface.resolution);
  }
  if (held > body.size() - head)
    return fail(fmt::format("a packet of {} octets in a block of {}", held, body.size() + 12));
  captured_on_ = id;
  out.octets = body.subspan(head, held);
  out.link_type = interface.link_type;
  out.layer = link_layer_of(interface.link_type);
  return true;
}

}  // namespace

std::unique_ptr<FrameReader> open_pcapng_frames(std::FILE* file, bool grows) {
  return std::make_unique<PcapngFrames>(
      std::unique_ptr<std::FILE, decltype(&std::fclose)>(file, std::fclose), grows);
}

}  // namespace reckon::peer
