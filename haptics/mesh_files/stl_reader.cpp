// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// STL, text and binary. Each facet has its own corners; equal ones are welded later. Its normal is
// ignored, because the corners define it.
#include <bit>
#include <cstring>

#include "reckon/haptics/mesh_files/mesh_readers.hpp"

namespace reckon::haptics {

namespace {

static_assert(std::endian::native == std::endian::little);

constexpr std::size_t kHeader = 84;  // octets; the last of them are the number of facets
constexpr std::size_t kFacet = 50;   // normal, three corners as floats, two octets of attributes
constexpr std::size_t kCorners = 12;

template <class T>
T value_at(std::string_view bytes, std::size_t at) noexcept {
  T value;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

std::size_t facets_of(std::string_view bytes) noexcept {
  return bytes.size() < kHeader ? 0 : value_at<std::uint32_t>(bytes, kHeader - 4);
}

void add_own_corner(MeshFile& file, const Eigen::Vector3d& p, std::size_t line) {
  add_vertex(file, p, line);
  add_corner(file, static_cast<long long>(file.vertices.size()) - 1, line);
}

void read_binary(std::string_view bytes, MeshFile& file) {
  file.place_word = "face";
  for (std::size_t facet = 0; facet < facets_of(bytes); ++facet) {
    begin_face(file, facet + 1);
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::size_t at = kHeader + facet * kFacet + kCorners + corner * kCorners;
      const auto coordinate = [&](std::size_t axis) {
        return static_cast<double>(value_at<float>(bytes, at + axis * sizeof(float)));
      };
      add_own_corner(file, {coordinate(0), coordinate(1), coordinate(2)}, 0);
    }
  }
}

void read_text(std::string_view bytes, MeshFile& file) {
  TextCursor text(bytes);
  bool open = false;
  while (text.next_line()) {
    const std::string_view what = text.word();
    if (what == "outer") begin_face(file, text.line());
    if (what == "outer" || what == "endloop") open = what == "outer";
    if (what != "vertex") continue;
    if (!open) throw MeshFileError(text.line(), "a vertex outside 'outer loop'; export it again");
    add_own_corner(file, take_point(text), text.line());
  }
  if (open)
    throw MeshFileError(text.line(), "ends within a facet; it is truncated, export it again");
}

}  // namespace

void read_stl(std::string_view bytes, MeshFile& file) {
  // A binary file may begin with "solid" too; its length identifies it. The letters of a text, read
  // as a number of facets, exceed any file.
  const std::size_t octets = kHeader + facets_of(bytes) * kFacet;
  const bool holds_facets = facets_of(bytes) > 0 && bytes.size() > octets;
  if (bytes.size() == octets || holds_facets) {
    file.octets_behind = bytes.size() - octets;
    return read_binary(bytes, file);
  }
  if (bytes.starts_with("solid")) return read_text(bytes, file);
  throw MeshFileError(
      0, "cannot be read as STL: it does not begin with 'solid', and as binary it would have " +
             std::to_string(facets_of(bytes)) + " facets, " + std::to_string(octets) +
             " octets, but it has " + std::to_string(bytes.size()) + "; export the mesh again");
}

}  // namespace reckon::haptics
