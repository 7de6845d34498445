// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The view `emissions`: at the end of the source, all emissions with their entity and start.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "reckon/peer/emissions/emission_table.hpp"
#include "reckon/peer/loops/aoim_setup.hpp"
#include "reckon/tools/datagrams/bounded_time.hpp"
#include "reckon/tools/emissions/emission_text.hpp"
#include "reckon/tools/inspect/output/view.hpp"
#include "reckon/tools/terminal/text_end.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::tools {
namespace {

using std::chrono::nanoseconds;

/// Ended emissions stay in the table as long as there is room.
class EmissionsView final : public View {
 public:
  explicit EmissionsView(bool json) : json_(json) {}

  void expect(const peer::SourceDatagram& datagram) override {
    last_ = std::max(last_, bounded_time(datagram.time));
  }
  void pdu(const peer::SourceDatagram& datagram, const PduRow& row, nanoseconds start,
           std::string&) override {
    start_ = bounded_time(start);
    if (row.decoded)
      table_.take(row.bytes, {peer::source_of(datagram.source), bounded_time(datagram.time)});
  }
  void finish(const InspectTally&, std::string& out) override {
    std::vector<const peer::Emission*> rows;
    for (const peer::Emission& row : table_.rows()) rows.push_back(&row);
    std::ranges::sort(rows, {}, [](const peer::Emission* row) {
      return std::tuple(row->entity, row->kind(), row->number);
    });
    if (!json_) return text(rows, out);
    for (const peer::Emission* row : rows) {
      append_emission_json(out, *row, start_, last_);
      out += '\n';
    }
  }

 private:
  static constexpr std::size_t kRows = 16384;

  void text(const std::vector<const peer::Emission*>& rows, std::string& out) const {
    out += rows.empty() ? "No Electromagnetic Emission, IFF or Transmitter PDU.\n"
                        : emissions_table(rows, start_, last_);
    const peer::EmissionRefusals& refused = table_.refusals();
    if (refused.disputed > 0)
      fmt::format_to(end_of(out), "{} left out: another host sends that system\n",
                     counted(refused.disputed, "state"));
    if (refused.no_room > 0)
      fmt::format_to(end_of(out), "{} left out: more than {} systems of an entity, or {} in all\n",
                     counted(refused.no_room, "state"), peer::EmissionTable::kRowsOfEntity, kRows);
  }

  bool json_;
  peer::EmissionTable table_{kRows};
  nanoseconds start_{0}, last_{0};
};

}  // namespace

namespace view {

InspectViewKind emissions() {
  return {"emissions", "active emitters with their beams, IFF, radios, and since when", false,
          [](const InspectOptions& options, const Console&) -> std::unique_ptr<View> {
            return std::make_unique<EmissionsView>(options.json);
          }};
}

}  // namespace view
}  // namespace reckon::tools
