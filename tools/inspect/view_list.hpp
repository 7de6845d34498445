// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// THE list of the inspector's views. A new view = a header, an alternative of InspectView, and a
// row of kInspectViews.
//
// What a view may offer; it has those member functions that it needs, and the run calls no others:
//   begin(out)                          titles, before anything is read
//   expect(datagram)                    a datagram, before its PDUs
//   look(row)                           each of its PDUs, those that --where keeps out as well
//   pdu(datagram, row, start, out)      each PDU that is to be shown; `start` = time of the first
//                                       datagram
//   datagram(datagram, start, out)      after the PDUs, where one of them was to be shown,
//   skip()                              and where none was
//   tick(now, report, out)              live sources: after each datagram and every 0.1 s; `now`
//                                       since 1970-01-01 UTC
//   has_ended()                         whether the user ended it by the view's own means
//   finish(tally, out)                  at the end of the source
//   found_faults()                      whether the verb's exit status is 1; a view that has it
//                                       gives the counts of good and bad PDUs itself
#pragma once

#include <array>
#include <string_view>
#include <utility>
#include <variant>

#include "reckon/tools/command_line/console.hpp"
#include "reckon/tools/inspect/check/check_view.hpp"
#include "reckon/tools/inspect/output/options.hpp"
#include "reckon/tools/inspect/top/top_view.hpp"
#include "reckon/tools/inspect/views/bundles.hpp"
#include "reckon/tools/inspect/views/haptics.hpp"
#include "reckon/tools/inspect/views/stats.hpp"
#include "reckon/tools/inspect/views/tail.hpp"

namespace reckon::tools {

using InspectView = std::variant<TailView, StatsView, CheckView, BundlesView, HapticsView, TopView>;

struct InspectViewKind {
  std::string_view name;
  std::string_view meaning;  ///< for --help
  bool takes_csv;
  InspectView (*make)(const InspectOptions& options, const Console& console);
};

inline constexpr std::array<InspectViewKind, 6> kInspectViews{{
    {"tail", "one line a PDU (the default for files, pipes and --json)", false,
     [](const InspectOptions& options, const Console& console) -> InspectView {
       return TailView(options, console.colour);
     }},
    {"stats", "how much of what by whom", true,
     [](const InspectOptions& options, const Console&) -> InspectView {
       return StatsView(options.format(), options.by);
     }},
    {"check", "what is wrong and how to mend it", true,
     [](const InspectOptions& options, const Console& console) -> InspectView {
       return CheckView(options.format(), console.colour);
     }},
    {"bundles", "one line a datagram", true,
     [](const InspectOptions& options, const Console&) -> InspectView {
       return BundlesView(options.format());
     }},
    {"haptics", "contact forces over time, by the models on the wire", true,
     [](const InspectOptions& options, const Console& console) -> InspectView {
       return HapticsView(options, canvas_of(console.out));
     }},
    {"top",
     "one line an entity: rate, why it was sent, how far it jumped (the default, live on a "
     "terminal)",
     true,
     [](const InspectOptions& options, const Console& console) -> InspectView {
       return TopView(options, console);
     }},
}};

/// The kind of that name; of the first row where there is none.
[[nodiscard]] constexpr const InspectViewKind& inspect_view_kind(std::string_view name) {
  for (const InspectViewKind& kind : kInspectViews)
    if (kind.name == name) return kind;
  return kInspectViews.front();
}

}  // namespace reckon::tools
