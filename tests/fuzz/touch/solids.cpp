// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tests/fuzz/touch/solids.hpp"

#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

namespace reckon::fuzz {
namespace {

using Eigen::Vector3d;

enum class Solid { none, wall, box, pit, tetrahedron };

constexpr double kSize = 0.04;  // [m], of a box
constexpr double kPit = 0.015;  // [m], radius

// Meshes come from files. Gone with the process.
class TetrahedronFile {
 public:
  TetrahedronFile() {
    std::ofstream(path_) << "OFF\n4 4 0\n.02 0 0\n-.02 .02 0\n-.02 -.01 .02\n-.02 -.01 -.02\n"
                            "3 0 1 2\n3 0 2 3\n3 0 3 1\n3 1 3 2\n";
  }
  ~TetrahedronFile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  TetrahedronFile(const TetrahedronFile&) = delete;
  TetrahedronFile& operator=(const TetrahedronFile&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_ = std::filesystem::temp_directory_path() /
                                ("reckon_touch_" + std::to_string(::getpid()) + ".off");
};

// The side that faces a hand is half a size from the object's origin, that of a wall is there.
haptics::Shape shape_of(Solid solid, const Vector3d& normal) {
  switch (solid) {
    case Solid::box:
      return haptics::BoxShape{Vector3d::Constant(kSize)};
    case Solid::pit: {
      haptics::CsgShape shape;
      shape.parts.resize(2);
      shape.parts[0].shape = haptics::BoxShape{Vector3d::Constant(kSize)};
      shape.parts[1].operation = haptics::CsgOperation::subtract;
      shape.parts[1].shape = haptics::SphereShape{kPit};
      shape.parts[1].position = 0.5 * kSize * Vector3d::UnitX();
      return shape;
    }
    case Solid::tetrahedron: {
      static const TetrahedronFile file;
      haptics::MeshShape shape;
      shape.file = file.path();
      return shape;
    }
    default:
      return haptics::PlaneShape{normal};
  }
}

haptics::SceneObject object_of(const char* name, Solid solid, double stiffness, double gap,
                               double tilt) {
  haptics::SceneObject object;
  object.name = name;
  const Vector3d normal(std::cos(tilt), std::sin(tilt), 0);
  object.shape = shape_of(solid, normal);
  object.pose.position = -gap * normal;
  if (solid != Solid::wall) {
    object.pose.orientation = Eigen::AngleAxisd(tilt, Vector3d::UnitZ());
    object.pose.position -= 0.5 * kSize * normal;
  }
  object.effects.of<haptics::SpringDamper>() = {stiffness, 0.0};
  return object;
}

}  // namespace

haptics::EffectPlan solids_of(const Scenario& s, const Vector3d& home) {
  haptics::Scene scene;
  if (s[Shared::wall] > 0) {
    scene.objects.push_back(
        object_of("wall", Solid::wall, s[Shared::wall], s[Shared::wall_gap], s[Shared::wall_tilt]));
  }
  if (s[Shared::solid] > 0 && s[Shared::solid_stiffness] > 0) {
    scene.objects.push_back(object_of("solid", static_cast<Solid>(s[Shared::solid]),
                                      s[Shared::solid_stiffness], s[Shared::solid_gap],
                                      s[Shared::solid_tilt]));
  }
  for (haptics::SceneObject& object : scene.objects) object.pose.position += home;
  return haptics::EffectPlan(scene);
}

}  // namespace reckon::fuzz
