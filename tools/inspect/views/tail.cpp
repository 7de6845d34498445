// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The view `tail`: every PDU separately, as a line, a tree of its fields or a JSON object.
#include <chrono>
#include <memory>
#include <string>

#include "reckon/tools/inspect/output/json_lines.hpp"
#include "reckon/tools/inspect/output/text_lines.hpp"
#include "reckon/tools/inspect/output/view.hpp"

namespace reckon::tools {
namespace {

class TailView final : public View {
 public:
  TailView(const InspectOptions& options, bool colour)
      : json_(options.json), full_(options.full), tree_(options.tree), colour_(colour) {}

  void begin(std::string& out) override {
    if (!json_ && !tree_) append_tail_titles(out);
  }
  void pdu(const peer::SourceDatagram&, const PduRow& row, std::chrono::nanoseconds start,
           std::string& out) override {
    if (json_)
      append_json_line(out, row, full_);
    else if (tree_)
      append_tree(out, row, colour_);
    else
      append_tail_line(out, row, start, colour_);
  }

 private:
  bool json_;
  bool full_;
  bool tree_;
  bool colour_;
};

}  // namespace

namespace view {

InspectViewKind tail() {
  return {"tail", "one line per PDU (the default for files, pipes and --json)", false,
          [](const InspectOptions& options, const Console& console) -> std::unique_ptr<View> {
            return std::make_unique<TailView>(options, console.colour);
          }};
}

}  // namespace view
}  // namespace reckon::tools
