// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/inspect/top/columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <numeric>

#include "reckon/pdu/seconds.hpp"
#include "reckon/tools/inspect/output/format.hpp"

namespace reckon::tools {
namespace {

using Cell = TopCell;
constexpr auto kLeft = TextTable::Align::left;
constexpr auto kRight = TextTable::Align::right;
constexpr double kMedian = 0.5;
constexpr double kTail = 0.99;

std::string lower(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return out;
}

std::string number(double value) { return json_number(value); }
std::string truth(bool value) { return value ? "true" : "false"; }

/// The domain of a platform, "haptic" for an entity with a force model, else the kind.
std::string kind(const Cell& cell) {
  if (cell.entity.is_haptic()) return "haptic";
  if (!cell.entity.has_state) return "-";
  const pdu::EntityType type = cell.entity.entity_state().entity_type;
  const bool platform = type.kind == pdu::EntityKind::platform;
  const std::string_view named = platform ? pdu::name(type.domain) : pdu::name(type.kind);
  if (!named.empty()) return lower(named);
  return platform ? fmt::format("domain {}", static_cast<unsigned>(type.domain))
                  : fmt::format("kind {}", static_cast<unsigned>(type.kind));
}

/// "4 RVW".
std::string drm(const Cell& cell) {
  if (!cell.entity.has_state) return "-";
  const auto algorithm = cell.entity.entity_state().dead_reckoning.algorithm;
  std::string_view named = pdu::name(algorithm);
  if (named.starts_with("DRM ")) named.remove_prefix(4);
  return fmt::format("{} {}", static_cast<unsigned>(algorithm), lower(named));
}

std::string percentile(const Cell& cell, double share) {
  if (cell.row.jumps.count() == 0) return "-";
  return distance_text(cell.row.jumps.percentile(share));
}

/// The same for the orientation.
std::string turn(const Cell& cell, double degrees) {
  return cell.row.turns.count() == 0 ? "-" : angle_text(degrees);
}

/// Seconds from the first datagram to the greatest jump.
double worst_at(const Cell& cell) {
  return pdu::to_seconds(cell.row.worst_time - cell.table.start());
}

std::string age(const Cell& cell) {
  const double seconds = cell.entity.age(cell.now);
  if (seconds < 100) return fmt::format("{:.1f}s", std::max(seconds, 0.0));
  return seconds < 6000 ? fmt::format("{:.0f}m", seconds / 60)
                        : fmt::format("{:.0f}h", seconds / 3600);
}

std::string endpoint(const peer::IpEndpoint& endpoint) {
  return endpoint.is_unspecified() ? "-" : endpoint.text();
}

/// "2.31 N  k1 500 N/m  b 4 N s/m  mu 0.3/0.2  r 10 mm".
void append_force(std::string& out, const Cell& cell) {
  const ReceivedModel* received = cell.table.listener().model_of(cell.entity);
  if (received == nullptr) return;
  const deadreckon::ForceModel& model = received->model;
  const auto to = std::back_inserter(out);
  fmt::format_to(to, "{:.2f} N  k1 {:g}", cell.table.contact_force(cell.entity, cell.now),
                 model.k1);
  if (model.k3 != 0) fmt::format_to(to, "  k3 {:g}", model.k3);
  if (model.damping != 0) fmt::format_to(to, "  b {:g}", model.damping);
  fmt::format_to(to, "  mu {:.3g}/{:.3g}  r {}", model.static_friction, model.kinetic_friction,
                 distance_text(model.radius));
  const JumpHistogram* jumps = cell.table.force_jumps(cell.entity);
  if (jumps->count() > 0) fmt::format_to(to, "  jump p99 {:.2g} N", jumps->percentile(kTail));
}

/// Important states of the entity besides the numbers.
void append_state(std::string& out, const Cell& cell) {
  const auto item = [&](std::string_view text) {
    if (!out.empty()) out += "  ";
    out += text;
  };
  const EntityRow& row = cell.row;
  if (row.last_is_bad)
    item(fmt::format("last PDU bad: {}", row.rule));
  else if (row.bad > 0)
    item(fmt::format("{} bad, the last {}", row.bad, row.rule));
  if (row.late > 0) item(fmt::format("{} late", row.late));
  if (row.duplicated > 0) item(fmt::format("{} twice", row.duplicated));
}

std::string remarks(const Cell& cell) {
  std::string text;
  append_force(text, cell);
  append_state(text, cell);
  return text;
}

/// Cause of the last update, or a note that updates have stopped.
std::string why(const Cell& cell) {
  if (cell.entity.gone) return "gone";
  if (cell.entity.is_silent(cell.now)) return "STALE";
  return cell.row.cause == UpdateCause::none ? "-" : std::string(name(cell.row.cause));
}

/// The PDU of the last update, for members that need it.
pdu::EntityState state(const Cell& cell) { return cell.entity.entity_state(); }

template <auto Get>
std::string of_state(const Cell& cell) {
  if (!cell.entity.has_state) return "";
  return fmt::format("{}", static_cast<unsigned>(Get(state(cell))));
}
template <UpdateCause Cause>
std::string sent(const Cell& cell) {
  return fmt::format("{}", cell.row.causes[static_cast<std::size_t>(Cause)]);
}
template <auto Get>
std::string of_model(const Cell& cell) {
  const ReceivedModel* received = cell.table.listener().model_of(cell.entity);
  return received == nullptr ? "" : number(Get(received->model));
}
std::string jump(const Cell& cell, double value) {
  return cell.row.jumps.count() == 0 ? "" : number(value);
}
std::string force_jump(const Cell& cell, double share) {
  const JumpHistogram* jumps = cell.table.force_jumps(cell.entity);
  return jumps == nullptr || jumps->count() == 0 ? "" : number(jumps->percentile(share));
}

using State = pdu::EntityState;
using Model = deadreckon::ForceModel;

/// THE columns.
constexpr auto kColumns = std::to_array<TopColumn>({
    {"ID", kLeft, [](const Cell& c) { return id_text(c.entity.id); },
     [](const Cell&) { return 0.0; }},
    {"MARK", kLeft,
     [](const Cell& c) {
       return c.entity.has_state ? printable_text(state(c).marking.view()) : std::string("-");
     },
     nullptr},
    {"SIDE", kRight,
     [](const Cell& c) {
       return c.entity.has_state ? of_state<[](const State& s) { return s.force_id; }>(c)
                                 : std::string("-");
     },
     nullptr},
    {"KIND", kLeft, kind, nullptr},
    {"DRM", kLeft, drm, nullptr},
    {"HZ", kRight,
     [](const Cell& c) {
       const double rate = c.row.rate(c.entity, c.now);
       return rate > 0 ? fmt::format("{:.{}f}", rate, rate < 1 ? 2 : 1) : std::string("-");
     },
     [](const Cell& c) { return c.row.rate(c.entity, c.now); }},
    {"WHY", kLeft, why, nullptr},
    {"JUMP p50", kRight, [](const Cell& c) { return percentile(c, kMedian); },
     [](const Cell& c) { return c.row.jumps.percentile(kMedian); }},
    {"p99", kRight, [](const Cell& c) { return percentile(c, kTail); },
     [](const Cell& c) { return c.row.jumps.percentile(kTail); }},
    {"max", kRight,
     [](const Cell& c) {
       return c.row.worst_frame == 0 ? std::string("-") : distance_text(c.row.jumps.max());
     },
     [](const Cell& c) { return static_cast<double>(c.row.jumps.max()); }},
    {"AT", kRight,
     [](const Cell& c) {
       return c.row.worst_frame == 0 ? std::string("-") : fmt::format("{:.1f}s", worst_at(c));
     },
     nullptr},
    {"TURN", kRight, [](const Cell& c) { return turn(c, c.row.turns.max()); },
     [](const Cell& c) { return c.row.turns.max(); }},
    {"AGE", kRight, age, [](const Cell& c) { return c.entity.age(c.now); }},
    {"OCTETS", kRight, [](const Cell& c) { return fmt::format("{}", c.row.octets); },
     [](const Cell& c) { return static_cast<double>(c.row.octets); }},
    {"GROUP", kLeft, [](const Cell& c) { return endpoint(c.row.group); }, nullptr},
    {"SENDER", kLeft, [](const Cell& c) { return endpoint(c.row.sender); }, nullptr},
    {"CONTACT, STATE", kLeft, remarks,
     [](const Cell& c) {
       return c.table.contact_force(c.entity, c.now) + static_cast<double>(c.row.bad);
     }},
});

/// THE members.
constexpr auto kMembers = std::to_array<TopMember>({
    {"id", true, [](const Cell& c) { return id_text(c.entity.id); }},
    {"exercise", false, [](const Cell& c) { return fmt::format("{}", c.entity.exercise); }},
    {"marking", true,
     [](const Cell& c) {
       return c.entity.has_state ? std::string(state(c).marking.view()) : std::string();
     }},
    {"force_id", false, of_state<[](const State& s) { return s.force_id; }>},
    {"kind", false, of_state<[](const State& s) { return s.entity_type.kind; }>},
    {"domain", false, of_state<[](const State& s) { return s.entity_type.domain; }>},
    {"drm", false, of_state<[](const State& s) { return s.dead_reckoning.algorithm; }>},
    {"updates", false, [](const Cell& c) { return fmt::format("{}", c.entity.updates); }},
    {"rate_hz", false, [](const Cell& c) { return number(c.row.rate(c.entity, c.now)); }},
    {"why", true,
     [](const Cell& c) {
       return c.row.cause == UpdateCause::none ? std::string() : std::string(name(c.row.cause));
     }},
    {"sent_first", false, sent<UpdateCause::first>},
    {"sent_event", false, sent<UpdateCause::event>},
    {"sent_threshold", false, sent<UpdateCause::threshold>},
    {"sent_force", false, sent<UpdateCause::force>},
    {"sent_heartbeat", false, sent<UpdateCause::heartbeat>},
    {"sent_repeat", false, sent<UpdateCause::repeat>},
    {"jump_m", false, [](const Cell& c) { return jump(c, c.row.jump); }},
    {"jump_p50_m", false, [](const Cell& c) { return jump(c, c.row.jumps.percentile(kMedian)); }},
    {"jump_p99_m", false, [](const Cell& c) { return jump(c, c.row.jumps.percentile(kTail)); }},
    {"jump_max_m", false, [](const Cell& c) { return jump(c, c.row.jumps.max()); }},
    {"jump_max_at_s", false,
     [](const Cell& c) { return c.row.worst_frame == 0 ? std::string() : number(worst_at(c)); }},
    {"jump_max_frame", false,
     [](const Cell& c) {
       return c.row.worst_frame == 0 ? std::string() : fmt::format("{}", c.row.worst_frame);
     }},
    {"jump_deg", false, [](const Cell& c) { return jump(c, c.row.turn); }},
    {"jump_p50_deg", false,
     [](const Cell& c) { return jump(c, c.row.turns.percentile(kMedian)); }},
    {"jump_p99_deg", false, [](const Cell& c) { return jump(c, c.row.turns.percentile(kTail)); }},
    {"jump_max_deg", false, [](const Cell& c) { return jump(c, c.row.turns.max()); }},
    {"age_s", false, [](const Cell& c) { return number(c.entity.age(c.now)); }},
    {"heartbeat_s", false,
     [](const Cell& c) { return c.entity.has_state ? number(c.entity.heartbeat) : std::string(); }},
    {"stale", false, [](const Cell& c) { return truth(c.entity.is_silent(c.now)); }},
    {"gone", false, [](const Cell& c) { return truth(c.entity.gone); }},
    {"group", true, [](const Cell& c) { return endpoint(c.row.group); }},
    {"sender", true, [](const Cell& c) { return endpoint(c.row.sender); }},
    {"octets", false, [](const Cell& c) { return fmt::format("{}", c.row.octets); }},
    {"late", false, [](const Cell& c) { return fmt::format("{}", c.row.late); }},
    {"duplicated", false, [](const Cell& c) { return fmt::format("{}", c.row.duplicated); }},
    {"bad", false, [](const Cell& c) { return fmt::format("{}", c.row.bad); }},
    {"last_is_bad", false, [](const Cell& c) { return truth(c.row.last_is_bad); }},
    {"rule", true, [](const Cell& c) { return std::string(c.row.rule); }},
    {"contact_n", false,
     [](const Cell& c) {
       return !c.entity.is_haptic() ? std::string()
                                                 : number(c.table.contact_force(c.entity, c.now));
     }},
    {"force_jump_p50_n", false, [](const Cell& c) { return force_jump(c, kMedian); }},
    {"force_jump_p99_n", false, [](const Cell& c) { return force_jump(c, kTail); }},
    {"k1", false, of_model<[](const Model& m) { return m.k1; }>},
    {"k3", false, of_model<[](const Model& m) { return m.k3; }>},
    {"damping", false, of_model<[](const Model& m) { return m.damping; }>},
    {"static_friction", false, of_model<[](const Model& m) { return m.static_friction; }>},
    {"kinetic_friction", false, of_model<[](const Model& m) { return m.kinetic_friction; }>},
    {"radius", false, of_model<[](const Model& m) { return m.radius; }>},
});

}  // namespace

std::span<const TopColumn> top_columns() { return kColumns; }
std::span<const TopMember> top_members() { return kMembers; }

std::vector<std::size_t> top_order(const EntityTable& table, std::chrono::nanoseconds now,
                                   std::size_t column, bool reverse) {
  const auto entities = table.entities();
  const auto order = kColumns[std::min(column, kColumns.size() - 1)].order;
  std::vector<double> keys(entities.size());
  for (std::size_t i = 0; order != nullptr && i < entities.size(); ++i)
    keys[i] = order({table, i, now});
  std::vector<std::size_t> places(entities.size());
  std::iota(places.begin(), places.end(), std::size_t{0});
  std::sort(places.begin(), places.end(), [&](std::size_t a, std::size_t b) {
    return keys[a] != keys[b] ? keys[a] > keys[b] : entities[a].key < entities[b].key;
  });
  if (reverse) std::reverse(places.begin(), places.end());
  return places;
}

std::vector<std::string> top_cells(const TopCell& cell) {
  std::vector<std::string> cells;
  for (const TopColumn& column : kColumns) cells.push_back(column.text(cell));
  return cells;
}

}  // namespace reckon::tools
