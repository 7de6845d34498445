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
std::string meanings_of(const auto& list) {
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
      {"height", &OriginConfig::height, within("m", -12e3, 1e6), "above the ellipsoid"},
  }};
}

namespace {

Section<haptics::WorkSpace> work_space_section() {
  using haptics::WorkSpace;
  return {{
      {"size", &WorkSpace::size, within("m", 0, kWorld), "edge lengths, all above 0; 0: no box"},
      {"position", &WorkSpace::position, within("m", -kWorld, kWorld), "of its centre, in S"},
      {"restitution", &WorkSpace::restitution, within("", 0, 1),
       "coefficient of a rebound from it"},
  }};
}

Section<SceneFile> scene_section() {
  return {{
      {"name", &SceneFile::name, "for display; when absent, the file name without its extension"},
      {"origin", &SceneFile::origin, origin_section(),
       "origin of the scene's frame S (east, north, up)"},
      {"gravity", in(&SceneFile::scene, &haptics::Scene::gravity), within("m/s2", -100, 100),
       "acceleration of bodies, in S"},
      {"work_space", in(&SceneFile::scene, &haptics::Scene::work_space), work_space_section(),
       "a box that bodies cannot leave; hands do not feel it"},
  }};
}

Section<HandModel> hand_section() {
  const auto grab = [](double haptics::GrabSpring::*member) {
    return in(&HandModel::grab, member);
  };
  return {{
              {"radius", &HandModel::radius, within("m", 1e-4, 1),
               "of the sphere that other hands touch"},
              {"contact_radius", &HandModel::contact_radius, within("m", 0, 1),
               "of the ball that touches objects; 0 is a point"},
              {"patch_radius", &HandModel::patch_radius, within("m", 0, 1),
               "of the contact patch of a soft finger, which resists rotation of held bodies; 0 is "
               "a point"},
              {"grab_stiffness", grab(&haptics::GrabSpring::stiffness), within("N/m", 0, 1e5),
               "of the spring that holds a body while its button is pressed, limited by device and "
               "body; 0: it holds none"},
              {"grab_most", grab(&haptics::GrabSpring::most), declared("N", 1e-3, 1e3),
               "a greater pull tears the body off; absent: it holds any pull"},
              {"grab_viscosity", grab(&haptics::GrabSpring::viscosity), within("N s/m", 0, 100),
               "of that spring"},
              {"k1", &HandModel::k1, within("N/m", 0, 1e6),
               "stiffness; each receiver limits it to that of its device"},
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
       "rotation vector in S of a device of six axes at `to`; none at `from`"},
      {"period", &OperatorConfig::period, within("s", 0.01, 86400),
       "period of the sinusoidal motion"},
      {"grab", &OperatorConfig::grabs, "it holds what it touches on the way to `to`"},
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
           "world or body axes; auto: the one that needs the fewest updates for the present "
           "motion"},
          {"position", threshold(&Thresholds::position), within("m", 1e-6, 1e4),
           "an update is sent if the error of remote copies exceeds this"},
          {"angle", threshold(&Thresholds::angle), within("rad", kPi / 180e3, kPi),
           "the same for the orientation"},
          {"force", threshold(&Thresholds::force), within("N", 1e-4, 1e3),
           "the same for the contact force"},
          {"force_share", threshold(&Thresholds::weber), within("", 0, 1),
           "or this share of the force, if that is larger; people notice 0.07 to 0.1"},
          {"rule", &Config::rule, "meaning of `position`: " + meanings_of(deadreckon::kSendRules)},
          {"acceleration", &Config::acceleration,
           "meaning of the acceleration in rvb: rate of the velocity's body components, or the "
           "acceleration itself in body axes; the same for all peers"},
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
       "curve along which the error of the shown pose goes to zero after an update; cubic has no "
       "step in velocity, quintic none in acceleration"},
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
  return {{
              {"trace", &OperatorConfig::trace,
               "a recorded hand, CSV with t_s,px_m,py_m,pz_m, beside the scene file"},
              {"passive", no_key, "a hand that rests at `position`"},
              {"sweep", std::identity(), sweep_section(),
               "a hand that moves back and forth along a line"},
              {"position", &OperatorConfig::position, within("m", -kWorld, kWorld),
               "passive: its rest position; trace: added to every point"},
              {"speed", &OperatorConfig::speed, within("", 0.01, 100),
               "trace: playback speed; 2 is twice as fast"},
              {"begin", &OperatorConfig::begin, within("s", 0, 86400),
               "trace: start time in the recording; later rounds start at its first point"},
              {"approach", &OperatorConfig::approach, within("m", -kWorld, kWorld),
               "trace: initial offset from the starting point; it moves from there until `start`"},
              {"start", &OperatorConfig::start, within("s", 0, 86400),
               "trace: it rests at its first point until then"},
              {"stiffness", &OperatorConfig::stiffness, within("N/m", 0, 1e5),
               "stiffness of the grip between hand and device"},
              {"damping", &OperatorConfig::damping, within("N s/m", 0, 1e3), "damping of the grip"},
              {"turn_stiffness", &OperatorConfig::turn_stiffness, within("N m/rad", 0, 1e3),
               "rotational stiffness of the grip, for a device of six axes"},
              {"turn_damping", &OperatorConfig::turn_damping, within("N m s/rad", 0, 10),
               "rotational damping of the grip"},
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
          {"object", objects, object_section(),
           "one object to touch; without any, the world is empty"},
          {"node", &SceneFile::node_tables, node_section(),
           "a parent frame of objects and other nodes: docs/scene_graph.md"},
          {"region", regions, region_section(),
           "a part of space, or all of it, that applies a force without contact"},
          {"hand", &SceneFile::hand, hand_section(),
           "the force model of this peer's hand, which other peers feel"},
          {"operator", &SceneFile::operators, operator_section(),
           "one simulated hand per table, and its motion"},
          {"device", devices, device_section(),
           "one device of one peer; in a file without any, each peer has a simulated one"},
          {"entity", entities, entity_section(),
           "an entity without a device: a vehicle, a post, a robot's tip"},
          {"dead_reckoning", &SceneFile::dead_reckoning, dead_reckoning_section(),
           "thresholds of updates, and their extrapolation"},
          {"convergence", &SceneFile::convergence, convergence_section(),
           "convergence of the shown pose after an update"},
          {"aoim", &SceneFile::aoim, aoim_section(),
           "cells, and the radius within which this peer receives"},
          {"network", &SceneFile::network, network_section(), "sending and receiving of this peer"},
          {"impairment", &SceneFile::impairment, impairment_section(),
           "simulated impairment of received datagrams, for tests"},
      },
      check_file};
  return section;
}

}  // namespace reckon::peer
