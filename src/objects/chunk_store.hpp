// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Where a fetch stores the octets of an object.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "reckon/peer/objects/chunk_map.hpp"
#include "reckon/peer/objects/object_layout.hpp"

namespace reckon::peer {

/// Room for the data of one object. One thread.
class ChunkStore {
 public:
  virtual ~ChunkStore() = default;
  /// Offsets are within the size. @return false if it fails; problem() has the reason
  [[nodiscard]] virtual bool write(std::uint64_t offset,
                                   std::span<const std::byte> octets) noexcept = 0;
  [[nodiscard]] virtual bool read(std::uint64_t offset,
                                  std::span<std::byte> out) const noexcept = 0;
  /// Stores which chunks of the object are there, for a later run. May do nothing.
  virtual void keep(const ChunkMap&) noexcept {}
  /// A sentence for the user.
  [[nodiscard]] virtual std::string problem() const = 0;
};

/// Octets in memory, for small objects.
class MemoryStore final : public ChunkStore {
 public:
  explicit MemoryStore(std::uint64_t size) : octets_(size, '\0') {}
  bool write(std::uint64_t offset, std::span<const std::byte> octets) noexcept override;
  bool read(std::uint64_t offset, std::span<std::byte> out) const noexcept override;
  std::string problem() const override { return {}; }
  [[nodiscard]] const std::string& octets() const noexcept { return octets_; }

 private:
  std::string octets_;
};

/// A file HASH.part of a folder, and HASH.have that lists its chunks. Both remain if the program
/// ends early, also by a signal, so that the next run fetches only the rest. If another process
/// uses them, the store has files of its own and removes them at its end.
class FileStore final : public ChunkStore {
 public:
  /// Opens or creates the files. @throws std::runtime_error with the file and the reason
  FileStore(std::filesystem::path folder, const ObjectHash& hash, std::uint64_t size);
  ~FileStore() override;
  FileStore(const FileStore&) = delete;
  FileStore& operator=(const FileStore&) = delete;

  /// Chunks stored by an earlier run. Their octets are not checked yet.
  [[nodiscard]] const ChunkMap& kept() const noexcept { return kept_; }
  /// The object is complete and checked: renames it to HASH.
  /// @throws std::filesystem::filesystem_error
  std::filesystem::path finish();

  bool write(std::uint64_t offset, std::span<const std::byte> octets) noexcept override;
  bool read(std::uint64_t offset, std::span<std::byte> out) const noexcept override;
  void keep(const ChunkMap& received) noexcept override;
  std::string problem() const override;

 private:
  [[nodiscard]] bool lock_files(const std::string& name);
  void open_files(const std::string& name);
  void close_files() noexcept;
  void load_kept();

  std::filesystem::path folder_;
  std::string name_;
  std::filesystem::path part_, have_path_;
  bool is_private_ = false;
  std::uint64_t size_;
  int data_ = -1, have_ = -1;
  mutable int error_ = 0;  // errno
  ChunkMap kept_;
};

}  // namespace reckon::peer
