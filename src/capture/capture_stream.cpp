// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/capture/capture_stream.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace reckon::peer {
namespace {

constexpr std::size_t kBufferSize = std::size_t{1} << 17;
constexpr std::size_t kLongestMagic = 6;

int open_or_throw(const std::string& path) {
  if (path == "-") return STDIN_FILENO;
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0)
    throw std::runtime_error(fmt::format("{} cannot be opened: {}; give a pcap or pcapng file",
                                         path, std::strerror(errno)));
  return file;
}

}  // namespace

CaptureStream::CaptureStream(const std::string& path)
    : path_(path),
      name_(path == "-" ? "standard input" : path),
      file_(open_or_throw(path)),
      buffer_(kBufferSize) {
  try {
    look_at_head();
  } catch (...) {
    if (file_ != STDIN_FILENO) ::close(file_);
    throw;
  }
}

CaptureStream::~CaptureStream() {
  if (file_ != STDIN_FILENO) ::close(file_);
}

// Reads only enough to identify the file; on a pipe the rest may come much later.
void CaptureStream::look_at_head() {
  struct stat status {};
  if (fstat(file_, &status) == 0 && S_ISDIR(status.st_mode))
    throw std::runtime_error(name_ + " is a folder; name a capture file in it");
  is_plain_file_ = S_ISREG(status.st_mode) && path_ != "-";
  std::size_t held = 0;
  while (held < kLongestMagic) {
    const std::size_t count = read_file(std::span(buffer_).subspan(held));
    if (count == 0) break;
    held += count;
  }
  input_ = std::span(buffer_).first(held);
  if (error_ != 0)
    throw std::runtime_error(fmt::format("{} cannot be read: {}", name_, std::strerror(error_)));
  if (held == 0)
    throw std::runtime_error(name_ + " is empty; give a pcap or pcapng file with its header");
  if (begins_zstd(input_)) zstd_ = std::make_unique<ZstdDecompressor>();
  const std::string_view method = archive_method(input_);
  if (method.empty()) return;
  archive_ = std::make_unique<ArchiveDecompressor>(method, [this] { return read_buffer(); });
  if (!archive_->error().empty()) throw std::runtime_error(name_ + " " + archive_->error());
}

std::FILE* CaptureStream::open() {
  // A plain file is read directly.
  if (is_plain_file()) {
    std::FILE* const file = std::fopen(path_.c_str(), "rb");
    if (file != nullptr) std::setvbuf(file, nullptr, _IOFBF, kBufferSize);
    return file;
  }
  cookie_io_functions_t functions{};
  functions.read = read_cookie;
  std::FILE* stream = fopencookie(this, "r", functions);
  if (stream != nullptr) std::setvbuf(stream, nullptr, _IOFBF, kBufferSize);
  return stream;
}

std::string CaptureStream::problem() const {
  if (error_ != 0) return std::strerror(error_);
  if (archive_) return archive_->error();
  if (!zstd_) return {};
  const std::uint64_t whole = zstd_->frames();
  if (!zstd_->error().empty())
    return fmt::format("its zstd frame {} is damaged: {}; {} before it are intact", whole + 1,
                       zstd_->error(), whole);
  if (at_end_ && zstd_->inside_frame())
    return fmt::format("it ends within a zstd frame: {} of {} are intact", whole, whole + 1);
  return {};
}

std::string_view CaptureStream::compression() const noexcept {
  if (zstd_) return "zstd";
  return archive_ ? archive_->method() : std::string_view();
}

std::uint64_t CaptureStream::zstd_frames() const noexcept { return zstd_ ? zstd_->frames() : 0; }

ssize_t CaptureStream::read_cookie(void* cookie, char* to, std::size_t size) {
  auto& stream = *static_cast<CaptureStream*>(cookie);
  const auto out = std::as_writable_bytes(std::span(to, size));
  const std::size_t count = stream.read_content(out);
  stream.content_ += count;
  return static_cast<ssize_t>(count);
}

std::size_t CaptureStream::read_content(std::span<std::byte> out) {
  if (zstd_) return read_zstd(out);
  return archive_ ? archive_->decompress(out) : read_as_is(out);
}

// The next octets of the file, unchanged; none at its end.
std::span<const std::byte> CaptureStream::read_buffer() {
  if (input_.empty()) input_ = std::span(buffer_).first(read_file(buffer_));
  return std::exchange(input_, {});
}

std::size_t CaptureStream::read_as_is(std::span<std::byte> out) {
  if (input_.empty()) return read_file(out);
  const std::size_t count = std::min(out.size(), input_.size());
  std::memcpy(out.data(), input_.data(), count);
  input_ = input_.subspan(count);
  return count;
}

// A damaged or truncated stream ends early; problem() gives the reason.
std::size_t CaptureStream::read_zstd(std::span<std::byte> out) {
  while (true) {
    const std::size_t count = zstd_->decompress(input_, out);
    if (count > 0 || !zstd_->error().empty()) return count;
    if (!input_.empty()) continue;
    input_ = std::span(buffer_).first(read_file(buffer_));
    at_end_ = input_.empty();
    if (at_end_) return 0;
  }
}

// Returns 0 at the end, and after an error, which is stored.
std::size_t CaptureStream::read_file(std::span<std::byte> out) {
  ssize_t count = -1;
  do {
    count = ::read(file_, out.data(), out.size());
  } while (count < 0 && errno == EINTR);
  if (count < 0) error_ = errno;
  octets_ += static_cast<std::uint64_t>(std::max<ssize_t>(count, 0));
  return static_cast<std::size_t>(std::max<ssize_t>(count, 0));
}

}  // namespace reckon::peer
