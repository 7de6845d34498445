// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/exercise/live_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "reckon/tools/emissions/emission_text.hpp"
#include "reckon/tools/exercise/fitted_columns.hpp"
#include "reckon/tools/exercise/hand_report.hpp"
#include "reckon/tools/exercise/leaders_report.hpp"
#include "reckon/tools/exercise/live_frame.hpp"
#include "reckon/tools/terminal/plot_axis.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::tools {
namespace {

using peer::EntityView;
using peer::PeerView;

constexpr auto kLeft = TextTable::Align::left;
constexpr auto kRight = TextTable::Align::right;
constexpr std::size_t kLeastNoticeLines = 3, kMostNoticeLines = 8;
constexpr std::size_t kRowsForNotices = 12, kRowsForKeys = 6, kRowsForTitles = 4;

std::uint64_t count(const peer::Counters& counters, std::string_view name) {
  const peer::Counter* counter = counters.find(name);
  return counter == nullptr ? 0 : counter->value();
}

std::string id_text(const pdu::EntityId& id) {
  return fmt::format("{}:{}:{}", id.site, id.application, id.entity);
}

// Input of a cell. The first hand shares the line of its peer.
struct HandCell {
  const TablePeer& peer;
  const peer::HandView* hand;  // null: the peer has none
  bool first;
  std::size_t shown;  // remote entities with a line
  double elapsed;
  std::size_t bar;  // columns of a bar for a force of `whole` [N]
  double whole;
};
struct EntityCell {
  const EntityView& row;
  const PeerView& view;
};

// Share of the springs of hands that energy and the number of contacts allow.
double shown_share(const haptics::ServoSnapshot& servo) {
  return servo.spring_share * servo.crowd_share;
}
bool is_held_back(const haptics::ServoSnapshot& servo) {
  const auto is_touched = [](const haptics::ContactAccount& contact) {
    return contact.asked_force.norm() > haptics::Shortfall::kLeastForce;
  };
  const auto* end = servo.contacts.data() + servo.count;
  return shown_share(servo) < 1.0 - haptics::Shortfall::kLeastShare &&
         std::any_of(servo.contacts.data(), end, is_touched);
}

bool is_softened(const haptics::ServoSnapshot& servo) {
  return servo.softening < 1.0 - haptics::Shortfall::kLeastShare;
}

bool is_cut(const haptics::ServoSnapshot& servo) {
  return servo.limit_share < 1.0 - haptics::Shortfall::kLeastShare;
}

// Whether the force column (two digits of newtons) shows more than 0.00, or the hand touches or
// grabs.
bool is_felt(const haptics::ServoSnapshot& servo) {
  constexpr double kLeastShown = 0.005;  // [N]
  return servo.in_mesh_contact || servo.held.number > 0 || servo.force.norm() >= kLeastShown;
}

bool is_worth_a_look(const haptics::ServoSnapshot& servo) {
  return servo.stopped || !servo.enabled || servo.left_out > 0 || servo.loan > 0 ||
         is_held_back(servo) || is_softened(servo) || is_cut(servo);
}

std::string state_text(const HandCell& cell) {
  if (cell.peer.view->frozen) return "FROZEN";
  if (cell.hand == nullptr) return "";
  const haptics::ServoSnapshot& servo = cell.hand->servo;
  if (servo.stopped) return "STOPPED";
  if (!servo.enabled) return "OFF";
  if (servo.left_out > 0) return fmt::format("{} UNFELT", servo.left_out);
  if (is_cut(servo)) return fmt::format("CUT {:.0f}%", 100.0 * servo.limit_share);
  if (is_held_back(servo)) return fmt::format("HELD {:.0f}%", 100.0 * shown_share(servo));
  if (is_softened(servo)) return fmt::format("SOFT {:.0f}%", 100.0 * servo.softening);
  const double loan = servo.loan + servo.region_loan;
  if (loan > 0) return fmt::format("LOAN{:2.0f}mJ", std::ceil(1e3 * loan));
  return is_felt(servo) ? "touches" : "free";
}

std::string sees_text(const HandCell& cell) {
  if (!cell.first) return "";
  const std::size_t all = cell.peer.view->entities;
  return cell.shown < all ? fmt::format("{} of {}", cell.shown, all) : fmt::format("{}", all);
}

std::string place_text(const HandCell& cell) {
  if (cell.hand == nullptr) return "";
  const Eigen::Vector3d mm = 1e3 * cell.hand->servo.scp;
  return fmt::format("{:+6.1f} {:+6.1f} {:+6.1f}", mm.x(), mm.y(), mm.z());
}

std::string sent_text(const HandCell& cell) {
  if (!cell.first || !(cell.elapsed > 0)) return "";
  const auto sent = static_cast<double>(count(*cell.peer.counters, "datagrams_out"));
  return fmt::format("{:.1f}/s", sent / cell.elapsed);
}

/// Force that fills a bar [N].
double bar_end(const LivePicture& picture) {
  constexpr double kParts = 2;
  return round_end(picture.strongest, kParts);
}

/// Widths of a number with its unit, and minimum and maximum of the force bar after it.
constexpr std::size_t kNewtons = 7, kLeastBar = 3, kMostBar = 24;

std::string force_text(const HandCell& cell) {
  if (cell.hand == nullptr) return "";
  const double force = cell.hand->servo.force.norm();
  const double length = std::min(force / cell.whole, 1.0) * static_cast<double>(cell.bar);
  std::string bar(static_cast<std::size_t>(length), '#');
  if (bar.empty() && is_felt(cell.hand->servo)) bar = ".";
  return fmt::format("{:>{}} {:<{}}", fmt::format("{:.2f} N", force), kNewtons, bar, cell.bar);
}

constexpr std::array<FittedColumn<HandCell>, 8> kHandColumns{{
    {"PEER", kLeft, 10, 0,
     [](const HandCell& c) { return id_text(c.hand != nullptr ? c.hand->id : c.peer.view->own); }},
    {"SEES", kRight, 8, 1, sees_text},
    {"HAND mm", kRight, 20, 4, place_text},
    {"  FORCE", kLeft, kNewtons + 1 + kLeastBar, 3, force_text, kMostBar - kLeastBar},
    {"STATE", kLeft, 8, 2, state_text},
    {"SENT", kRight, 8, 5, sent_text},
    {"LOST", kRight, 4, 6,
     [](const HandCell& c) {
       return c.first ? fmt::format("{}", count(*c.peer.counters, "datagrams_lost")) : "";
     }},
    {"ENERGY", kRight, 10, 7,
     [](const HandCell& c) {
       return c.hand == nullptr ? "" : fmt::format("{:.1e} J", c.hand->servo.port_energy);
     }},
}};

constexpr std::array<FittedColumn<EntityCell>, 10> kEntityColumns{{
    {"  REMOTE", kLeft, 12, 0, [](const EntityCell& c) { return "  " + id_text(c.row.id); }},
    {"MARKING", kLeft, 11, 1,
     [](const EntityCell& c) { return printable_text(c.row.marking.data()); }},
    {"AWAY", kRight, 7, 2,
     [](const EntityCell& c) { return distance_text((c.row.position - c.view.middle).norm()); }},
    {"RATE", kRight, 8, 5,
     [](const EntityCell& c) {
       return c.row.rate_hz > 0 ? fmt::format("{:.1f} Hz", c.row.rate_hz) : std::string("-");
     }},
    {"JUMP", kRight, 9, 3,
     [](const EntityCell& c) { return fmt::format("{:.2f} mm", 1e3 * c.row.jump_m); }},
    {"AGE", kRight, 6, 4, [](const EntityCell& c) { return fmt::format("{:.1f} s", c.row.age); }},
    {"FORCE", kRight, 7, 6,
     [](const EntityCell& c) {
       if (c.row.refused) return std::string("REFUSED");
       return c.row.haptic ? fmt::format("{:.2f} N", c.row.force_n) : "";
     }},
    {"DRM", kRight, 3, 7,
     [](const EntityCell& c) { return fmt::format("{}", static_cast<int>(c.row.algorithm)); }},
    {"K1", kRight, 8, 8,
     [](const EntityCell& c) {
       if (!c.row.haptic) return std::string();
       if (c.row.k1_felt < c.row.k1) return fmt::format("{:.0f}/{:.0f}", c.row.k1_felt, c.row.k1);
       return fmt::format("{:.0f} N/m", c.row.k1);
     }},
    {"LEDGER", kRight, 9, 9,
     [](const EntityCell& c) {
       return c.row.haptic ? fmt::format("{:.2f} mJ", 1e3 * c.row.ledger_j) : "";
     }},
}};

// Lines that a peer needs in addition to its first one.
std::size_t hand_lines(const PeerView& view) {
  return view.hand_count - std::min<std::size_t>(view.hand_count, 1);
}
std::size_t wanted(const PeerView& view) {
  // One line states the number of hidden entities, or that there are none.
  const bool remark = view.entities > view.count || view.entities == 0;
  const auto emitting = std::count_if(view.rows.begin(), view.rows.begin() + view.count,
                                      [](const EntityView& row) { return row.emits.any(); });
  return hand_lines(view) + view.count + static_cast<std::size_t>(emitting) + (remark ? 1 : 0);
}

// Lines of each peer after its first, distributed round-robin until none is left.
std::vector<std::size_t> shares(std::span<const TablePeer> peers, std::size_t room) {
  std::vector<std::size_t> share(peers.size(), 0);
  for (bool given = true; given && room > 0;) {
    given = false;
    for (std::size_t i = 0; i < peers.size() && room > 0; ++i) {
      if (share[i] == wanted(*peers[i].view)) continue;
      ++share[i];
      --room;
      given = true;
    }
  }
  return share;
}

// The nearest entities of a view, in the order of their IDs.
std::vector<std::size_t> nearest(const PeerView& view, std::size_t most) {
  std::vector<std::size_t> places(view.count);
  std::iota(places.begin(), places.end(), std::size_t{0});
  if (most >= places.size()) return places;
  const auto distance = [&](std::size_t i) {
    const double away = (view.rows[i].position - view.middle).squaredNorm();
    return away == away ? away : std::numeric_limits<double>::max();
  };
  std::nth_element(places.begin(), places.begin() + static_cast<std::ptrdiff_t>(most), places.end(),
                   [&](std::size_t a, std::size_t b) {
                     return std::pair(distance(a), a) < std::pair(distance(b), b);
                   });
  places.resize(most);
  std::sort(places.begin(), places.end());
  return places;
}

class Table {
 public:
  Table(const LivePicture& picture, ScreenSize size)
      : picture_(picture),
        hands_(kHandColumns, size.columns),
        entities_(kEntityColumns, size.columns),
        whole_(bar_end(picture)) {}

  [[nodiscard]] std::vector<ScreenLine> titles() const {
    return {{hands_.titles(), LineStyle::title}, {entities_.titles(), LineStyle::faint}};
  }

  /// Number of lines for all hands and entities.
  [[nodiscard]] std::size_t wanted_lines() const {
    std::size_t lines = picture_.peers.size();
    for (const TablePeer& peer : picture_.peers) lines += wanted(*peer.view);
    return lines;
  }
  /// Lines of all peers, at most `room`.
  [[nodiscard]] std::vector<ScreenLine> lines(std::size_t room) const {
    std::vector<ScreenLine> out;
    std::span<const TablePeer> peers = picture_.peers;
    const bool all = peers.size() <= room;
    if (!all) peers = peers.first(room > 0 ? room - 1 : 0);
    const auto share = shares(peers, all ? room - peers.size() : 0);
    for (std::size_t i = 0; i < peers.size(); ++i) block(peers[i], share[i], out);
    if (!all && room > 0)
      out.push_back({fmt::format("and {} more peers", picture_.peers.size() - peers.size())});
    return out;
  }

 private:
  void block(const TablePeer& peer, std::size_t lines, std::vector<ScreenLine>& out) const {
    const PeerView& view = *peer.view;
    const std::size_t more_hands = std::min(lines, hand_lines(view));
    lines -= more_hands;
    // With one line left, an entity is more useful than the number of hidden ones.
    const bool cut = lines < view.entities;
    const std::size_t shown = std::min(view.count, cut && lines > 1 ? lines - 1 : lines);
    for (std::size_t i = 0; i <= more_hands; ++i) {
      const peer::HandView* hand = i < view.hand_count ? &view.hands[i] : nullptr;
      const bool is_bad = view.frozen || (hand != nullptr && is_worth_a_look(hand->servo));
      out.push_back({hands_.row({peer, hand, i == 0, shown, picture_.elapsed,
                                 kLeastBar + hands_.more(), whole_}),
                     is_bad ? LineStyle::bad : LineStyle::title});
    }
    const bool remark = shown < view.entities;
    std::size_t left = lines - std::min(lines, shown + (remark ? 1 : 0));
    for (const std::size_t i : nearest(view, shown)) {
      const EntityView& row = view.rows[i];
      out.push_back({entities_.row({row, view}), row.frozen ? LineStyle::faint : LineStyle::plain});
      if (left == 0 || !row.emits.any()) continue;
      out.push_back({"    emits " + emitted_text(row.emits), LineStyle::faint});
      --left;
    }
    if (shown < lines && shown < view.entities)
      out.push_back({fmt::format("  and {} more, farther away", view.entities - shown)});
    if (view.entities == 0 && lines > 0) out.push_back({"  no entity received yet"});
  }

  const LivePicture& picture_;
  FittedColumns<HandCell, kHandColumns.size()> hands_;
  FittedColumns<EntityCell, kEntityColumns.size()> entities_;
  double whole_;  // [N], force of a full bar
};

}  // namespace

std::vector<ScreenLine> live_lines(const LivePicture& picture, ScreenSize size) {
  std::vector<ScreenLine> out{
      {title_of(picture, bar_end(picture), size.columns), LineStyle::title}};
  if (size.rows >= kRowsForKeys) append_head(picture.head, size.columns, out);
  std::vector<const PeerView*> views;
  for (const TablePeer& peer : picture.peers) views.push_back(peer.view);
  const auto add = [&](const std::string& sentence, LineStyle style) {
    if (size.rows < kRowsForNotices || sentence.empty()) return;
    for (std::string& line : wrap(sentence, size.columns)) out.push_back({std::move(line), style});
  };
  add(softer_text(picture), LineStyle::bad);
  const std::string leaders = leaders_text(views);
  add(leaders.empty() ? leaders : "leaders: " + leaders, LineStyle::faint);
  const bool rests = std::ranges::any_of(views, &PeerView::bodies_rest);
  add(bodies_text(picture), rests ? LineStyle::bad : LineStyle::faint);

  const Table table(picture, size);
  if (size.rows >= kRowsForTitles)
    for (ScreenLine& line : table.titles()) out.push_back(std::move(line));
  std::vector<ScreenLine> foot;
  if (size.rows >= kRowsForNotices) {
    const std::size_t taken = out.size() + table.wanted_lines() + 1;
    const std::size_t free = size.rows - std::min(size.rows, taken);
    foot = notice_lines(picture.notices, size.columns,
                        std::clamp(free, kLeastNoticeLines, kMostNoticeLines));
  }
  if (size.rows >= kRowsForKeys) foot.push_back({keys_text(picture), LineStyle::faint});
  const std::size_t used = out.size() + foot.size();
  for (ScreenLine& line : table.lines(size.rows > used ? size.rows - used : 0))
    out.push_back(std::move(line));
  out.resize(std::max(size.rows, foot.size()) - foot.size());
  out.insert(out.end(), foot.begin(), foot.end());
  out.resize(size.rows);
  for (ScreenLine& line : out) line.text = cut_to(line.text, size.columns);
  return out;
}

std::string live_status(const LivePicture& picture) {
  std::size_t most = 0;
  std::uint64_t sent = 0, lost = 0;
  for (const TablePeer& peer : picture.peers) {
    most = std::max(most, peer.view->entities);
    sent += count(*peer.counters, "datagrams_out");
    lost += count(*peer.counters, "datagrams_lost");
  }
  return fmt::format("{:.1f} s: {}, {} seen, {} sent, {} lost", picture.elapsed,
                     counted(picture.peers.size(), "peer"),
                     most == 1 ? "1 remote entity" : fmt::format("{} remote entities", most),
                     counted(sent, "datagram"), lost);
}

}  // namespace reckon::tools
