// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/objects/chunk_store.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
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
  if (!lock_files(name_)) {
    is_private_ = true;
    open_files(fmt::format("{}.{}", name_, ::getpid()));
  }
  const bool is_open = data_ >= 0 && have_ >= 0;
  if (!is_open || ::ftruncate(data_, static_cast<off_t>(size)) != 0) {
    const std::string reason = std::strerror(errno);
    close_files();
    throw std::runtime_error(fmt::format("{}: {}", part_.string(), reason));
  }
  load_kept();
}

FileStore::~FileStore() {
  close_files();
  std::error_code ignored;
  if (is_private_) fs::remove(part_, ignored);
  if (is_private_) fs::remove(have_path_, ignored);
}

// False if another process has them. It may finish and rename a file between the two calls.
bool FileStore::lock_files(const std::string& name) {
  open_files(name);
  if (data_ < 0) return true;  // reported by the caller
  struct stat locked {
  }, present{};
  const bool is_ours = ::flock(data_, LOCK_EX | LOCK_NB) == 0 && ::fstat(data_, &locked) == 0 &&
                       ::stat(part_.c_str(), &present) == 0 && locked.st_ino == present.st_ino;
  if (!is_ours) close_files();
  return is_ours;
}

void FileStore::open_files(const std::string& name) {
  constexpr int kFlags = O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW;
  part_ = folder_ / (name + ".part");
  have_path_ = folder_ / (name + ".have");
  data_ = ::open(part_.c_str(), kFlags, kMode);
  have_ = ::open(have_path_.c_str(), kFlags, kMode);
}

void FileStore::close_files() noexcept {
  for (int* file : {&data_, &have_})
    if (const int number = std::exchange(*file, -1); number >= 0) ::close(number);
}

void FileStore::load_kept() {
  std::vector<std::uint64_t> words(kept_.words().size());
  if (read_all(have_, 0, std::as_writable_bytes(std::span(words))) != 0) return;
  const ObjectLayout layout(size_);
  for (std::uint32_t i = layout.list_chunks(); i < layout.chunks(); ++i)
    if ((words[i / 64] >> (i % 64) & 1) != 0) kept_.add(i);
}

fs::path FileStore::finish() {
  const fs::path done = folder_ / name_;
  fs::rename(part_, done);
  std::error_code ignored;
  fs::remove(have_path_, ignored);
  return done;
}

bool FileStore::write(std::uint64_t offset, std::span<const std::byte> octets) noexcept {
  error_ = write_all(data_, offset, octets);
  return error_ == 0;
}

bool FileStore::read(std::uint64_t offset, std::span<std::byte> out) const noexcept {
  error_ = read_all(data_, offset, out);
  return error_ == 0;
}

void FileStore::keep(const ChunkMap& received) noexcept {
  static_cast<void>(write_all(have_, 0, std::as_bytes(received.words())));
}

std::string FileStore::problem() const {
  return fmt::format("{}: {}", part_.string(), std::strerror(error_));
}

}  // namespace reckon::peer
