// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/inspect/views/haptics.hpp"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "reckon/pdu/codec/enumerations.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/tools/command_line/console.hpp"
#include "reckon/tools/command_line/output_file.hpp"
#include "reckon/tools/datagrams/bounded_time.hpp"
#include "reckon/tools/plots/curves.hpp"
#include "reckon/tools/terminal/text_end.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::tools {
namespace {

using std::chrono::nanoseconds;

/// Longest silence that is sampled, the heartbeat of haptic entities; it bounds the work.
constexpr nanoseconds kLongestSilence = std::chrono::seconds(5);
constexpr nanoseconds kLeastStep = std::chrono::microseconds(100);
/// Number of plots in the terminal: the contacts with the greatest forces.
constexpr std::size_t kMostPlots = 3;
/// Number of haptic entities whose coefficients are shown at the end.
constexpr std::size_t kMostEntities = kPeerRules.most_entities;
/// Two directions of a contact are one curve if they differ by less than this share of the peak.
constexpr double kSameCurve = 0.02;
constexpr std::string_view kBeforeGate =
    "Forces of the transmitted models, before the receivers' gates and without friction.";

std::string marking_of(const ReceivedEntity& entity) {
  std::string text;
  for (const char letter : entity.entity_state().marking.text) {
    if (letter == '\0') break;
    const auto octet = static_cast<unsigned char>(letter);
    text += octet < 0x20 || octet > 0x7E ? '?' : letter;
  }
  return text;
}

pdu::EntityId id_of(std::uint16_t site, std::uint16_t application, std::uint16_t entity) {
  return {site, application, entity};
}

bool same_curve(const ContactCourse& a, const ContactCourse& b) {
  const std::vector<float>& left = a.history.peaks();
  const std::vector<float>& right = b.history.peaks();
  const double most = kSameCurve * std::max(a.peak, b.peak);
  for (std::size_t i = 0; i < std::max(left.size(), right.size()); ++i) {
    const double x = i < left.size() ? double{left[i]} : 0.0;
    const double y = i < right.size() ? double{right[i]} : 0.0;
    if (std::abs(x - y) > most) return false;
  }
  return true;
}

}  // namespace

HapticsView::HapticsView(const InspectOptions& options, const PlotCanvas& canvas)
    : format_(options.format()),
      svg_(options.svg),
      step_(options.step.value_or(kStep)),
      canvas_(canvas) {
  if (step_ < kLeastStep) throw UsageError("--step is too small; write 100us or more");
  check_writable(svg_);
}

void HapticsView::begin(std::string& out) {
  if (format_ == Format::csv) out += "time,on,by,depth,force,east,north,up,given,need\n";
}

void HapticsView::expect(const peer::SourceDatagram& datagram) {
  const nanoseconds time = bounded_time(datagram.time);
  if (!started_) {
    started_ = true;
    start_ = next_ = last_ = time;
  }
  const nanoseconds until = std::min(time, last_ + kLongestSilence);
  for (; next_ < until && !heard_.entities().empty(); next_ += step_) sample(next_);
  last_ = std::max(last_, time);
  if (next_ >= time) return;
  // There are no samples before this datagram, however late it is.
  const auto steps = (time - next_ + step_ - nanoseconds(1)) / step_;
  number_ += static_cast<std::uint64_t>(steps);
  next_ += steps * step_;
}

void HapticsView::sample(nanoseconds time) {
  ++number_;
  heard_.forget_silent(time);
  for (const ContactForce& found : forces_.forces_at(heard_, time)) {
    if (format_ != Format::text) append_sample(found, time);
    ContactCourse* course = contact(found.on, found.by);
    if (course == nullptr) {
      ++crowded_contacts_;
      continue;
    }
    const double newtons = found.force.norm();
    if (course->samples == 0 || course->last + 1 != number_) ++course->touches;
    course->last = number_;
    ++course->samples;
    course->sum += newtons;
    course->history.add(time - start_, newtons);
    if (newtons <= course->peak) continue;
    course->peak = newtons;
    course->peak_time = time - start_;
  }
}

ContactCourse* HapticsView::contact(const pdu::EntityId& on, const pdu::EntityId& by) {
  const Key key{on.site, on.application, on.entity, by.site, by.application, by.entity};
  const auto known = contacts_.find(key);
  if (known != contacts_.end()) return &known->second;
  if (contacts_.size() == kMostContacts) return nullptr;
  return &contacts_.try_emplace(key, step_).first->second;
}

void HapticsView::pdu(const peer::SourceDatagram& datagram, const PduRow& row, nanoseconds,
                      std::string&) {
  if (row.decoded) heard_.take_pdu(row.bytes, row.header, bounded_time(datagram.time));
}

void HapticsView::datagram(const peer::SourceDatagram& datagram, nanoseconds, std::string& out) {
  for (const ForceJump& jump : forces_.jumps_of_datagram(heard_, bounded_time(datagram.time))) {
    ContactCourse* course = contact(jump.on, jump.by);
    if (course == nullptr) continue;
    ++course->updates;
    course->jumps.add(jump.size);
  }
  remember_updated();
  heard_.end_datagram();
  flush(out);
}

void HapticsView::remember_updated() {
  for (const TouchedEntity& touched : heard_.touched()) {
    const pdu::EntityId& id = touched.id;
    const ReceivedEntity* entity = heard_.find_entity(id);
    if (entity == nullptr || !entity->is_haptic()) continue;
    const ReceivedModel& heard = *heard_.model_of(*entity);
    const std::array<std::uint16_t, 3> key{id.site, id.application, id.entity};
    if (!entities_.contains(key) && entities_.size() == kMostEntities) continue;
    entities_[key] = {id, marking_of(*entity), heard.model, entity->updates, heard.valid_until()};
  }
}

void HapticsView::flush(std::string& out) {
  out += rows_;
  rows_.clear();
}

void HapticsView::append_sample(const ContactForce& force, nanoseconds time) {
  const StatedEnergy stated = heard_.stated_energy(force.by, force.on);
  const Eigen::Vector3d& f = force.force;
  if (format_ == Format::csv) {
    append_time(rows_, time);
    fmt::format_to(end_of(rows_), ",{},{},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g}\n",
                   id_text(force.on), id_text(force.by), force.depth, f.norm(), f.x(), f.y(), f.z(),
                   stated.given, stated.need);
    return;
  }
  rows_ += "{\"kind\":\"sample\",\"time\":";
  append_time(rows_, time);
  fmt::format_to(end_of(rows_),
                 ",\"on\":\"{}\",\"by\":\"{}\",\"depth\":{},\"force\":{},\"vector\":[{},{},{}],"
                 "\"given\":{},\"need\":{}}}\n",
                 id_text(force.on), id_text(force.by), json_number(force.depth),
                 json_number(f.norm()), json_number(f.x()), json_number(f.y()), json_number(f.z()),
                 json_number(stated.given), json_number(stated.need));
}

double HapticsView::seconds(std::uint64_t samples) const {
  return static_cast<double>(samples) * pdu::to_seconds(step_);
}

nanoseconds HapticsView::span() const { return last_ - start_; }

void HapticsView::finish(const InspectTally&, std::string& out) {
  for (auto& [key, course] : contacts_) course.history.reach(span());
  flush(out);
  if (format_ == Format::text) text(out);
  if (format_ == Format::json) json(out);
  if (!svg_.empty()) write_svg();
}

// Text
// ------------------------------------------------------------------------------------------------

void HapticsView::text(std::string& out) {
  fmt::format_to(end_of(out), "{}\n{} with a force model, {:.3f} s, a sample every {:g} ms.\n",
                 kBeforeGate,
                 entities_.size() == 1 ? "1 entity" : fmt::format("{} entities", entities_.size()),
                 pdu::to_seconds(span()), 1e3 * pdu::to_seconds(step_));
  text_contacts(out);
  text_entities(out);
  text_left_out(out);
  text_plots(out);
}

void HapticsView::text_contacts(std::string& out) const {
  constexpr auto kRight = TextTable::Align::right;
  TextTable table({{"FORCE ON"},
                   {"BY MODEL OF"},
                   {"TOUCHES", kRight},
                   {"CONTACT s", kRight},
                   {"MEAN N", kRight},
                   {"PEAK N", kRight},
                   {"AT s", kRight},
                   {"UPDATES", kRight},
                   {"JUMP p50 N", kRight},
                   {"p99 N", kRight}});
  for (const auto& [key, course] : contacts_) {
    const peer::Spread jumps = course.jumps.spread();
    table.add({id_text(id_of(key[0], key[1], key[2])), id_text(id_of(key[3], key[4], key[5])),
               fmt::format("{}", course.touches), fmt::format("{:.2f}", seconds(course.samples)),
               fmt::format("{:.3f}", course.mean()), fmt::format("{:.3f}", course.peak),
               fmt::format("{:.2f}", pdu::to_seconds(course.peak_time)),
               fmt::format("{}", course.updates), fmt::format("{:.3f}", jumps.p50),
               fmt::format("{:.3f}", jumps.p99)});
  }
  out += '\n';
  out += table.empty() ? "No two of them touched.\n" : table.text();
}

void HapticsView::text_entities(std::string& out) const {
  if (entities_.empty()) return;
  constexpr auto kRight = TextTable::Align::right;
  TextTable table({{"ENTITY"},
                   {"MARKING"},
                   {"KIND"},
                   {"k1 N/m", kRight},
                   {"k3 N/m^3", kRight},
                   {"b N s/m", kRight},
                   {"mu s/k", kRight},
                   {"r mm", kRight},
                   {"UPDATES", kRight},
                   {"VALID s", kRight},
                   {"GIVEN mJ", kRight},
                   {"NEED mJ", kRight}});
  for (const auto& [key, kept] : entities_) {
    const StatedEnergy stated = heard_.stated_energy(kept.id);
    const deadreckon::ForceModel& model = kept.model;
    const bool expired = kept.valid_until < last_;
    table.add({id_text(kept.id), kept.marking, std::string(pdu::name(model.kind)),
               fmt::format("{:g}", model.k1), fmt::format("{:g}", model.k3),
               fmt::format("{:g}", model.damping),
               fmt::format("{:.2g}/{:.2g}", model.static_friction, model.kinetic_friction),
               fmt::format("{:.4g}", 1e3 * model.radius), fmt::format("{}", kept.updates),
               fmt::format("{:g}{}", model.validity, expired ? " over" : ""),
               fmt::format("{:.3g}", 1e3 * stated.given),
               fmt::format("{:.3g}", 1e3 * stated.need)});
  }
  out += '\n';
  out += table.text();
}

void HapticsView::text_left_out(std::string& out) const {
  const ListenerRefusals& refused = heard_.refusals();
  const auto tell = [&](std::uint64_t count, std::string_view noun, std::string_view why) {
    if (count > 0) fmt::format_to(end_of(out), "{} {}\n", counted(count, noun), why);
  };
  tell(refused.values, "record", "left out: impossible values, which a peer refuses");
  tell(refused.stale, "Entity State", "left out: not newer than an earlier one");
  tell(refused.unplaced, "force model",
       "left out: no Entity State with CEI set before it (see `check`)");
  tell(refused.crowded, "update",
       fmt::format("left out: more than {} haptic entities", kMostEntities));
  tell(crowded_contacts_, "sample",
       fmt::format("not in the table: more than {} contacts", kMostContacts));
}

std::vector<HapticsView::Curve> HapticsView::curves() const {
  std::vector<Curve> found;
  for (const auto& [key, course] : contacts_) {
    if (course.samples == 0) continue;
    const std::string on = id_text(id_of(key[0], key[1], key[2]));
    const std::string by = id_text(id_of(key[3], key[4], key[5]));
    const auto back = contacts_.find({key[3], key[4], key[5], key[0], key[1], key[2]});
    const bool twin = back != contacts_.end() && same_curve(course, back->second);
    if (twin && back->first < key) continue;
    found.push_back({twin ? fmt::format("{} and {} on each other", on, by)
                          : fmt::format("on {} by the model of {}", on, by),
                     &course});
  }
  std::ranges::stable_sort(
      found, [](const Curve& a, const Curve& b) { return a.course->peak > b.course->peak; });
  return found;
}

void HapticsView::text_plots(std::string& out) const {
  const std::vector<Curve> all = curves();
  for (std::size_t i = 0; i < std::min(all.size(), kMostPlots); ++i) {
    fmt::format_to(end_of(out), "\n{}, force [N] over time [s]\n", all[i].name);
    out += terminal_plot(all[i].course->history.peaks(), {"N", pdu::to_seconds(span())}, canvas_);
  }
  if (all.size() > kMostPlots)
    fmt::format_to(end_of(out), "\nand {} more: --svg FILE draws {} of them, --csv has all\n",
                   all.size() - kMostPlots, SvgPlot::kMostCurves);
}

// JSON and SVG
// ------------------------------------------------------------------------------------------------

void HapticsView::json(std::string& out) const {
  for (const auto& [key, course] : contacts_) {
    const peer::Spread jumps = course.jumps.spread();
    fmt::format_to(end_of(out),
                   "{{\"kind\":\"contact\",\"on\":\"{}\",\"by\":\"{}\",\"touches\":{},"
                   "\"seconds\":{},\"mean\":{},\"peak\":{},\"peak_at\":{},\"updates\":{},"
                   "\"jump_p50\":{},\"jump_p99\":{},\"jump_max\":{}}}\n",
                   id_text(id_of(key[0], key[1], key[2])), id_text(id_of(key[3], key[4], key[5])),
                   course.touches, json_number(seconds(course.samples)), json_number(course.mean()),
                   json_number(course.peak), json_number(pdu::to_seconds(course.peak_time)),
                   course.updates, json_number(jumps.p50), json_number(jumps.p99),
                   json_number(jumps.max));
  }
  for (const auto& [key, kept] : entities_) {
    const StatedEnergy stated = heard_.stated_energy(kept.id);
    const deadreckon::ForceModel& model = kept.model;
    fmt::format_to(end_of(out), "{{\"kind\":\"entity\",\"id\":\"{}\"", id_text(kept.id));
    append_json_member(out, "marking", kept.marking);
    fmt::format_to(
        end_of(out),
        ",\"model\":{},\"k1\":{},\"k3\":{},\"damping\":{},\"mass\":{},\"static_friction\":{},"
        "\"kinetic_friction\":{},\"radius\":{},\"updates\":{},\"validity\":{},\"valid\":{},"
        "\"given\":{},\"need\":{}}}\n",
        static_cast<unsigned>(model.kind), json_number(model.k1), json_number(model.k3),
        json_number(model.damping), json_number(model.mass), json_number(model.static_friction),
        json_number(model.kinetic_friction), json_number(model.radius), kept.updates,
        json_number(model.validity), kept.valid_until >= last_, json_number(stated.given),
        json_number(stated.need));
  }
  const ListenerRefusals& refused = heard_.refusals();
  fmt::format_to(end_of(out),
                 "{{\"kind\":\"all\",\"summary\":\"haptics\",\"seconds\":{},\"step\":{},"
                 "\"entities\":{},\"contacts\":{},\"refused\":{},\"stale\":{},\"unplaced\":{},"
                 "\"crowded\":{}}}\n",
                 json_number(pdu::to_seconds(span()), 9), json_number(pdu::to_seconds(step_)),
                 entities_.size(), contacts_.size(), refused.values, refused.stale,
                 refused.unplaced, refused.crowded + crowded_contacts_);
}

void HapticsView::write_svg() const {
  SvgPlot plot;
  plot.title = "Contact force of the transmitted models";
  plot.note = "before the receivers' gates, without friction";
  plot.value = "force [N]";
  plot.end = pdu::to_seconds(span());
  for (const Curve& curve : curves())
    plot.curves.push_back({curve.name, curve.course->history.peaks()});
  std::ofstream file(svg_, std::ios::binary | std::ios::trunc);
  file << svg_text(plot);
  if (!file.flush())
    throw UsageError(fmt::format("{} could not be written completely; is the disk full?", svg_));
}

namespace view {

InspectViewKind haptics() {
  return {"haptics", "contact forces over time, from the transmitted models", true,
          [](const InspectOptions& options, const Console& console) -> std::unique_ptr<View> {
            return std::make_unique<HapticsView>(options, canvas_of(console.out));
          }};
}

}  // namespace view
}  // namespace reckon::tools
