// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/listener/entity_table.hpp"

#include <algorithm>
#include <utility>

#include "reckon/deadreckon/motion/rotation.hpp"
#include "reckon/pdu/seconds.hpp"

namespace reckon::tools {
namespace {

using deadreckon::ConversionError;
using pdu::to_seconds;
using std::chrono::nanoseconds;

constexpr nanoseconds kRateWindow = std::chrono::seconds(5);
constexpr std::uint64_t kRateUpdates = 4;
constexpr double kRateOfGone = 1.0;  // [s] for which the rate of a removed entity is kept

ListenerRules rules_for(std::size_t most_rows) {
  ListenerRules rules = kMonitorRules;
  rules.most_entities = most_rows;
  return rules;
}

/// Moves the window of the rate. @param arrival of the entity's last update  @param updates its
/// number
void move_window(EntityRow& row, nanoseconds arrival, std::uint64_t updates) {
  if (updates - row.window_updates[1] < kRateUpdates || arrival - row.window_time[1] < kRateWindow)
    return;
  row.window_time = {row.window_time[1], arrival};
  row.window_updates = {row.window_updates[1], updates};
}

void set_cause(EntityRow& row, UpdateCause cause) {
  row.cause = cause;
  ++row.causes[static_cast<std::size_t>(cause)];
}

}  // namespace

double EntityRow::rate(const ReceivedEntity& entity, nanoseconds now) const noexcept {
  if (entity.is_silent(now) || (entity.gone && entity.age(now) > kRateOfGone)) return 0;
  const auto count = static_cast<double>(entity.updates - window_updates[0]);
  const double span = to_seconds(entity.arrival - window_time[0]);
  if (count == 0 || span <= 0) return 0;
  return count / std::max(span, to_seconds(now - window_time[0]) - span / count);
}

std::vector<double> EntityRow::recent_jumps() const {
  const std::uint64_t end = jumps.count();
  std::vector<double> out;
  for (std::uint64_t i = end - std::min<std::uint64_t>(end, recent.size()); i < end; ++i)
    out.push_back(recent[i % recent.size()]);
  return out;
}

/// Updates the row for each PDU that the listener takes.
struct EntityTable::Counting : ListenerObserver {
  Counting(EntityTable& the_table, const PduRow& the_pdu, const peer::SourceDatagram& the_datagram,
           Watch* the_watch)
      : table(the_table), pdu(the_pdu), datagram(the_datagram), watch(the_watch) {}

  void receive_state(const StateUpdate& update) {
    EntityRow& row = table.row_at(update.place);
    row.octets += update.compressed > 0 ? update.compressed : pdu.bytes.size();
    if (update.verdict == ReceiveVerdict::values)
      return note_bad(update.place, pdu.rule.empty() ? sentence(update.error) : pdu.rule);
    if (update.verdict == ReceiveVerdict::stale) ++row.late;
    if (update.verdict == ReceiveVerdict::duplicate) ++row.duplicated;
    if (update.verdict != ReceiveVerdict::taken) return;
    if (watch != nullptr) watch->before_state(update);
    const ReceivedEntity& last = table.entities()[update.place];
    set_cause(row, update.is_first ? begin_anew(row, last, update) : compare(row, last, update));
    adopt(row, last, update);
  }

  void receive_records(std::size_t place, std::size_t sets) {
    if (table.entities()[place].has_state && sets == 1)
      table.rows_[place].octets += pdu.bytes.size();
  }

  void receive_model(const ModelUpdate& update) {
    if (watch != nullptr) watch->before_model(table.entities()[update.place], update);
    const bool is_new = table.forces_.note_model(table.listener_, update);
    if (!is_new || table.entities()[update.place].arrival != update.arrival) return;
    // A changed force model replaces the weaker cause of the Entity State before it.
    EntityRow& row = table.rows_[update.place];
    if (row.cause == UpdateCause::heartbeat || row.cause == UpdateCause::repeat) {
      --row.causes[static_cast<std::size_t>(row.cause)];
      set_cause(row, UpdateCause::force);
    }
  }

  void note_bad(std::size_t place, std::string_view rule) const {
    EntityRow& row = table.row_at(place);
    if (!table.entities()[place].has_state) {
      row.sender = datagram.source;
      row.group = datagram.group;
    }
    ++row.bad;
    row.rule = rule;
    row.last_is_bad = true;
  }

  // No comparison with the state before is possible.
  static UpdateCause begin_anew(EntityRow& row, const ReceivedEntity& last,
                                const StateUpdate& update) {
    row.window_time = {update.arrival, update.arrival};
    row.window_updates = {last.updates + 1, last.updates + 1};
    return UpdateCause::first;
  }

  UpdateCause compare(EntityRow& row, const ReceivedEntity& last, const StateUpdate& update) const {
    const Innovation found = innovation(last.state, update.state, update.between);
    row.jump = found.jump;
    if (row.worst_frame == 0 || static_cast<float>(found.jump) > row.jumps.max()) {
      row.worst_time = update.arrival;
      row.worst_frame = pdu.frame;
    }
    row.recent[row.jumps.count() % row.recent.size()] = static_cast<float>(found.jump);
    row.jumps.add(found.jump);
    row.turn = deadreckon::in_degrees(found.turn);
    row.turns.add(row.turn);
    const UpdateCause cause =
        cause_of(found, update.between.seconds, update.heartbeat, row.least_early_jump);
    return is_event(last.octets, update.octets) ? UpdateCause::event : cause;
  }

  // Makes the update the entity's last one.
  void adopt(EntityRow& row, const ReceivedEntity& last, const StateUpdate& update) const {
    row.last_is_bad = false;
    row.length = pdu.header.length;
    row.frame = pdu.frame;
    row.pdu_index = pdu.pdu;
    row.sender = datagram.source;
    row.group = datagram.group;
    move_window(row, update.arrival, last.updates + 1);
    table.forces_.note_state(table.listener_, update);
  }

  EntityTable& table;
  const PduRow& pdu;
  const peer::SourceDatagram& datagram;
  Watch* watch;  // null: none
};

EntityTable::EntityTable(std::size_t most_rows) : listener_(rules_for(most_rows)) {}

EntityRow& EntityTable::row_at(std::size_t place) {
  if (place == rows_.size()) rows_.emplace_back();
  return rows_[place];
}

void EntityTable::take_pdu(const PduRow& row, const peer::SourceDatagram& datagram, Watch* watch) {
  if (!start_.has_value()) start_ = datagram.time;
  Counting counting(*this, row, datagram, watch);
  if (row.decoded)
    return listener_.take_pdu(row.bytes, row.header, datagram.time, counting, row.entity_state);
  // Only Entity States create an entity, so broken ones do too.
  if (row.status != PduStatus::error || !row.id.has_value() ||
      row.header.pdu_type != pdu::PduType::entity_state)
    return;
  const std::size_t place =
      listener_.take_unreadable(row.header.exercise_id, *row.id, datagram.time);
  if (place == Listener::kNone) return;
  row_at(place).octets += row.bytes.size();
  counting.note_bad(place, row.rule);
}

void EntityTable::drop_where(auto&& is_over) {
  // The last row moves to the free place, so this place is checked again.
  for (std::size_t i = 0; i < rows_.size();) {
    const ReceivedEntity& entity = entities()[i];
    if (!is_over(entity)) {
      ++i;
      continue;
    }
    if (entity.is_haptic()) forces_.forget_model(entity.model);
    listener_.forget_entity(i);
    if (i + 1 != rows_.size()) rows_[i] = std::move(rows_.back());
    rows_.pop_back();
  }
}

void EntityTable::drop_gone(nanoseconds now) {
  drop_where([now](const ReceivedEntity& entity) {
    return entity.gone && now - entity.gone_at > kGoneShown;
  });
}

void EntityTable::drop_silent(nanoseconds now, nanoseconds silence) {
  drop_where([now, silence](const ReceivedEntity& entity) {
    const bool is_dumb = !entity.has_state || entity.is_silent(now);
    return is_dumb && now - entity.arrival > silence;
  });
}

const JumpHistogram* EntityTable::force_jumps(const ReceivedEntity& entity) const noexcept {
  return entity.is_haptic() ? &forces_.jumps(entity.model) : nullptr;
}

}  // namespace reckon::tools
