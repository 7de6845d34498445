// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/contact/static_contact.hpp"

#include <algorithm>

#include "reckon/haptics/contact/load_sum.hpp"
#include "reckon/haptics/contact/region_share.hpp"

namespace reckon::haptics {
namespace {

double depth_of(const ContactResult& result) noexcept {
  return result.in_contact ? result.objects[result.deepest].depth : -1.0;
}

}  // namespace

template <int axes>
StaticContactOf<axes>::StaticContactOf(const EffectPlan& plan, double stiffness_cap, double radius,
                                       std::size_t probes)
    : regions_(plan, kRegionsOverWalls * stiffness_cap) {
  size_ = std::clamp<std::size_t>(probes, 1, kMost);
  for (std::size_t i = 0; i < size(); ++i) walls_[i].emplace(plan, stiffness_cap, radius);
}

template <int axes>
void StaticContactOf<axes>::limit(double stiffness) noexcept {
  for (std::size_t i = 0; i < size(); ++i) walls_[i]->limit(stiffness);
  regions_.limit(kRegionsOverWalls * stiffness);
}

template <int axes>
void StaticContactOf<axes>::reset(const Tool& tool) noexcept {
  for (std::size_t i = 0; i < size(); ++i) {
    walls_[i]->reset(tool.place(i));
    grabs_[i] = {};
  }
  regions_.reset(tool.place());
  deepest_ = 0;
}

template <int axes>
void StaticContactOf<axes>::settle(const Tool& tool, double dt, Port& port) noexcept {
  const bool in_steps = port.reads_in_steps();
  for (std::size_t i = 0; i < size(); ++i) {
    const Eigen::Vector3d change = walls_[i]->move(tool.place(i), dt, port);
    if (in_steps) port.follow(tool.at_port(i, change), tool.motion());
    walls_[i]->settle(dt, port);
    const Eigen::Vector3d pull = grabs_[i].move(tool.place(i), port);
    if (in_steps) port.follow(tool.at_port(i, pull), tool.motion());
    grabs_[i].settle(dt, port);
  }
  if constexpr (axes != 3) find_deepest();
  if (regions_.empty()) return;
  regions_.move(tool.place(), port);
  if (in_steps) port.follow(tool.at_port(0, regions_.change()), tool.motion());
  regions_.settle(dt, port);
}

template <int axes>
void StaticContactOf<axes>::find_deepest() noexcept {
  for (std::size_t i = 0; i < size(); ++i) {
    if (depth_of(walls_[i]->result()) > depth_of(result())) deepest_ = i;
  }
}

template <int axes>
void StaticContactOf<axes>::load(const Tool& tool, double dt, Load& load) noexcept {
  LoadSum<axes> sum(load);
  for (std::size_t i = 0; i < size(); ++i) {
    PortLoad& one = sum.of_probe();
    if (i == 0 && !regions_.empty()) regions_.load(tool.velocity(), dt, one);
    walls_[i]->load(tool.velocity(i), dt, one);
    grabs_[i].load(one);
    sum.add(tool, i);
  }
  sum.finish(tool);
}

template <int axes>
double StaticContactOf<axes>::lacks() const noexcept {
  double sum = 0.0;
  for (std::size_t i = 0; i < size(); ++i) sum += walls_[i]->lacks();
  return sum;
}

template <int axes>
double StaticContactOf<axes>::hidden() const noexcept {
  double most = 0.0;
  for (std::size_t i = 0; i < size(); ++i) most = std::max(most, walls_[i]->hidden());
  return most;
}

template <int axes>
void StaticContactOf<axes>::shown(double extra) noexcept {
  for (std::size_t i = 0; i < size(); ++i) {
    walls_[i]->shown(extra);
    grabs_[i].shown(extra);
  }
  if (!regions_.empty()) regions_.shown(extra);
}

template <int axes>
void StaticContactOf<axes>::attenuate(double factor, EnergyLedger& ledger) noexcept {
  for (std::size_t i = 0; i < size(); ++i) {
    walls_[i]->attenuate(factor, ledger);
    grabs_[i].attenuate(factor, ledger);
  }
  if (!regions_.empty()) regions_.attenuate(factor, ledger);
}

template <int axes>
Eigen::Vector3d StaticContactOf<axes>::force() const noexcept {
  Eigen::Vector3d sum = regions_.force();
  for (std::size_t i = 0; i < size(); ++i) sum = walls_[i]->force() + grabs_[i].force() + sum;
  return sum;
}

template <int axes>
double StaticContactOf<axes>::share() const noexcept {
  double least = 1.0;
  for (std::size_t i = 0; i < size(); ++i) least = std::min(least, walls_[i]->share());
  return least;
}

template <int axes>
double StaticContactOf<axes>::asked() const noexcept {
  double sum = 0.0;
  for (std::size_t i = 0; i < size(); ++i) sum += walls_[i]->asked();
  return sum;
}

template <int axes>
typename StaticContactOf<axes>::Force StaticContactOf<axes>::held_back(
    const Tool& tool) const noexcept {
  Force sum = Force::Zero();
  for (std::size_t i = 0; i < size(); ++i)
    sum += tool.at_port(i, walls_[i]->held_back() + grabs_[i].held_back());
  return sum;
}

template <int axes>
bool StaticContactOf<axes>::touches_body(const EffectPlan& plan) const noexcept {
  for (std::size_t probe = 0; probe < size(); ++probe) {
    for (const std::uint32_t index : walls_[probe]->result().touched)
      if (plan.objects()[index].is_body()) return true;
  }
  return false;
}

template <int axes>
bool StaticContactOf<axes>::touches_others_body(const EffectPlan& plan) const noexcept {
  for (std::size_t probe = 0; probe < size(); ++probe) {
    for (const std::uint32_t index : walls_[probe]->result().touched) {
      if (walls_[probe]->is_carried(index) && plan.objects()[index].is_body()) return true;
    }
  }
  return false;
}

template class StaticContactOf<3>;
template class StaticContactOf<6>;

}  // namespace reckon::haptics
