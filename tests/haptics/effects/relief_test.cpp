// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Textures from pictures, and the feel of any texture on a mesh of many triangles.
#include "reckon/haptics/effects/relief.hpp"

#include <gmock/gmock.h>
#include <png.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <random>
#include <vector>

#include "reckon/haptics/contact/contact_solver.hpp"
#include "reckon/tests/support/scratch_folder.hpp"

namespace reckon::haptics {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

std::string refusal(const std::filesystem::path& file) {
  try {
    static_cast<void>(read_image(file));
    return "read";
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
}

/// Writes a picture by the library.
template <class Pixel>
void write_png(const std::filesystem::path& file, unsigned width, unsigned height,
               png_uint_32 format, const std::vector<Pixel>& pixels) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = width;
  image.height = height;
  image.format = format;
  ASSERT_NE(png_image_write_to_file(&image, file.c_str(), 0, pixels.data(), 0, nullptr), 0);
}

/// h = (1 + cos(2 pi (x + 2 y))) / 2 over one period.
HeightMap waves(std::size_t count) {
  std::vector<float> heights;
  for (std::size_t i = 0; i < count * count; ++i) {
    const double x = static_cast<double>(i % count), y = static_cast<double>(i / count);
    const double phase = 2.0 * std::numbers::pi * (x + 2.0 * y) / static_cast<double>(count);
    heights.push_back(static_cast<float>(0.5 + 0.5 * std::cos(phase)));
  }
  return {count, count, std::move(heights)};
}

TEST(HeightMap, RepeatsTheHeightsOfItsTable) {
  const HeightMap map(4, 5, {0, .1F, .2F, .3F, .4F, .5F, .6F, .7F, .8F, .9F,
                             1, .9F, .8F, .7F, .6F, .5F, .4F, .3F, .2F, .1F});
  for (int period = -3; period <= 3; ++period) {
    EXPECT_NEAR(map.at({period + 0.25, 0.4 - period}), 0.9, 1e-6);
    EXPECT_NEAR(map.at({period + 0.75, 0.0}), 0.3, 1e-6);
  }
  EXPECT_THROW(HeightMap(3, 4, std::vector<float>(12)), std::invalid_argument);
  EXPECT_THROW(HeightMap(4, 4, std::vector<float>(15)), std::invalid_argument);
}

TEST(HeightMap, FollowsWavesAndTheirSlope) {
  const HeightMap map = waves(64);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(-5.0, 5.0);
  for (int i = 0; i < 1000; ++i) {
    const Vector2d place(any(random), any(random));
    const double phase = 2.0 * std::numbers::pi * (place.x() + 2.0 * place.y());
    // A cubic through 32 samples of a wave has an error of some 1e-4 of its height.
    EXPECT_NEAR(map.at(place), 0.5 + 0.5 * std::cos(phase), 1e-3);
    const Vector2d slope = -std::numbers::pi * std::sin(phase) * Vector2d(1.0, 2.0);
    EXPECT_LT((map.gradient(place) - slope).norm(), 0.02 * std::numbers::pi * std::sqrt(5.0));
  }
  EXPECT_NEAR(map.wavelength({0.01, 0.01}), 0.01 / std::sqrt(5.0), 1e-2 * 0.0045);
}

TEST(HeightMap, SlopeIsTheGradientOfTheHeight) {
  const HeightMap map = HeightMap::random(7);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> any(-2.0, 2.0);
  constexpr double kStep = 1e-6;
  for (int i = 0; i < 1000; ++i) {
    const Vector2d place(any(random), any(random));
    const Vector2d x(kStep, 0), y(0, kStep);
    const Vector2d differences((map.at(place + x) - map.at(place - x)) / (2 * kStep),
                               (map.at(place + y) - map.at(place - y)) / (2 * kStep));
    // The differences themselves have errors of rounding / step = 1e-10, and of step x curvature at
    // a border of pixels.
    EXPECT_LT((map.gradient(place) - differences).norm(), 1e-6 * 64 * 64) << place.transpose();
  }
}

TEST(HeightMap, RandomMapIsReproducibleAndBounded) {
  EXPECT_EQ(HeightMap::random(3).at({0.3, 0.7}), HeightMap::random(3).at({0.3, 0.7}));
  EXPECT_NE(HeightMap::random(3).at({0.3, 0.7}), HeightMap::random(4).at({0.3, 0.7}));
  const HeightMap map = HeightMap::random(3);
  for (const double far : {1e300, -1e300, 1e18, std::nan("")})
    EXPECT_TRUE(map.gradient({far, 0.1}).allFinite()) << far;
  const HeightMap flat(4, 4, std::vector<float>(16, 0.5F));
  EXPECT_TRUE(std::isinf(flat.wavelength({1.0, 1.0})));
}

TEST(ImageFile, ReadsGreyColourAndSixteenBits) {
  const test::ScratchFolder folder;
  const std::filesystem::path file = folder.file("a.png");
  std::vector<std::uint8_t> grey(20, 0);
  grey[1] = 51;
  write_png(file, 5, 4, PNG_FORMAT_GRAY, grey);
  GreyImage image = read_image(file);
  EXPECT_EQ(image.width, 5U);
  EXPECT_EQ(image.height, 4U);
  EXPECT_NEAR(image.pixels[1], 0.2, 1e-6);
  EXPECT_EQ(image.pixels[2], 0.0F);

  std::vector<std::uint16_t> deep(16, 0);
  deep[5] = 13107;
  write_png(file, 4, 4, PNG_FORMAT_LINEAR_Y, deep);
  image = read_image(file);
  EXPECT_NEAR(image.pixels[5], 0.2, 1e-6);

  std::vector<std::uint8_t> colour(4 * 4 * 4, 255);
  for (std::size_t i = 3; i < 16; i += 4) colour[i] = 0;  // the first row is transparent
  write_png(file, 4, 4, PNG_FORMAT_RGBA, colour);
  image = read_image(file);
  EXPECT_EQ(image.pixels[0], 0.0F);
  EXPECT_EQ(image.pixels[15], 1.0F);
}

TEST(ImageFile, RefusesInvalidPicturesWithTheRemedy) {
  const test::ScratchFolder folder;
  EXPECT_THAT(refusal(folder.file("none.png")), testing::HasSubstr("none.png"));
  EXPECT_THAT(refusal(folder.file("")), testing::HasSubstr("does not exist; give the path"));
  std::ofstream(folder.file("text.png")) << "GIF89a";
  EXPECT_THAT(refusal(folder.file("text.png")), testing::HasSubstr("neither a PNG picture nor"));
  write_png(folder.file("small.png"), 3, 9, PNG_FORMAT_GRAY, std::vector<std::uint8_t>(27));
  EXPECT_THAT(refusal(folder.file("small.png")), testing::HasSubstr("give 4 to 4096"));
  write_png(folder.file("long.png"), 4097, 4, PNG_FORMAT_GRAY, std::vector<std::uint8_t>(4 * 4097));
  EXPECT_THAT(refusal(folder.file("long.png")), testing::HasSubstr("4097 x 4"));
  // A file that ends early.
  write_png(folder.file("whole.png"), 64, 64, PNG_FORMAT_GRAY, std::vector<std::uint8_t>(4096, 7));
  std::filesystem::resize_file(folder.file("whole.png"), 60);
  EXPECT_THAT(refusal(folder.file("whole.png")),
              testing::HasSubstr("is not a readable PNG picture"));
}

std::string refusal_of(std::string_view bytes) {
  try {
    static_cast<void>(decode_image(bytes));
    return "read";
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
}

TEST(ImageFile, ReadsGreyMapsAsTextAndBinary) {
  // A fifth, and white, at their pixels; written by hand after pgm(5).
  const auto check = [](std::string_view bytes) {
    const GreyImage image = decode_image(bytes);
    ASSERT_EQ(image.width, 4U);
    ASSERT_EQ(image.height, 5U);
    ASSERT_EQ(image.pixels.size(), 20U);
    EXPECT_NEAR(image.pixels[1], 0.2, 1e-6);
    EXPECT_EQ(image.pixels[4], 1.0F);
    for (const std::size_t black : {0U, 2U, 3U, 5U, 19U}) EXPECT_EQ(image.pixels[black], 0.0F);
  };
  const std::string rest(15, '\0');
  check("P2\n4 5\n15\n0 3 0 0\n15 0 0 0\n0 0 0 0\n0 0 0 0 0 0 0 0");
  check("P2 # of heights\n#\n4#wide\n5\t65535 0 13107 0 0 65535 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0\n");
  check(std::string("P5 4 5 255\n\0\x33\0\0\xff", 16) + rest);
  check(std::string("P5\n4 5\n1000\n\0\0\0\xc8\0\0\0\0\3\xe8", 22) + rest + rest);
  check(std::string("P5 4 5 5 \0\1\0\0\5", 14) + rest + "P5 and a second picture");

  // Through the file of an effect, as named by a scene.
  const test::ScratchFolder folder;
  std::ofstream(folder.file("steps.pgm")) << "P2 4 4 1 1 0 1 0 0 1 0 1 1 0 1 0 0 1 0 1";
  EXPECT_NEAR(Relief({folder.file("steps.pgm"), 0.01, 1e-4, 1}).map().at({0.0, 0.0}), 0.0, 1e-6);
  EXPECT_NEAR(Relief({folder.file("steps.pgm"), 0.01, 1e-4, 1}).map().at({0.25, 0.0}), 1.0, 1e-6);
}

TEST(ImageFile, RefusesBrokenGreyMapsWithoutLargeAllocations) {
  using testing::HasSubstr;
  EXPECT_THAT(refusal_of("P5"), HasSubstr("has no width in its header"));
  EXPECT_THAT(refusal_of("P2 4"), HasSubstr("has no height"));
  EXPECT_THAT(refusal_of("P2 -4 4 1"), HasSubstr("has no width"));
  EXPECT_THAT(refusal_of("P2 99999999999 4 1"), HasSubstr("has no width"));
  EXPECT_THAT(refusal_of("P5 4 4"), HasSubstr("has no greatest value"));
  EXPECT_THAT(refusal_of("P5 3 4 255 "), HasSubstr("3 x 4 pixels: give 4 to 4096"));
  EXPECT_THAT(refusal_of("P5 4294967295 4294967295 255 "), HasSubstr("give 4 to 4096"));
  EXPECT_THAT(refusal_of("P5 4 4 0 "), HasSubstr("0 as its greatest value: give 1 to 65535"));
  EXPECT_THAT(refusal_of("P5 4 4 65536 "), HasSubstr("give 1 to 65535"));
  EXPECT_THAT(refusal_of("P5 4 4 255"), HasSubstr("no blank after its greatest value"));
  EXPECT_THAT(refusal_of("P5 4096 4096 65535 ab"), HasSubstr("33554432 octets and 2 exist"));
  EXPECT_THAT(refusal_of("P5 4 4 255 123456789012345"), HasSubstr("16 octets and 15 exist"));
  EXPECT_THAT(refusal_of("P5 4 4 9 aaaaaaaaaaaaaaaa"), HasSubstr("row 1, column 1: 97 is above"));
  EXPECT_THAT(refusal_of("P2 4096 4096 9 1 2"), HasSubstr("ends early"));
  EXPECT_THAT(refusal_of("P2 4 4 9 0 0 0 0 0 0 10 0 0 0 0 0 0 0 0 0"),
              HasSubstr("row 2, column 3: 10 is above its greatest value 9"));
  EXPECT_THAT(refusal_of("P2 4 4 9 0 0 0 0 0 0 0 0 0 0 0 0 0 0 x 0"),
              HasSubstr("row 4, column 3: not a number"));
  EXPECT_THAT(refusal_of("P2 4 4 9 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 #"), HasSubstr("not a number"));
  EXPECT_THAT(refusal_of(""), HasSubstr("neither a PNG picture"));
}

/// A box of 80 mm, turned and moved, with a picture on it.
struct Printed {
  SceneObject object;
  EffectPlan plan;
  ContactSolver solver{plan};

  explicit Printed(const ReliefPicture& picture)
      : object(made(picture)), plan(Scene{"", {object}}) {}
  static SceneObject made(const ReliefPicture& picture) {
    SceneObject object;
    object.name = "printed";
    object.shape = BoxShape{{0.08, 0.08, 0.08}};
    object.pose.position = {0.3, -0.2, 1.1};
    object.pose.orientation = Eigen::AngleAxisd(0.7, Vector3d(1, 2, -1).normalized());
    object.effects.of<SpringDamper>() = {1000.0, 0.0};
    object.effects.declare<Relief>() = picture;
    return object;
  }
  /// Force of the effect with the top pressed by 2 mm [N, the object's axes].
  Vector3d force_at(double x, double y, double speed = 0.0) {
    const auto at = [&](double z) -> Vector3d {
      return object.pose.orientation * Vector3d(x, y, z) + object.pose.position;
    };
    solver.reset(at(0.05));
    solver.step(at(0.05));
    solver.step(at(0.038));
    const Vector3d velocity = object.pose.orientation * Vector3d(speed, 0, 0);
    return object.pose.orientation.conjugate() * solver.effect_force(velocity, 0.001);
  }
};

TEST(Relief, IsTheSlopeTimesTheNormalForce) {
  const test::ScratchFolder folder;
  const std::filesystem::path file = folder.file("wave.png");
  // One wave across, and twice as high as wide: the top row is far in +y.
  std::vector<std::uint16_t> pixels;
  for (int i = 0; i < 64 * 128; ++i) {
    const double across = 0.5 + 0.25 * std::cos(2 * std::numbers::pi * (i % 64) / 64.0);
    const double up = 0.25 * std::cos(2 * std::numbers::pi * (1.0 - (i / 64 + 1) / 128.0));
    pixels.push_back(static_cast<std::uint16_t>(65535 * (across + up)));
  }
  write_png(file, 64, 128, PNG_FORMAT_LINEAR_Y, pixels);
  Printed printed({file, 0.01, 4e-4, 1});
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-0.03, 0.03);
  for (int i = 0; i < 200; ++i) {
    const double x = any(random), y = any(random);
    const double kx = 2 * std::numbers::pi / 0.01, ky = 2 * std::numbers::pi / 0.02;
    const Vector3d slope(-1e-4 * kx * std::sin(kx * x), -1e-4 * ky * std::sin(ky * y), 0);
    // 2 N; the cubics through 64 heights a wave and the rounding of 16 bits are accurate to 1 %.
    EXPECT_LT((printed.force_at(x, y) + 2.0 * slope).norm(), 0.02 * 1e-4 * kx) << x << ", " << y;
  }
}

TEST(Relief, FadesAgainstAliasingAndLimitsItsSlope) {
  Printed fine({{}, 0.01, 1e-4, 5});
  const double wavelength = Relief({{}, 0.01, 1e-4, 5}).wavelength();
  EXPECT_GT(fine.force_at(0.0031, 0.0012).norm(), 1e-3);
  EXPECT_NEAR(fine.force_at(0.0031, 0.0012, 0.2 * wavelength / 0.001).norm(),
              fine.force_at(0.0031, 0.0012).norm(), 1e-12);
  EXPECT_EQ(fine.force_at(0.0031, 0.0012, 0.51 * wavelength / 0.001), Vector3d::Zero());
  Printed cliffs({{}, 0.001, 1e-2, 5});
  for (double x = 0.0; x < 0.01; x += 0.00037)
    EXPECT_LE(cliffs.force_at(x, 0.0).norm(), 2.0 * (1 + 1e-5));
}

TEST(Relief, GivesItsWavelengthAndTopSpeed) {
  const Printed printed({{}, 0.01, 1e-4, 5});
  const std::string told = printed.plan.stages().back().parameters;
  EXPECT_THAT(told, testing::StartsWith("no file, width 0.01 m"));
  EXPECT_THAT(told, testing::ContainsRegex("waves of 0\\.00[0-9]+ m, whole up to 0\\.[0-9]+ m/s"));
}

/// Writes a sphere of 40 mm: an icosahedron with each face cut into 19 x 19.
void write_sphere(const std::filesystem::path& file) {
  constexpr int kCuts = 19;
  const double g = 0.5 * (1 + std::sqrt(5.0));
  const std::vector<Vector3d> corners = {{-1, g, 0}, {1, g, 0}, {-1, -g, 0}, {1, -g, 0},
                                         {0, -1, g}, {0, 1, g}, {0, -1, -g}, {0, 1, -g},
                                         {g, 0, -1}, {g, 0, 1}, {-g, 0, -1}, {-g, 0, 1}};
  const std::vector<Eigen::Vector3i> faces = {
      {0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
      {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
      {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  std::ofstream out(file);
  out.precision(17);
  out << "solid sphere\n";
  for (const Eigen::Vector3i& face : faces) {
    const auto at = [&](int i, int j) -> Vector3d {
      const Vector3d& a = corners[static_cast<std::size_t>(face[0])];
      const Vector3d& b = corners[static_cast<std::size_t>(face[1])];
      const Vector3d& c = corners[static_cast<std::size_t>(face[2])];
      return 0.02 * (a + (b - a) * i / kCuts + (c - a) * j / kCuts).normalized();
    };
    const auto put = [&](const Vector3d& a, const Vector3d& b, const Vector3d& c) {
      out << "facet normal 0 0 0\nouter loop\n";
      for (const Vector3d& p : {a, b, c})
        out << "vertex " << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
      out << "endloop\nendfacet\n";
    };
    for (int i = 0; i < kCuts; ++i) {
      for (int j = 0; i + j < kCuts; ++j) {
        put(at(i, j), at(i + 1, j), at(i, j + 1));
        if (i + j + 1 < kCuts) put(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
      }
    }
  }
  out << "endsolid\n";
}

TEST(Texture, IsContinuousAtTheEdgesOfAMesh) {
  const test::ScratchFolder folder;
  write_sphere(folder.file("sphere.stl"));
  SceneObject object;
  object.name = "sphere";
  object.shape = MeshShape{folder.file("sphere.stl"), 0.0, false};
  object.effects.of<SpringDamper>() = {1000.0, 0.0};
  object.effects.declare<Texture>() = {5e-5, 0.004, 0.0, 0.0};
  const EffectPlan plan(Scene{"", {object}});
  ContactSolver solver(plan);
  double step = 0.0, most = 0.0;
  int edges = 0;
  for (int line = 0; line < 20; ++line) {
    const Vector3d axis =
        Vector3d(std::sin(line), std::cos(3.0 * line), 0.3 * line - 3).normalized();
    const Vector3d from = axis.unitOrthogonal();
    Vector3d before = Vector3d::Zero();
    std::uint32_t triangle = ContactedObject::kNoTriangle;
    solver.reset(0.021 * from);
    for (int i = 0; i < 6000; ++i) {  // by 5 microns
      const Vector3d device = 0.018 * (Eigen::AngleAxisd(2.5e-4 * i, axis) * from);
      const ContactResult contact = solver.step(device);
      const Vector3d force = solver.effect_force(Vector3d::Zero(), 0.001);
      if (i > 0) step = std::max(step, (force - before).norm());
      if (i > 0 && contact.objects[0].triangle != triangle) ++edges;
      triangle = contact.objects[0].triangle;
      before = force;
      most = std::max(most, force.norm());
    }
  }
  EXPECT_GT(edges, 500);
  std::printf("[ edges    ] %d edges, largest step %.4f of %.4f N\n", edges, step, most);
  EXPECT_LT(step, 0.05 * most);
}

}  // namespace
}  // namespace reckon::haptics
