// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Mesh files made by a test.
#pragma once

#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "reckon/tests/support/touch_meshes.hpp"

namespace reckon::test {

/// A file that lasts as long as the test.
class TemporaryMesh {
 public:
  TemporaryMesh(const std::string& ending, const std::string& text)
      : path_(std::filesystem::temp_directory_path() / ("reckon_mesh_" + std::to_string(getpid()) +
                                                        "_" + std::to_string(++count_) + ending)) {
    std::ofstream(path_, std::ios::binary) << text;
  }
  ~TemporaryMesh() { std::filesystem::remove(path_); }
  TemporaryMesh(const TemporaryMesh&) = delete;
  TemporaryMesh& operator=(const TemporaryMesh&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  inline static int count_ = 0;
  std::filesystem::path path_;
};

/// As OBJ, the vertices moved by `offset`, with nine decimals: a nanometre.
inline std::string obj_text(const MeshData& mesh, const Vector3d& offset = Vector3d::Zero()) {
  std::ostringstream out;
  out << std::fixed;
  out.precision(9);
  for (const Vector3d& v : mesh.vertices) out << "v " << (v + offset).transpose() << "\n";
  for (const auto& t : mesh.triangles) {
    out << "f " << t[0] + 1 << " " << t[1] + 1 << " " << t[2] + 1 << "\n";
  }
  return out.str();
}

/// As binary STL, in single precision.
inline std::string stl_octets(const MeshData& mesh) {
  std::string out(80, ' ');
  const auto append = [&](const auto& value) {
    out.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  append(static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const auto& triangle : mesh.triangles) {
    out.append(12, '\0');  // the normal, which readers ignore
    for (const std::uint32_t corner : triangle) {
      for (const double value : mesh.vertices[corner]) append(static_cast<float>(value));
    }
    out.append(2, '\0');
  }
  return out;
}

}  // namespace reckon::test
