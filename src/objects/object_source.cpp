// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/objects/object_source.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace reckon::peer {
namespace {

class TextObject final : public ObjectSource {
 public:
  explicit TextObject(std::string octets)
      : ObjectSource(octets.size()), octets_(std::move(octets)) {
    find_hash();
  }

 private:
  bool read(std::uint64_t offset, std::span<std::byte> out) const noexcept override {
    std::memcpy(out.data(), octets_.data() + offset, out.size());
    return true;
  }

  std::string octets_;
};

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& reason) {
  throw std::runtime_error(fmt::format("{}: {}", file.string(), reason));
}

/// Closes the descriptor, also if the constructor of FileObject throws.
struct OpenFile {
  explicit OpenFile(const std::filesystem::path& file)
      : number(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {
    struct stat facts {};
    if (number < 0 || ::fstat(number, &facts) != 0) {
      const std::string reason = std::strerror(errno);
      close();
      fail(file, reason);
    }
    size = static_cast<std::uint64_t>(facts.st_size);
    if (S_ISREG(facts.st_mode) && size <= kMostObjectOctets) return;
    close();
    fail(file, S_ISREG(facts.st_mode)
                   ? fmt::format("has {} octets; at most {} are sent", size, kMostObjectOctets)
                   : "is no regular file");
  }
  ~OpenFile() { close(); }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  void close() const noexcept {
    if (number >= 0) static_cast<void>(::close(number));
  }

  int number;
  std::uint64_t size = 0;
};

class FileObject final : private OpenFile, public ObjectSource {
 public:
  explicit FileObject(const std::filesystem::path& file)
      : OpenFile(file), ObjectSource(OpenFile::size) {
    try {
      find_hash();
    } catch (const std::runtime_error& error) {
      fail(file, error.what());
    }
  }

 private:
  bool read(std::uint64_t offset, std::span<std::byte> out) const noexcept override {
    while (!out.empty()) {
      const ssize_t got = ::pread(number, out.data(), out.size(), static_cast<off_t>(offset));
      if (got < 0 && errno == EINTR) continue;
      if (got <= 0) return false;
      offset += static_cast<std::uint64_t>(got);
      out = out.subspan(static_cast<std::size_t>(got));
    }
    return true;
  }
};

}  // namespace

bool ObjectSource::read_chunk(std::uint32_t index, std::span<std::byte> out) const noexcept {
  if (!layout_.is_of_list(index)) return read(layout_.offset(index), out);
  const auto list = std::as_bytes(std::span(blocks_));
  std::memcpy(out.data(), list.data() + layout_.offset(index), out.size());
  return true;
}

void ObjectSource::find_hash() {
  std::vector<std::byte> block;
  for (std::uint32_t i = 0; i < layout_.blocks(); ++i) {
    block.resize(layout_.block_length(i));
    if (!read(std::uint64_t{i} * kBlockOctets, block))
      throw std::runtime_error("became shorter while it was read");
    blocks_.push_back(hash_of_block(block));
  }
  hash_ = hash_of_object(layout_.size(), blocks_);
}

std::shared_ptr<const ObjectSource> object_of(std::string octets) {
  return std::make_shared<TextObject>(std::move(octets));
}

std::shared_ptr<const ObjectSource> object_of_file(const std::filesystem::path& file) {
  return std::make_shared<FileObject>(file);
}

}  // namespace reckon::peer
