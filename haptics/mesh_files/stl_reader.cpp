// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// STL, text and binary. Each facet repeats its corners, and here equal ones become one vertex: six
// facets of a closed surface share one. The facet's normal is ignored, because the corners define
// it.
#include <bit>
#include <cstring>

#include "reckon/haptics/mesh_files/mesh_readers.hpp"
#include "reckon/haptics/mesh_files/position_table.hpp"

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

/// The facets of a file, and their vertices.
class Facets {
 public:
  /// @param expected number of facets, or 0
  Facets(MeshFile& file, std::size_t expected) : file_(file), table_(file.vertices, expected / 2) {
    file.faces.reserve(expected);
    file.corners.reserve(3 * expected);
  }
  ~Facets() { file_.merged_vertices = file_.corners.size() - file_.vertices.size(); }
  Facets(const Facets&) = delete;
  Facets& operator=(const Facets&) = delete;

  void add_corner(const Eigen::Vector3d& p, std::size_t line) {
    check_vertex(p, file_.corners.size(), line);
    file_.corners.push_back(table_.number_of(p));
    ++file_.faces.back().count;
  }
  /// Fetches the memory for a later add_corner().
  void fetch(const Eigen::Vector3d& p) const noexcept { table_.fetch(p); }

 private:
  MeshFile& file_;
  PositionTable table_;
};

Eigen::Vector3d corner_at(std::string_view bytes, std::size_t facet, std::size_t corner) noexcept {
  const std::size_t at = kHeader + facet * kFacet + kCorners + corner * kCorners;
  const auto coordinate = [&](std::size_t axis) {
    return static_cast<double>(value_at<float>(bytes, at + axis * sizeof(float)));
  };
  return {coordinate(0), coordinate(1), coordinate(2)};
}

void read_binary(std::string_view bytes, MeshFile& file) {
  constexpr std::size_t kFetched = 4;  // facets, for the memory to arrive
  file.place_word = "face";
  const std::size_t count = facets_of(bytes);
  Facets facets(file, count);
  for (std::size_t facet = 0; facet < count; ++facet) {
    begin_face(file, facet + 1);
    for (std::size_t corner = 0; corner < 3; ++corner) {
      if (facet + kFetched < count) facets.fetch(corner_at(bytes, facet + kFetched, corner));
      facets.add_corner(corner_at(bytes, facet, corner), 0);
    }
  }
}

void read_text(std::string_view bytes, MeshFile& file) {
  TextCursor text(bytes);
  Facets facets(file, 0);
  bool open = false;
  while (text.next_line()) {
    const std::string_view what = text.word();
    if (what == "outer") begin_face(file, text.line());
    if (what == "outer" || what == "endloop") open = what == "outer";
    if (what != "vertex") continue;
    if (!open) throw MeshFileError(text.line(), "a vertex outside 'outer loop'; export it again");
    facets.add_corner(take_point(text), text.line());
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
