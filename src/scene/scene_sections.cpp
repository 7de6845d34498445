// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/scene/scene_sections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <numbers>
#include <type_traits>

#include "reckon/peer/scene/node_section.hpp"

namespace reckon::peer {
namespace {

constexpr double kPi = std::numbers::pi;

/// "a: what it means; b: ...".
template <typename List>
std::string meanings_of(const List& list) {
  std::string text;
  for (const auto& row : list) {
    text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", row.name, row.meaning);
  }
  return text;
}

}  // namespace

Section<OriginConfig> origin_section() {
  return {{
      {"latitude", &OriginConfig::latitude, within("rad", -kPi / 2, kPi / 2), "geodetic, WGS84"},
      {"longitude", &OriginConfig::longitude, within("rad", -kPi, kPi), "east of Greenwich"},
      {"height", &OriginConfig::height, within("m", -12e3, 1e6), "over the ellipsoid"},
  }};
}

namespace {

Section<haptics::WorkSpace> work_space_section() {
  using haptics::WorkSpace;
  return {{
      {"size", &WorkSpace::size, within("m", 0, kWorld), "all edges above 0, or there is none"},
      {"position", &WorkSpace::position, within("m", -kWorld, kWorld), "of its middle, in S"},
      {"restitution", &WorkSpace::restitution, within("", 0, 1), "of a rebound from it"},
  }};
}

Section<SceneFile> scene_section() {
  return {{
      {"name", &SceneFile::name, "for display; when absent, the file name without its ending"},
      {"origin", &SceneFile::origin, origin_section(),
       "where the scene's frame S (east, north, up) stands"},
      {"gravity", in(&SceneFile::scene, &haptics::Scene::gravity), within("m/s2", -100, 100),
       "what bodies fall by, in S"},
      {"work_space", in(&SceneFile::scene, &haptics::Scene::work_space), work_space_section(),
       "a box that no body leaves; hands do not feel it"},
  }};
}

Section<HandModel> hand_section() {
  const auto grab = [](double haptics::GrabSpring::*member) {
    return in(&HandModel::grab, member);
  };
  return {
      {
          {"radius", &HandModel::radius, within("m", 1e-4, 1), "of the sphere that others touch"},
          {"contact_radius", &HandModel::contact_radius, within("m", 0, 1),
           "of the ball that feels the objects; 0 is a point"},
          {"patch_radius", &HandModel::patch_radius, within("m", 0, 1),
           "of the patch by which it holds bodies against turning, as a soft finger; 0 is a point"},
          {"grab_stiffness", grab(&haptics::GrabSpring::stiffness), within("N/m", 0, 1e5),
           "of the spring by which it holds a body while its button is pressed, as far as device "
           "and body can take it; 0: it holds none"},
          {"grab_most", grab(&haptics::GrabSpring::most), declared("N", 1e-3, 1e3),
           "what pulls harder tears the body off; absent: nothing does"},
          {"grab_viscosity", grab(&haptics::GrabSpring::viscosity), within("N s/m", 0, 100),
           "of that spring"},
          {"k1", &HandModel::k1, within("N/m", 0, 1e6),
           "stiffness; each receiver caps it at what its device can show"},
          {"k3", &HandModel::k3, within("N/m3", 0, 1e13), "hardening: F = k1 d + k3 d^3"},
          {"damping", &HandModel::damping, within("N s/m", 0, 1e4), "along the contact normal"},
          {"static_friction", &HandModel::static_friction, within("", 0, 10),
           "coefficient, at least kinetic_friction"},
          {"kinetic_friction", &HandModel::kinetic_friction, within("", 0, 10),
           "coefficient; 0 is no friction"},
          {"validity", &HandModel::validity, within("s", 12, 65),
           "the force fades out after this time without an update"},
      },
      check_hand};
}

Section<OperatorConfig> sweep_section() {
  return {{
      {"from", &OperatorConfig::from, within("m", -kWorld, kWorld), "one end, in S"},
      {"to", &OperatorConfig::to, within("m", -kWorld, kWorld), "the other end, in S"},
      {"turn", &OperatorConfig::turned, within("rad", -kPi, kPi),
       "how a device of six axes is turned at `to`, about the axis of S of this vector; not at "
       "`from`"},
      {"period", &OperatorConfig::period, within("s", 0.01, 86400), "period, sinusoidal motion"},
      {"grab", &OperatorConfig::grabs, "on the way to `to` it holds what it touches"},
  }};
}

/// The parameters of the sending rules, from each rule's own table.
std::vector<Row<DeadReckoningConfig>> rows_of_rules() {
  std::vector<Row<DeadReckoningConfig>> rows;
  deadreckon::for_each_send_rule([&]<class Rule>(std::type_identity<Rule>) {
    for (const auto& row : Rule::kParameters) {
      rows.push_back({row.key,
                      [field = row.field](DeadReckoningConfig& config) -> double& {
                        return config.thresholds.of<Rule>().*field;
                      },
                      within(row.unit, row.minimum, row.maximum),
                      fmt::format("rule {}: {}", Rule::kName, row.help)});
    }
  });
  return rows;
}

}  // namespace

Section<DeadReckoningConfig> dead_reckoning_section() {
  using Config = DeadReckoningConfig;
  using deadreckon::Thresholds;
  const auto threshold = [](double Thresholds::*member) { return in(&Config::thresholds, member); };
  Section<Config> section{
      {
          {"algorithm", &Config::algorithm,
           "DRM of IEEE 1278.1: F/R without or with rotation, P/V velocity or acceleration, W/B "
           "world or body axes; auto: the one that needs the fewest updates, as the motion goes"},
          {"position", threshold(&Thresholds::position), within("m", 1e-6, 1e4),
           "an update is sent if the error of remote copies exceeds this"},
          {"angle", threshold(&Thresholds::angle), within("rad", kPi / 180e3, kPi),
           "the same for the orientation"},
          {"force", threshold(&Thresholds::force), within("N", 1e-4, 1e3),
           "the same for the contact force"},
          {"force_share", threshold(&Thresholds::weber), within("", 0, 1),
           "or this share of the force, if that is larger; people notice 0.07 to 0.1"},
          {"rule", &Config::rule,
           "how `position` is meant: " + meanings_of(deadreckon::kSendRules)},
          {"acceleration", &Config::acceleration,
           "what peers mean by it in rvb: the rate of the velocity's body components, or the "
           "acceleration itself in body axes; must be the same for all"},
          {"heartbeat", &Config::heartbeat, within("s", 0.1, 60),
           "longest time between two updates; silence for 2.4 times this is a time-out"},
      },
      check_dead_reckoning};
  const auto behind =
      std::ranges::find(section.rows, "rule", [](const auto& row) { return row.key().key; });
  const auto rules = rows_of_rules();
  section.rows.insert(behind + 1, rules.begin(), rules.end());
  return section;
}

namespace {

Section<ConvergenceConfig> convergence_section() {
  using deadreckon::ConvergenceSettings;
  const auto setting = [](auto member) { return in(&ConvergenceConfig::settings, member); };
  return {{
      {"curve", setting(&ConvergenceSettings::curve),
       "how the error of what is shown goes to zero after an update; cubic has no step in "
       "velocity, quintic none in acceleration"},
      {"duration", setting(&ConvergenceSettings::duration),
       within("s", ConvergenceSettings::kLeastDuration, ConvergenceSettings::kMostDuration),
       "duration of convergence; longer is smoother and less accurate"},
      {"longest", setting(&ConvergenceSettings::longest),
       within("s", ConvergenceSettings::kLeastDuration, 10),
       "longest convergence, for large errors, so that the correction looks like motion; if it is "
       "not above `duration`, the duration is fixed"},
      {"teleport_distance", setting(&ConvergenceSettings::teleport_distance),
       within("m", 1e-3, kWorld),
       "a larger error is a discontinuity: the entity is shown at its new position at once"},
      {"teleport_angle", setting(&ConvergenceSettings::teleport_angle),
       within("rad", kPi / 180, kPi), "the same for the orientation; 180 deg is never"},
      {"prediction", &ConvergenceConfig::prediction,
       "the shown pose follows the model of the last update, or the model that predicted the last "
       "updates best; forces always follow the former"},
  }};
}

}  // namespace

Section<OperatorConfig> operator_section() {
  const auto no_key = [](const OperatorConfig&) { return false; };
  return {
      {
          {"trace", &OperatorConfig::trace,
           "a recorded hand, CSV with t_s,px_m,py_m,pz_m, beside the scene file"},
          {"passive", no_key, "a hand that holds still at `position`"},
          {"sweep", std::identity(), sweep_section(),
           "a hand that moves back and forth along a line"},
          {"position", &OperatorConfig::position, within("m", -kWorld, kWorld),
           "passive: where it rests; trace: added to every point"},
          {"speed", &OperatorConfig::speed, within("", 0.01, 100), "trace: 2 plays twice as fast"},
          {"begin", &OperatorConfig::begin, within("s", 0, 86400),
           "trace: where in the recording it begins; later rounds begin at its first point"},
          {"approach", &OperatorConfig::approach, within("m", -kWorld, kWorld),
           "trace: where it is at first, beside the point where it begins; it comes from there "
           "until `start`"},
          {"start", &OperatorConfig::start, within("s", 0, 86400),
           "trace: it rests at its first point until then"},
          {"stiffness", &OperatorConfig::stiffness, within("N/m", 0, 1e5),
           "stiffness of the grip between hand and device"},
          {"damping", &OperatorConfig::damping, within("N s/m", 0, 1e3), "damping of the grip"},
          {"turn_stiffness", &OperatorConfig::turn_stiffness, within("N m/rad", 0, 1e3),
           "the same of a device of six axes, in turning"},
          {"turn_damping", &OperatorConfig::turn_damping, within("N m s/rad", 0, 10),
           "damping of that"},
      },
      check_operator};
}

const Section<SceneFile>& file_section() {
  const auto objects = [](const SceneFile& file) { return file.scene.objects; };
  const auto regions = [](const SceneFile& file) { return file.scene.regions; };
  const auto devices = [](const SceneFile& file) { return file.devices; };
  const auto entities = [](const SceneFile& file) { return file.entities; };
  static const Section<SceneFile> section{
      {
          {"scene", std::identity(), scene_section(), "the world: its name and its place on Earth"},
          {"object", objects, object_section(), "one thing to touch; none is an empty world"},
          {"node", &SceneFile::node_tables, node_section(),
           "a frame that objects and other nodes hang on: docs/scene_graph.md"},
          {"region", regions, region_section(),
           "a part of space, or all of it, in which a device feels a force and touches nothing"},
          {"hand", &SceneFile::hand, hand_section(),
           "the force model of this peer's own hand, which others feel"},
          {"operator", &SceneFile::operators, operator_section(),
           "one simulated hand for each table, and what moves it"},
          {"device", devices, device_section(),
           "one device of one peer; where a file has none, each peer has a simulated one"},
          {"entity", entities, entity_section(),
           "an entity that no device moves: a vehicle, a post, a robot's tip"},
          {"dead_reckoning", &SceneFile::dead_reckoning, dead_reckoning_section(),
           "when updates are sent, and how they are extrapolated"},
          {"convergence", &SceneFile::convergence, convergence_section(),
           "how the shown pose converges after an update"},
          {"aoim", &SceneFile::aoim, aoim_section(), "cells, and how far this peer senses"},
          {"network", &SceneFile::network, network_section(), "how this peer sends and receives"},
          {"impairment", &SceneFile::impairment, impairment_section(),
           "simulated impairment of received datagrams, for tests"},
      },
      check_file};
  return section;
}

}  // namespace reckon::peer
