// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// One reader for each format, and their common parts. Private to read_mesh_file().
#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <unordered_map>

#include "reckon/haptics/mesh_files/mesh_file.hpp"
#include "reckon/haptics/mesh_files/text_cursor.hpp"

namespace reckon::haptics {

/// A fault of a file, and its line (0: none, or not a text file).
class MeshFileError : public std::runtime_error {
 public:
  MeshFileError(std::size_t line, const std::string& what)
      : std::runtime_error(what), line_(line) {}
  [[nodiscard]] std::size_t line() const noexcept { return line_; }

 private:
  std::size_t line_;
};

// Each appends the content of `bytes` to an empty file. @throws MeshFileError
void read_obj(std::string_view bytes, MeshFile& file);
void read_off(std::string_view bytes, MeshFile& file);
void read_ply(std::string_view bytes, MeshFile& file);
void read_stl(std::string_view bytes, MeshFile& file);

/// @param number of the vertex in the file, from 0  @param line 0 if there is none
/// @throws MeshFileError for a vertex that is not finite, or has too high a number
void check_vertex(const Eigen::Vector3d& p, std::size_t number, std::size_t line);
/// Checks and appends it. @throws MeshFileError
void add_vertex(MeshFile& file, const Eigen::Vector3d& p, std::size_t line);
/// Assigns numbers to materials and groups.
class FaceNamer {
 public:
  /// @param file outlives this object, and receives the names
  explicit FaceNamer(MeshFile& file) : file_(file) {}
  /// Number in MeshFile::names, from 1; 0 for an empty name.
  [[nodiscard]] std::uint32_t number_of(std::string_view name);

 private:
  MeshFile& file_;
  std::unordered_map<std::string, std::uint32_t> numbers_;
};
/// Begins a face without corners; add_corner() adds them.
void begin_face(MeshFile& file, std::size_t place);
/// @throws MeshFileError for an index that is invalid in any file
void add_corner(MeshFile& file, long long index, std::size_t line);

/// The next word of the line as a number. @throws MeshFileError "line's `what` ..."
[[nodiscard]] double take_number(TextCursor& text, std::string_view what);
/// Three numbers. @throws MeshFileError
[[nodiscard]] Eigen::Vector3d take_point(TextCursor& text);
/// The next word of the line as a whole number. @throws MeshFileError
[[nodiscard]] long long take_integer(TextCursor& text, std::string_view what);

}  // namespace reckon::haptics
