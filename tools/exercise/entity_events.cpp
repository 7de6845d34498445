// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/exercise/entity_events.hpp"

#include <fmt/format.h>

#include <string>

#include "reckon/tools/terminal/json_text.hpp"

namespace reckon::tools {

EntityEvents::Letter::Letter(std::size_t entities) {
  heard.reserve(entities);
  removed.reserve(entities);
}

void EntityEvents::begin_pass(peer::ModelLoop&) noexcept {}

void EntityEvents::receive(const pdu::PduHeader&, std::span<const std::byte>,
                           const peer::InteractionSender&) noexcept {}

// While the reader holds the last letter, changes gather in the table: the newest of each entity.
// Updates are reported too, so that the update count is known when the entity goes.
void EntityEvents::end_pass(peer::ModelLoop& loop) noexcept {
  if (!letters_.is_free()) return;
  Letter& letter = letters_.letter();
  for (const peer::EntityChange& change : loop.remote().take_changes()) {
    if (change.change == peer::Change::removed) {
      letter.removed.push_back(change.id);
    } else if (const peer::RemoteEntity* row = loop.remote().find(change.id)) {
      letter.heard.push_back({row->id, row->marking, row->updates});
    }
  }
  if (!letter.heard.empty() || !letter.removed.empty()) letters_.send();
}

void EntityEvents::report(double elapsed, std::FILE* out) {
  Letter* letter = letters_.take();
  if (letter == nullptr) return;
  std::string text;
  const auto tell = [&](const char* event, const Heard& heard) {
    std::string marking;
    append_json_string(marking, heard.marking.data());
    text +=
        fmt::format(R"({{"event":"{}","id":"{}:{}:{}","marking":{},"seconds":{:.3f},"updates":{}}})"
                    "\n",
                    event, heard.id.site, heard.id.application, heard.id.entity, marking, elapsed,
                    heard.updates);
  };
  for (const pdu::EntityId& id : letter->removed) {
    const auto known = known_.find(id);
    if (known == known_.end()) continue;
    tell("gone", known->second);
    known_.erase(known);
  }
  for (const Heard& heard : letter->heard) {
    if (known_.insert_or_assign(heard.id, heard).second) tell("appeared", heard);
  }
  letter->heard.clear();
  letter->removed.clear();
  letters_.give_back();
  if (text.empty()) return;
  std::fwrite(text.data(), 1, text.size(), out);
  std::fflush(out);
}

void EntityEvents::report_rest(peer::ModelLoop& loop, double elapsed, std::FILE* out) {
  report(elapsed, out);
  end_pass(loop);
  report(elapsed, out);
}

}  // namespace reckon::tools
