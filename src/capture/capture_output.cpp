// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/capture/capture_output.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <utility>

#include "reckon/peer/capture/capture_writer.hpp"
#include "reckon/peer/capture/pcapng_blocks.hpp"

namespace reckon::peer {
namespace {

/// A frame ends at this size [octets]; larger ones hardly reduce the file.
constexpr std::size_t kFrameSize = std::size_t{1} << 20;

/// Packets and octets of the blocks in `blocks` that end within its first `written` octets.
std::pair<std::uint64_t, std::size_t> whole_blocks(std::span<const std::byte> blocks,
                                                   std::size_t written) {
  std::uint64_t packets = 0;
  std::size_t end = 0;
  while (end < blocks.size()) {
    std::array<std::uint32_t, 2> head{};
    std::memcpy(head.data(), blocks.data() + end, sizeof head);
    if (end + head[1] > written) break;
    end += head[1];
    if (head[0] == kEnhancedPacket) ++packets;
  }
  return {packets, end};
}

int create(const std::string& path, bool overwrite) {
  const int mode = O_WRONLY | O_CREAT | O_CLOEXEC | (overwrite ? O_TRUNC : O_EXCL);
  const int file = ::open(path.c_str(), mode, 0644);
  if (file >= 0) return file;
  const int error = errno;
  if (std::error_code none; std::filesystem::is_directory(path, none))
    throw CaptureWriteError(path + " is a folder; name a file in it");
  if (error == EEXIST)
    throw CaptureWriteError(path + " exists; choose another name, or --force to overwrite it");
  throw CaptureWriteError(
      fmt::format("{} cannot be written: {}; choose another place", path, std::strerror(error)));
}

}  // namespace

CaptureOutput::CaptureOutput(std::string path, bool overwrite, bool compress)
    : path_(std::move(path)), file_(create(path_, overwrite)) {
  struct stat created {};
  if (::fstat(file_, &created) == 0) {
    device_ = created.st_dev;
    inode_ = created.st_ino;
  }
  if (compress) compressor_.emplace();
}

CaptureOutput::~CaptureOutput() {
  try {
    finish();
  } catch (const CaptureWriteError&) {
    // The file was truncated to a whole block; finish() would have reported it.
  }
}

void CaptureOutput::append(std::span<const std::byte> blocks) {
  if (file_ < 0 || blocks.empty()) return;
  if (compressor_.has_value())
    append_frame(blocks, frame_.size() + blocks.size() >= kFrameSize);
  else
    append_plain(blocks);
}

void CaptureOutput::finish() {
  if (file_ >= 0 && !frame_.empty()) append_frame({}, true);
  close();
}

bool CaptureOutput::remove() const {
  struct stat there {};
  if (::lstat(path_.c_str(), &there) != 0 || there.st_dev != device_ || there.st_ino != inode_)
    return false;
  if (::unlink(path_.c_str()) == 0) return true;
  throw CaptureWriteError(
      fmt::format("{} cannot be removed: {}; the total size would exceed its limit", path_,
                  std::strerror(errno)));
}

CaptureOutput::Written CaptureOutput::write(std::span<const std::byte> octets) {
  std::size_t done = 0;
  while (done < octets.size()) {
    const ssize_t count = ::write(file_, octets.data() + done, octets.size() - done);
    if (count > 0)
      done += static_cast<std::size_t>(count);
    else if (count == 0 || errno != EINTR)
      return {done, count == 0 ? ENOSPC : errno};
  }
  return {done, 0};
}

void CaptureOutput::append_plain(std::span<const std::byte> blocks) {
  const Written written = write(blocks);
  const auto [packets, end] = whole_blocks(blocks, written.octets);
  position_ += end;
  packets_ += packets;
  if (written.error != 0) fail(written.error, truncate());
}

void CaptureOutput::append_frame(std::span<const std::byte> blocks, bool end) {
  compressed_.clear();
  compressor_->compress(blocks, end, compressed_);
  const Written written = write(compressed_);
  if (written.error != 0) fail(written.error, cut_back_frame());
  position_ += compressed_.size();
  const std::uint64_t packets = whole_blocks(blocks, blocks.size()).first;
  packets_ += packets;
  frame_packets_ += packets;
  frame_.insert(frame_.end(), blocks.begin(), blocks.end());
  if (!end) return;
  frame_.clear();
  frame_begin_ = position_;
  frame_packets_ = 0;
}

// Rewrites the safe blocks of the frame in place, as a complete frame: this needs no further disk
// space. If it fails, the frame is lost.
bool CaptureOutput::cut_back_frame() {
  compressed_.clear();
  compressor_->reset();
  if (!frame_.empty()) compressor_->compress(frame_, true, compressed_);
  const bool there = ::lseek(file_, static_cast<off_t>(frame_begin_), SEEK_SET) >= 0;
  position_ = frame_begin_;
  if (there && write(compressed_).error == 0)
    position_ += compressed_.size();
  else
    packets_ -= frame_packets_;
  return truncate();
}

bool CaptureOutput::truncate() { return ::ftruncate(file_, static_cast<off_t>(position_)) == 0; }

// Reports the content of the file.
void CaptureOutput::fail(int error, bool whole) {
  close();
  throw CaptureWriteError(
      fmt::format("{}: {}; {} datagrams before that are safe and can be read{}; free space or "
                  "choose another place",
                  path_, std::strerror(error), packets_, whole ? "" : " (its end may be torn)"));
}

void CaptureOutput::close() {
  if (file_ >= 0) ::close(std::exchange(file_, -1));
  compressor_.reset();
  compressed_ = {};
  frame_ = {};
}

}  // namespace reckon::peer
