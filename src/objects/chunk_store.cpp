// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/objects/chunk_store.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace reckon::peer {
namespace {

namespace fs = std::filesystem;

constexpr mode_t kMode = 0644;

/// Calls a function of the kind of pread() until all octets are done. @return errno, or 0
int transfer_all(std::uint64_t offset, std::size_t size, auto&& some) {
  for (std::size_t done = 0; done < size;) {
    const ssize_t moved = some(done, static_cast<off_t>(offset + done));
    if (moved < 0 && errno == EINTR) continue;
    if (moved < 0) return errno;
    if (moved == 0) return ENODATA;
    done += static_cast<std::size_t>(moved);
  }
  return 0;
}

int write_all(int file, std::uint64_t offset, std::span<const std::byte> octets) {
  return transfer_all(offset, octets.size(), [&](std::size_t done, off_t at) {
    return ::pwrite(file, octets.data() + done, octets.size() - done, at);
  });
}

int read_all(int file, std::uint64_t offset, std::span<std::byte> out) {
  return transfer_all(offset, out.size(), [&](std::size_t done, off_t at) {
    return ::pread(file, out.data() + done, out.size() - done, at);
  });
}

}  // namespace

bool MemoryStore::write(std::uint64_t offset, std::span<const std::byte> octets) noexcept {
  std::memcpy(octets_.data() + offset, octets.data(), octets.size());
  return true;
}

bool MemoryStore::read(std::uint64_t offset, std::span<std::byte> out) const noexcept {
  std::memcpy(out.data(), octets_.data() + offset, out.size());
  return true;
}

FileStore::FileStore(fs::path folder, const ObjectHash& hash, std::uint64_t size)
    : folder_(std::move(folder)),
      name_(text_of(hash)),
      size_(size),
      kept_(ObjectLayout(size).chunks()) {
  fs::create_directories(folder_);
  data_ = ::open(path(".part").c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, kMode);
  have_ = ::open(path(".have").c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, kMode);
  std::string reason;
  if (data_ < 0 || have_ < 0) {
    reason = std::strerror(errno);
  } else if (::flock(data_, LOCK_EX | LOCK_NB) != 0) {
    reason = "another process receives this object: wait until it ends";
  } else if (::ftruncate(data_, static_cast<off_t>(size)) != 0) {
    reason = std::strerror(errno);
  }
  if (!reason.empty()) {
    for (const int file : {data_, have_})
      if (file >= 0) ::close(file);
    throw std::runtime_error(fmt::format("{}: {}", path(".part").string(), reason));
  }
  load_kept();
}

FileStore::~FileStore() {
  ::close(data_);
  ::close(have_);
}

fs::path FileStore::path(const char* end) const { return folder_ / (name_ + end); }

void FileStore::load_kept() {
  std::vector<std::uint64_t> words(kept_.words().size());
  if (read_all(have_, 0, std::as_writable_bytes(std::span(words))) != 0) return;
  const ObjectLayout layout(size_);
  for (std::uint32_t i = layout.list_chunks(); i < layout.chunks(); ++i)
    if ((words[i / 64] >> (i % 64) & 1) != 0) kept_.add(i);
}

fs::path FileStore::finish() {
  const fs::path done = folder_ / name_;
  fs::rename(path(".part"), done);
  std::error_code ignored;
  fs::remove(path(".have"), ignored);
  return done;
}

bool FileStore::write(std::uint64_t offset, std::span<const std::byte> octets) noexcept {
  error_ = write_all(data_, offset, octets);
  return error_ == 0;
}

bool FileStore::read(std::uint64_t offset, std::span<std::byte> out) const noexcept {
  return read_all(data_, offset, out) == 0;
}

void FileStore::keep(const ChunkMap& received) noexcept {
  static_cast<void>(write_all(have_, 0, std::as_bytes(received.words())));
}

std::string FileStore::problem() const {
  return fmt::format("{}: {}", path(".part").string(), std::strerror(error_));
}

}  // namespace reckon::peer
