// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/mesh_files/mesh_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cstring>
#include <numeric>
#include <random>

#include "reckon/haptics/input_files/load_budget.hpp"
#include "reckon/tests/support/mesh_text.hpp"

namespace reckon::haptics {
namespace {

using Eigen::Vector3d;
using test::TemporaryMesh;
using testing::HasSubstr;

// Millimetres at national coordinates: 0.4 um is the last digit of a double there.
constexpr const char* kFarVertices[] = {"4321012.3451 678901.2342 432.1003",
                                        "4321012.3462 678901.2342 432.1003",
                                        "4321012.3451 678901.2353 432.1003"};
const Vector3d kFar[] = {{4321012.3451, 678901.2342, 432.1003},
                         {4321012.3462, 678901.2342, 432.1003},
                         {4321012.3451, 678901.2353, 432.1003}};

std::string far_lines(const std::string& prefix) {
  std::string text;
  for (const char* vertex : kFarVertices) text += prefix + vertex + "\n";
  return text;
}

template <class T>
void append(std::string& out, T value, bool big_endian = false) {
  char bytes[sizeof(T)];
  std::memcpy(bytes, &value, sizeof value);
  if (big_endian) std::reverse(std::begin(bytes), std::end(bytes));
  out.append(bytes, sizeof bytes);
}

/// Three vertices of doubles and a triangle, with irrelevant properties before and after them.
std::string binary_ply(bool big_endian) {
  std::string out = std::string("ply\nformat binary_") + (big_endian ? "big" : "little") +
                    "_endian 1.0\ncomment made by hand\nelement material 1\n"
                    "property list uchar ushort shades\nelement vertex 3\n"
                    "property uchar red\nproperty double x\nproperty double y\nproperty double z\n"
                    "property float32 quality\nelement face 1\nproperty short flags\n"
                    "property list uint8 int32 vertex_indices\nend_header\n";
  append(out, std::uint8_t{2});
  append(out, std::uint16_t{7}, big_endian);
  append(out, std::uint16_t{8}, big_endian);
  for (const Vector3d& p : kFar) {
    append(out, std::uint8_t{255});
    for (const double x : p) append(out, x, big_endian);
    append(out, 0.5f, big_endian);
  }
  append(out, std::int16_t{-1}, big_endian);
  append(out, std::uint8_t{3});
  for (const std::int32_t corner : {0, 1, 2}) append(out, corner, big_endian);
  return out;
}

void expect_far_triangle(const std::string& ending, const std::string& text) {
  SCOPED_TRACE(ending + ": " + text.substr(0, 40));
  const TemporaryMesh written(ending, text);
  const MeshFile file = read_mesh_file(written.path());
  ASSERT_EQ(file.vertices.size(), 3u);
  // The literals above and the text are each rounded to double once: equal to the bit.
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(file.vertices[i], kFar[i]);
  ASSERT_EQ(file.faces.size(), 1u);
  EXPECT_THAT(file.corners_of(file.faces[0]), testing::ElementsAre(0u, 1u, 2u));
}

TEST(MeshFile, KeepsEveryDigitOfEveryFormat) {
  expect_far_triangle(".obj", far_lines("v ") + "f 1 2 3\n");
  expect_far_triangle(".off", "OFF\n3 1 0\n" + far_lines("") + "3 0 1 2\n");
  expect_far_triangle(".OFF", "# bare\n3 1 0\n" + far_lines("") + "3 0 1 2 255 0 0\n");
  expect_far_triangle(".ply",
                      "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\n"
                      "property double y\nproperty double z\nelement face 1\n"
                      "property list uchar int vertex_index\nend_header\n" +
                          far_lines("") + "3 0 1 2\n");
  expect_far_triangle(".ply", binary_ply(false));
  expect_far_triangle(".ply", binary_ply(true));
  expect_far_triangle(".stl", "solid s\nfacet normal 0 0 1\nouter loop\n" + far_lines("vertex ") +
                                  "endloop\nendfacet\nendsolid\n");
}

std::string binary_stl(std::string bytes) {
  bytes.resize(80, ' ');
  append(bytes, std::uint32_t{2});
  for (int facet = 0; facet < 2; ++facet) {
    for (int i = 0; i < 12; ++i) append(bytes, static_cast<float>(facet * 12 + i));
    append(bytes, std::uint16_t{0});
  }
  return bytes;
}

TEST(MeshFile, ReadsABinaryStlWithATextHeader) {
  const TemporaryMesh written(".stl", binary_stl("solid but binary"));
  const MeshFile file = read_mesh_file(written.path());
  ASSERT_EQ(file.faces.size(), 2u);
  ASSERT_EQ(file.vertices.size(), 6u);
  EXPECT_EQ(file.vertices[4], Vector3d(18, 19, 20));  // after the second normal, 12 to 14
  EXPECT_EQ(file.place_word, "face");
}

TEST(MeshFile, CountsOctetsAfterTheFacesOfAnStl) {
  for (const char* begin : {"solid but binary", "binary"}) {
    for (const std::size_t behind : {0U, 2U, 50U}) {
      const TemporaryMesh written(".stl", binary_stl(begin) + std::string(behind, 'x'));
      const MeshFile file = read_mesh_file(written.path());
      EXPECT_EQ(file.faces.size(), 2u) << begin;
      EXPECT_EQ(file.octets_behind, behind) << begin;
    }
  }
}

TEST(MeshFile, TakesObjIndicesOfEveryKind) {
  const TemporaryMesh written(".obj",
                              "\xEF\xBB\xBF# made by hand\r\nv +0 0 0\r\nv 1 0 0 1.0\r\n"
                              "v 1e0 1 0 0.2 0.3 0.4\nvt 0 0\nvn 0 0 1\nf 1/1/1 2//1 \\\n  -1/1\n"
                              "v 0 1 0\ng side # two\nusemtl red\nf 1 -2 -1\nl 1 2\n");
  const MeshFile file = read_mesh_file(written.path());
  ASSERT_EQ(file.faces.size(), 2u);
  EXPECT_THAT(file.corners_of(file.faces[0]), testing::ElementsAre(0u, 1u, 2u));
  EXPECT_THAT(file.corners_of(file.faces[1]), testing::ElementsAre(0u, 2u, 3u));
  EXPECT_EQ(file.faces[0].place, 7u);
  EXPECT_EQ(file.faces[1].place, 12u);
}

TEST(MeshFile, GivesMaterialAndGroupOfEachFace) {
  const TemporaryMesh obj(".obj",
                          "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\ng lid side\nusemtl felt\nf 1 2 3\n"
                          "usemtl steel\nf 1 2 3\nusemtl felt\no lid\nf 1 2 3\ng\nf 1 2 3\n");
  const MeshFile file = read_mesh_file(obj.path());
  EXPECT_THAT(file.names, testing::ElementsAre("lid", "felt", "steel"));
  const std::uint32_t materials[] = {0, 2, 3, 2, 2};
  const std::uint32_t groups[] = {0, 1, 1, 1, 0};
  ASSERT_EQ(file.faces.size(), 5u);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(file.faces[i].material, materials[i]) << i;
    EXPECT_EQ(file.faces[i].group, groups[i]) << i;
  }

  const TemporaryMesh ply(".ply",
                          "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                          "property float y\nproperty float z\nelement face 2\n"
                          "property int material_index\nproperty list uchar int vertex_indices\n"
                          "end_header\n0 0 0\n1 0 0\n0 1 0\n4 3 0 1 2\n0 3 0 2 1\n");
  const MeshFile numbered = read_mesh_file(ply.path());
  EXPECT_THAT(numbered.names, testing::ElementsAre("4", "0"));
  EXPECT_EQ(numbered.faces.at(0).material, 1u);
  EXPECT_EQ(numbered.faces.at(1).material, 2u);
}

TEST(MeshFile, NamesFileLineAndRemedyOfEachFault) {
  const auto message = [](const std::string& ending, const std::string& text) {
    const TemporaryMesh written(ending, text);
    try {
      (void)read_mesh_file(written.path());
    } catch (const std::runtime_error& error) {
      const std::string what = error.what();
      const std::string begin = "mesh " + written.path().string();
      EXPECT_EQ(what.substr(0, begin.size()), begin);
      return what.substr(begin.size());
    }
    return std::string("read without complaint");
  };
  EXPECT_EQ(message(".obj", "v 0 0 0\nv 1 nan 0\n"),
            ":2: vertex 1, counted from 0, is not finite; repair it or export the mesh again");
  EXPECT_THAT(message(".obj", "v 0 0 0\nv 1 1e999 0\n"), HasSubstr(":2: vertex 1, counted"));
  EXPECT_THAT(message(".obj", "v 0 0 0\n\nv 1 0\n"), HasSubstr(":3: a vertex's z is missing"));
  EXPECT_THAT(message(".obj", "v 0 zero 0\n"), HasSubstr(":1: a vertex's y is not a number"));
  EXPECT_THAT(message(".obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 9\n"),
              HasSubstr(":5: a face refers to vertex 8, counted from 0, of 3"));
  EXPECT_THAT(message(".obj", "v 0 0 0\nf -1 -2 -3\n"),
              HasSubstr(":2: face 1 refers to vertex -1"));
  EXPECT_THAT(message(".obj", "v 0 0 0\nf 0 1 1\n"), HasSubstr(":2: '0' refers to no vertex"));
  const std::string little("v\0 \0001\0 \000", 8), big("\0v\0 \0001\0 ", 8);
  EXPECT_EQ(message(".obj", little), ": is text in UTF-16 (little-endian); save it in UTF-8");
  EXPECT_EQ(message(".obj", "\xFF\xFE" + little), message(".obj", little));
  EXPECT_EQ(message(".obj", big), ": is text in UTF-16 (big-endian); save it in UTF-8");
  EXPECT_EQ(message(".ply", "\xFE\xFF" + big), message(".obj", big));
  EXPECT_THAT(message(".off", "OFF BINARY\n"), HasSubstr(":1: is binary; export it as text"));
  EXPECT_THAT(message(".off", "OFF\n3 1 0\n0 0 0\n1 0 0\n"),
              HasSubstr("ends before vertex 2 of 3"));
  EXPECT_THAT(message(".off", "OFF\n1 1 0\n0 0 0\n3 0 0\n"),
              HasSubstr("a corner of the face is m"));
  EXPECT_THAT(message(".ply", "plx\n"), HasSubstr("does not begin with 'ply'"));
  EXPECT_THAT(message(".ply", "ply\nelement face 1\nproperty int a\nend_header\n1\n"),
              HasSubstr("no list vertex_indices"));
  EXPECT_THAT(message(".ply", binary_ply(false).substr(0, 400)), HasSubstr("truncated"));
  EXPECT_THAT(message(".stl", "solid s\nouter loop\nvertex 0 0 0\n"), HasSubstr("truncated"));
  EXPECT_THAT(message(".stl", binary_stl("cut").substr(0, 180)), HasSubstr("184 octets, but"));
  EXPECT_THAT(message(".stl", std::string(100, 'x')), HasSubstr("octets, but it has 100"));
  EXPECT_THAT(message(".3ds", ""), HasSubstr("ends in .obj, .ply, .stl or .off"));
}

TEST(MeshFile, NamesTheFaceOfABinaryFile) {
  std::string bytes = binary_ply(false);
  bytes[bytes.size() - 12] = 5;  // the first corner
  const TemporaryMesh written(".ply", bytes);
  EXPECT_THAT([&] { (void)read_mesh_file(written.path()); },
              testing::ThrowsMessage<std::runtime_error>(HasSubstr(": face 1 refers to vertex 5")));
}

/// True if the file is read, false if it is refused with a message.
bool is_read(const std::string& ending, const std::string& text) {
  const TemporaryMesh written(ending, text);
  try {
    const MeshFile file = read_mesh_file(written.path());
    for (const std::uint32_t corner : file.corners) EXPECT_LT(corner, file.vertices.size());
    for (const Vector3d& p : file.vertices) EXPECT_TRUE(p.allFinite());
    return true;
  } catch (const std::runtime_error&) {
    return false;
  }
}

TEST(MeshFile, AcceptsOrRefusesAnyDamagedFile) {
  const std::pair<std::string, std::string> files[] = {
      {".obj", far_lines("v ") + "f 1/2/3 2 \\\n -1\n"},
      {".off", "OFF\n3 1 0\n" + far_lines("") + "3 0 1 2\n"},
      {".ply", binary_ply(false)},
      {".ply", binary_ply(true)},
      {".stl", "solid s\nfacet normal 0 0 1\nouter loop\n" + far_lines("vertex ") + "endloop\n"}};
  std::mt19937 random(11);
  for (const auto& [ending, text] : files) {
    EXPECT_TRUE(is_read(ending, text));
    for (std::size_t size = 0; size < text.size(); ++size)
      (void)is_read(ending, text.substr(0, size));
    for (int i = 0; i < 500; ++i) {
      std::string damaged = text;
      for (int k = 0; k < 3; ++k) damaged[random() % text.size()] = static_cast<char>(random());
      (void)is_read(ending, damaged);
    }
  }
}

double area(const std::vector<Vector3d>& p, const std::array<std::uint32_t, 3>& t) {
  return 0.5 * (p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]).z();
}

// An L, a comb and a square with a point on its edge: every triangle has the winding of the
// outline, and their total area is the outline's (by hand).
TEST(MeshFile, CutsConcavePolygonsWithoutOverlap) {
  const std::pair<std::vector<Vector3d>, double> outlines[] = {
      {{{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}}, 3.0},
      {{{0, 0, 0},
        {5, 0, 0},
        {5, 3, 0},
        {4, 3, 0},
        {4, 1, 0},
        {3, 1, 0},
        {3, 3, 0},
        {2, 3, 0},
        {2, 1, 0},
        {1, 1, 0},
        {1, 3, 0},
        {0, 3, 0}},
       11.0},
      {{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}, 4.0}};
  for (const auto& [outline, whole] : outlines) {
    // From every corner on: the choice of the first one must not matter.
    for (std::size_t first = 0; first < outline.size(); ++first) {
      std::vector<std::uint32_t> corners(outline.size());
      std::iota(corners.begin(), corners.end(), 0u);
      std::ranges::rotate(corners, corners.begin() + static_cast<std::ptrdiff_t>(first));
      std::vector<std::array<std::uint32_t, 3>> triangles;
      cut_polygon(outline, corners, triangles);
      ASSERT_EQ(triangles.size(), outline.size() - 2);
      double sum = 0.0;
      for (const auto& triangle : triangles) {
        EXPECT_GE(area(outline, triangle), 0.0) << "from corner " << first;
        sum += std::abs(area(outline, triangle));
      }
      EXPECT_NEAR(sum, whole, 1e-12) << "from corner " << first;
    }
  }
}

std::vector<Vector3d> star(std::size_t points) {
  std::vector<Vector3d> outline;
  for (std::size_t i = 0; i < points; ++i) {
    const double turn = 2.0 * M_PI * static_cast<double>(i) / static_cast<double>(points);
    outline.push_back((i % 2 == 0 ? 1.0 : 0.5) * Vector3d(std::cos(turn), std::sin(turn), 0.0));
  }
  return outline;
}

// Three turns of a strip: most ears appear only after others were cut.
TEST(MeshFile, CutsSpiralsWithoutOverlap) {
  constexpr int kPoints = 150;
  std::vector<Vector3d> outline;
  const auto add = [&](int i, double in) {
    const double turn = 6.0 * M_PI * i / kPoints, radius = 1.0 + turn / M_PI - in;
    outline.emplace_back(radius * std::cos(turn), radius * std::sin(turn), 0.0);
  };
  for (int i = 0; i <= kPoints; ++i) add(i, 0.0);
  for (int i = kPoints; i >= 0; --i) add(i, 0.2);
  std::vector<std::uint32_t> corners(outline.size());
  std::iota(corners.begin(), corners.end(), 0u);
  std::vector<std::array<std::uint32_t, 3>> triangles;
  cut_polygon(outline, corners, triangles);
  double whole = 0.0, sum = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i)
    whole += 0.5 * outline[i].cross(outline[(i + 1) % outline.size()]).z();
  for (const auto& triangle : triangles) sum += std::abs(area(outline, triangle));
  EXPECT_EQ(triangles.size(), outline.size() - 2);
  EXPECT_NEAR(sum, std::abs(whole), 1e-9);
}

TEST(MeshFile, CutsSelfCrossingPolygons) {
  std::vector<Vector3d> outline;
  for (std::size_t i = 0; i < 2000; ++i)
    outline.emplace_back(static_cast<double>(i * 7919 % 10007), static_cast<double>(i * i % 10009),
                         0.0);
  std::vector<std::uint32_t> corners(outline.size());
  std::iota(corners.begin(), corners.end(), 0u);
  std::vector<std::array<std::uint32_t, 3>> triangles;
  cut_polygon(outline, corners, triangles);
  EXPECT_EQ(triangles.size(), outline.size() - 2);
}

TEST(MeshFile, BoundsTheCornersOfConcaveFaces) {
  const auto cut = [](std::size_t points) {
    const std::vector<Vector3d> outline = star(points);
    std::vector<std::uint32_t> corners(outline.size());
    std::iota(corners.begin(), corners.end(), 0u);
    std::vector<std::array<std::uint32_t, 3>> triangles;
    cut_polygon(outline, corners, triangles);
    return triangles.size();
  };
  EXPECT_EQ(cut(1000), 998u);
  EXPECT_THROW((void)cut(10'002), LoadLimitError) << "before the work";
  const LoadBudget scene;
  for (int i = 0; i < 25; ++i) EXPECT_EQ(cut(2000), 1998u);
  EXPECT_THROW((void)cut(2000), LoadLimitError) << "all faces together";
}

}  // namespace
}  // namespace reckon::haptics
