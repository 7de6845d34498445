// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/scene/scene_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <numbers>
#include <type_traits>
#include <utility>

#include "reckon/deadreckon/motion/convergence.hpp"
#include "reckon/deadreckon/sending/send_rules.hpp"
#include "reckon/haptics/effects/effect_types.hpp"
#include "reckon/peer/scene/units.hpp"

namespace reckon::peer {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kWorld = 1e6;  // [m] beyond which a local tangent frame makes no sense

SceneKey table(std::string section, std::string key, std::string sentence) {
  return {std::move(section), std::move(key), KeyKind::table, "", 0, 0, "", std::move(sentence)};
}

SceneKey tables(std::string section, std::string key, std::string sentence) {
  return {std::move(section), std::move(key), KeyKind::tables, "", 0, 0, "", std::move(sentence)};
}

SceneKey number(std::string section, std::string key, std::string unit, double least, double most,
                std::string standard, std::string sentence) {
  return {std::move(section),  std::move(key),     KeyKind::number, std::move(unit), least, most,
          std::move(standard), std::move(sentence)};
}

SceneKey integer(std::string section, std::string key, double least, double most,
                 std::string standard, std::string sentence) {
  return {std::move(section),  std::move(key),     KeyKind::integer, "", least, most,
          std::move(standard), std::move(sentence)};
}

SceneKey boolean(std::string section, std::string key, std::string standard, std::string sentence) {
  return {std::move(section),  std::move(key),     KeyKind::boolean, "", 0, 0,
          std::move(standard), std::move(sentence)};
}

SceneKey text(std::string section, std::string key, std::string standard, std::string sentence) {
  return {std::move(section),  std::move(key),     KeyKind::text, "", 0, 0,
          std::move(standard), std::move(sentence)};
}

SceneKey choice(std::string section, std::string key, std::string words, std::string standard,
                std::string sentence) {
  return {std::move(section),  std::move(key),      KeyKind::choice, "", 0, 0,
          std::move(standard), std::move(sentence), std::move(words)};
}

SceneKey point(std::string section, std::string key, std::string unit, double most,
               std::string standard, std::string sentence) {
  return {std::move(section),  std::move(key),     KeyKind::point, std::move(unit), -most, most,
          std::move(standard), std::move(sentence)};
}

using Keys = std::vector<SceneKey>;

void add_file(Keys& keys) {
  keys.push_back(table("", "scene", "the world: its name and its place on Earth"));
  keys.push_back(tables("", "object", "one thing to touch; none is an empty world"));
  keys.push_back(table("", "hand", "the force model of this peer's own hand, which others feel"));
  keys.push_back(tables("", "operator", "one simulated hand each; what moves it"));
  keys.push_back(table("", "dead_reckoning", "how far remote copies may be off"));
  keys.push_back(table("", "convergence", "how this peer shows what updates correct"));
  keys.push_back(table("", "aoim", "cells, and how far this peer senses"));
  keys.push_back(table("", "network", "where and how this peer speaks"));
  keys.push_back(table("", "impairment", "seeded damage to what this peer hears, for trying out"));
}

void add_scene(Keys& keys) {
  keys.push_back(
      text("scene", "name", "", "for people; the file's name without its ending when absent"));
  keys.push_back(table("scene", "origin", "where the scene's frame S (east, north, up) stands"));
  keys.push_back(
      number("scene.origin", "latitude", "rad", -kPi / 2, kPi / 2, "0 deg", "geodetic, WGS84"));
  keys.push_back(
      number("scene.origin", "longitude", "rad", -kPi, kPi, "0 deg", "east of Greenwich"));
  keys.push_back(number("scene.origin", "height", "m", -12e3, 1e6, "0 m", "over the ellipsoid"));
}

void add_object(Keys& keys) {
  keys.push_back(text("object", "name", "", "required; unlike all others"));
  keys.push_back(text("object", "mesh", "", "an OBJ, PLY, STL or OFF file beside the scene file"));
  keys.push_back(
      point("object", "plane", "", 1e6, "", "a half-space; its outward normal, as [0, 0, 1]"));
  keys.push_back(number("object", "sphere", "m", 1e-4, 1e3, "", "radius of a sphere"));
  keys.push_back(point("object", "box", "m", 1e3, "", "edge lengths of a box about its centre"));
  keys.push_back(
      number("object", "scale_to", "m", 1e-4, 1e3, "",
             "mesh: the diagonal of its bounding box becomes this; metres as drawn when absent"));
  keys.push_back(boolean("object", "centre", "false",
                         "mesh: the middle of its bounding box becomes its origin"));
  keys.push_back(point("object", "position", "m", kWorld, "[0, 0, 0]", "of its origin in S"));
  keys.push_back(point("object", "orientation", "rad", 4 * kPi, "[0, 0, 0]",
                       "turned about S's x, then y, then z axis"));
}

/// "Higher sticks longer." as the other rows are written.
std::string as_row(std::string_view sentence) {
  std::string row(sentence);
  if (row.ends_with('.')) row.pop_back();
  if (!row.empty()) row[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(row[0])));
  return row;
}

/// What the effects say of themselves.
void add_effects(Keys& keys) {
  haptics::for_each_effect([&]<class Effect>(std::type_identity<Effect>) {
    keys.push_back(table("object", std::string(Effect::kKey),
                         fmt::format("the effect {}; costs {}", Effect::kName, Effect::kCost)));
  });
  haptics::for_each_effect([&]<class Effect>(std::type_identity<Effect>) {
    for (const auto& row : Effect::kParameters) {
      keys.push_back(number("object." + std::string(Effect::kKey), std::string(row.key),
                            std::string(row.unit), row.minimum, row.maximum,
                            format_quantity(row.default_value, row.unit), as_row(row.help)));
    }
  });
}

void add_hand(Keys& keys) {
  keys.push_back(
      number("hand", "radius", "m", 1e-4, 1, "20 mm", "of the sphere that others touch"));
  keys.push_back(number("hand", "k1", "N/m", 0, 1e6, "800 N/m",
                        "stiffness; each receiver caps it at what its device can show"));
  keys.push_back(number("hand", "k3", "N/m3", 0, 1e13, "0 N/m3", "hardening: F = k1 d + k3 d^3"));
  keys.push_back(number("hand", "damping", "N s/m", 0, 1e4, "2 N s/m", "along the contact normal"));
  keys.push_back(number("hand", "static_friction", "", 0, 10, "0.4",
                        "coefficient, at least kinetic_friction"));
  keys.push_back(
      number("hand", "kinetic_friction", "", 0, 10, "0.3", "coefficient; 0 is no friction"));
  keys.push_back(number("hand", "validity", "s", 12, 65, "12 s",
                        "after so long without an update the force fades out"));
}

void add_operator(Keys& keys) {
  keys.push_back(text("operator", "trace", "",
                      "a recorded hand, CSV with t_s,px_m,py_m,pz_m, beside the scene file"));
  keys.push_back(boolean("operator", "passive", "false", "a hand that holds still at `position`"));
  keys.push_back(table("operator", "sweep", "a hand that goes to and fro along a line"));
  keys.push_back(point("operator", "position", "m", kWorld, "[0, 0, 0]",
                       "passive: where it rests; trace: added to every point"));
  keys.push_back(number("operator", "speed", "", 0.01, 100, "1", "trace: 2 plays twice as fast"));
  keys.push_back(
      number("operator", "start", "s", 0, 86400, "0 s", "rests at its first point until then"));
  keys.push_back(number("operator", "stiffness", "N/m", 0, 1e5, "300 N/m",
                        "of the grip between hand and device"));
  keys.push_back(number("operator", "damping", "N s/m", 0, 1e3, "3 N s/m", "of the grip"));
  keys.push_back(point("operator.sweep", "from", "m", kWorld, "[0, 0, 0]", "one end, in S"));
  keys.push_back(point("operator.sweep", "to", "m", kWorld, "[0, 0, 0]", "the other end, in S"));
  keys.push_back(number("operator.sweep", "period", "s", 0.01, 86400, "2 s",
                        "there and back, a sine in time"));
}

/// "a b c" of a list whose rows have names.
template <typename List>
std::string names_of(const List& list) {
  std::string words;
  for (const auto& row : list) words += (words.empty() ? "" : " ") + std::string(row.name);
  return words;
}

/// "a: what it means; b: ...".
template <typename List>
std::string meanings_of(const List& list) {
  std::string text;
  for (const auto& row : list) {
    text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", row.name, row.meaning);
  }
  return text;
}

void add_dead_reckoning(Keys& keys) {
  const std::string section = "dead_reckoning";
  keys.push_back(choice(section, "algorithm", "auto static fpw rpw rvw fvw fpb rpb rvb fvb", "auto",
                        "DRM of IEEE 1278.1: F/R without or with rotation, P/V velocity or "
                        "acceleration, W/B world or body axes; auto: the one that needs the fewest "
                        "updates, as the motion goes"));
  keys.push_back(number(section, "position", "m", 1e-6, 1e4, "500 um",
                        "an update goes out when copies are off by more"));
  keys.push_back(
      number(section, "angle", "rad", kPi / 180e3, kPi, "3 deg", "the same for the orientation"));
  keys.push_back(
      number(section, "force", "N", 1e-4, 1e3, "50 mN", "the same for the contact force"));
  keys.push_back(number(section, "force_share", "", 0, 1, "0",
                        "or by more than this share of the force, where that is more; people "
                        "notice 0.07 to 0.1"));
  keys.push_back(choice(section, "rule", names_of(deadreckon::kSendRules), "true_distance",
                        "how `position` is meant: " + meanings_of(deadreckon::kSendRules)));
  deadreckon::for_each_send_rule([&]<class Rule>(std::type_identity<Rule>) {
    for (const auto& row : Rule::kParameters) {
      keys.push_back(number(section, std::string(row.key), std::string(row.unit), row.minimum,
                            row.maximum, format_quantity(row.default_value, row.unit),
                            fmt::format("rule {}: {}", Rule::kName, row.help)));
    }
  });
  keys.push_back(choice(section, "acceleration", "component inertial", "component",
                        "what peers mean by it in rvb: the rate of the velocity's body components, "
                        "or the acceleration itself in body axes; must be the same for all"));
  keys.push_back(number(section, "heartbeat", "s", 0.1, 60, "5 s",
                        "an update at least so often; silence for 2.4 of these is a time-out"));
}

void add_convergence(Keys& keys) {
  const std::string section = "convergence";
  keys.push_back(choice(section, "curve", names_of(deadreckon::kConvergenceCurves), "cubic",
                        "how the error of what is shown goes to zero after an update; cubic has no "
                        "step in velocity, quintic none in acceleration"));
  keys.push_back(number(section, "duration", "s", 0.02, 2, "100 ms",
                        "in this time; longer is smoother and wrong for longer"));
  keys.push_back(number(section, "longest", "s", 0.02, 10, "1 s",
                        "a large error takes up to this, so that its correction looks like motion; "
                        "at most `duration` is a fixed time"));
  keys.push_back(number(section, "teleport_distance", "m", 1e-3, kWorld, "10 m",
                        "what is off by more was moved on purpose: shown there at once"));
  keys.push_back(number(section, "teleport_angle", "rad", kPi / 180, kPi, "180 deg",
                        "the same for the orientation; 180 deg is never"));
  keys.push_back(choice(section, "prediction", "as_sent adaptive", "as_sent",
                        "what is shown follows the model of the last update, or what predicted the "
                        "last updates best; forces always follow the model"));
}

void add_aoim(Keys& keys) {
  keys.push_back(choice("aoim", "scheme", "square hexagonal", "hexagonal", "shape of the cells"));
  keys.push_back(number("aoim", "cell", "m", 0.01, kWorld, "1 m",
                        "side of a square, corner radius of a hexagon"));
  keys.push_back(number("aoim", "radius", "m", 0.01, kWorld, "2 m", "how far this peer senses"));
  keys.push_back(integer("aoim", "pool", 1, 65535, "256", "multicast groups after the base group"));
}

void add_network(Keys& keys) {
  keys.push_back(text("network", "group", "239.192.1.0", "base group, IPv4 or IPv6"));
  keys.push_back(integer("network", "port", 1, 65535, "3000", "UDP port"));
  keys.push_back(boolean("network", "interop", "false",
                         "plain DIS to the base group, for other DIS programs"));
  keys.push_back(integer("network", "exercise", 1, 255, "1", "DIS exercise; others are not heard"));
  keys.push_back(integer("network", "ttl", 1, 255, "1", "hops; 1 stays on this LAN"));
  keys.push_back(text(
      "network", "iface", "",
      "interface name or address; when absent, chosen by the rule that `reckon doctor` shows"));
  keys.push_back(table("network", "bundle", "many PDUs in one datagram"));
  keys.push_back(number("network.bundle", "max", "B", 256, 9216, "1288 B",
                        "payload of a datagram, headers of IP and UDP not counted"));
  keys.push_back(number("network.bundle", "hold", "s", 0, 1, "0 ms",
                        "a pose that is off or due waits so long for company; events and forces "
                        "leave at once"));
}

void add_impairment(Keys& keys) {
  const std::string section = "impairment";
  keys.push_back(number(section, "delay", "s", 0, 10, "0 ms", "one way"));
  keys.push_back(number(section, "jitter", "s", 0, 10, "0 ms",
                        "delay varies uniformly by so much either way"));
  keys.push_back(
      number(section, "loss", "", 0, 1, "0", "share of datagrams lost, each for itself"));
  keys.push_back(
      number(section, "burst_loss", "", 0, 0.999, "0", "share of datagrams lost in bursts"));
  keys.push_back(
      number(section, "burst_length", "", 1, 1e4, "1", "mean datagrams in such a burst"));
  keys.push_back(number(section, "reorder", "", 0, 1, "0", "share of datagrams held back"));
  keys.push_back(number(section, "reorder_delay", "s", 0, 10, "5 ms", "for so long"));
  keys.push_back(number(section, "duplicate", "", 0, 1, "0", "share of datagrams that come twice"));
  keys.push_back(
      integer(section, "seed", 0, 9007199254740992.0, "1", "equal seeds give equal damage"));
  keys.push_back(tables(section, "outage", "a time in which nothing passes"));
  keys.push_back(
      number("impairment.outage", "start", "s", 0, 1e9, "0 s", "after the start of the run"));
  keys.push_back(number("impairment.outage", "duration", "s", 0, 1e9, "0 s", "how long"));
  keys.push_back(
      number("impairment.outage", "period", "s", 0, 1e9, "0 s", "again each such time; 0 is once"));
}

/// "number" as a person would say it.
std::string quantity_name(std::string_view unit) {
  if (unit.empty()) return "number";
  return fmt::format("number [{}]", unit);
}

Keys make_keys() {
  Keys keys;
  for (const auto add :
       {add_file, add_scene, add_object, add_effects, add_hand, add_operator, add_dead_reckoning,
        add_convergence, add_aoim, add_network, add_impairment}) {
    add(keys);
  }
  return keys;
}

/// "1 mm to 1 m", or nothing where there is no range to tell.
std::string range_of(const SceneKey& key) {
  if (key.kind == KeyKind::integer) return fmt::format("{:.0f} to {:.0f}", key.least, key.most);
  if (key.kind != KeyKind::number) return {};
  return fmt::format("{} to {}", format_quantity(key.least, key.unit),
                     format_quantity(key.most, key.unit));
}

std::string heading_of(const Keys& keys, const std::string& section) {
  if (section.empty()) return "The file";
  const bool repeated = std::ranges::any_of(keys, [&](const SceneKey& key) {
    return key.kind == KeyKind::tables &&
           (key.section.empty() ? key.key : key.section + '.' + key.key) == section;
  });
  return repeated ? "`[[" + section + "]]`" : "`[" + section + "]`";
}

}  // namespace

const std::vector<SceneKey>& scene_keys() {
  static const Keys keys = make_keys();
  return keys;
}

std::string describe_kind(const SceneKey& key) {
  switch (key.kind) {
    case KeyKind::number:
      return quantity_name(key.unit);
    case KeyKind::integer:
      return "whole number";
    case KeyKind::boolean:
      return "true or false";
    case KeyKind::text:
      return "text";
    case KeyKind::choice:
      return "one of " + key.words;
    case KeyKind::point:
      return key.unit.empty() ? "three numbers" : fmt::format("three numbers [{}]", key.unit);
    case KeyKind::table:
      return "table";
    case KeyKind::tables:
      break;
  }
  return "tables, any number";
}

std::string scene_keys_markdown() {
  std::string text;
  const Keys& keys = scene_keys();
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const SceneKey& key = keys[i];
    if (i == 0 || keys[i - 1].section != key.section) {
      text += fmt::format(
          "{}### {}\n\n| key | value | range | default | meaning |\n"
          "|---|---|---|---|---|\n",
          i == 0 ? "" : "\n", heading_of(keys, key.section));
    }
    text += fmt::format("| `{}` | {} | {} | {} | {} |\n", key.key, describe_kind(key),
                        range_of(key), key.standard, key.sentence);
  }
  return text;
}

}  // namespace reckon::peer
