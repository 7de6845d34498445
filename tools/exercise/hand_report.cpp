// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/exercise/hand_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>

#include "reckon/tools/terminal/json_text.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::tools {
namespace {

using haptics::ServoTally;
using haptics::Shortfall;
using peer::HandView;

constexpr std::size_t kNamed = 4;  // hands named in a sentence

std::string text_of(const pdu::EntityId& id) {
  return fmt::format("{}:{}:{}", id.site, id.application, id.entity);
}

std::string id_of(const HandView& hand) { return text_of(hand.id); }

void print_line(std::FILE* out, std::string_view what, std::string_view how) {
  fmt::print(out, "  {:<26} {}\n", what, how);
}

// "1:1:1, 1:2:1 and 4 more"
std::string names(const Hands& hands) {
  std::string text;
  for (std::size_t i = 0; i < std::min(kNamed, hands.size()); ++i)
    text += (i == 0 ? "" : ", ") + id_of(*hands[i]);
  return hands.size() > kNamed ? text + fmt::format(" and {} more", hands.size() - kNamed) : text;
}

// Empty if all hands are meant.
std::string behind(const Hands& some, std::size_t all) {
  return some.size() == all ? "" : " (" + names(some) + ")";
}

void print_softer(std::FILE* out, const Hands& hands) {
  std::map<std::string, Hands> by_sentence;
  for (const HandView* hand : hands) {
    for (const std::string& sentence : softer_than_asked(hand->stiffness))
      by_sentence[sentence].push_back(hand);
  }
  for (const auto& [sentence, some] : by_sentence)
    print_line(out, "softer than asked", sentence + behind(some, hands.size()));
}

/// A kind of shortfall, the time of which it is a share, and its cause.
struct Kind {
  std::string_view name;
  Shortfall ServoTally::*shortfall;
  double ServoTally::*of;  // [s]; null: no such time is counted
  std::string_view why;
};
constexpr Kind kKinds[] = {
    {"held back", &ServoTally::held_back, &ServoTally::hands, "energy was short"},
    {"guests held back", &ServoTally::guests, &ServoTally::hands, "energy was short, with hands"},
    {"softened", &ServoTally::softened, &ServoTally::hands, "energy was short for longer"},
    {"crowded", &ServoTally::crowd, &ServoTally::hands, "together stiffer than the device allows"},
    {"walls held back", &ServoTally::walls, nullptr, "energy was short"},
    {"held forces cut", &ServoTally::effects, nullptr, "energy was short"},
    {"rate limited", &ServoTally::rate, nullptr, "it grew or rotated faster than allowed"},
    {"force cut", &ServoTally::limit, nullptr, "it exceeded the limit of the device"},
};

double lacking(const Shortfall& s) { return (1.0 - s.share) * s.asked; }

void print_shortfall(std::FILE* out, const Kind& kind, const Hands& hands) {
  Hands some;
  double seconds = 0.0, of = 0.0;
  Shortfall worst;
  for (const HandView* hand : hands) {
    const ServoTally& tally = hand->servo.tally;
    const Shortfall& one = tally.*kind.shortfall;
    if (kind.of != nullptr) of += tally.*kind.of;
    if (one.seconds > 0) some.push_back(hand);
    seconds += one.seconds;
    if (lacking(one) > lacking(worst)) worst = one;
  }
  if (some.empty()) return;
  const std::string span =
      of > 0 ? fmt::format("{:.2g} % of the time in contact with hands", 100.0 * seconds / of)
             : fmt::format("{:.2g} s", seconds);
  print_line(out, kind.name,
             fmt::format("{}, at worst {:.0f} % of {:.3g} N displayed: {}{}", span,
                         100.0 * worst.share, worst.asked, kind.why, behind(some, hands.size())));
}

void print_touching(std::FILE* out, const Hands& hands) {
  Hands apart;
  for (const HandView* hand : hands) {
    if (!(hand->servo.tally.hands > 0) && !(hand->servo.tally.bodies > 0)) apart.push_back(hand);
  }
  if (apart.empty()) return;
  const bool all = apart.size() == hands.size();
  print_line(out, "touched nobody",
             all ? "no hand touched another, or an object of another peer" : names(apart));
}

void print_refused(std::FILE* out, const Hands& hands) {
  Hands some;
  double longest = 0.0;
  for (const HandView* hand : hands) {
    if (hand->servo.tally.refused > 0) some.push_back(hand);
    longest = std::max(longest, hand->servo.tally.refused);
  }
  if (some.empty()) return;
  print_line(
      out, "not shown",
      fmt::format("for {:.2g} s, a force model near a hand, because its values are impossible{}",
                  longest, behind(some, hands.size())));
}

void print_passed(std::FILE* out, const Hands& hands) {
  Hands some;
  std::uint64_t times = 0;
  for (const HandView* hand : hands) {
    if (hand->servo.tally.passed > 0) some.push_back(hand);
    times += hand->servo.tally.passed;
  }
  if (some.empty()) return;
  print_line(out, "let through",
             fmt::format("{}, an object exceeded the greatest force and moved through a hand{}",
                         counted(times, "time"), behind(some, hands.size())));
}

// The greatest loan for regions and the greatest energy of oscillations of any hand.
void print_sources(std::FILE* out, const Hands& hands) {
  double lent = 0.0, put_in = 0.0;
  for (const HandView* hand : hands) {
    lent = std::max(lent, hand->servo.region_loan_most);
    put_in = std::max(put_in, hand->servo.oscillation_energy);
  }
  if (!(lent > 0) && !(put_in > 0)) return;
  print_line(out, "regions put in",
             fmt::format("a loan of up to {:.3g} mJ; by oscillations {:.3g} mJ", 1e3 * lent,
                         1e3 * put_in));
}

void print_hidden(std::FILE* out, const Hands& hands) {
  Hands some;
  double deepest = 0.0;
  for (const HandView* hand : hands) {
    if (hand->servo.tally.hidden > 0) some.push_back(hand);
    deepest = std::max(deepest, hand->servo.tally.hidden);
  }
  if (some.empty()) return;
  print_line(out, "walls hidden",
             fmt::format("up to {:.3g} mm of their depth, because the hand started deeper inside "
                         "than its loan covers{}",
                         1e3 * deepest, behind(some, hands.size())));
}

// All hands of a program are stopped together.
void print_stops(std::FILE* out, const Hands& hands) {
  std::uint32_t stops = 0;
  double longest = 0.0;
  for (const HandView* hand : hands) {
    stops = std::max(stops, hand->servo.tally.stops);
    longest = std::max(longest, hand->servo.tally.stopped);
  }
  if (stops == 0) return;
  print_line(out, "forces stopped",
             fmt::format("{}, {:.3g} s in all", counted(stops, "time"), longest));
}

void print_steps(std::FILE* out, const Hands& hands) {
  std::uint64_t late = 0, force_drops = 0, failed = 0;
  double late_cost = 0.0;
  for (const HandView* hand : hands) {
    late += hand->servo.tally.late;
    force_drops += hand->servo.tally.force_drops;
    failed += hand->servo.tally.failed;
    late_cost += hand->servo.late_cost;
  }
  if (late > 0 || force_drops > 0)
    print_line(
        out, "late servo steps",
        fmt::format("{}; in {} of them, the device had dropped its force", late, force_drops));
  if (late_cost > 1e-9)
    print_line(out, "energy of late steps",
               fmt::format("up to {:.1e} J; the energy may be below 0 by this", late_cost));
  if (failed > 0)
    print_line(out, "failed readings", fmt::format("{} readings of a device's position", failed));
}

void append_shortfall(std::string& out, const Shortfall& shortfall) {
  JsonObject(out)
      .value("s", fmt::format("{:.6g}", shortfall.seconds))
      .value("worst_share", fmt::format("{:.6g}", shortfall.share))
      .value("worst_asked_n", fmt::format("{:.6g}", shortfall.asked))
      .end();
}

void append_hand(std::string& out, const HandView* hand) {
  const auto number = [](double value) {
    return std::isfinite(value) ? fmt::format("{:.6g}", value) : std::string("null");
  };
  const peer::DeviceStiffness& device = hand->stiffness;
  const ServoTally& tally = hand->servo.tally;
  JsonObject object(out);
  object.text("id", id_of(*hand))
      .value("walls_n_m", number(device.walls_shown()))
      .value("walls_asked_n_m", number(device.walls_asked))
      .value("regions_n_m", number(device.regions_shown()))
      .value("regions_asked_n_m", number(device.regions_asked))
      .value("hand_n_m", number(device.hand_shown()))
      .value("hand_asked_n_m", number(device.hand_asked))
      .value("hand_straight_from_m", number(device.straight_from()))
      .value("touching_hands_s", number(tally.hands))
      .value("touching_bodies_s", number(tally.bodies))
      .value("touching_scene_s", number(tally.scene))
      .value("holding_body_s", number(tally.grabbed));
  append_shortfall(object.member("held_back"), tally.held_back);
  append_shortfall(object.member("guests_held_back"), tally.guests);
  append_shortfall(object.member("softened"), tally.softened);
  append_shortfall(object.member("crowded"), tally.crowd);
  append_shortfall(object.member("walls_held_back"), tally.walls);
  append_shortfall(object.member("held_forces_cut"), tally.effects);
  append_shortfall(object.member("rate_limited"), tally.rate);
  append_shortfall(object.member("force_cut"), tally.limit);
  object.value("loan_j", number(hand->servo.loan_most))
      .value("region_loan_j", number(hand->servo.region_loan_most))
      .value("oscillation_j", number(hand->servo.oscillation_energy))
      .value("walls_hidden_m", number(tally.hidden))
      .value("refused_s", number(tally.refused))
      .value("late_steps", tally.late)
      .value("let_go", tally.force_drops)
      .value("failed_readings", tally.failed)
      .value("let_through", tally.passed)
      .value("stops", tally.stops)
      .value("stopped_s", number(tally.stopped))
      .end();
}

}  // namespace

void add_hands(const peer::PeerView& view, Hands& hands) {
  for (const HandView& hand : view.own_hands()) hands.push_back(&hand);
}

std::vector<std::string> softer_than_asked(const peer::DeviceStiffness& device) {
  std::vector<std::string> sentences;
  if (device.softens_walls())
    sentences.push_back(
        fmt::format("walls {:.6g} of {:.6g} N/m", device.walls_shown(), device.walls_asked));
  if (device.softens_regions())
    sentences.push_back(
        fmt::format("regions {:.6g} of {:.6g} N/m", device.regions_shown(), device.regions_asked));
  if (device.softens_hand())
    sentences.push_back(
        fmt::format("hands {:.6g} of {:.6g} N/m", device.hand_shown(), device.hand_asked));
  else if (std::isfinite(device.straight_from()))
    sentences.push_back(fmt::format("hands harden up to {:.6g} N/m, {:.3g} mm deep",
                                    device.hand_limit(), 1e3 * device.straight_from()));
  return sentences;
}

void print_hands(std::FILE* out, const Hands& hands) {
  if (hands.empty()) return;
  print_touching(out, hands);
  print_softer(out, hands);
  for (const Kind& kind : kKinds) print_shortfall(out, kind, hands);
  print_passed(out, hands);
  print_sources(out, hands);
  print_stops(out, hands);
  print_hidden(out, hands);
  print_refused(out, hands);
  print_steps(out, hands);
}

std::string hands_json(const Hands& hands) {
  std::string text = "[";
  for (const HandView* hand : hands) {
    if (text.size() > 1) text += ',';
    append_hand(text, hand);
  }
  return text + "]";
}

std::string felt_lines(const peer::PeerView& view, double seconds) {
  std::string text;
  for (std::size_t i = 0; i < view.hand_count; ++i) {
    const haptics::ServoSnapshot& servo = view.hands[i].servo;
    text += fmt::format(R"({{"event":"felt","id":"{}","seconds":{:.3f},"force_n":{{)",
                        id_of(view.hands[i]), seconds);
    for (std::size_t k = 0; k < servo.count; ++k) {
      const haptics::ContactAccount& contact = servo.contacts[k];
      text += fmt::format(R"({}"{}":{:.4f})", k == 0 ? "" : ",", text_of(contact.id),
                          (contact.force + contact.damper_force).norm());
    }
    text += "}}\n";
  }
  return text;
}

}  // namespace reckon::tools
