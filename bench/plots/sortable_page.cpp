// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/plots/sortable_page.hpp"

#include <fmt/format.h>

#include "reckon/bench/plots/html_page.hpp"

namespace reckon::bench {
namespace {

constexpr std::string_view kSortStyle = R"(
body>svg,section>svg{display:block;width:100%;height:auto;max-width:60rem;margin:.8rem 0}
.d td{color:var(--soft)}th button{all:unset;cursor:pointer}
th button:focus-visible{outline:2px solid}
th[aria-sort=ascending] button::after{content:" \2191"}
th[aria-sort=descending] button::after{content:" \2193"}
.few tr.d,.few td:last-child,.few th:last-child{display:none}
.more{font:inherit;margin:.6rem 0;padding:.2rem .7rem;color:inherit;background:var(--band);
border:1px solid var(--line);border-radius:6px;cursor:pointer}
)";

constexpr std::string_view kScript = R"(
for (const section of document.querySelectorAll("section")) {
  const table = section.querySelector("table"), body = table.tBodies[0];
  const beaten = body.querySelectorAll("tr.d").length;
  if (beaten > 0) {
    const more = document.createElement("button");
    more.className = "more";
    const show = few => {
      table.classList.toggle("few", few);
      more.textContent = (few ? "Show" : "Hide") + " the " + beaten + " dominated settings";
    };
    more.onclick = () => show(!table.classList.contains("few"));
    show(true);
    table.parentNode.before(more);
  }
  table.querySelectorAll("th").forEach((head, column) => {
    const button = document.createElement("button");
    button.textContent = head.textContent;
    head.replaceChildren(button);
    button.onclick = () => {
      const up = head.getAttribute("aria-sort") !== "ascending";
      for (const other of table.querySelectorAll("th")) other.removeAttribute("aria-sort");
      head.setAttribute("aria-sort", up ? "ascending" : "descending");
      const value = row => row.cells[column].dataset.v ?? row.cells[column].textContent;
      const order = (a, b) => {
        const x = value(a), y = value(b);
        return isNaN(x) || isNaN(y) ? x.localeCompare(y) : x - y;
      };
      body.append(...[...body.rows].sort((a, b) => up ? order(a, b) : order(b, a)));
    };
  });
}
)";

}  // namespace

std::string sortable_page(std::string_view title, std::string_view style, std::string_view body) {
  return html_page(title, fmt::format("{}{}", kSortStyle, style),
                   fmt::format("{}<script>{}</script>\n", body, kScript));
}

std::string page_cell(double value, const std::string& text) {
  return fmt::format("<td data-v=\"{:.6g}\">{}</td>", value, text);
}

}  // namespace reckon::bench
