// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/capture/archive_decompressor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <new>
#include <utility>

#include "reckon/peer/capture/archive_library.hpp"

namespace reckon::peer {
namespace {

/// One method, and the function of libarchive that allows it.
struct Method {
  std::string_view name;
  std::string_view magic;
  int (*ArchiveLibrary::*allow)(archive*);
};
constexpr std::array kMethods{
    Method{"gzip", "\x1f\x8b", &ArchiveLibrary::allow_gzip},
    Method{"bzip2", "BZh", &ArchiveLibrary::allow_bzip2},
    Method{"xz", std::string_view("\xfd\x37\x7a\x58\x5a\x00", 6), &ArchiveLibrary::allow_xz},
    Method{"lz4", "\x04\x22\x4d\x18", &ArchiveLibrary::allow_lz4}};

}  // namespace

std::string_view archive_method(std::span<const std::byte> head) noexcept {
  const std::string_view octets(reinterpret_cast<const char*>(head.data()), head.size());
  for (const Method& method : kMethods)
    if (octets.starts_with(method.magic)) return method.name;
  return {};
}

ArchiveDecompressor::ArchiveDecompressor(std::string_view method, Read read,
                                         const ArchiveLibrary& library)
    : library_(library), method_(method), read_(std::move(read)), archive_(nullptr, nullptr) {
  if (!library.problem.empty()) {
    error_ = fmt::format("is compressed by {}, and {}", method, library.problem);
    return;
  }
  archive_ = {library.read_new(), library.read_free};
  if (!archive_) throw std::bad_alloc();
}

ArchiveDecompressor::ArchiveDecompressor(std::string_view method, Read read)
    : ArchiveDecompressor(method, std::move(read), archive_library()) {}

ArchiveDecompressor::~ArchiveDecompressor() = default;

std::size_t ArchiveDecompressor::decompress(std::span<std::byte> out) {
  if (!error_.empty() || (!is_open_ && !open())) return 0;
  while (content_.empty()) {
    const void* block = nullptr;
    std::size_t size = 0;
    la_int64_t offset = 0;
    const int result = library_.data_block(archive_.get(), &block, &size, &offset);
    if (result == ARCHIVE_EOF) return 0;
    if (result != ARCHIVE_OK) {
      fail();
      return 0;
    }
    content_ = {static_cast<const std::byte*>(block), size};
  }
  const std::size_t count = std::min(out.size(), content_.size());
  std::copy_n(content_.begin(), count, out.begin());
  content_ = content_.subspan(count);
  return count;
}

// Only this method is allowed, and only once: else a small file could request any number of
// decompressors.
bool ArchiveDecompressor::open() {
  is_open_ = true;
  const auto method = std::find_if(kMethods.begin(), kMethods.end(),
                                   [&](const Method& m) { return m.name == method_; });
  if ((library_.*method->allow)(archive_.get()) != ARCHIVE_OK) {
    error_ = fmt::format("the installed libarchive does not read {}; decompress it first", method_);
    return false;
  }
  library_.allow_raw(archive_.get());
  library_.allow_empty(archive_.get());
  archive_entry* entry = nullptr;
  if (library_.read_open(archive_.get(), this, nullptr, read_callback, nullptr) != ARCHIVE_OK) {
    fail();
    return false;
  }
  if (library_.filter_count(archive_.get()) > 2) {  // the method, and the file
    error_ = fmt::format("it is compressed more than once by {}; decompress it first", method_);
    return false;
  }
  const int result = library_.next_header(archive_.get(), &entry);
  if (result == ARCHIVE_EOF) return true;
  if (result != ARCHIVE_OK) fail();
  return result == ARCHIVE_OK;
}

void ArchiveDecompressor::fail() {
  const char* reason = library_.error_string(archive_.get());
  error_ = fmt::format("its {} data is damaged: {}", method_,
                       reason != nullptr ? reason : "no reason is known");
}

std::ptrdiff_t ArchiveDecompressor::read_callback(archive*, void* self, const void** buffer) {
  const auto octets = static_cast<ArchiveDecompressor*>(self)->read_();
  *buffer = octets.data();
  return static_cast<std::ptrdiff_t>(octets.size());
}

}  // namespace reckon::peer
