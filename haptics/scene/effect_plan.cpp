// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/scene/effect_plan.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "reckon/haptics/geometry/implicit_solid.hpp"
#include "reckon/haptics/geometry/surface_contact_point.hpp"
#include "reckon/haptics/geometry/surface_mesh.hpp"
#include "reckon/haptics/input_files/load_budget.hpp"
#include "reckon/haptics/scene/least_mass.hpp"

namespace reckon::haptics {

namespace {

// Greatest excess of a patch's value over the value of the object's own surface.
double most_beyond(const SurfacePatches* patches, double Surface::*member) noexcept {
  double most = 0.0;
  if (patches == nullptr) return most;
  const double own = patches->feel_of(0).surface.*member;
  for (const PlannedPatch& patch : patches->patches) {
    most = std::max(most, patch.feel.surface.*member - own);
  }
  return most;
}

}  // namespace

double PlannedObject::stiffness() const noexcept {
  double sum = most_beyond(patches.get(), &Surface::stiffness);
  effects.for_each([&]<class Effect>(const Effect& effect) {
    if constexpr (StoresEnergy<Effect>) sum += effect.stiffness();
  });
  return sum;
}

Eigen::Vector3d PlannedRegion::beyond(const Eigen::Vector3d& place) const noexcept {
  return std::visit(
      [&](const auto& s) -> Eigen::Vector3d {
        if constexpr (std::is_same_v<std::decay_t<decltype(s)>, std::monostate>) {
          return Eigen::Vector3d::Zero();
        } else {
          return place - s.nearest_inside(place);
        }
      },
      shape);
}

double PlannedRegion::stiffness() const noexcept {
  double sum = 0.0;
  effects.for_each([&]<class Effect>(const Effect& effect) {
    if constexpr (StoresRegionEnergy<Effect>) sum += effect.stiffness();
  });
  return sum;
}

double PlannedObject::damping() const noexcept {
  double sum = most_beyond(patches.get(), &Surface::damping);
  effects.for_each([&]<class Effect>(const Effect& effect) {
    if constexpr (GivesForce<Effect>) sum += effect.damping();
  });
  return sum;
}

namespace {

// Number of objects up to which a linear search is faster than the tree.
constexpr std::size_t kFewObjects = 8;
// Bounds within this distance [m] go into the tree; farther out single precision cannot separate
// them.
constexpr double kFarthestBound = 1e9;

using Eigen::Vector3d;
using MeshPointer = std::shared_ptr<const SurfaceMesh>;
using ImplicitPointer = std::shared_ptr<const ImplicitSolid>;

/// The shapes of one plan. Objects with the same mesh or picture, such as copies, share it.
class ShapeMaker {
 public:
  ContactShape make(const Shape& shape);

 private:
  using Numbers = std::array<double, 4>;
  MeshPointer shared(const std::filesystem::path& file, const Numbers& numbers, auto load) {
    MeshPointer& mesh = meshes_[{file, numbers}];
    if (!mesh) mesh = std::make_shared<const SurfaceMesh>(load());
    return mesh;
  }

  std::map<std::pair<std::filesystem::path, Numbers>, MeshPointer> meshes_;
};

ContactShape ShapeMaker::make(const Shape& shape) {
  return std::visit(
      [this](const auto& s) -> ContactShape {
        using S = std::decay_t<decltype(s)>;
        if constexpr (std::is_same_v<S, PlaneShape>) {
          return HalfSpace(s);
        } else if constexpr (std::is_same_v<S, SphereShape>) {
          return Ball(s);
        } else if constexpr (std::is_same_v<S, BoxShape>) {
          return Block(s);
        } else if constexpr (std::is_same_v<S, MeshShape>) {
          return shared(s.file, {s.scale_to, s.centre ? 1.0 : 0.0},
                        [&] { return SurfaceMesh::load(s); });
        } else if constexpr (std::is_same_v<S, HeightsShape>) {
          return shared(s.file, {s.width, s.length, s.height, s.base},
                        [&] { return SurfaceMesh::load_heights(s); });
        } else {
          return std::make_shared<const ImplicitSolid>(s);
        }
      },
      shape);
}

// Box in S of a placed shape, grown by the clearance.
Eigen::AlignedBox3d place_bounds(const PlannedObject& object) {
  const Eigen::AlignedBox3d local = std::visit(
      [](const auto& s) -> Eigen::AlignedBox3d {
        using S = std::decay_t<decltype(s)>;
        if constexpr (std::is_same_v<S, MeshPointer> || std::is_same_v<S, ImplicitPointer>) {
          return s->bounds();
        } else {
          return s.bounds();
        }
      },
      object.shape);
  if (std::holds_alternative<HalfSpace>(object.shape) || !local.sizes().allFinite()) return local;
  const Vector3d half = object.orientation.cwiseAbs() * (0.5 * local.sizes());
  const Vector3d centre = object.to_scene(local.center());
  const Vector3d margin =
      Vector3d::Constant(4.0 * kRelativeClearance * local.sizes().norm() + 1e-12 * centre.norm());
  return {centre - half - margin, centre + half + margin};
}

template <class Effect>
std::string_view key_of(const Effect& effect) noexcept {
  if constexpr (IsGuarded<Effect>) {
    return effect.effect().key();
  } else {
    return Effect::kKey;
  }
}

// Only one effect may hold the contact point.
void check_one_holder(const PlannedEffects& effects) {
  std::string_view holder;
  effects.for_each([&](const auto& effect) {
    if (!hooks_of(effect).holds) return;
    const std::string_view key = key_of(effect);
    if (!holder.empty()) {
      throw std::invalid_argument(std::string(holder) + " and " + std::string(key) +
                                  " both hold the contact point: declare one of them");
    }
    holder = key;
  });
}

PlannedEffects plan_effects(const SceneObject& object) {
  PlannedEffects effects(object.effects);
  for (const DeclaredCustomEffect& declared : object.custom_effects)
    effects.add(GuardedEffect(declared, object.name));
  check_one_holder(effects);
  return effects;
}

// If only patches have friction, the object still needs the effect that holds the contact point.
void hold_for(const SurfacePatches& patches, PlannedEffects& effects) {
  const bool rough = std::ranges::any_of(patches.patches, [](const PlannedPatch& patch) {
    return patch.feel.friction.static_coefficient > 0.0;
  });
  if (rough && effects.find<StickSlipFriction>() == nullptr) {
    effects.add<StickSlipFriction>(patches.feel_of(0).friction);
    check_one_holder(effects);
  }
}

Eigen::Quaterniond checked_orientation(const ObjectPose& pose) {
  const Eigen::Quaterniond& q = pose.orientation;
  if (!pose.position.allFinite() || !q.coeffs().allFinite() || !(q.norm() > 0.0)) {
    throw std::invalid_argument("pose must be finite, with a non-zero orientation");
  }
  return q.normalized();
}

PlannedObject plan_object(const SceneObject& object, ShapeMaker& shapes) {
  const Eigen::Quaterniond orientation = checked_orientation(object.pose);
  PlannedObject planned{object.name,
                        shapes.make(object.shape),
                        orientation.toRotationMatrix(),
                        object.pose.position,
                        Vector3d::Zero(),
                        {},
                        plan_effects(object),
                        nullptr,
                        object.matter,
                        object.grab,
                        object.carried};
  // A mesh far from its origin has its own axes.
  if (const MeshPointer* mesh = std::get_if<MeshPointer>(&planned.shape)) {
    planned.origin = (*mesh)->origin();
    planned.position += planned.orientation * planned.origin;
    planned.patches = plan_patches(object, **mesh);
    if (planned.patches) hold_for(*planned.patches, planned.effects);
  } else if (!object.patches.empty()) {
    throw std::invalid_argument("only a mesh or a picture has patches: remove them");
  }
  planned.bounds = place_bounds(planned);
  if (planned.matter.mass > 0 && planned.damping() > 0) planned.least_mass = least_mass_of(planned);
  return planned;
}

PlannedRegionEffects plan_effects(const SceneRegion& region) {
  PlannedRegionEffects effects(region.effects);
  for (const DeclaredCustomRegionEffect& declared : region.custom_effects)
    effects.add(GuardedRegionEffect(declared, region.name));
  return effects;
}

PlannedRegion plan_region(const SceneRegion& region) {
  const Eigen::Quaterniond orientation = checked_orientation(region.pose);
  PlannedRegion planned{
      region.name, {}, orientation.toRotationMatrix(), region.pose.position, plan_effects(region)};
  if (!region.shape) {
    for_each_region_effect([&]<class Effect>(std::type_identity<Effect>) {
      if (ActsOutside<Effect> && region.effects.find<Effect>() != nullptr)
        throw std::invalid_argument("a region without a shape has no " + std::string(Effect::kKey) +
                                    ": give it a shape");
    });
    return planned;
  }
  if (const auto* plane = std::get_if<PlaneShape>(&*region.shape)) {
    planned.shape = HalfSpace(*plane);
  } else if (const auto* sphere = std::get_if<SphereShape>(&*region.shape)) {
    planned.shape = Ball(*sphere);
  } else if (const auto* box = std::get_if<BoxShape>(&*region.shape)) {
    planned.shape = Block(*box);
  } else {
    throw std::invalid_argument("a region must be a plane, a sphere, a box, or have no shape");
  }
  return planned;
}

bool acts_outside(const PlannedRegionEffects& effects) {
  bool acts = false;
  effects.for_each([&]<class Effect>(const Effect& effect) {
    if constexpr (std::is_same_v<Effect, GuardedRegionEffect>)
      acts |= !effect.effect().hooks().inside_only;
    else
      acts |= ActsOutside<Effect>;
  });
  return acts;
}

bool is_bounded(const Eigen::AlignedBox3d& box) {
  return box.min().cwiseAbs().maxCoeff() <= kFarthestBound &&
         box.max().cwiseAbs().maxCoeff() <= kFarthestBound;
}

}  // namespace

bool PlannedObject::acts_from_afar() const noexcept {
  bool acts = false;
  effects.for_each([&](const auto& effect) {
    const EffectHookSet hooks = hooks_of(effect);
    acts |= hooks.gives && !hooks.in_contact_only;
  });
  return acts;
}

void PlannedObject::place(const Vector3d& at, const Eigen::Matrix3d& turned) noexcept {
  position = at;
  orientation = turned;
  bounds = place_bounds(*this);
}

EffectPlan::EffectPlan(const Scene& scene) {
  const auto named = [](const char* what, const std::string& name, auto&& plan) {
    const std::string where = std::string(what) + " \"" + name + "\": ";
    try {
      return plan();
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(where + error.what());
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(where + error.what());
    }
  };
  const LoadBudget budget;
  ShapeMaker shapes;
  objects_.reserve(scene.objects.size());
  for (const SceneObject& object : scene.objects)
    objects_.push_back(named("object", object.name, [&] { return plan_object(object, shapes); }));
  regions_.reserve(scene.regions.size());
  for (const SceneRegion& region : scene.regions)
    regions_.push_back(named("region", region.name, [&] { return plan_region(region); }));
  plant_tree();
}

void EffectPlan::plant_tree() {
  std::vector<Eigen::AlignedBox3d> boxes;
  for (std::uint32_t i = 0; i < objects_.size(); ++i) {
    const PlannedObject& object = objects_[i];
    has_moving_ |= object.moves();
    if (object.moves()) continue;
    if (object.acts_from_afar() || !is_bounded(object.bounds)) {
      always_.push_back(i);
    } else {
      in_tree_.push_back(i);
      boxes.push_back(object.bounds);
    }
  }
  if (boxes.size() > kFewObjects) {
    tree_ = BoundingVolumeTree(boxes, 0.0);
    return;
  }
  always_.insert(always_.end(), in_tree_.begin(), in_tree_.end());
  std::ranges::sort(always_);
  in_tree_.clear();
}

bool EffectPlan::has_within(const Eigen::Vector3d& at, double reach) const noexcept {
  const auto is_near = [&](const PlannedRegion& region) {
    const Eigen::Vector3d place = region.orientation.transpose() * (at - region.position);
    return region.beyond(place).norm() <= reach || acts_outside(region.effects);
  };
  bool found = has_moving_ || std::ranges::any_of(regions_, is_near);
  const Eigen::Vector3d room = Eigen::Vector3d::Constant(reach);
  visit_near({at - room, at + room}, [&](std::uint32_t index) {
    const PlannedObject& object = objects_[index];
    found = found || object.acts_from_afar() ||
            distance_below(object.shape, object.to_object(at)) <= reach;
  });
  return found;
}

double EffectPlan::max_stiffness() const noexcept {
  double most = 0.0;
  for (const PlannedObject& object : objects_) {
    most = std::max(most, object.stiffness());
  }
  return most;
}

double EffectPlan::max_region_stiffness() const noexcept {
  double most = 0.0;
  for (const PlannedRegion& region : regions_) most = std::max(most, region.stiffness());
  return most;
}

std::vector<std::shared_ptr<const GuardReport>> EffectPlan::custom_effects() const {
  std::vector<std::shared_ptr<const GuardReport>> reports;
  const auto note = [&]<class Effect>(const Effect& effect) {
    if constexpr (IsGuarded<Effect>) reports.push_back(effect.report());
  };
  for (const PlannedObject& object : objects_) object.effects.for_each(note);
  for (const PlannedRegion& region : regions_) region.effects.for_each(note);
  return reports;
}

}  // namespace reckon::haptics
