// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Cells of the area of interest: the force of a hand in a cell that is not subscribed. Whole peers
// in simulated time.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <future>

#include "reckon/bench/studies/contact/contact_run.hpp"
#include "reckon/bench/studies/contact/contact_scenes.hpp"
#include "reckon/bench/studies/touch/touch_study.hpp"
#include "reckon/peer/notation/units.hpp"

namespace reckon::bench {
namespace {

constexpr double kSeconds = 12;

const ContactScene& sweep() {
  return *std::ranges::find(contact_scenes(), std::string_view("sweep-2"), &ContactScene::name);
}

TouchSetting setting_of(double cell, double radius, std::uint64_t seed) {
  const ContactScene& contact = sweep();
  peer::SceneFile scene = scene_of(contact);
  scene.aoim.cell = cell;
  scene.aoim.radius = radius;
  scene.impairment.seed = seed;
  scene.impairment.law.delay = std::chrono::milliseconds(5);
  scene.impairment.law.jitter = std::chrono::milliseconds(2);
  scene.hash = peer::scene_hash(scene);
  const ContactRun run = run_contact(scene, contact.hands, scripts_of(contact), kSeconds);
  TouchSetting setting{fmt::format("cells {}, sensing {}", peer::format_quantity(cell, "m"),
                                   peer::format_quantity(radius, "m")),
                       {},
                       {}};
  setting.error = error_at_instant(run.record, {contact.stiffness, 2 * scene.hand.radius});
  setting.cost = {run.servo_step_ns, 0, 0};
  return setting;
}

}  // namespace

TouchCase cell_case(const TouchConditions& conditions) {
  TouchCase made;
  made.truth =
      "two hands of 20 mm and 300 N/m that sweep through each other, 5 ms of delay: 300 N/m x the "
      "true overlap at that instant";
  made.remark =
      "The first row receives all updates: its error is prediction and delay. Hands touch at 40 "
      "mm. A peer joins every cell within its radius, so small cells cost groups and lose nothing; "
      "a radius below the distance of touch loses force. NS: median of complete servo steps, about "
      "400 ns of them for the simulated device; rows that receive the same differ by chance.";
  struct Choice {
    double cell, radius;
  };
  std::vector<std::future<TouchSetting>> runs;
  for (const Choice& choice :
       {Choice{100, 2}, Choice{1, 2}, Choice{1, 0.1}, Choice{0.05, 0.1}, Choice{0.05, 0.05},
        Choice{0.02, 0.02}, Choice{0.005, 0.02}, Choice{0.005, 0.01}})
    runs.push_back(std::async(std::launch::async, [=] {
      return setting_of(choice.cell, choice.radius, conditions.seed);
    }));
  for (auto& run : runs) made.settings.push_back(run.get());
  return made;
}

}  // namespace reckon::bench
