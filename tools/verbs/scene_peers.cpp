// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/verbs/scene_peers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <limits>
#include <memory>
#include <string_view>
#include <utility>
#include <variant>

#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/haptics/servo/servo_loop.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/notation/entity_type_text.hpp"
#include "reckon/peer/notation/units.hpp"
#include "reckon/peer/scene/belongings.hpp"
#include "reckon/peer/scene/scene_words.hpp"
#include "reckon/peer/world/shared_bodies.hpp"
#include "reckon/tools/exercise/felt_device.hpp"
#include "reckon/tools/exercise/simulated_hand.hpp"

namespace reckon::tools {
namespace {

using Facts = std::vector<std::pair<std::string, std::string>>;

/// A computed value with three digits.
std::string about(double value, std::string_view unit) {
  if (value == 0 || !std::isfinite(value)) return peer::format_quantity(value, unit);
  const double step = std::pow(10.0, std::floor(std::log10(std::abs(value))) - 2);
  return peer::format_quantity(std::round(value / step) * step, unit);
}

std::string point(const Eigen::Vector3d& p) {
  return fmt::format("[{:.6g}, {:.6g}, {:.6g}] m", p.x(), p.y(), p.z());
}

// --- devices ---

std::string holder_of(const peer::SceneFile& scene, const peer::DeviceConfig& device) {
  if (const peer::Driver* const driver = device.driver)
    return driver->holder != nullptr ? driver->holder(device)
                                     : fmt::format("a person, by {}", driver->article);
  if (scene.operators.empty()) return "a hand at rest";
  const std::size_t count = scene.operators.size();
  const std::size_t index = (device.operator_number - 1) % count;
  const peer::OperatorConfig& config = scene.operators[index];
  if (device.source == peer::DeviceSource::pointer) {
    return fmt::format("a pointer, within {} of the start of operator {}, with a lag of {}",
                       peer::format_quantity(device.reach, "m"), index + 1,
                       peer::format_quantity(haptics::PointerPath::kLag, "s"));
  }
  return fmt::format("operator {}, {}{}{}", index + 1, peer::word_of(config.kind),
                     device.operator_number > count ? ", aside" : "",
                     device.admittance.mass > 0
                         ? fmt::format("; an admittance device with a mass of {}, up to {}",
                                       peer::format_quantity(device.admittance.mass, "kg"),
                                       peer::format_quantity(device.admittance.bandwidth, "Hz"))
                         : "");
}

std::string spring_limits_of(const peer::DeviceConfig& device) {
  const haptics::DeviceLimits limits = device.driver->springs->felt(device)->limits();
  return fmt::format(
      "{}, {}; {} over {}; a change acts {} later", peer::format_quantity(limits.max_force, "N"),
      peer::format_quantity(limits.max_speed, "m/s"), limits.axes == 1 ? "an axis" : "two axes",
      peer::format_quantity(limits.workspace_max.x() - limits.workspace_min.x(), "m"),
      about(pdu::to_seconds(device.driver->springs->change(device)), "s"));
}

std::string limits_of(const peer::DeviceConfig& device) {
  const double period = pdu::to_seconds(device.period);
  return fmt::format(
      "{}{}, {}, {}; {}; a force acts {}", peer::format_quantity(device.max_force, "N"),
      device.continuous_force > 0
          ? fmt::format(" ({} permanently)", peer::format_quantity(device.continuous_force, "N"))
          : "",
      peer::format_quantity(device.max_speed, "m/s"),
      peer::format_quantity(device.damping, "N s/m"), about(1.0 / period, "Hz"),
      device.delay_samples == 0 ? "at once" : about(device.delay_samples * period, "s") + " later");
}

std::string tool_of(const peer::DeviceConfig& device) {
  std::string text =
      fmt::format("six axes: {}, {}; ", peer::format_quantity(device.max_torque, "N m"),
                  peer::format_quantity(device.turn_damping, "N m s/rad"));
  if (device.probes.empty()) return text + "touches with the handle";
  double farthest = 0.0;
  for (const peer::ProbeConfig& probe : device.probes)
    farthest = std::max(farthest, probe.position.norm());
  return text + fmt::format("touches with {} of its tool, up to {} from the handle",
                            device.probes.size() == 1
                                ? "a probe"
                                : fmt::format("{} probes", device.probes.size()),
                            peer::format_quantity(farthest, "m"));
}

haptics::ServoConfig servo_of(const peer::SceneFile& scene, const peer::DeviceConfig& device) {
  haptics::ServoConfig config;
  config.period = device.period;
  config.device_origin = device.position;
  config.device_orientation = device.orientation;
  config.probe_radius = scene.hand.radius;
  config.contact_radius = scene.hand.contact_radius;
  if (device.max_force_rate > 0) config.max_force_rate = device.max_force_rate;
  config.max_received_power = device.received_power;
  config.region_loan = device.regions.loan;
  config.oscillation_power = device.regions.oscillation_power;
  config.oscillation_energy = device.regions.oscillation_energy;
  config.grab = scene.hand.grab;
  config.probes = probes_of(device);
  return config;
}

/// Energy that regions may put into the hand.
std::string sources_of(const peer::DeviceConfig& device) {
  return fmt::format("potentials borrow at most {}; oscillations add at most {}, {} at once",
                     peer::format_quantity(device.regions.loan, "J"),
                     peer::format_quantity(device.regions.oscillation_power, "W"),
                     peer::format_quantity(device.regions.oscillation_energy, "J"));
}

/// Force rate limit of the device, and the requested rate if it is higher.
std::string growth_of(const peer::SceneFile& scene, const peer::DeviceConfig& device) {
  FeltDevice hand(scene, device);
  const haptics::ServoLoop servo(hand.get(), haptics::EffectPlan(), servo_of(scene, device));
  const std::string text = "up to " + about(servo.force_rate_limit(), "N/s");
  if (!(device.max_force_rate > servo.force_rate_limit())) return text;
  return text + fmt::format(" of the requested {}: the rate of its stiffest wall at 1 m/s",
                            peer::format_quantity(device.max_force_rate, "N/s"));
}

/// "; hands as asked": kinds of things that are not softened. Softened ones are listed with their
/// stiffness between peers, see softened_notes().
std::string as_asked(const peer::SceneFile& scene, const peer::DeviceStiffness& can) {
  std::string text;
  const auto note = [&](bool is, std::string_view kind) {
    if (is) text += (text.empty() ? "; " : " and ") + std::string(kind);
  };
  const bool is_body_softer = std::any_of(
      scene.entities.begin(), scene.entities.end(), [&](const peer::EntityConfig& entity) {
        return entity.model &&
               entity.model->k1 > can.bodies * can.left_beside(entity.model->damping);
      });
  const bool has_bodies =
      std::any_of(scene.entities.begin(), scene.entities.end(),
                  [](const peer::EntityConfig& entity) { return entity.model.has_value(); });
  note(can.walls_asked > 0 && !can.softens_walls(), "objects");
  note(can.regions_asked > 0 && !can.softens_regions(), "regions");
  note(!can.softens_hand(), "hands");
  note(has_bodies && !is_body_softer, "entities");
  return text.empty() ? text : text + " as asked";
}

std::string stiffness_of(const peer::SceneFile& scene, const haptics::ServoLoop& servo) {
  const peer::DeviceStiffness can = peer::stiffness_of(servo, scene.hand);
  std::string text = fmt::format("walls up to {}, hands up to {}", about(can.walls, "N/m"),
                                 about(can.hand_limit(), "N/m"));
  if (can.hand_limit() < can.hands)
    text += fmt::format(" with a damper of {}, {} without it",
                        peer::format_quantity(can.damper_shown(scene.hand.damping), "N s/m"),
                        about(can.hands, "N/m"));
  return text + as_asked(scene, can);
}

std::string described_text(const peer::DeviceConfig& device) {
  const peer::DescribedDevice& described = device.described;
  const Eigen::Vector3d size = 1e3 * described.work_space.sizes();
  return fmt::format("{} ({}): {}, dry friction {}, work space {:.4g} x {:.4g} x {:.4g} mm",
                     described.name, std::filesystem::path(device.descriptor).filename().string(),
                     peer::format_quantity(described.mass, "kg"),
                     peer::format_quantity(described.friction, "N"), size.x(), size.y(), size.z());
}

/// Mapping from the handle to the hand; empty: one to one.
std::string mapping_text(const peer::DeviceConfig& device) {
  std::string text;
  const auto add = [&](bool is, const std::string& what) {
    if (is) text += (text.empty() ? "" : "; ") + what;
  };
  add(device.scale != 1.0,
      fmt::format("{:.4g} times as far as the handle, with at most {} in the scene", device.scale,
                  about(device.max_force / device.scale, "N")));
  add(device.left_handed, "left and right are swapped");
  add(device.clutch_button >= 0,
      fmt::format("it stays while button {} is down", device.clutch_button));
  return text;
}

/// How its button holds bodies.
std::string hold_of(const peer::SceneFile& scene, const peer::DeviceConfig& device,
                    const haptics::ServoLoop& servo) {
  if (!(scene.hand.grab.stiffness > 0)) return "no: set grab_stiffness of [hand]";
  std::string text = fmt::format("while button {} is pressed, by {}", device.grab_button,
                                 about(servo.grab_stiffness(), "N/m"));
  if (servo.grab_stiffness() < scene.hand.grab.stiffness)
    text += fmt::format(" of the requested {}: the limit of the device or the lightest body",
                        peer::format_quantity(scene.hand.grab.stiffness, "N/m"));
  if (device.peer > 1) text += "; only bodies that its peer simulates, as owner or as a copy";
  return text;
}

Facts facts_of(const peer::SceneFile& scene, const haptics::EffectPlan& plan,
               const peer::DeviceConfig& device) {
  FeltDevice hand(scene, device);
  const haptics::ServoLoop servo(
      hand.get(), std::make_shared<const haptics::EffectPlan>(plan), servo_of(scene, device),
      haptics::make_bodies(plan, scene.scene,
                           std::make_shared<peer::BodyMover>(plan, scene.nodes)));
  if (peer::renders_springs(device)) {
    return {{"held by", holder_of(scene, device)},
            {"stands at", point(device.position)},
            {"limits", spring_limits_of(device)},
            {"stiffness", "walls, hands and entities up to " +
                              about(servo.static_stiffness_limit(), "N/m") +
                              ", rendered by the device along its axes"}};
  }
  Facts facts = {{"held by", holder_of(scene, device)},
                 {"stands at", point(device.position)},
                 {"limits", limits_of(device)},
                 {"force grows by", growth_of(scene, device)},
                 {"stiffness", stiffness_of(scene, servo)}};
  if (std::ranges::any_of(plan.objects(), &haptics::PlannedObject::is_body))
    facts.push_back({"holds bodies", hold_of(scene, device, servo)});
  if (!scene.scene.regions.empty()) facts.push_back({"regions", sources_of(device)});
  if (device.axes == 6) facts.insert(facts.begin() + 3, {"turns", tool_of(device)});
  if (const std::string text = mapping_text(device); !text.empty())
    facts.insert(facts.begin() + 2, {"hand moves", text});
  if (!device.described.name.empty()) facts.insert(facts.begin(), {"is", described_text(device)});
  return facts;
}

// --- entities ---

std::string motion_of(const peer::EntityConfig& entity, const peer::EntityTrack& track) {
  if (!track.moves()) return "stands at " + point(entity.position);
  const peer::TrackCurve& curve = *track.curve();
  return fmt::format("{}: {} in {}, then {}", entity.track.filename().string(),
                     about(curve.length(), "m"), about(curve.duration() / entity.speed, "s"),
                     curve.repeats() ? "again" : "stays");
}

std::string sending_of(const peer::DeadReckoningConfig& config, bool felt) {
  const auto& thresholds = config.thresholds;
  return fmt::format("when off by {} or {}{}; else every {}",
                     peer::format_quantity(thresholds.position, "m"),
                     peer::format_quantity(thresholds.angle, "rad"),
                     felt ? " or " + peer::format_quantity(thresholds.force, "N") : "",
                     peer::format_quantity(pdu::to_seconds(config.heartbeat), "s"));
}

std::string model_of(const peer::EntityConfig& entity) {
  if (!entity.model) return "nothing: hands pass through it";
  const deadreckon::ForceModel& model = *entity.model;
  const bool round = model.kind != pdu::ForceModelKind::plane;
  return fmt::format("{}{}, {}, {}; gives up to {}", peer::word_of(model.kind),
                     round ? " of " + peer::format_quantity(model.radius, "m") : "",
                     peer::format_quantity(model.k1, "N/m"),
                     peer::format_quantity(model.damping, "N s/m"),
                     peer::format_quantity(entity.power, "W"));
}

Facts facts_of(const peer::EntityConfig& entity, const peer::EntityTrack& track) {
  return {{"type", fmt::format("{} ({})", peer::entity_type_numbers(entity.type),
                               peer::entity_type_words(entity.type))},
          {"motion", motion_of(entity, track)},
          {"sends", sending_of(entity.dead_reckoning, entity.model.has_value())},
          {"felt", model_of(entity)}};
}

/// Objects that can be pushed or are carried, and solids that bodies pass through.
std::vector<PeerFact> body_facts(const haptics::EffectPlan& plan) {
  std::size_t count = 0;
  double least = std::numeric_limits<double>::infinity(), most = 0.0;
  std::size_t carried = 0;
  std::string passed;
  for (const haptics::PlannedObject& object : plan.objects()) {
    if (std::holds_alternative<std::shared_ptr<const haptics::ImplicitSolid>>(object.shape))
      passed += (passed.empty() ? "" : ", ") + object.name;
    carried += object.carried ? 1 : 0;
    if (!object.is_body()) continue;
    ++count;
    least = std::min(least, object.matter.mass);
    most = std::max(most, object.matter.mass);
  }
  std::vector<PeerFact> rows;
  if (carried > 0)
    rows.push_back({1, fmt::format("carried {}", carried), "moved",
                    "by functions of time, at each peer; hands and bodies do not stop them"});
  if (count == 0) return rows;
  const std::string mass = least < most
                               ? fmt::format("{} to {}", peer::format_quantity(least, "kg"),
                                             peer::format_quantity(most, "kg"))
                               : peer::format_quantity(most, "kg");
  rows.push_back({1, fmt::format("bodies {}", count), "mass", mass});
  rows.push_back({1, fmt::format("bodies {}", count), "step",
                  "within the servo steps of its hands; measured above"});
  if (!passed.empty()) rows.push_back({1, fmt::format("bodies {}", count), "go through", passed});
  return rows;
}

void add(std::vector<PeerFact>& rows, std::uint32_t number, const std::string& has, Facts facts) {
  for (auto& [what, how] : facts) rows.push_back({number, has, std::move(what), std::move(how)});
}

}  // namespace

std::vector<PeerFact> peer_facts(const peer::SceneFile& scene, const haptics::EffectPlan& plan) {
  std::vector<PeerFact> rows;
  for (std::uint32_t number = 1; number <= peer::peers_of(scene); ++number) {
    const std::size_t before = rows.size();
    std::size_t count = 0;
    for (const peer::DeviceConfig& device : peer::devices_of(scene, number)) {
      add(rows, number, fmt::format("device {} {}", ++count, device.marking),
          facts_of(scene, plan, device));
    }
    if (number == 1) std::ranges::copy(body_facts(plan), std::back_inserter(rows));
    const auto entities = peer::entities_of(scene, number);
    const auto tracks = peer::tracks_of(entities);
    for (std::size_t i = 0; i < entities.size(); ++i) {
      add(rows, number, fmt::format("entity {} {}", i + 1, entities[i].marking),
          facts_of(entities[i], tracks[i]));
    }
    if (rows.size() == before) rows.push_back({number, "nothing", "", "it only receives"});
  }
  return rows;
}

}  // namespace reckon::tools
