// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/capture/archive_library.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

namespace reckon::peer {
namespace {

// Its binary interface since libarchive 3.0; cmake/sbom.py and the packages name it too.
constexpr const char* kLibrary = "libarchive.so.13";
constexpr const char* kRemedy = "install the package libarchive13, or decompress the file first";

/// Finds functions of a library, and remembers a missing one.
struct Functions {
  void* library;
  const char* missing = nullptr;

  template <class Function>
  void find(const char* name, Function*& function) {
    function = reinterpret_cast<Function*>(dlsym(library, name));
    if (function == nullptr) missing = name;
  }
};

}  // namespace

ArchiveLibrary load_archive_library(const char* name) {
  ArchiveLibrary out;
  void* const library = dlopen(name, RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {
    out.problem = fmt::format("{} cannot be loaded; {}", name, kRemedy);
    return out;
  }
  Functions functions{library};
  functions.find("archive_read_new", out.read_new);
  functions.find("archive_read_free", out.read_free);
  functions.find("archive_read_support_filter_gzip", out.allow_gzip);
  functions.find("archive_read_support_filter_bzip2", out.allow_bzip2);
  functions.find("archive_read_support_filter_xz", out.allow_xz);
  functions.find("archive_read_support_filter_lz4", out.allow_lz4);
  functions.find("archive_read_support_format_raw", out.allow_raw);
  functions.find("archive_read_support_format_empty", out.allow_empty);
  functions.find("archive_read_open", out.read_open);
  functions.find("archive_filter_count", out.filter_count);
  functions.find("archive_read_next_header", out.next_header);
  functions.find("archive_read_data_block", out.data_block);
  functions.find("archive_error_string", out.error_string);
  if (functions.missing != nullptr)
    out.problem = fmt::format("{} has no {}; {}", name, functions.missing, kRemedy);
  return out;
}

const ArchiveLibrary& archive_library() {
  static const ArchiveLibrary library = load_archive_library(kLibrary);
  return library;
}

}  // namespace reckon::peer
