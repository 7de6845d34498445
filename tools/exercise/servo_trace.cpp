// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/exercise/servo_trace.hpp"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <iterator>
#include <string_view>

#include "reckon/pdu/seconds.hpp"

namespace reckon::tools {
namespace {

constexpr std::string_view kColumns =
    "t_s,peer,px_m,py_m,pz_m,sx_m,sy_m,sz_m,vx_mps,vy_mps,vz_mps,fx_N,fy_N,fz_N,"
    "mesh_fx_N,mesh_fy_N,mesh_fz_N,hand_fx_N,hand_fy_N,hand_fz_N,"
    "record_fx_N,record_fy_N,record_fz_N,ledger_J,need_J,energy_J,contacts,patch,device,pace";
constexpr std::string_view kTurnColumns =
    ",tx_Nm,ty_Nm,tz_Nm,qw,qx,qy,qz,wx_radps,wy_radps,wz_radps";

}  // namespace

ServoTrace::ServoTrace(const std::filesystem::path& file, bool turns)
    : turns_(turns), file_(file, fmt::format("{}{}", kColumns, turns ? kTurnColumns : "")) {}

void ServoTrace::write(std::size_t peer, std::size_t device, double pace,
                       const haptics::ServoSnapshot& step) {
  line_.clear();
  const auto to = std::back_inserter(line_);
  const auto vector = [&](const Eigen::Vector3d& v) {
    fmt::format_to(to, FMT_COMPILE(",{:.9g},{:.9g},{:.9g}"), v.x(), v.y(), v.z());
  };
  fmt::format_to(to, FMT_COMPILE("{:.6f},{}"), pdu::to_seconds(step.time), peer + 1);
  vector(step.device);
  vector(step.scp);
  vector(step.velocity);
  vector(step.force);
  vector(step.mesh_force);

  // Sums over all remote hands: as rendered, and as their records state.
  Eigen::Vector3d hands = Eigen::Vector3d::Zero(), records = Eigen::Vector3d::Zero();
  double ledger = 0.0, need = 0.0;
  for (std::size_t i = 0; i < step.count; ++i) {
    hands += step.contacts[i].force;
    records += step.contacts[i].ungated_force;
    ledger += step.contacts[i].ledger;
    need += step.contacts[i].need;
  }
  vector(hands);
  vector(records);
  fmt::format_to(to, FMT_COMPILE(",{:.9g},{:.9g},{:.9g},{},{},{},{}"), ledger, need,
                 step.port_energy, step.count, step.mesh_patch, device + 1, pace);
  if (turns_) {
    const Eigen::Quaterniond& q = step.tool.orientation;
    vector(step.tool.torque);
    fmt::format_to(to, FMT_COMPILE(",{:.9g},{:.9g},{:.9g},{:.9g}"), q.w(), q.x(), q.y(), q.z());
    vector(step.tool.turn_rate);
  }
  line_ += '\n';
  file_.write(line_);
}

}  // namespace reckon::tools
