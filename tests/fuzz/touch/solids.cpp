// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tests/fuzz/touch/solids.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <type_traits>

namespace reckon::fuzz {
namespace {

using Eigen::Vector3d;

enum class Solid { none, wall, box, pit, tetrahedron };

constexpr double kSize = 0.04;  // [m], of a box
constexpr double kPit = 0.015;  // [m], radius

// Meshes come from files. The file is removed with the process.
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

// A box faces a hand half its size from the object's origin; the side of a wall is at the origin.
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

// Defaults times 0.1 to 10; without a default a hundredth of the maximum takes its place.
template <class Effect>
typename Effect::Parameters values_of(double strength) {
  typename Effect::Parameters values{};
  const double factor = std::pow(10.0, 2.0 * strength - 1.0);
  for (const auto& row : Effect::kParameters) {
    const double plain = row.default_value != 0 ? row.default_value : 0.01 * row.maximum;
    const double value = std::clamp(factor * plain, row.minimum, row.maximum);
    values.*row.field = row.key == "seed" ? std::floor(value) : value;
  }
  return values;
}

// Declares the effect of this row of a list, counted from 1; nothing if it refuses its values.
template <class Types>
void declare(haptics::EffectDeclarations<Types>& effects, std::size_t number, double strength) {
  std::size_t row = 0;
  haptics::for_each_effect<Types>([&]<class Effect>(std::type_identity<Effect>) {
    if constexpr (!haptics::AlwaysThere<Effect>) {
      if (++row != number) return;
      const auto values = values_of<Effect>(strength);
      try {
        static_cast<void>(Effect(values));
      } catch (const std::invalid_argument&) {
        return;
      }
      effects.template declare<Effect>() = values;
    }
  });
}

}  // namespace

haptics::Scene solids_of(const Scenario& s, const Vector3d& home, const haptics::Scene* drawn) {
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
  for (haptics::SceneObject& object : scene.objects) {
    object.pose.position += home;
    declare(object.effects, static_cast<std::size_t>(s[Shared::effect]),
            s[Shared::effect_strength]);
  }
  if (s[Shared::region] > 0) {
    haptics::SceneRegion& region = scene.regions.emplace_back();
    region.name = "region";
    region.shape = haptics::SphereShape{kRegion};
    region.pose.position = home + s[Shared::region_off] * Vector3d::UnitX();
    declare(region.effects, static_cast<std::size_t>(s[Shared::region]),
            s[Shared::region_strength]);
  }
  if (drawn == nullptr) return scene;
  for (const haptics::SceneObject& object : drawn->objects)
    scene.objects.emplace_back(object).pose.position += home;
  for (const haptics::SceneRegion& region : drawn->regions)
    scene.regions.emplace_back(region).pose.position += home;
  return scene;
}

std::optional<test::DrawnTouch> drawn_of(const Scenario& s) {
  const auto seed = static_cast<unsigned>(s[Shared::drawn_seed]);
  switch (static_cast<Drawn>(s[Shared::drawn])) {
    case Drawn::walls:
      return test::DrawnTouch(test::TouchKind::walls, seed);
    case Drawn::effects:
      return test::DrawnTouch(test::TouchKind::effects, seed);
    case Drawn::bodies:
      return test::DrawnTouch(test::TouchKind::bodies, seed);
    default:
      return std::nullopt;
  }
}

}  // namespace reckon::fuzz
