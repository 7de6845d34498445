// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Solids with a picture as upper side, against the closed form of the drawn heights.
#include "reckon/haptics/geometry/height_field.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <random>

#include "reckon/haptics/contact/contact_solver.hpp"
#include "reckon/tests/support/scratch_folder.hpp"

namespace reckon::haptics {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;

constexpr int kColumns = 161, kRows = 81;
constexpr double kWidth = 0.16, kLength = 0.08, kHeight = 0.02, kBase = 0.015;  // [m]
constexpr double kPixel = 0.001;                                                // [m]
constexpr double kStep = kHeight / 65535;  // [m], between two grey levels
constexpr double kStiffness = 800.0;

/// Draws heights in [0, 1] over the rectangle about the origin, as 16-bit PGM.
void draw(const std::string& file, const std::function<double(double x, double y)>& height) {
  std::ofstream out(file, std::ios::binary);
  out << "P5 " << kColumns << ' ' << kRows << " 65535\n";
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      const double x = kPixel * (column - kColumns / 2), y = kPixel * (kRows / 2 - row);
      const auto grey = static_cast<unsigned>(std::lround(65535 * height(x, y)));
      out.put(static_cast<char>(grey >> 8)).put(static_cast<char>(grey & 255));
    }
  }
}

/// A turned and moved solid of a picture, pressed by one hand.
class Land {
 public:
  explicit Land(const HeightsShape& shape) {
    SceneObject object;
    object.name = "land";
    object.shape = shape;
    object.pose.position = {0.3, -0.2, 1.1};
    object.pose.orientation = Eigen::AngleAxisd(0.7, Vector3d(1, 2, -1).normalized());
    object.effects.of<SpringDamper>() = {kStiffness, 0.0};
    object_ = object;
    plan_ = EffectPlan(Scene{"", {object}});
    solver_.emplace(plan_);
  }
  /// Force on a hand that moves from `above` to `at`, in the object's axes [N].
  Vector3d press(const Vector3d& above, const Vector3d& at) {
    (void)solver_->reset(in_scene(above));
    ContactResult result;
    for (int i = 1; i <= 20; ++i) result = solver_->step(in_scene(above + (at - above) * i / 20));
    return object_.pose.orientation.conjugate() * result.force;
  }
  [[nodiscard]] const SurfaceMesh& mesh() const {
    return *std::get<std::shared_ptr<const SurfaceMesh>>(plan_.objects()[0].shape);
  }

 private:
  [[nodiscard]] Vector3d in_scene(const Vector3d& p) const {
    return object_.pose.orientation * p + object_.pose.position;
  }
  SceneObject object_;
  EffectPlan plan_;
  std::optional<ContactSolver> solver_;
};

class HeightField : public testing::Test {
 protected:
  HeightsShape drawn(const std::function<double(double x, double y)>& height) {
    draw(folder_.file("land.pgm"), height);
    return {folder_.file("land.pgm"), kWidth, 0.0, kHeight, kBase};
  }
  test::ScratchFolder folder_;
};

TEST_F(HeightField, IsAClosedSolidWithNamedSides) {
  const Land land(drawn([](double x, double) { return 0.5 + x / kWidth; }));
  const MeshReport& report = land.mesh().report();
  EXPECT_TRUE(report.closed);
  EXPECT_EQ(report.pieces, 1U);
  EXPECT_EQ(report.inward_pieces, 0U);
  EXPECT_EQ(report.turned.count, 0U);
  EXPECT_EQ(report.dropped_degenerate.count, 0U);
  const std::size_t border = 2 * (kColumns + kRows - 2);
  EXPECT_EQ(report.triangles, 2U * (kColumns - 1) * (kRows - 1) + 3 * border);
  EXPECT_NEAR(report.volume, kWidth * kLength * (kBase + 0.5 * kHeight), 1e-3 * report.volume);
  EXPECT_LT((report.extent - Vector3d(kWidth, kLength, kHeight + kBase)).norm(), 1e-9);
  ASSERT_EQ(land.mesh().names(), (std::vector<std::string>{"top", "side", "bottom"}));
  for (std::size_t i = 0; i < land.mesh().triangles().size(); ++i) {
    const Vector3d& normal = land.mesh().triangles()[i].normal;
    const std::string& name = land.mesh().names()[land.mesh().face_names()[i].material - 1];
    EXPECT_EQ(name == "top", normal.z() > 0.5);
    EXPECT_EQ(name == "bottom", normal.z() < -0.5);
  }
}

// Force and depth as on an inclined plane, within the grey levels. Up is y.
TEST_F(HeightField, SlopeFeelsLikeAPlane) {
  const auto height = [](double x, double y) { return 0.5 + 0.3 * x / kWidth - 0.6 * y / kLength; };
  Land land(drawn(height));
  const Vector3d normal =
      Vector3d(-0.3 * kHeight / kWidth, 0.6 * kHeight / kLength, 1).normalized();
  std::mt19937 random(1);
  std::uniform_real_distribution<double> share(-0.8, 0.8), depths(0.0005, 0.005);
  for (int i = 0; i < 200; ++i) {
    const double x = 0.5 * kWidth * share(random), y = 0.5 * kLength * share(random);
    const double below = depths(random);
    const double top = kHeight * height(x, y);
    const Vector3d force = land.press({x, y, top + 0.01}, {x, y, top - below});
    const Vector3d plane = kStiffness * below * normal.z() * normal;
    // Half a grey step in depth; in direction a step over a pixel. The contact point rests
    // kRelativeClearance of the size above the surface.
    const double depth_error = kStep + 2 * kRelativeClearance * land.mesh().size();
    EXPECT_LE((force - plane).norm(),
              kStiffness * (depth_error + below * std::sqrt(2.0) * kStep / kPixel))
        << x << ", " << y << ", " << below;
  }
}

// h = 1 - x² / a² - y² / b²: at a distance d below a surface point along its normal, that point is
// the nearest while d is less than the radius of curvature.
TEST_F(HeightField, ParaboloidIsFeltAlongItsNormals) {
  const double a = 0.5 * kWidth, b = 0.5 * kLength * std::sqrt(2.0);
  Land land(drawn(
      [&](double x, double y) { return std::max(0.0, 1.0 - x * x / (a * a) - y * y / (b * b)); }));
  const double bend = 2.0 * kHeight / (b * b);  // greatest curvature [1/m]: a radius of 80 mm
  std::mt19937 random(2);
  std::uniform_real_distribution<double> share(-0.45, 0.45), depths(0.0005, 0.005);
  double worst = 0.0;
  for (int i = 0; i < 200; ++i) {
    const double x = a * share(random), y = 0.5 * kLength * share(random), depth = depths(random);
    const Vector3d point(x, y, kHeight * (1.0 - x * x / (a * a) - y * y / (b * b)));
    const Vector3d normal =
        Vector3d(2 * kHeight * x / (a * a), 2 * kHeight * y / (b * b), 1).normalized();
    const Vector3d force = land.press(point + 0.01 * normal, point - depth * normal);
    // A facet of two pixels is below the arc by bend pixel² / 4 and is turned by bend pixel; grey
    // levels and clearance as on the slope.
    const double facet = 0.25 * bend * kPixel * kPixel + kStep;
    const double turned = std::sqrt(2.0) * (bend * kPixel + kStep / kPixel);
    const double most =
        kStiffness * (facet + 2 * kRelativeClearance * land.mesh().size() + depth * turned);
    const double error = (force - kStiffness * depth * normal).norm();
    EXPECT_LE(error, most) << x << ", " << y << ", " << depth;
    worst = std::max(worst, error / (kStiffness * depth));
  }
  std::printf("[ height   ] largest error %.4f of the force\n", worst);
}

TEST_F(HeightField, SidesAndBottomAreSolidWithTheirPatches) {
  const HeightsShape shape = drawn([](double, double) { return 1.0; });
  Land land(shape);
  const auto felt = [&](const Vector3d& from, const Vector3d& way) -> Vector3d {
    return land.press(from - 0.01 * way, from + 0.002 * way);
  };
  const double near = kStiffness * 2 * kRelativeClearance * land.mesh().size() + 1e-9;
  const double full = kStiffness * 0.002;
  EXPECT_LE((felt({0, 0, kHeight}, -Vector3d::UnitZ()) - full * Vector3d::UnitZ()).norm(), near);
  EXPECT_LE((felt({0.01, 0, -kBase}, Vector3d::UnitZ()) + full * Vector3d::UnitZ()).norm(), near);
  EXPECT_LE((felt({0.08, 0, 0.001}, -Vector3d::UnitX()) - full * Vector3d::UnitX()).norm(), near);
  EXPECT_LE((felt({0, -0.04, 0.001}, Vector3d::UnitY()) + full * Vector3d::UnitY()).norm(), near);

  SceneObject object;
  object.name = "land";
  object.shape = shape;
  object.patches.push_back({"top", {200.0, 0.0}, {}});
  const EffectPlan plan(Scene{"", {object}});
  EXPECT_EQ(plan.objects()[0].patches->patches.at(1).name, "top");
  EXPECT_EQ(plan.objects()[0].patches->patches.at(1).triangles, 2U * (kColumns - 1) * (kRows - 1));
}

TEST_F(HeightField, LengthStretchesItAndInvalidShapesAreRefused) {
  HeightsShape shape = drawn([](double, double) { return 0.0; });
  shape.length = 0.3;
  EXPECT_NEAR(SurfaceMesh::load_heights(shape).bounds().sizes().y(), 0.3, 1e-12);
  EXPECT_EQ(SurfaceMesh::load_heights(shape, 100).report().extent,
            SurfaceMesh::load_heights(shape).report().extent);
  shape.length = 0.0;
  EXPECT_EQ(SurfaceMesh::load_heights(shape, 100).report().extent,
            SurfaceMesh::load_heights(shape).report().extent);
  EXPECT_LE(SurfaceMesh::load_heights(shape, 100).report().triangles, 500U);
  const auto refusal = [](const HeightsShape& refused) {
    try {
      static_cast<void>(SurfaceMesh::load_heights(refused));
      return std::string("read");
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
  };
  HeightsShape bad = shape;
  bad.base = 0.0;
  EXPECT_THAT(refusal(bad), HasSubstr("heights: base is 0.000000 m: give 0.1 mm to 1 km"));
  bad = shape;
  bad.width = std::nan("");
  EXPECT_THAT(refusal(bad), HasSubstr("heights: width"));
  bad = shape;
  bad.file = folder_.file("none.png");
  EXPECT_THAT(refusal(bad), HasSubstr("none.png: does not exist"));
  std::ofstream(folder_.file("wide.pgm")) << "P5 1025 1024 255\n" << std::string(1025 * 1024, 'a');
  bad.file = folder_.file("wide.pgm");
  EXPECT_THAT(refusal(bad), HasSubstr("has 1049600 pixels, and a solid allows 1048576: scale"));
}

}  // namespace
}  // namespace reckon::haptics
