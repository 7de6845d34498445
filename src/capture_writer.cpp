// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "src/capture_writer.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

namespace reckon::peer {
namespace {

using std::chrono::nanoseconds;

/// Block types and numbers of draft-ietf-opsawg-pcapng.
constexpr std::uint32_t kSectionHeader = 0x0a0d0d0a;
constexpr std::uint32_t kInterfaceDescription = 1;
constexpr std::uint32_t kInterfaceStatistics = 5;
constexpr std::uint32_t kEnhancedPacket = 6;
constexpr std::uint32_t kByteOrderMagic = 0x1a2b3c4d;
constexpr std::uint32_t kSnapLength = 262144;
constexpr std::uint32_t kPacketOverhead = 32;

/// What is buffered goes to the kernel at this size [octets].
constexpr std::size_t kFlushSize = std::size_t{1} << 16;

constexpr std::size_t padded(std::size_t length) { return (length + 3) & ~std::size_t{3}; }

std::string numbered(const std::string& path, std::size_t number) {
  const std::filesystem::path whole(path);
  const auto name =
      fmt::format("{}_{:05}{}", whole.stem().string(), number, whole.extension().string());
  return (whole.parent_path() / name).string();
}

/// Packets and octets of the blocks of `buffer` that end within its first `written` octets.
std::pair<std::uint64_t, std::size_t> whole_blocks(std::span<const std::byte> buffer,
                                                   std::size_t written) {
  std::uint64_t packets = 0;
  std::size_t end = 0;
  while (end < buffer.size()) {
    std::array<std::uint32_t, 2> head{};
    std::memcpy(head.data(), buffer.data() + end, sizeof head);
    if (end + head[1] > written) break;
    end += head[1];
    if (head[0] == kEnhancedPacket) ++packets;
  }
  return {packets, end};
}

}  // namespace

CaptureWriter::CaptureWriter(CaptureWriterOptions options) : options_(std::move(options)) {
  buffer_.reserve(4 * kFlushSize);
  open_next();
}

CaptureWriter::~CaptureWriter() {
  try {
    flush();
  } catch (const CaptureWriteError&) {
    // The file was cut back to its last whole block; finish() would have told.
  }
  close();
}

void CaptureWriter::write(const SourceDatagram& datagram) {
  if (is_full(datagram.time)) {
    flush();
    close();
    open_next();
  }
  if (datagram.captured.empty()) {
    make_ip_packet(datagram, packet_);
    append_packet(datagram, packet_, packet_.size());
  } else {
    append_packet(datagram, datagram.captured, datagram.captured_on_wire);
  }
  if (in_file_++ == 0) file_begin_ = datagram.time;
  last_time_ = datagram.time;
  ++pending_;
  if (buffer_.size() >= kFlushSize) flush();
}

void CaptureWriter::flush() {
  std::size_t written = 0;
  while (written < buffer_.size()) {
    const ssize_t count = ::write(file_, buffer_.data() + written, buffer_.size() - written);
    if (count > 0)
      written += static_cast<std::size_t>(count);
    else if (count == 0 || errno != EINTR)
      fail(written, count == 0 ? ENOSPC : errno);
  }
  position_ += buffer_.size();
  safe_ += pending_;
  pending_ = 0;
  buffer_.clear();
}

void CaptureWriter::finish(std::uint64_t received, std::uint64_t dropped) {
  append_statistics(received, dropped);
  flush();
  close();
}

bool CaptureWriter::is_full(nanoseconds time) const noexcept {
  if (in_file_ == 0) return false;
  if (options_.rotate_octets > 0 && position_ + buffer_.size() >= options_.rotate_octets)
    return true;
  return options_.rotate_after.count() > 0 && time - file_begin_ >= options_.rotate_after;
}

void CaptureWriter::open_next() {
  const bool rotates = options_.rotate_octets > 0 || options_.rotate_after.count() > 0;
  const std::string path = rotates ? numbered(options_.path, paths_.size() + 1) : options_.path;
  const int mode = O_WRONLY | O_CREAT | O_CLOEXEC | (options_.overwrite ? O_TRUNC : O_EXCL);
  file_ = ::open(path.c_str(), mode, 0644);
  if (file_ < 0 && errno == EEXIST)
    throw CaptureWriteError(path + " exists; take another name, or --force to overwrite it");
  if (file_ < 0)
    throw CaptureWriteError(
        fmt::format("{} cannot be written: {}; choose another place", path, std::strerror(errno)));
  paths_.push_back(path);
  earlier_octets_ += std::exchange(position_, 0);
  in_file_ = 0;
  begin_section();
  flush();
}

void CaptureWriter::close() {
  if (file_ >= 0) ::close(std::exchange(file_, -1));
}

// Cuts the file back to its last whole block and says what it holds.
void CaptureWriter::fail(std::size_t written, int error) {
  const auto [packets, end] = whole_blocks(buffer_, written);
  position_ += end;
  safe_ += packets;
  buffer_.clear();
  pending_ = 0;
  const bool cut = ::ftruncate(file_, static_cast<off_t>(position_)) == 0;
  close();
  const char* last = cut ? "" : " (its end may be torn)";
  throw CaptureWriteError(fmt::format(
      "{}: {}; {} datagrams before that are safe and can be read{}; free space or choose another "
      "place",
      paths_.back(), std::strerror(error), safe_, last));
}

void CaptureWriter::u16(std::uint16_t value) {
  const auto octets = std::as_bytes(std::span(&value, 1));
  buffer_.insert(buffer_.end(), octets.begin(), octets.end());
}
void CaptureWriter::u32(std::uint32_t value) {
  const auto octets = std::as_bytes(std::span(&value, 1));
  buffer_.insert(buffer_.end(), octets.begin(), octets.end());
}
void CaptureWriter::u64(std::uint64_t value) {
  const auto octets = std::as_bytes(std::span(&value, 1));
  buffer_.insert(buffer_.end(), octets.begin(), octets.end());
}

void CaptureWriter::time_words(nanoseconds time) {
  const auto count = static_cast<std::uint64_t>(std::max(time, nanoseconds{0}).count());
  u32(static_cast<std::uint32_t>(count >> 32));
  u32(static_cast<std::uint32_t>(count));
}

// Section header and the one interface; times count in units of 10^-9 s.
void CaptureWriter::begin_section() {
  constexpr std::uint32_t kSectionLength = 28;
  u32(kSectionHeader);
  u32(kSectionLength);
  u32(kByteOrderMagic);
  u16(1);
  u16(0);
  u64(~std::uint64_t{0});  // the section's length is not known
  u32(kSectionLength);

  constexpr std::uint32_t kInterfaceLength = 32;
  u32(kInterfaceDescription);
  u32(kInterfaceLength);
  u16(options_.link_type);
  u16(0);
  u32(kSnapLength);
  u16(9);  // if_tsresol
  u16(1);
  buffer_.insert(buffer_.end(), {std::byte{9}, std::byte{0}, std::byte{0}, std::byte{0}});
  u32(0);  // end of options
  u32(kInterfaceLength);
}

void CaptureWriter::append_packet(const SourceDatagram& datagram, std::span<const std::byte> frame,
                                  std::size_t on_wire) {
  const auto length = static_cast<std::uint32_t>(kPacketOverhead + padded(frame.size()));
  u32(kEnhancedPacket);
  u32(length);
  u32(0);
  time_words(datagram.time);
  u32(static_cast<std::uint32_t>(frame.size()));
  u32(static_cast<std::uint32_t>(on_wire));
  buffer_.insert(buffer_.end(), frame.begin(), frame.end());
  buffer_.resize(buffer_.size() + padded(frame.size()) - frame.size());
  u32(length);
}

void CaptureWriter::append_statistics(std::uint64_t received, std::uint64_t dropped) {
  constexpr std::uint32_t kLength = 52;
  u32(kInterfaceStatistics);
  u32(kLength);
  u32(0);
  time_words(last_time_);
  u16(4);  // isb_ifrecv
  u16(8);
  u64(received);
  u16(5);  // isb_ifdrop
  u16(8);
  u64(dropped);
  u32(0);  // end of options
  u32(kLength);
}

}  // namespace reckon::peer
