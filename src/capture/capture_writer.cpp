// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/capture/capture_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <span>
#include <string_view>
#include <utility>

#include "reckon/peer/capture/capture_output.hpp"
#include "reckon/peer/capture/pcapng_blocks.hpp"

namespace reckon::peer {
namespace {

using std::chrono::nanoseconds;

constexpr std::uint32_t kSnapLength = 262144;
constexpr std::uint32_t kPacketOverhead = 32;

/// Buffer size at which it is passed to the kernel [octets].
constexpr std::size_t kFlushSize = std::size_t{1} << 16;

/// Number of files for `rotate_total`, if their size is not given.
constexpr std::uint64_t kFilesOfTotal = 10;

constexpr std::size_t padded(std::size_t length) { return (length + 3) & ~std::size_t{3}; }

/// The part of a file's name after the number: its extension, or two if the last is .zst.
std::string extension_of(const std::filesystem::path& path) {
  const std::string last = path.extension().string();
  return last == ".zst" ? path.stem().extension().string() + last : last;
}

std::string numbered(const std::string& path, std::size_t number) {
  const std::filesystem::path whole(path);
  const std::string extension = extension_of(whole);
  std::string name = whole.filename().string();
  name.insert(name.size() - extension.size(), fmt::format("_{:05}", number));
  return (whole.parent_path() / name).string();
}

}  // namespace

CaptureWriter::CaptureWriter(CaptureWriterOptions options) : options_(std::move(options)) {
  buffer_.reserve(4 * kFlushSize);
  if (options_.rotate_octets == 0) options_.rotate_octets = options_.rotate_total / kFilesOfTotal;
  open_next();
}

CaptureWriter::~CaptureWriter() {
  try {
    flush();
  } catch (const CaptureWriteError&) {
    // The file was truncated to its last whole block; finish() would have reported it.
  }
}

void CaptureWriter::write(const SourceDatagram& datagram) {
  if (is_full(datagram.time)) {
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
  if (buffer_.size() >= kFlushSize) flush();
}

void CaptureWriter::flush() {
  // If this throws, the rest must not be written again.
  std::swap(buffer_, flushing_);
  buffer_.clear();
  if (file_) file_->append(flushing_);
}

void CaptureWriter::finish(std::uint64_t received, std::uint64_t dropped) {
  append_statistics(received, dropped);
  close();
}

void CaptureWriter::close() {
  flush();
  file_->finish();
}

std::uint64_t CaptureWriter::datagrams() const noexcept {
  return earlier_packets_ + (file_ ? file_->packets() : 0);
}

std::uint64_t CaptureWriter::octets() const noexcept {
  return earlier_octets_ + (file_ ? file_->octets() : 0);
}

bool CaptureWriter::is_full(nanoseconds time) const noexcept {
  if (in_file_ == 0) return false;
  // The compressed size of the blocks in the buffer is not known.
  const std::uint64_t size = file_->octets() + (options_.compress ? 0 : buffer_.size());
  if (options_.rotate_octets > 0 && size >= options_.rotate_octets) return true;
  return options_.rotate_after.count() > 0 && time - file_begin_ >= options_.rotate_after;
}

void CaptureWriter::open_next() {
  const bool rotates = options_.rotate_octets > 0 || options_.rotate_after.count() > 0;
  const std::string path =
      rotates ? numbered(options_.path, paths_.size() + removed_.files + 1) : options_.path;
  if (file_) put_away();
  if (options_.rotate_total > 0) make_room();
  file_ = std::make_unique<CaptureOutput>(path, options_.overwrite, options_.compress);
  paths_.push_back(path);
  in_file_ = 0;
  begin_section();
  flush();
}

// Adds the finished file to the totals.
void CaptureWriter::put_away() {
  earlier_octets_ += file_->octets();
  earlier_packets_ += file_->packets();
  if (options_.rotate_total > 0) finished_.push_back(std::move(file_));
  file_.reset();
}

// Makes room for the next file by removing the oldest ones. A file that was moved no longer counts.
void CaptureWriter::make_room() {
  while (!finished_.empty() && earlier_octets_ + options_.rotate_octets > options_.rotate_total) {
    const std::unique_ptr<CaptureOutput> oldest = std::move(finished_.front());
    finished_.pop_front();
    earlier_octets_ -= oldest->octets();
    if (!oldest->remove()) continue;
    earlier_packets_ -= oldest->packets();
    ++removed_.files;
    removed_.datagrams += oldest->packets();
    removed_.octets += oldest->octets();
    std::erase(paths_, oldest->path());
  }
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

void CaptureWriter::begin_section() {
  constexpr std::uint32_t kSectionLength = 28;
  u32(kSectionHeader);
  u32(kSectionLength);
  u32(kByteOrderMagic);
  u16(1);
  u16(0);
  u64(~std::uint64_t{0});  // unknown length of the section
  u32(kSectionLength);
  link_types_.clear();
  (void)interface_of(options_.link_type);
}

// The number of the interface with that link type; a new one gets a description block. Its times
// are in units of 10^-9 s.
std::uint32_t CaptureWriter::interface_of(std::uint16_t link_type) {
  const auto known = std::find(link_types_.begin(), link_types_.end(), link_type);
  const auto number = static_cast<std::uint32_t>(known - link_types_.begin());
  if (known != link_types_.end()) return number;
  link_types_.push_back(link_type);
  const std::string_view name = number == 0 ? options_.interface : std::string_view();
  const std::size_t option = name.empty() ? 0 : 4 + padded(name.size());
  const auto length = static_cast<std::uint32_t>(32 + option);
  u32(kInterfaceDescription);
  u32(length);
  u16(link_type);
  u16(0);
  u32(kSnapLength);
  if (!name.empty()) {
    u16(2);  // if_name
    u16(static_cast<std::uint16_t>(name.size()));
    const auto octets = std::as_bytes(std::span(name));
    buffer_.insert(buffer_.end(), octets.begin(), octets.end());
    buffer_.resize(buffer_.size() + padded(name.size()) - name.size());
  }
  u16(9);  // if_tsresol
  u16(1);
  buffer_.insert(buffer_.end(), {std::byte{9}, std::byte{0}, std::byte{0}, std::byte{0}});
  u32(0);  // end of options
  u32(length);
  return number;
}

void CaptureWriter::append_packet(const SourceDatagram& datagram, std::span<const std::byte> frame,
                                  std::size_t on_wire) {
  const auto length = static_cast<std::uint32_t>(kPacketOverhead + padded(frame.size()));
  const std::uint32_t interface =
      interface_of(datagram.captured.empty() ? kLinkTypeRawIp : datagram.link_type);
  u32(kEnhancedPacket);
  u32(length);
  u32(interface);
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
