// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Geomview OFF as text: counts, then a line for each vertex and each face. The rest of a line
// (colours, normals) only affects the appearance.
#include <algorithm>

#include "reckon/haptics/mesh_files/mesh_readers.hpp"

namespace reckon::haptics {

namespace {

// The keyword may be absent, or followed by the counts on the same line.
std::size_t read_counts(TextCursor& text, std::size_t& faces) {
  TextCursor behind = text;
  if (!text.next_line()) throw MeshFileError(1, "cannot be read as OFF: it is empty");
  behind = text;
  const std::string_view keyword = behind.word();
  if (keyword.ends_with("OFF")) {
    if (keyword.find_first_of("4n") != keyword.npos) {
      throw MeshFileError(text.line(),
                          "does not have three coordinates a vertex; export it as plain OFF");
    }
    text = behind;
    if (behind.word() == "BINARY") {
      throw MeshFileError(text.line(), "is binary; export it as text, or as PLY");
    }
    TextCursor same = text;
    if (same.word().empty() && !text.next_line()) {
      throw MeshFileError(text.line(), "ends after its first line; export the mesh again");
    }
  } else if (!to_integer(keyword)) {
    throw MeshFileError(text.line(), "cannot be read as OFF: it does not begin with 'OFF'");
  }
  const long long vertices = take_integer(text, "the number of vertices");
  const long long polygons = take_integer(text, "the number of faces");
  if (vertices < 0 || polygons < 0) {
    throw MeshFileError(text.line(), "a number of vertices or faces is below 0");
  }
  faces = static_cast<std::size_t>(polygons);
  return static_cast<std::size_t>(vertices);
}

void next_element(TextCursor& text, std::string_view what, std::size_t index, std::size_t count) {
  if (text.next_line()) return;
  throw MeshFileError(text.line(), "ends before " + std::string(what) + " " +
                                       std::to_string(index) + " of " + std::to_string(count) +
                                       "; it is truncated, export the mesh again");
}

}  // namespace

void read_off(std::string_view bytes, MeshFile& file) {
  TextCursor text(bytes);
  std::size_t faces = 0;
  const std::size_t vertices = read_counts(text, faces);
  for (std::size_t i = 0; i < vertices; ++i) {
    next_element(text, "vertex", i, vertices);
    add_vertex(file, take_point(text), text.line());
  }
  for (std::size_t i = 0; i < faces; ++i) {
    next_element(text, "face", i, faces);
    begin_face(file, text.line());
    const long long corners = take_integer(text, "a face's number of corners");
    for (long long k = 0; k < corners; ++k) {
      add_corner(file, take_integer(text, "a corner of the face"), text.line());
    }
  }
}

}  // namespace reckon::haptics
