// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/exercise/body_trace.hpp"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "reckon/pdu/seconds.hpp"
#include "reckon/tools/command_line/console.hpp"

namespace reckon::tools {
namespace {

// In quotes; quotes within the name are doubled.
std::string csv(const std::string& name) {
  std::string out = "\"";
  for (const char c : name) out.append(c == '"' ? 2 : 1, c);
  return out + '"';
}

// Names of all objects. @throws UsageError if none of them moves
std::vector<std::string> names_of(const haptics::Scene& scene) {
  const auto moves = [](const haptics::SceneObject& object) {
    return object.matter.mass > 0 || object.carried;
  };
  if (std::ranges::none_of(scene.objects, moves))
    throw UsageError("--trace-bodies: this scene has no bodies; give an object a mass");
  std::vector<std::string> names;
  for (const haptics::SceneObject& object : scene.objects) names.push_back(csv(object.name));
  return names;
}

}  // namespace

BodyTrace::BodyTrace(const std::filesystem::path& file, const haptics::Scene& scene)
    : objects_(names_of(scene)),
      file_(file,
            "t_s,object,x_m,y_m,z_m,qw,qx,qy,qz,vx_mps,vy_mps,vz_mps,wx_radps,wy_radps,wz_radps,"
            "awake") {}

void BodyTrace::write(const haptics::BodyStep& step) {
  line_.clear();
  const auto to = std::back_inserter(line_);
  const auto vector = [&](const Eigen::Vector3d& v) {
    fmt::format_to(to, FMT_COMPILE(",{:.9g},{:.9g},{:.9g}"), v.x(), v.y(), v.z());
  };
  const haptics::BodyState& body = step.state;
  const Eigen::Quaterniond& q = body.orientation;
  fmt::format_to(to, FMT_COMPILE("{:.6f},{}"), pdu::to_seconds(step.time), objects_[body.object]);
  vector(body.position);
  fmt::format_to(to, FMT_COMPILE(",{:.9g},{:.9g},{:.9g},{:.9g}"), q.w(), q.x(), q.y(), q.z());
  vector(body.velocity);
  vector(body.turn_rate);
  fmt::format_to(to, FMT_COMPILE(",{:d}\n"), body.awake);
  file_.write(line_);
}

}  // namespace reckon::tools
