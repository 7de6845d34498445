// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/geometry/mesh_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace reckon::haptics {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

MeshReport good() {
  MeshReport report;
  report.faces = report.triangles = 5184;
  report.vertices = 2594;
  report.pieces = 1;
  report.extent = {0.2, 0.15, 0.08};
  report.closed = true;
  return report;
}

TEST(MeshReport, GivesOnlyTheSizeOfAGoodMesh) {
  EXPECT_EQ(mesh_summary(good()), "200 x 150 x 80 mm, 5184 triangles, closed");
  EXPECT_THAT(mesh_notes(good()), IsEmpty());
}

TEST(MeshReport, SuspectsTheUnitOfExtremeSizes) {
  MeshReport report = good();
  report.extent = {100, 120, 74.8331477};  // diagonal 173.2
  EXPECT_THAT(mesh_notes(report), ElementsAre(AllOf(HasSubstr("is 173.2 m large"),
                                                    HasSubstr("scale_to = \"173.2 mm\""))));
  EXPECT_THAT(mesh_summary(report), HasSubstr("100 x 120 x 74.83 m,"));
  report.extent = {0.0001, 0.0002, 0.0002};
  EXPECT_THAT(mesh_notes(report), ElementsAre(HasSubstr("is only 300 um large")));
  report.extent = {3, 4, 5};
  EXPECT_THAT(mesh_notes(report), IsEmpty());
}

TEST(MeshReport, ListsEachFindingWithPlaceAndRepair) {
  MeshReport report = good();
  report.place_word = "line";
  report.closed = false;
  report.polygons = {2, 3};
  report.merged_vertices = 1;
  report.octets_behind = 2;
  report.dropped_degenerate = {1, 17};
  report.dropped_duplicates = {2, 18};
  report.turned = {3, 19};
  report.inward_pieces = 1;
  report.pieces = 4;
  report.one_sided_edges = 5;
  report.boundary_edges = {6, 20};
  report.holes = 2;
  report.non_manifold_edges = {7, 21};
  report.non_manifold_vertices = {8, 22};
  EXPECT_EQ(mesh_summary(report),
            "200 x 150 x 80 mm, 5184 triangles, open, both sides felt, 4 pieces; 2 polygons cut, "
            "1 vertex merged");
  EXPECT_THAT(
      mesh_notes(report),
      ElementsAre(
          HasSubstr("2 octets after the 5184 faces of the file's count were not read"),
          HasSubstr("1 triangle without area was dropped (first: line 17)"),
          HasSubstr(
              "2 triangles were dropped, because another has the same corners (first: line 18)"),
          HasSubstr("3 triangles had the opposite orientation of the neighbours and were turned "
                    "(first: line 19)"),
          HasSubstr("1 of 4 pieces faced inwards"), HasSubstr("disagree at 5 edges"),
          HasSubstr("is open: 6 edges of one triangle only, round 2 holes (first: line 20)"),
          HasSubstr("has 7 edges of three or more triangles (first: line 21)"),
          HasSubstr("has 8 corners where surfaces meet in one point only (first: line 22)")));
}

TEST(MeshReport, WritesLengthsInASuitableUnit) {
  EXPECT_EQ(length_text(4031234.0), "4031 km");
  EXPECT_EQ(length_text(173.21), "173.2 m");
  EXPECT_EQ(length_text(0.0025), "2.5 mm");
  EXPECT_EQ(length_text(2e-6), "2 um");
}

}  // namespace
}  // namespace reckon::haptics
