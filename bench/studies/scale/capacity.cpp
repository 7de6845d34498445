// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/scale/capacity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "reckon/bench/studies/scale/live_costs.hpp"
#include "reckon/bench/studies/scale/mechanisms.hpp"
#include "reckon/tools/terminal/json_text.hpp"

namespace reckon::bench {
namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();
constexpr double kLeastPower = 0.02;  // a quantity with a smaller power is constant

/// A resource that a peer uses.
struct Use {
  std::string_view words;
  double (*of)(const ScaleRow&);  ///< use per peer and second
  double (*most)(const HostLimits&);
};

double a_peer(const ScaleRow& row, double sum) {
  return sum / (row.run.counts.seconds * static_cast<double>(row.peers()));
}

// THE list.
constexpr std::array kUses{
    Use{"the link of a host",
        [](const ScaleRow& row) {
          const WholeCounts& counts = row.run.counts;
          return 8 * a_peer(row, static_cast<double>(counts.octets + counts.heard_octets));
        },
        [](const HostLimits& limits) { return limits.link_share * limits.link; }},
    Use{"the CPU of a host", [](const ScaleRow& row) { return row.run.cpu_share(); },
        [](const HostLimits& limits) { return limits.core_share; }},
};

/// The number of peers at which `use` reaches `most`.
double reached_at(const Use& use, const ScaleRow& small, const ScaleRow& large, double most) {
  const double before = use.of(small), now = use.of(large);
  const auto peers = static_cast<double>(large.peers());
  if (!(now > 0)) return kUnbounded;
  const double growth = std::log(peers / static_cast<double>(small.peers()));
  const double power = before > 0 ? std::log(now / before) / growth : 1.0;
  if (power < kLeastPower) return now > most ? 0.0 : kUnbounded;
  return peers * std::pow(most / now, 1 / power);
}

Capacity capacity_of(const ScaleRow& small, const ScaleRow& large, const HostLimits& limits) {
  Capacity out;
  out.mechanism = large.mechanism;
  out.peers = kUnbounded;
  for (const Use& use : kUses) {
    const double at = reached_at(use, small, large, use.most(limits));
    if (at >= out.peers) continue;
    out.peers = at;
    out.limit = use.words;
  }
  const double farthest = kFarthest * static_cast<double>(large.peers());
  if (out.peers > farthest) {
    out.peers = farthest;
    out.limit = {};
  }
  out.entities = out.peers * entities_a_peer(large.run.setting);
  out.within = out.peers <= static_cast<double>(large.peers());
  return out;
}

/// Rounds down to two significant digits: "1,200".
std::string rounded(double value) {
  const double unit = std::pow(10, std::max(0.0, std::floor(std::log10(std::max(value, 1.0))) - 1));
  const auto whole = static_cast<std::uint64_t>(std::max(0.0, std::floor(value / unit) * unit));
  std::string digits = fmt::format("{}", whole);
  for (std::size_t at = digits.size(); at > 3; at -= 3) digits.insert(at - 3, ",");
  return digits;
}

std::string carries(const Capacity& one) {
  const std::string size =
      fmt::format("{} peers with {} entities", rounded(one.peers), rounded(one.entities));
  if (one.limit.empty())
    return fmt::format("at least {}, where no limit\n  is near; raise --peers to find it.\n", size);
  return fmt::format("some {};\n  {} is the first limit{}.\n", size, one.limit,
                     one.within ? "" : ", extrapolated");
}

}  // namespace

std::vector<Capacity> capacities(std::span<const ScaleRow> rows, const HostLimits& limits) {
  std::vector<Capacity> out;
  for (std::size_t mechanism = 0; mechanism < kMechanisms.size(); ++mechanism) {
    const auto ladder = ladder_of(rows, mechanism);
    if (ladder.size() < 2) return {};
    out.push_back(capacity_of(**(ladder.end() - 2), *ladder.back(), limits));
  }
  return out;
}

std::string capacity_text(std::span<const Capacity> capacities, const HostLimits& limits) {
  if (capacities.empty()) return {};
  return fmt::format(
             "Capacity of a LAN of {:g} Gbit/s, with {:g} % of it and {:g} % of a core for each "
             "peer;\n{}:\n",
             1e-9 * limits.link, 100 * limits.link_share, 100 * limits.core_share,
             costs_text(limits.costs)) +
         "- with all mechanisms: " + carries(capacities.back()) +
         "- with dead reckoning only: " + carries(capacities[1]);
}

std::string capacity_json(std::span<const Capacity> capacities) {
  std::string out;
  for (const Capacity& one : capacities) {
    tools::JsonObject object(out);
    object.text("kind", "capacity").text("mechanism", kMechanisms[one.mechanism].name);
    object.number("peers", one.peers).number("entities", one.entities);
    object.text("limit", one.limit).value("within", one.within).end("\n");
  }
  return out;
}

}  // namespace reckon::bench
