// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// libarchive, loaded when the first compressed capture is opened: with the six libraries behind it,
// such as ICU, it would cost each program 0.8 ms at its start. Private to the peer library.
#pragma once

#include <archive.h>

#include <string>

namespace reckon::peer {

/// The functions of libarchive that are used; its header declares them without their prefix.
struct ArchiveLibrary {
  decltype(archive_read_new)* read_new = nullptr;
  decltype(archive_read_free)* read_free = nullptr;
  decltype(archive_read_support_filter_gzip)* allow_gzip = nullptr;
  decltype(archive_read_support_filter_bzip2)* allow_bzip2 = nullptr;
  decltype(archive_read_support_filter_xz)* allow_xz = nullptr;
  decltype(archive_read_support_filter_lz4)* allow_lz4 = nullptr;
  decltype(archive_read_support_format_raw)* allow_raw = nullptr;
  decltype(archive_read_support_format_empty)* allow_empty = nullptr;
  decltype(archive_read_open)* read_open = nullptr;
  decltype(archive_filter_count)* filter_count = nullptr;
  decltype(archive_read_next_header)* next_header = nullptr;
  decltype(archive_read_data_block)* data_block = nullptr;
  decltype(archive_error_string)* error_string = nullptr;
  /// Empty, or why no function may be called, with the remedy.
  std::string problem;
};

/// Loads a library by its file name; it stays loaded. Never throws for a missing one.
[[nodiscard]] ArchiveLibrary load_archive_library(const char* name);

/// The library of the system, loaded by the first call. Any thread.
[[nodiscard]] const ArchiveLibrary& archive_library();

}  // namespace reckon::peer
