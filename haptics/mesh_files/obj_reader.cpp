// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Wavefront OBJ: the lines `v` and `f`, and the names from `usemtl`, `g` and `o` for the faces that
// follow. Other lines only affect the appearance.
#include "reckon/haptics/mesh_files/mesh_readers.hpp"

namespace reckon::haptics {

namespace {

/// "3", "3/1", "3//2" or "3/1/2": the vertex is the first number, from 1 on, or backwards from -1.
long long corner_of(std::string_view word, const MeshFile& file, std::size_t line) {
  const auto number = to_integer(word.substr(0, word.find('/')));
  if (!number || *number == 0) {
    throw MeshFileError(line, "'" + std::string(word) +
                                  "' refers to no vertex; they count from 1, or back from -1");
  }
  return *number > 0 ? *number - 1 : static_cast<long long>(file.vertices.size()) + *number;
}

}  // namespace

void read_obj(std::string_view bytes, MeshFile& file) {
  TextCursor text(bytes);
  FaceNamer namer(file);
  std::uint32_t material = 0, group = 0;
  while (text.next_line()) {
    const std::size_t line = text.line();
    const std::string_view what = text.word();
    if (what == "v") add_vertex(file, take_point(text), line);
    if (what == "usemtl") material = namer.number_of(text.word());
    if (what == "g" || what == "o") group = namer.number_of(text.word());
    if (what != "f") continue;
    begin_face(file, line);
    file.faces.back().material = material;
    file.faces.back().group = group;
    for (std::string_view word = text.word(); !word.empty(); word = text.word()) {
      add_corner(file, corner_of(word, file, line), line);
    }
  }
}

}  // namespace reckon::haptics
