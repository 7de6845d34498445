// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/command_line/manual_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "reckon/tools/command_line/command_line.hpp"
#include "reckon/tools/command_line/version.hpp"

namespace reckon::tools {
namespace {

constexpr std::size_t kColumns = 78;  // of the page's source

/// Removes the next line from the text and returns it.
std::string_view next_line(std::string_view& text) {
  const std::size_t end = std::min(text.find('\n'), text.size());
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return line;
}

/// Fills words into short lines. Each sentence begins a line, as is usual in man pages.
std::string filled(std::string_view text) {
  std::string out;
  std::size_t column = 0;
  bool sentence_ended = false;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    const std::string word = roff_text(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (word.empty()) continue;
    if (column > 0 && (sentence_ended || column + 1 + word.size() > kColumns)) {
      out += '\n';
      column = 0;
    }
    if (column > 0) out += ' ';
    out += word;
    column += word.size() + 1;
    sentence_ended = word.ends_with('.') && word != "e.g.";
  }
  return out + '\n';
}

/// Prose; indented lines stay unchanged.
void print_prose(std::string_view text, std::FILE* out) {
  std::string paragraph;
  bool kept = false;
  const auto end_paragraph = [&] {
    if (!paragraph.empty()) fmt::print(out, "{}", filled(paragraph));
    paragraph.clear();
  };
  while (!text.empty()) {
    const std::string_view line = next_line(text);
    const bool keep = line.starts_with(' ');
    if (keep != kept || line.empty()) end_paragraph();
    if (keep != kept) fmt::print(out, "{}", keep ? ".RS 2\n.nf\n" : ".fi\n.RE\n");
    kept = keep;
    if (keep) {
      fmt::print(out, "{}\n", roff_text(line.substr(line.find_first_not_of(' '))));
    } else if (line.empty()) {
      if (!text.empty()) fmt::print(out, ".PP\n");
    } else {
      paragraph += fmt::format("{} ", line);
    }
  }
  end_paragraph();
  if (kept) fmt::print(out, ".fi\n.RE\n");
}

void print_entry(const ManualEntry& entry, std::FILE* out) {
  fmt::print(out, ".TP\n\\fB{}\\fR", roff_text(entry.names));
  if (!entry.value.empty()) fmt::print(out, " \\fI{}\\fR", roff_text(entry.value));
  fmt::print(out, "\n{}", filled(entry.help));
}

void print_examples(const std::vector<std::string>& examples, std::FILE* out) {
  fmt::print(out, ".PP\nExamples:\n.PP\n.RS 2\n.nf\n");
  for (const std::string& example : examples) fmt::print(out, "{}\n", roff_text(example));
  fmt::print(out, ".fi\n.RE\n");
}

void print_verbs(std::span<const Verb> verbs, std::FILE* out) {
  fmt::print(out, ".SH VERBS\n");
  for (const Verb& verb : verbs) {
    std::fflush(out);
    const std::array<std::string_view, 1> ask{kManualSection};
    Console console;
    console.out = out;
    (void)verb.run(ask, console);
  }
}

void print_exit_status(std::FILE* out) {
  fmt::print(out, ".SH EXIT STATUS\n");
  for (const ExitMeaning& row : exit_meanings())
    fmt::print(out, ".TP\n\\fB{}\\fR\n{}", exit_status(row.code), filled(row.meaning));
}

}  // namespace

std::string roff_text(std::string_view text) {
  std::string out;
  if (text.starts_with('.') || text.starts_with('\'')) out = "\\&";
  for (const char letter : text) {
    switch (letter) {
      case '\\':
        out += "\\e";
        break;
      case '-':
        out += "\\-";
        break;
      case '\'':
        out += "\\(aq";
        break;
      case '`':
        out += "\\(ga";
        break;
      case '^':
        out += "\\(ha";
        break;
      case '~':
        out += "\\(ti";
        break;
      default:
        out += letter;
    }
  }
  return out;
}

void print_manual_section(const ManualSection& section, std::FILE* out) {
  fmt::print(out, ".SS reckon {} {}\n", roff_text(section.verb), roff_text(section.synopsis));
  print_prose(section.summary, out);
  for (const ManualEntry& entry : section.entries) print_entry(entry, out);
  print_examples(section.examples, out);
}

void print_manual_page(std::span<const Verb> verbs, std::FILE* out) {
  fmt::print(out,
             ".\\\" Made by `reckon help --man`.\n"
             ".TH RECKON 1 {} \"reckon {}\" \"User Commands\"\n"
             ".SH NAME\nreckon \\- worlds that people touch together, peer to peer\n"
             ".SH SYNOPSIS\n.B reckon\n.I VERB\n.RI [ ARGUMENTS ]\n.br\n.B reckon\n.I FILE\n.br\n"
             ".B reckon \\-\\-help\n|\n.B \\-\\-version\n"
             ".SH DESCRIPTION\n",
             RECKON_DATE, program_version());
  print_prose(
      "Reckon is a DIS peer for haptics: people on a LAN touch the same things over UDP multicast "
      "with IEEE 1278.1-2012 PDUs. The program demonstrates it, runs a peer, and inspects, records "
      "and replays any DIS traffic.\n\n"
      "Data goes to standard output, everything else to standard error. Durations take units, as "
      "in 250ms, 10s or 5min; lengths and sizes too. `reckon VERB --help` shows what a verb takes. "
      "`reckon FILE` inspects a capture and touches a scene or a mesh. With --json, data comes as "
      "one JSON object per line.",
      out);
  print_verbs(verbs, out);
  print_exit_status(out);
  fmt::print(out, ".SH ENVIRONMENT\n.TP\n\\fBNO_COLOR\\fR\n{}",
             filled("If set: no colour. Output that is not a terminal has none."));
  fmt::print(out,
             ".SH FILES\n.TP\n\\fI../share/reckon/scenes\\fR\n{}"
             ".TP\n\\fI../share/reckon/wireshark/reckon.lua\\fR\n{}",
             filled("Scene files that come with the program, from its own folder."),
             filled("Plug-in that shows bundles and force models in Wireshark and tshark."));
  fmt::print(out, ".SH SEE ALSO\n.BR tshark (1),\n.BR tcpdump (1),\n.BR jq (1)\n");
}

}  // namespace reckon::tools
