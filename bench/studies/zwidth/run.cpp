// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// `reckon zwidth`: its flags, and its rows as table, CSV, JSON Lines, picture and page.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "reckon/bench/analysis/device_damping.hpp"
#include "reckon/bench/plots/html_page.hpp"
#include "reckon/bench/studies/frame/fields.hpp"
#include "reckon/bench/studies/frame/study.hpp"
#include "reckon/bench/studies/frame/study_watch.hpp"
#include "reckon/bench/studies/sweep/values.hpp"
#include "reckon/bench/studies/zwidth/study.hpp"
#include "reckon/haptics/devices/simulated_device.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/notation/units.hpp"
#include "reckon/peer/scene/belongings.hpp"
#include "reckon/tools/plots/curves.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::bench {
namespace {

using peer::format_quantity;

constexpr std::string_view kSummary =
    "Computes the stiffness and damping of a wall that a sampled device with delay can render: the "
    "passivity limit by theory, and measured in simulation with held forces.\n\n"
    "SCENE is a scene file with damping, rate, delay and largest stiffness of each [[device]] (it "
    "has no mass: --mass); flags override it. Default: 0.1 kg, 1 N s/m, 1 kHz, no delay.";
constexpr std::string_view kExamples =
    "reckon zwidth\n"
    "reckon zwidth --damping 2 --rate 4kHz --delay 1ms --report zwidth.html\n"
    "reckon zwidth scenes/two_hands.toml --device 2 --walls 0..0.5/11\n"
    "reckon zwidth --delay 20ms --json | jq .passive";

constexpr std::size_t kDampings = 21;
constexpr double kStiffWall = 2000;  // [N/m], a wall of this stiffness feels stiff
/// Stability borders above this multiple of the passive one are cut in the picture.
constexpr double kShownBeyond = 2.2;

constexpr std::string_view kPageStyle = "section>svg{display:block;width:100%;max-width:60rem}\n";

constexpr std::array<std::array<std::string_view, 2>, 7> kMeanings{{
    {"DAMPING", "of the wall, B [N s/m]; all others [N/m]"},
    {"(3.8)", "2 (b - |B|)/T: correct without delay (the printed (3.7), its source, lacks K)"},
    {"PASSIVE TO", "(3.5) with the delay, solved for the stiffness"},
    {"ENERGY FROM", "measured: a stiffer wall gives energy to a hand that moves back and forth"},
    {"OFF", "deviation of the measurement from PASSIVE TO"},
    {"SWINGS FROM", "measured: from here the free handle oscillates with growing amplitude"},
    {"SHOWN TO",
     "limit of the servo for walls of a scene; the rest is for hands and margin; dampers above 3/8 "
     "of the device's reduce it no further"},
}};

struct ZWidthReport {
  std::string command;  ///< as typed
  std::string subject;  ///< "device 2 of peer 1"; empty for a device given by flags alone
  ZWidthDevice device;
  std::vector<ZWidthRow> rows;  ///< at least one
};

std::string device_text(const ZWidthDevice& device) {
  return fmt::format(
      "mass {}, damping {}, {}, {}", format_quantity(device.mass, "kg"),
      format_quantity(device.damping, "N s/m"), format_quantity(1 / device.period, "Hz"),
      device.delay_samples == 0
          ? "no delay"
          : fmt::format(
                "{} late ({})", format_quantity(device.period * device.delay_samples, "s"),
                tools::counted(static_cast<std::uint64_t>(device.delay_samples), "sample")));
}

/// A row for the device of a report.
auto zwidth_fields(const ZWidthDevice& device) {
  return [&device](const ZWidthRow& row) {
    Fields fields;
    const auto stiffness = [&](std::string_view name, std::string title, double value) {
      const bool known = std::isfinite(value);
      const Value number = known ? std::optional(value) : std::nullopt;
      fields.json(name, number).csv(fmt::format("{}_N_m", name), number);
      fields.shown(title, title, value, known ? fmt::format("{:.4g}", value) : "never");
    };
    fields.json("damping", row.damping)
        .csv("damping_Ns_m", row.damping)
        .shown("DAMPING", "DAMPING", row.damping, fmt::format("{:.4g}", row.damping));
    stiffness("undelayed", "(3.8)", row.undelayed);
    stiffness("passive", "PASSIVE TO", row.passive);
    stiffness("energy", "ENERGY FROM", row.energy);
    fields.shown("OFF", "OFF", row.off(),
                 row.passive > 0 ? fmt::format("{:+.3f} %", 100 * row.off()) : "");
    stiffness("unstable", "SWINGS FROM", row.unstable);
    stiffness("shown", "SHOWN TO", row.shown);
    return fields.json("device_mass", device.mass)
        .json("device_damping", device.damping)
        .json("device_period", device.period)
        .json("device_delay_samples", device.delay_samples);
  };
}

std::string stiff_wall_text(const ZWidthDevice& device) {
  return fmt::format(
      "A wall of {} needs a device with more than {:.4g} N s/m; this device has {:.4g}.",
      format_quantity(kStiffWall, "N/m"),
      spring_damping(kStiffWall, device.period, device.delay_samples), device.damping);
}

std::string agreement_text(const ZWidthReport& report) {
  double worst = 0;
  for (const ZWidthRow& row : report.rows) worst = std::max(worst, std::abs(row.off()));
  return fmt::format("Theory and measured energy agree within {:.3f} %.", 100 * worst);
}

std::string title_of(const ZWidthReport& report) {
  return report.subject.empty() ? "Stiffness and damping that a device can render"
                                : "Stiffness and damping that " + report.subject + " can show";
}

std::string zwidth_text(const ZWidthReport& report) {
  std::string out =
      fmt::format("{}{}{}\n{}\n", report.subject, report.subject.empty() ? "" : ": ",
                  device_text(report.device), table_of(report.rows, zwidth_fields(report.device)));
  for (const auto& [name, meaning] : kMeanings) out += fmt::format("{:<12} {}\n", name, meaning);
  return out + fmt::format("\n{}\n{}\n", agreement_text(report), stiff_wall_text(report.device));
}

/// Theoretical borders as lines, measured ones as circles.
std::string zwidth_svg(const ZWidthReport& report) {
  struct Curve {
    std::string_view name;
    double ZWidthRow::*member;
    bool is_measured = false;
    std::vector<float> at = {}, values = {};
  };
  std::array curves{Curve{"passive to: thesis (3.5)", &ZWidthRow::passive},
                    Curve{"energy from (measured)", &ZWidthRow::energy, true},
                    Curve{"swings from (measured)", &ZWidthRow::unstable, true},
                    Curve{"thesis (3.8): no delay", &ZWidthRow::undelayed},
                    Curve{"rendered by the servo", &ZWidthRow::shown}};
  tools::SvgPlot plot;
  plot.value = "stiffness of the wall [N/m]";
  plot.across = "damping of the wall [N s/m]";
  double most = 0;
  for (const ZWidthRow& row : report.rows) {
    plot.end = std::max(plot.end, row.damping);
    most = std::max({most, row.passive, row.energy});
  }
  plot.range = {0, most > 0 ? kShownBeyond * most : 1};
  plot.note = device_text(report.device) + ". Points below (3.5) are passive.";
  for (Curve& curve : curves) {
    for (const ZWidthRow& row : report.rows) {
      if (!std::isfinite(row.*curve.member)) continue;
      curve.at.push_back(static_cast<float>(row.damping));
      curve.values.push_back(static_cast<float>(row.*curve.member));
    }
    plot.curves.push_back({std::string(curve.name), curve.values, curve.at, curve.is_measured});
  }
  return tools::svg_panels(title_of(report), std::array{plot.note}, std::array{plot});
}

std::string zwidth_page(const ZWidthReport& report) {
  std::string body = fmt::format(
      "<dl><dt>command</dt><dd><code>{}</code></dd><dt>device</dt><dd>{}</dd></dl>\n<p>{} {}</p>\n"
      "<section>\n{}</section>\n<section>\n{}<dl>\n",
      html_escaped(report.command), html_escaped(device_text(report.device)),
      agreement_text(report), stiff_wall_text(report.device), zwidth_svg(report),
      page_table_of(report.rows, zwidth_fields(report.device)));
  for (const auto& [name, meaning] : kMeanings)
    body += fmt::format("<dt>{}</dt><dd>{}</dd>\n", name, html_escaped(meaning));
  return html_page(title_of(report), kPageStyle, body + "</dl>\n</section>\n");
}

double one_value(const std::string& text, const ValueRule& rule, std::string_view flag) {
  const std::vector<double> values = read_values(text, rule, flag);
  if (values.size() == 1) return values.front();
  throw tools::UsageError(fmt::format("{}: '{}' is more than one value; write one", flag, text));
}

class ZWidthStudy final : public Study {
 public:
  ZWidthStudy() : Study({kSummary, kExamples}) {}

  std::vector<Flag> flags() override {
    return {
        {"SCENE", &scene_, "scene file with the device"},
        {"--device", &device_, "which device of SCENE, from 1, peer by peer (1)"},
        {"--mass", &mass_, "moving mass of the device at the handle (100g)"},
        {"--damping", &damping_, "of the device itself (1 N s/m)"},
        {"--rate", &rate_, "of the servo (1kHz)"},
        {"--delay", &shared_.delay,
         "delay until a force acts at the handle; whole periods, rounded up (0s)"},
        {"--walls", &walls_,
         "dampings of the wall, such as 0..0.5/11 or 0,0.2,0.4 N s/m (21, up to the device's)"},
        {"--csv", &shared_.csv, "write all figures to this file"},
        {"--svg", &shared_.plot, "write the picture to this file"},
        {"--report", &shared_.report, "write one HTML page with picture and table"},
        {"--json", &shared_.json, "one JSON object per damping"},
    };
  }

  StudyOutput run(const StudyCall& call) override {
    if (device_ && scene_.empty()) throw tools::UsageError("--device needs a SCENE; add it");
    ZWidthReport report;
    report.command = call.command;
    if (!scene_.empty()) take_device_of_scene(report);
    apply_flags(report.device);
    const std::string walls =
        walls_.empty() ? fmt::format("0..{}/{}", report.device.damping, kDampings) : walls_;
    const auto dampings = read_values(walls, {"N s/m", 0, 1000, false}, "--walls");
    report.rows = run_zwidth(report.device, dampings, StudyWatch(call.console).of("dampings"));
    if (report.rows.empty()) return {.note = "stopped before the end: no table\n"};
    const auto fields = zwidth_fields(report.device);
    return {shared_.json ? json_of(report.rows, fields) : zwidth_text(report),
            csv_of(report.rows, fields), zwidth_svg(report), zwidth_page(report)};
  }

 private:
  /// The device settings of the scene, and the name of the device.
  void take_device_of_scene(ZWidthReport& report) const {
    std::vector<peer::DeviceConfig> all;
    try {
      const peer::SceneFile scene = peer::load_scene_file(scene_);
      for (std::uint32_t number = 1; number <= peer::peers_of(scene); ++number)
        for (peer::DeviceConfig& device : peer::devices_of(scene, number)) {
          device.peer = number;
          all.push_back(device);
        }
    } catch (const peer::SceneFileError& error) {
      throw tools::UsageError(error.what());
    }
    if (all.empty())
      throw tools::UsageError(fmt::format(
          "{}: no peer has a device; remove SCENE, and describe the device by flags", scene_));
    const std::uint64_t number = device_.value_or(1);
    if (number < 1 || number > all.size())
      throw tools::UsageError(fmt::format("--device: {} is not from 1 to {}, the devices of {}",
                                          number, all.size(), scene_));
    const peer::DeviceConfig& chosen = all[number - 1];
    report.device.damping = chosen.damping;
    report.device.period = pdu::to_seconds(chosen.period);
    report.device.delay_samples = chosen.delay_samples;
    report.device.max_stiffness = chosen.max_stiffness;
    report.subject =
        fmt::format("device {} of {} in {} (peer {})", number, all.size(), scene_, chosen.peer);
    if (!chosen.marking.empty()) report.subject += " " + chosen.marking;
  }

  void apply_flags(ZWidthDevice& device) const {
    if (!mass_.empty()) device.mass = one_value(mass_, {"kg", 1e-3, 100, false}, "--mass");
    if (!damping_.empty())
      device.damping = one_value(damping_, {"N s/m", 0, 1000, true}, "--damping");
    const double old_delay = device.period * device.delay_samples;
    if (!rate_.empty()) device.period = 1 / one_value(rate_, {"Hz", 100, 10'000, false}, "--rate");
    const double delay = shared_.delay ? pdu::to_seconds(*shared_.delay) : old_delay;
    const double samples = std::ceil(delay / device.period - 1e-9);
    if (!(samples <= haptics::SimulatedDevice::kMostDelay))
      throw tools::UsageError(fmt::format(
          "--delay: {} are {:.0f} samples at {}; write at most {}", format_quantity(delay, "s"),
          samples, format_quantity(1 / device.period, "Hz"), haptics::SimulatedDevice::kMostDelay));
    device.delay_samples = static_cast<int>(samples);
    if (!(device.damping > 0))
      throw tools::UsageError(
          fmt::format("{}: a device without damping can render no wall; add --damping", scene_));
  }

  std::string scene_, mass_, damping_, rate_, walls_;
  std::optional<std::uint64_t> device_;
};

}  // namespace

std::unique_ptr<Study> zwidth_study() { return std::make_unique<ZWidthStudy>(); }

}  // namespace reckon::bench

namespace reckon::tools::verb {

Verb zwidth() { return reckon::bench::study_verb(verb_row("zwidth"), reckon::bench::zwidth_study); }

}  // namespace reckon::tools::verb
