// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/plots/html_page.hpp"

#include <fmt/format.h>

#include "reckon/tools/plots/markup.hpp"

namespace reckon::bench {
namespace {

constexpr std::string_view kStyle = R"(
:root{color-scheme:light dark;--ink:#1f2328;--soft:#59636e;--line:#d8dee4;--page:#fff;
--band:#f6f8fa}
@media(prefers-color-scheme:dark){:root{--ink:#e6edf3;--soft:#9198a1;--line:#30363d;--page:#0d1117;
--band:#161b22}}
@media print{:root{--ink:#000;--soft:#333;--line:#999;--page:#fff;--band:#eee}}
body{margin:0 auto;padding:1.5rem 1rem 4rem;max-width:76rem;font:15px/1.5 system-ui,sans-serif;
color:var(--ink);background:var(--page)}
h1{font-size:1.6rem;margin:0 0 .5rem}h2{font-size:1.25rem;margin:2.5rem 0 .2rem;
border-top:1px solid var(--line);padding-top:1.5rem}
p{margin:.3rem 0;max-width:60rem}code{font:13px ui-monospace,monospace;overflow-wrap:anywhere}
dl{display:grid;grid-template-columns:max-content 1fr;gap:.15rem 1rem;margin:1rem 0}
dt{color:var(--soft)}dd{margin:0}a{color:inherit}
nav a{display:inline-block;margin:.2rem .8rem .2rem 0}.note{color:var(--soft)}
.loud{border:2px solid;padding:.4rem .8rem;font-weight:600}
.wide{overflow-x:auto}table{border-collapse:collapse;font-variant-numeric:tabular-nums;
font-size:13px;white-space:nowrap}
th,td{padding:.2rem .6rem;text-align:right;border-bottom:1px solid var(--line)}
th{background:var(--band);font-weight:600}.w{text-align:left}
@media print{section{break-inside:avoid}}
)";

}  // namespace

std::string html_escaped(std::string_view text) {
  std::string out;
  tools::append_escaped(out, text);
  return out;
}

std::string html_page(std::string_view title, std::string_view style, std::string_view body) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n"
      "<title>{0}</title>\n<style>{1}{2}</style>\n</head>\n<body>\n<h1>{0}</h1>\n{3}</body>\n"
      "</html>\n",
      html_escaped(title), kStyle, style, body);
}

}  // namespace reckon::bench
