// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/accuracy/page_frame.hpp"

#include <fmt/format.h>

namespace reckon::bench {
namespace {

/// Colours that most people tell apart on white and on black; shapes tell them apart too.
constexpr std::string_view kStyle = R"(
:root{color-scheme:light dark;--ink:#1f2328;--soft:#59636e;--line:#d8dee4;--page:#fff;
--band:#f6f8fa;--front:#1f2328}
@media(prefers-color-scheme:dark){:root{--ink:#e6edf3;--soft:#9198a1;--line:#30363d;--page:#0d1117;
--band:#161b22;--front:#e6edf3}}
body{margin:0 auto;padding:1.5rem 1rem 4rem;max-width:76rem;font:15px/1.5 system-ui,sans-serif;
color:var(--ink);background:var(--page)}
h1{font-size:1.6rem;margin:0 0 .5rem}h2{font-size:1.25rem;margin:2.5rem 0 .2rem;
border-top:1px solid var(--line);padding-top:1.5rem}
p{margin:.3rem 0;max-width:60rem}code{font:13px ui-monospace,monospace;overflow-wrap:anywhere}
dl{display:grid;grid-template-columns:max-content 1fr;gap:.15rem 1rem;margin:1rem 0}
dt{color:var(--soft)}dd{margin:0}
nav a{display:inline-block;margin:.2rem .8rem .2rem 0}a{color:inherit}
.note{color:var(--soft)}.defs{position:absolute}
.plot{display:block;width:100%;max-width:60rem;margin:.8rem 0}
.plot text{font:13px system-ui,sans-serif;fill:var(--soft)}
.g{stroke:var(--line);fill:none}.a{stroke:var(--soft);fill:none}
.f{stroke:var(--front);fill:none;stroke-width:1.5;stroke-linejoin:round}
use{stroke:var(--page);stroke-width:.8}.plot .d{opacity:.28}
.legend span{display:inline-block;margin-right:1rem;white-space:nowrap}
.legend svg{vertical-align:-2px}
.m0{fill:#d55e00}.m1{fill:#8c8c8c}.m2{fill:#56b4e9}.m3{fill:#0072b2}.m4{fill:#009e73}
.m5{fill:#7fb800}.m6{fill:#e69f00}.m7{fill:#b8860b}.m8{fill:#cc79a7}.m9{fill:#8a5cd1}
.m10{fill:#17a2a2}
.wide{overflow-x:auto}table{border-collapse:collapse;font-variant-numeric:tabular-nums;
font-size:13px;white-space:nowrap}
th,td{padding:.2rem .6rem;text-align:right;border-bottom:1px solid var(--line)}
th{background:var(--band);font-weight:600}th button{all:unset;cursor:pointer}
th button:focus-visible{outline:2px solid}
th[aria-sort=ascending] button::after{content:" \2191"}
th[aria-sort=descending] button::after{content:" \2193"}
.w{text-align:left}tr.d td{color:var(--soft)}
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

std::string page_begin(std::string_view title) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n"
      "<title>{}</title>\n<style>{}</style>\n</head>\n<body>\n",
      html_text(title), kStyle);
}

std::string page_end() { return fmt::format("<script>{}</script>\n</body>\n</html>\n", kScript); }

std::string page_cell(double value, const std::string& text) {
  return fmt::format("<td data-v=\"{:.6g}\">{}</td>", value, text);
}

std::string html_text(std::string_view text) {
  std::string out;
  for (const char letter : text) {
    switch (letter) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += letter;
    }
  }
  return out;
}

}  // namespace reckon::bench
