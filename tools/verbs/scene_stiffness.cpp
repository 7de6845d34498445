// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/verbs/scene_stiffness.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <set>

#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/haptics/contact/region_share.hpp"
#include "reckon/haptics/servo/servo_loop.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/scene/belongings.hpp"
#include "reckon/peer/world/shared_bodies.hpp"
#include "reckon/tools/exercise/felt_device.hpp"
#include "reckon/tools/exercise/simulated_hand.hpp"
#include "reckon/tools/terminal/json_text.hpp"

namespace reckon::tools {
namespace {

constexpr std::size_t kNamed = 3;  // names listed in a sentence

// "a, b, c and 4 more"
std::string names(const std::set<std::string>& all) {
  std::string text;
  std::size_t named = 0;
  for (const std::string& name : all) {
    if (named == kNamed) return text + fmt::format(" and {} more", all.size() - named);
    text += (named++ == 0 ? "" : ", ") + name;
  }
  return text;
}

std::string device_text(const Softened& row) {
  return fmt::format("{} of peer {}", row.device, row.peer);
}

constexpr double kAlmost = 1.0 - 1e-9;

// Subject of one sentence: things of one kind that the same devices show equally.
struct Group {
  Softened first;
  std::set<std::string> things, devices;
  double most_asked = 0.0;
};

// Greatest velocity-dependent coefficient of its effects, except the damper of its surface [N s/m].
double greatest_drag(const haptics::PlannedObject& object) {
  double most = 0.0;
  object.effects.for_each([&]<class Effect>(const Effect& effect) {
    if constexpr (haptics::GivesForce<Effect> && !haptics::AlwaysThere<Effect>)
      most = std::max(most, effect.damping());
  });
  return most;
}

// Greatest damping of its surface or of any patch [N s/m].
double greatest_damping(const haptics::PlannedObject& object) {
  double most = object.effects.find<haptics::SpringDamper>()->damping();
  if (object.patches == nullptr) return most;
  for (const haptics::PlannedPatch& patch : object.patches->patches)
    most = std::max(most, patch.feel.surface.damping);
  return most;
}

std::string kind_of(const Softened& row) { return row.what.substr(0, row.what.find(' ')); }

std::string sentence(const Group& group, std::size_t devices) {
  const std::string by = group.devices.size() == devices
                             ? (devices == 1 ? "its device" : "every device")
                             : names(group.devices);
  if (group.first.damps && !group.first.is_light) {
    return fmt::format(
        "{} have {}{:.6g} N s/m: {:.6g} N s/m are reserved for them by {}, and the rest is "
        "rendered if the hand's motion supplies its energy; more damping in [[device]] reserves "
        "more",
        names(group.things), group.things.size() == 1 ? "" : "up to ", group.most_asked,
        group.first.shown, by);
  }
  if (group.first.is_light) {
    return fmt::format(
        "{} {} {}{:.6g} N s/m, but {} rendered with {:.6g} N s/m by {}: more would reverse so "
        "light a body within a period; more mass or a higher rate allows more",
        names(group.things), group.things.size() == 1 ? "has" : "have",
        group.things.size() == 1 ? "" : "up to ", group.most_asked,
        group.things.size() == 1 ? "is" : "are", group.first.shown, by);
  }
  const bool beside = group.first.shown < group.first.alone;
  const std::string remedy =
      fmt::format("{}; {}{} in [[device]] allows more",
                  beside ? fmt::format(", {:.6g} N/m without its damper", group.first.alone) : "",
                  beside ? "a weaker damper, " : "",
                  group.first.has_limit ? "a greater max_stiffness"
                                        : "more damping, a higher rate or less delay");
  if (group.first.is_hardening()) {
    return fmt::format(
        "k3 of [hand] is rendered up to a slope of {:.6g} N/m, {:.3g} mm deep, by {}{}",
        group.first.shown, 1e3 * group.first.from, by, remedy);
  }
  return fmt::format("{} {} {:.6g} N/m, but {} rendered with {:.6g} N/m by {}{}",
                     names(group.things), group.things.size() == 1 ? "has" : "have up to",
                     group.most_asked, group.things.size() == 1 ? "is" : "are", group.first.shown,
                     by, remedy);
}

}  // namespace

std::vector<SceneDevice> devices_in(const peer::SceneFile& scene, const haptics::EffectPlan& plan) {
  const auto shared = std::make_shared<const haptics::EffectPlan>(plan);
  std::vector<SceneDevice> devices;
  for (std::uint32_t number = 1; number <= peer::peers_of(scene); ++number) {
    std::size_t count = 0;
    for (const peer::DeviceConfig& device : peer::devices_of(scene, number)) {
      FeltDevice hand(scene, device);
      haptics::ServoConfig config;
      config.period = device.period;
      config.probe_radius = scene.hand.radius;
      config.probes = probes_of(device);
      config.device_origin = device.position;
      config.device_orientation = device.orientation;
      const haptics::ServoLoop servo(
          hand.get(), shared, config,
          haptics::make_bodies(plan, scene.scene,
                               std::make_shared<peer::BodyMover>(plan, scene.nodes)));
      std::string name = fmt::format("device {}", ++count);
      if (!device.marking.empty()) name += " " + device.marking;
      const peer::DeviceStiffness stiffness = peer::stiffness_of(servo, scene.hand);
      const double own = hand.get().limits().max_stiffness;
      devices.push_back({number, std::move(name), stiffness, pdu::to_seconds(config.period),
                         own > 0 && stiffness.walls >= kAlmost * own});
    }
  }
  return devices;
}

std::vector<Softened> softened(const peer::SceneFile& scene, const haptics::EffectPlan& plan,
                               const std::vector<SceneDevice>& devices) {
  std::vector<Softened> rows;
  for (const SceneDevice& device : devices) {
    const peer::DeviceStiffness& can = device.stiffness;
    const std::size_t first = rows.size();
    const auto note = [&](std::string what, double asked, double most, double alone) {
      if (asked > most)
        rows.push_back({device.peer, device.name, std::move(what), most, asked, 0.0, alone});
    };
    for (const haptics::PlannedObject& object : plan.objects())
      note("object " + object.name, object.stiffness(), can.walls, 0.0);
    for (const haptics::PlannedObject& object : plan.objects()) {
      const double kept = haptics::kMostDamperShare * can.damping;
      if (object.damping() > kept)
        rows.push_back({device.peer, device.name, "dampers of " + object.name, kept,
                        object.damping(), 0.0, 0.0, true});
    }
    for (const haptics::PlannedObject& object : plan.objects()) {
      const double most = object.most_viscosity(device.period);
      const auto note_light = [&](std::string what, double asked) {
        if (asked > most)
          rows.push_back({device.peer, device.name, std::move(what), most, asked, 0.0, 0.0, true,
                          false, true});
      };
      note_light("drag of " + object.name, greatest_drag(object));
      note_light("damping of " + object.name, greatest_damping(object));
    }
    for (const haptics::PlannedRegion& region : plan.regions())
      note("region " + region.name, region.stiffness(), haptics::kRegionsOverWalls * can.walls,
           0.0);
    note("hand", can.hand_asked, can.hand_limit(), can.hands);
    if (!can.softens_hand() && std::isfinite(can.straight_from()))
      rows.push_back({device.peer, device.name, "hand", can.hand_limit(), 0.0, can.straight_from(),
                      can.hands});
    for (const peer::EntityConfig& entity : scene.entities) {
      if (!entity.model) continue;
      note("entity " + entity.marking, entity.model->k1,
           can.bodies * can.left_beside(entity.model->damping), can.bodies);
    }
    for (std::size_t i = first; i < rows.size(); ++i) rows[i].has_limit = device.has_limit;
  }
  return rows;
}

std::vector<std::string> softened_notes(const std::vector<Softened>& rows, std::size_t devices) {
  std::vector<Group> groups;
  for (const Softened& row : rows) {
    const auto same = [&](const Group& group) {
      return kind_of(group.first) == kind_of(row) && group.first.shown == row.shown &&
             group.first.is_hardening() == row.is_hardening();
    };
    auto group = std::find_if(groups.begin(), groups.end(), same);
    if (group == groups.end()) group = groups.insert(group, {row, {}, {}, 0.0});
    group->things.insert(row.what);
    group->devices.insert(device_text(row));
    group->most_asked = std::max(group->most_asked, row.asked);
  }
  std::vector<std::string> notes;
  std::transform(groups.begin(), groups.end(), std::back_inserter(notes),
                 [&](const Group& group) { return sentence(group, devices); });
  return notes;
}

void append_softened(std::string& out, const Softened& row) {
  JsonObject object(out);
  object.value("peer", row.peer)
      .text("device", row.device)
      .text("what", row.what)
      .value("shown", fmt::format("{:.6g}", row.shown))
      .value("asked", row.is_hardening() ? "null" : fmt::format("{:.6g}", row.asked))
      .text("unit", row.damps ? "N s/m" : "N/m");
  if (row.is_hardening()) object.value("from_m", fmt::format("{:.6g}", row.from));
  object.end();
}

std::string felt_with(double asked, const std::vector<SceneDevice>& devices) {
  double least = asked, most = 0.0;
  for (const SceneDevice& device : devices) {
    least = std::min(least, device.stiffness.walls);
    most = std::max(most, std::min(asked, device.stiffness.walls));
  }
  if (!(least < asked)) return "";
  if (least == most) return fmt::format("felt with {:.6g} N/m", least);
  return fmt::format("felt with {:.6g} to {:.6g} N/m", least, most);
}

}  // namespace reckon::tools
