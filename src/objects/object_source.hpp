// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// An object that a peer can serve: a file, or octets in memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "reckon/peer/objects/object_layout.hpp"

namespace reckon::peer {

/// An object with the hashes of its blocks. One thread.
class ObjectSource {
 public:
  virtual ~ObjectSource() = default;
  ObjectSource(const ObjectSource&) = delete;
  ObjectSource& operator=(const ObjectSource&) = delete;

  [[nodiscard]] const ObjectHash& hash() const noexcept { return hash_; }
  [[nodiscard]] const ObjectLayout& layout() const noexcept { return layout_; }
  /// Reads a chunk.  @param index less than layout().chunks()  @param out of its length
  /// @return false if the file can no longer be read there
  [[nodiscard]] bool read_chunk(std::uint32_t index, std::span<std::byte> out) const noexcept;

 protected:
  explicit ObjectSource(std::uint64_t size) noexcept : layout_(size) {}
  /// Sets the hashes; reads everything once. @throws std::runtime_error if that fails
  void find_hash();
  [[nodiscard]] virtual bool read(std::uint64_t offset,
                                  std::span<std::byte> out) const noexcept = 0;

 private:
  ObjectLayout layout_;
  std::vector<ObjectHash> blocks_;
  ObjectHash hash_{};
};

/// Octets in memory.
[[nodiscard]] std::shared_ptr<const ObjectSource> object_of(std::string octets);
/// A regular file, open while the result lives. If it changes, receivers refuse its blocks.
/// @throws std::runtime_error with the file and the reason
[[nodiscard]] std::shared_ptr<const ObjectSource> object_of_file(const std::filesystem::path& file);

}  // namespace reckon::peer
