// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The mesh and the hand traces in scenes/: the output of make_scene.py, and contact of the hands.
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "reckon/haptics/contact/contact_solver.hpp"
#include "reckon/tests/support/places.hpp"
#include "reckon/tests/support/touch_meshes.hpp"

namespace reckon::haptics {
namespace {

using Eigen::Vector3d;
namespace fs = std::filesystem;

fs::path scenes() { return fs::path(reckon::test::source_dir()) / "scenes"; }

std::string bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

struct Row {
  double t;
  Vector3d p;
};

std::vector<Row> trace(const std::string& name) {
  std::ifstream in(scenes() / name);
  std::string line;
  std::getline(in, line);
  EXPECT_EQ(line, "t_s,px_m,py_m,pz_m");
  std::vector<Row> rows;
  while (std::getline(in, line)) {
    std::istringstream fields(line);
    Row row{};
    char comma = 0;
    fields >> row.t >> comma >> row.p[0] >> comma >> row.p[1] >> comma >> row.p[2];
    rows.push_back(row);
  }
  return rows;
}

EffectPlan stone() {
  Scene scene;
  SceneObject object;
  object.name = "touchstone";
  object.shape = MeshShape{scenes() / "touchstone.obj", 0.2, false};
  scene.objects.push_back(object);
  return EffectPlan(scene);
}

TEST(ShippedScene, EqualsTheScriptsOutput) {
  if (std::system("python3 --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "needs python3";
  const fs::path out = fs::temp_directory_path() / "reckon_make_scene";
  fs::create_directories(out);
  const std::string command =
      "python3 '" + (scenes() / "make_scene.py").string() + "' '" + out.string() + "'";
  ASSERT_EQ(std::system(command.c_str()), 0);
  for (const char* name :
       {"touchstone.obj", "land.pgm", "meeting_1.csv", "meeting_2.csv", "hand_trace.csv",
        "hand_trace_2.csv", "wall_trace.csv", "tip_track.csv", "truck_track.csv"}) {
    EXPECT_EQ(bytes_of(out / name), bytes_of(scenes() / name)) << name;
  }
  fs::remove_all(out);
}

TEST(ShippedScene, StoneIsClosedManifoldAndOfItsSize) {
  const SurfaceMesh mesh = SurfaceMesh::load({scenes() / "touchstone.obj", 0.0, false});
  EXPECT_TRUE(mesh.report().closed);
  EXPECT_EQ(mesh.report().inward_pieces, 0u);
  EXPECT_EQ(mesh.report().inconsistent_edges.count, 0u);
  EXPECT_EQ(mesh.report().dropped_degenerate.count, 0u);
  EXPECT_GE(mesh.report().triangles, 3000u);
  EXPECT_LE(mesh.report().triangles, 8000u);
  EXPECT_NEAR(mesh.size(), 0.2, 1e-6);
}

TEST(ShippedScene, EachHandTouchesTheStoneSlowlyAndReturns) {
  const EffectPlan plan = stone();
  const auto& mesh = *std::get<std::shared_ptr<const SurfaceMesh>>(plan.objects()[0].shape);
  for (const char* name : {"hand_trace.csv", "hand_trace_2.csv"}) {
    SCOPED_TRACE(name);
    const std::vector<Row> rows = trace(name);
    ASSERT_EQ(rows.size(), 15001u);
    EXPECT_EQ(rows.front().p, rows.back().p);
    ContactSolver solver(plan);
    double touched = 0.0;
    for (std::size_t i = 1; i < rows.size(); ++i) {
      const ContactResult result = solver.step(rows[i].p);
      const double speed = (rows[i].p - rows[i - 1].p).norm() / (rows[i].t - rows[i - 1].t);
      if (!result.in_contact) continue;
      touched += 0.004;
      ASSERT_LE(speed, 0.04) << "at " << rows[i].t << " s";
      ASSERT_LE((result.scp - rows[i].p).norm(), 0.006) << "at " << rows[i].t << " s";
      if (i % 25 == 0) {
        ASSERT_LT(test::winding_number(mesh, result.scp), 0.5) << "at " << rows[i].t;
      }
    }
    EXPECT_GT(touched, 10.0) << "[s] of contact in a loop";
  }
}

TEST(ShippedScene, HandsMeetAndPushGently) {
  const std::vector<Row> first = trace("hand_trace.csv");
  const std::vector<Row> second = trace("hand_trace_2.csv");
  double least = 1.0;
  double touched = 0.0;
  double fastest = 0.0;
  for (std::size_t i = 1; i < first.size(); ++i) {
    const Vector3d now = second[i].p - first[i].p;
    const Vector3d before = second[i - 1].p - first[i - 1].p;
    if (now.norm() >= 0.02) continue;
    touched += 0.004;
    least = std::min(least, now.norm());
    fastest = std::max(fastest, (now - before).norm() / 0.004);
  }
  EXPECT_NEAR(least, 0.0165, 1e-4) << "two balls of 10 mm, 3.5 mm of overlap";
  EXPECT_GT(touched, 8.0);
  EXPECT_LE(fastest, 0.005) << "relative speed [m/s] in contact";
}

}  // namespace
}  // namespace reckon::haptics
