// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/mesh_files/mesh_file.hpp"

#include <algorithm>
#include <cctype>
#include <limits>

#include "reckon/haptics/input_files/input_file.hpp"
#include "reckon/haptics/input_files/load_budget.hpp"
#include "reckon/haptics/mesh_files/mesh_readers.hpp"

namespace reckon::haptics {

namespace {

// Squares and volumes of nearer vertices stay finite.
constexpr double kFarthestVertex = 1e90;

struct Format {
  std::string_view ending;
  void (*read)(std::string_view, MeshFile&);
};
constexpr Format kFormats[] = {
    {".obj", read_obj}, {".off", read_off}, {".ply", read_ply}, {".stl", read_stl}};

std::runtime_error mesh_error(const std::filesystem::path& file, std::size_t line,
                              const std::string& what) {
  const std::string place = line > 0 ? ":" + std::to_string(line) : "";
  return std::runtime_error("mesh " + file.string() + place + ": " + what);
}

std::string read_bytes(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::exists(file, error)) {
    throw mesh_error(file, 0, "no such file; give the path relative to the scene file");
  }
  try {
    return read_input_file(file, kMostMeshOctets);
  } catch (const std::invalid_argument& refusal) {
    throw mesh_error(file, 0, refusal.what());
  }
}

const Format& format_of(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::ranges::transform(ending, ending.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const auto found = std::ranges::find(kFormats, ending, &Format::ending);
  if (found == std::end(kFormats)) {
    throw mesh_error(file, 0, "cannot be read; give a file that ends in .obj, .ply, .stl or .off");
  }
  return *found;
}

/// Refuses text in UTF-16, with or without a byte order mark. A binary STL may begin with any
/// octets.
void check_encoding(std::string_view text, const Format& format) {
  if (format.read == read_stl || text.size() < 4) return;
  const bool has_mark = text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF");
  const bool is_little = text[has_mark ? 3 : 1] == 0 && text[2] != 0;
  const bool is_big = text[has_mark ? 2 : 0] == 0 && text[3] != 0;
  if (!is_little && !is_big) return;
  throw MeshFileError(0, std::string("is text in UTF-16 (") + (is_little ? "little" : "big") +
                             "-endian); save it in UTF-8");
}

void check_corners(const MeshFile& file) {
  const bool lines = file.place_word == "line";
  for (const FileFace& face : file.faces) {
    for (const std::uint32_t corner : file.corners_of(face)) {
      if (corner < file.vertices.size()) continue;
      throw MeshFileError(lines ? face.place : 0,
                          (lines ? "a face" : "face " + std::to_string(face.place)) +
                              " refers to vertex " + std::to_string(corner) +
                              ", counted from 0, of " + std::to_string(file.vertices.size()) +
                              "; the file is damaged, export the mesh again");
    }
  }
}

}  // namespace

MeshFile read_mesh_file(const std::filesystem::path& file) {
  const LoadBudget budget;
  const Format& format = format_of(file);
  const std::string bytes = read_bytes(file);
  std::string_view text = bytes;
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  MeshFile mesh;
  try {
    check_encoding(text, format);
    format.read(text, mesh);
    check_corners(mesh);
  } catch (const MeshFileError& error) {
    throw mesh_error(file, error.line(), error.what());
  } catch (const LoadLimitError& error) {
    throw mesh_error(file, 0, error.what());
  }
  return mesh;
}

void check_vertex(const Eigen::Vector3d& p, std::size_t number, std::size_t line) {
  if (!(p.cwiseAbs().maxCoeff() <= kFarthestVertex) || !p.allFinite()) {
    throw MeshFileError(line,
                        "vertex " + std::to_string(number) +
                            ", counted from 0, is not finite; repair it or export the mesh again");
  }
  if (number >= std::numeric_limits<std::uint32_t>::max()) {
    throw MeshFileError(line, "more than 2^32 vertices; use a coarser mesh");
  }
}

void add_vertex(MeshFile& file, const Eigen::Vector3d& p, std::size_t line) {
  check_vertex(p, file.vertices.size(), line);
  file.vertices.push_back(p);
}

std::uint32_t FaceNamer::number_of(std::string_view name) {
  if (name.empty()) return 0;
  const auto next = static_cast<std::uint32_t>(file_.names.size() + 1);
  const auto [row, added] = numbers_.emplace(name, next);
  if (added) file_.names.emplace_back(name);
  return row->second;
}

void begin_face(MeshFile& file, std::size_t place) {
  LoadBudget::take(LoadWork::triangles, 1);
  file.faces.push_back({file.corners.size(), 0, static_cast<std::uint32_t>(place), 0, 0});
}

void add_corner(MeshFile& file, long long index, std::size_t line) {
  if (index < 0 || index >= std::numeric_limits<std::uint32_t>::max()) {
    throw MeshFileError(line, "face " + std::to_string(file.faces.size()) + " refers to vertex " +
                                  std::to_string(index) +
                                  ", counted from 0, which does not exist; export the mesh again");
  }
  file.corners.push_back(static_cast<std::uint32_t>(index));
  ++file.faces.back().count;
}

double take_number(TextCursor& text, std::string_view what) {
  const std::string_view word = text.word();
  if (const auto value = to_number(word)) return *value;
  throw MeshFileError(text.line(), std::string(what) +
                                       (word.empty() ? " is missing" : " is not a number") +
                                       "; export the mesh again");
}

Eigen::Vector3d take_point(TextCursor& text) {
  const double x = take_number(text, "a vertex's x");
  const double y = take_number(text, "a vertex's y");
  const double z = take_number(text, "a vertex's z");
  return {x, y, z};
}

long long take_integer(TextCursor& text, std::string_view what) {
  const std::string_view word = text.word();
  if (const auto value = to_integer(word)) return *value;
  throw MeshFileError(text.line(), std::string(what) +
                                       (word.empty() ? " is missing" : " is not a whole number") +
                                       "; export the mesh again");
}

}  // namespace reckon::haptics
