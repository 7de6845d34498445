// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/scene/effect_plan.hpp"

#include <algorithm>
#include <cstdio>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string_view>
#include <type_traits>
#include <utility>

#include "reckon/haptics/geometry/implicit_solid.hpp"
#include "reckon/haptics/geometry/surface_mesh.hpp"

namespace reckon::haptics {

namespace {

// Greatest excess of a patch's value over that of the object's own surface.
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

ContactShape make_shape(const Shape& shape) {
  return std::visit(
      [](const auto& s) -> ContactShape {
        using S = std::decay_t<decltype(s)>;
        if constexpr (std::is_same_v<S, PlaneShape>) {
          return HalfSpace(s);
        } else if constexpr (std::is_same_v<S, SphereShape>) {
          return Ball(s);
        } else if constexpr (std::is_same_v<S, BoxShape>) {
          return Block(s);
        } else if constexpr (std::is_same_v<S, MeshShape>) {
          return std::make_shared<const SurfaceMesh>(SurfaceMesh::load(s));
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

// Only one effect may hold the contact point.
void check_one_holder(const PlannedEffects& effects) {
  std::string_view holder;
  effects.for_each([&]<class Effect>(const Effect&) {
    if constexpr (HoldsContactPoint<Effect>) {
      if (!holder.empty()) {
        throw std::invalid_argument(std::string(holder) + " and " + std::string(Effect::kKey) +
                                    " both hold the contact point; declare one of them");
      }
      holder = Effect::kKey;
    }
  });
}

PlannedEffects plan_effects(const DeclaredEffects& declared) {
  const PlannedEffects effects =
      PlannedEffects::filled([&]<class Effect>(std::type_identity<Effect>) {
        using Slot = PlannedEffects::Slot<Effect>;
        const typename Effect::Parameters* parameters = declared.find<Effect>();
        if constexpr (AlwaysThere<Effect>) {
          return Slot(*parameters);
        } else {
          return parameters == nullptr ? Slot() : Slot(std::in_place, *parameters);
        }
      });
  check_one_holder(effects);
  return effects;
}

// If only patches have friction, the object still needs the effect that holds the contact point.
void hold_for(const SurfacePatches& patches, PlannedEffects& effects) {
  auto& friction = effects.of<StickSlipFriction>();
  const bool rough = std::ranges::any_of(patches.patches, [](const PlannedPatch& patch) {
    return patch.feel.friction.static_coefficient > 0.0;
  });
  if (rough && !friction) friction.emplace(patches.feel_of(0).friction);
}

PlannedObject plan_object(const SceneObject& object) {
  const Eigen::Quaterniond& q = object.pose.orientation;
  if (!object.pose.position.allFinite() || !q.coeffs().allFinite() || !(q.norm() > 0.0)) {
    throw std::invalid_argument("pose must be finite, with an orientation that is not zero");
  }
  PlannedObject planned{object.name,
                        make_shape(object.shape),
                        q.normalized().toRotationMatrix(),
                        object.pose.position,
                        {},
                        plan_effects(object.effects),
                        nullptr};
  // A mesh whose vertices are far from its origin has axes of its own.
  if (const MeshPointer* mesh = std::get_if<MeshPointer>(&planned.shape)) {
    planned.position += planned.orientation * (*mesh)->origin();
    planned.patches = plan_patches(object, **mesh);
    if (planned.patches) hold_for(*planned.patches, planned.effects);
  } else if (!object.patches.empty()) {
    throw std::invalid_argument("only a mesh has patches; take them out");
  }
  planned.bounds = place_bounds(planned);
  return planned;
}

bool acts_from_afar(const PlannedEffects& effects) {
  bool acts = false;
  effects.for_each([&]<class Effect>(const Effect&) {
    acts |= GivesForce<Effect> && !ActsInContactOnly<Effect>;
  });
  return acts;
}

bool is_bounded(const Eigen::AlignedBox3d& box) {
  return box.min().cwiseAbs().maxCoeff() <= kFarthestBound &&
         box.max().cwiseAbs().maxCoeff() <= kFarthestBound;
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

template <class Effect>
PlanStage effect_stage(const std::string& object, const Effect& effect) {
  PlanStage stage{std::string(Effect::kName), object, {}, std::string(Effect::kCost)};
  for (const auto& row : Effect::kParameters) {
    std::string& text = stage.parameters;
    if (!text.empty()) text.append(", ");
    text.append(row.key).append(" ").append(number(effect.parameters().*row.field));
    if (!row.unit.empty()) text.append(" ").append(row.unit);
  }
  return stage;
}

PlanStage contact_stage(const PlannedObject& object) {
  if (const auto* implicit = std::get_if<ImplicitPointer>(&object.shape)) {
    const std::size_t count = (*implicit)->function().leaves();
    return {"contact", object.name, (*implicit)->what(),
            count == 1 ? std::string("signed function")
                       : "linear in " + std::to_string(count) + " signed functions"};
  }
  const MeshPointer* mesh = std::get_if<MeshPointer>(&object.shape);
  if (mesh == nullptr) {
    constexpr const char* kNames[] = {"plane", "sphere", "box"};
    return {"contact", object.name, kNames[object.shape.index()], "closed form"};
  }
  const MeshReport& report = (*mesh)->report();
  return {"contact", object.name,
          (report.closed ? "closed mesh" : "open mesh, both sides felt") + std::string(", size ") +
              length_text((*mesh)->size()),
          "logarithmic in " + std::to_string(report.triangles) + " triangles"};
}

PlanStage patch_stage(const std::string& object, const PlannedPatch& patch, std::size_t id) {
  const Surface& surface = patch.feel.surface;
  const Friction& friction = patch.feel.friction;
  return {"patch", object,
          "\"" + patch.name + "\", number " + std::to_string(id) + ", stiffness " +
              number(surface.stiffness) + " N/m, damping " + number(surface.damping) +
              " N s/m, friction " + number(friction.static_coefficient) + " and " +
              number(friction.kinetic_coefficient),
          "two lags, where touched"};
}

}  // namespace

EffectPlan::EffectPlan(const Scene& scene) {
  objects_.reserve(scene.objects.size());
  for (const SceneObject& object : scene.objects) {
    try {
      objects_.push_back(plan_object(object));
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument("object \"" + object.name + "\": " + error.what());
    } catch (const std::runtime_error& error) {
      throw std::runtime_error("object \"" + object.name + "\": " + error.what());
    }
  }
  plant_tree();
}

void EffectPlan::plant_tree() {
  std::vector<Eigen::AlignedBox3d> boxes;
  for (std::uint32_t i = 0; i < objects_.size(); ++i) {
    const PlannedObject& object = objects_[i];
    if (acts_from_afar(object.effects) || !is_bounded(object.bounds)) {
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
  always_.resize(objects_.size());
  std::iota(always_.begin(), always_.end(), 0u);
  in_tree_.clear();
}

bool EffectPlan::has_within(const Eigen::Vector3d& at, double reach) const noexcept {
  bool found = false;
  const Eigen::Vector3d room = Eigen::Vector3d::Constant(reach);
  visit_near({at - room, at + room}, [&](std::uint32_t index) {
    const PlannedObject& object = objects_[index];
    found = found || acts_from_afar(object.effects) ||
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

std::vector<PlanStage> EffectPlan::stages() const {
  std::vector<PlanStage> stages;
  for (const PlannedObject& object : objects_) {
    stages.push_back(contact_stage(object));
    for (std::size_t id = 1; object.patches && id < object.patches->patches.size(); ++id) {
      stages.push_back(patch_stage(object.name, object.patches->patches[id], id));
    }
    for (int turn = 0; turn < kTurns; ++turn) {
      object.effects.for_each([&]<class Effect>(const Effect& effect) {
        if (kTurn<Effect> == turn) stages.push_back(effect_stage(object.name, effect));
      });
    }
  }
  return stages;
}

}  // namespace reckon::haptics
