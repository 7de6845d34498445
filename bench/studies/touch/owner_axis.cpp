// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Which peer simulates a body that hands of two peers touch: the error of their forces by the delay
// between the peers. Whole peers in simulated time.
#include <fmt/format.h>

#include <array>
#include <atomic>
#include <optional>
#include <utility>
#include <vector>

#include "reckon/bench/studies/sweep/all_cores.hpp"
#include "reckon/bench/studies/touch/touch_study.hpp"
#include "reckon/bench/studies/touch/touched_body.hpp"
#include "reckon/peer/notation/units.hpp"

namespace reckon::bench {
namespace {

using Forces = std::vector<Eigen::Vector3d>;

constexpr std::array kOneWayDelays{0.0003, 0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1};  // [s]

/// Of the samples with a felt or a true force.
ForceError error_in_contact(const Forces& truth, const Forces& felt) {
  Forces wanted, got;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (truth[i].isZero(0) && felt[i].isZero(0)) continue;
    wanted.push_back(truth[i]);
    got.push_back(felt[i]);
  }
  return touch_error(wanted, got);
}

struct OwnerRun {
  std::size_t touch = 0;  ///< index in body_touches()
  double delay = 0;
  OwnerRuleRow rule;
};

std::vector<OwnerRun> runs_of(const TouchConditions& conditions) {
  std::vector<double> delays(kOneWayDelays.begin(), kOneWayDelays.end());
  if (conditions.delay) delays = {*conditions.delay};
  std::vector<OwnerRun> runs;
  for (std::size_t touch = 0; touch < body_touches().size(); ++touch)
    for (const double delay : delays)
      for (const OwnerRuleRow& rule : owner_rules()) runs.push_back({touch, delay, rule});
  return runs;
}

TouchSetting setting_of(const OwnerRun& of, const Forces& truth,
                        const TouchConditions& conditions) {
  const BodyTouch& touch = body_touches()[of.touch];
  const BodyTouchRun run =
      run_body_touch(touch, 2, of.rule.rule, {of.delay, conditions.loss, conditions.seed});
  TouchSetting setting{
      fmt::format("{}, {}, {}", touch.name, peer::format_quantity(of.delay, "s"), of.rule.name),
      {},
      {}};
  setting.error = error_in_contact(truth, run.forces);
  setting.cost = run.cost;
  setting.delayed = DelayedTouch{touch.name, of.rule.name, of.delay};
  return setting;
}

}  // namespace

TouchCase owner_case(const TouchConditions& conditions) {
  TouchCase made;
  made.truth =
      "both hands at one peer, without a network: hands of 300 N/m, a body of 1 kg and 500 N/m, "
      "which the first peer owns at the start";
  made.remark = "Delay: one way, +-15 %. ";
  for (const BodyTouch& touch : body_touches())
    made.remark += fmt::format("{}: {}. ", touch.name, touch.meaning);
  made.remark +=
      "fixed: the first peer owns the body for ever; first hand: a peer requests the body when its "
      "hand touches it; before touch: a peer requests it before, by the time to contact (the rule "
      "of peers). NS: CPU time of a servo step in contact, with a simulated device; mean of both "
      "peers.";
  std::vector<Forces> truths;
  for (const BodyTouch& touch : body_touches()) truths.push_back(run_body_touch(touch, 1).forces);
  const std::vector<OwnerRun> runs = runs_of(conditions);
  std::vector<std::optional<TouchSetting>> settings(runs.size());
  run_on_all_cores(
      runs.size(),
      [&](std::size_t i, const std::atomic<bool>&) {
        settings[i] = setting_of(runs[i], truths[runs[i].touch], conditions);
      },
      [&](std::size_t) { return !conditions.go_on || conditions.go_on(); });
  for (std::optional<TouchSetting>& setting : settings)
    if (setting) made.settings.push_back(std::move(*setting));
  return made;
}

}  // namespace reckon::bench
