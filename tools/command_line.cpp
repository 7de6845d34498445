// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The only file that includes CLI11: its headers take seconds to compile.
#include "tools/command_line.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>

#include "src/scene_keys.hpp"
#include "tools/duration_text.hpp"

namespace reckon::tools {
namespace {

/// Reads a value that CLI11 hands over as text; throws its ValidationError with the remedy.
std::chrono::nanoseconds duration_value(const std::string& name, const std::string& text) {
  if (const auto duration = parse_duration(text)) return *duration;
  throw CLI::ValidationError(
      name, fmt::format("'{}' is not a duration; write a number and ns, us, ms, s, min or h, as in "
                        "10s",
                        text));
}

std::uint64_t count_value(const std::string& name, const std::string& text) {
  std::uint64_t count = 0;
  const char* end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, count);
  if (result.ec == std::errc{} && result.ptr == end) return count;
  throw CLI::ValidationError(name, fmt::format("'{}' is not a whole number from 0 on", text));
}

double number_value(const std::string& name, const std::string& text) {
  double number = 0;
  const char* end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, number);
  if (result.ec == std::errc{} && result.ptr == end) return number;
  throw CLI::ValidationError(name, fmt::format("'{}' is not a number; write it as in 0.5", text));
}

std::vector<std::string> reversed(Arguments arguments) {
  std::vector<std::string> words(arguments.begin(), arguments.end());
  std::reverse(words.begin(), words.end());  // as CLI11 wants them
  return words;
}

}  // namespace

struct CommandLine::Parser {
  CLI::App app;
  std::string verb;

  Parser(std::string_view verb_, std::string_view summary)
      : app(std::string(summary), "reckon " + std::string(verb_)), verb(verb_) {}

  /// An option whose text `read` turns into the value.
  template <typename Read>
  void add(const std::string& name, const std::string& help, const std::string& kind, Read read) {
    app.add_option_function<std::string>(name, read, help)->type_name(kind);
  }

  [[nodiscard]] std::vector<std::string> flag_names() const {
    std::vector<std::string> names;
    for (const CLI::Option* option : app.get_options()) {
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    }
    return names;
  }

  void list_flags(std::FILE* out) const {
    for (const std::string& name : flag_names()) fmt::print(out, "{}\n", name);
  }

  /// "; did you mean '--json'?" for the first unknown flag among the words, else nothing.
  [[nodiscard]] std::string suggestion(Arguments arguments) const {
    const std::vector<std::string> names = flag_names();
    const std::vector<std::string_view> known(names.begin(), names.end());
    for (std::string_view word : arguments) {
      word = word.substr(0, word.find('='));
      if (!word.starts_with("--") || std::find(known.begin(), known.end(), word) != known.end())
        continue;
      const std::string_view nearest = nearest_word(word, known);
      if (!nearest.empty()) return fmt::format("; did you mean '{}'?", nearest);
    }
    return {};
  }
};

CommandLine::CommandLine(std::string_view verb, std::string_view summary, std::string_view examples)
    : parser_(std::make_unique<Parser>(verb, summary)) {
  std::string footer = "Examples:\n";
  while (!examples.empty()) {
    const std::size_t end = std::min(examples.find('\n'), examples.size());
    footer += fmt::format("  {}\n", examples.substr(0, end));
    examples.remove_prefix(std::min(end + 1, examples.size()));
  }
  footer.pop_back();
  parser_->app.footer(footer);
  parser_->app.set_help_flag("-h,--help", "show this");
}

CommandLine::~CommandLine() = default;

void CommandLine::flag(const std::string& name, bool& target, const std::string& help) {
  parser_->app.add_flag(name, target, help);
}

void CommandLine::option(const std::string& name, std::string& target, const std::string& help) {
  parser_->app.add_option(name, target, help)->type_name("TEXT");
}

void CommandLine::option(const std::string& name, std::vector<std::string>& target,
                         const std::string& help) {
  parser_->app.add_option(name, target, help)->type_name("TEXT")->allow_extra_args(false);
}

void CommandLine::option(const std::string& name, std::optional<std::chrono::nanoseconds>& target,
                         const std::string& help) {
  parser_->add(name, help, "DURATION",
               [&target, name](const std::string& text) { target = duration_value(name, text); });
}

void CommandLine::option(const std::string& name, std::chrono::nanoseconds& target,
                         const std::string& help) {
  parser_->add(name, help, "DURATION",
               [&target, name](const std::string& text) { target = duration_value(name, text); });
}

void CommandLine::option(const std::string& name, std::uint64_t& target, const std::string& help) {
  parser_->add(name, help, "NUMBER",
               [&target, name](const std::string& text) { target = count_value(name, text); });
}

void CommandLine::option(const std::string& name, std::optional<std::uint64_t>& target,
                         const std::string& help) {
  parser_->add(name, help, "NUMBER",
               [&target, name](const std::string& text) { target = count_value(name, text); });
}

void CommandLine::option(const std::string& name, double& target, const std::string& help) {
  parser_->add(name, help, "NUMBER",
               [&target, name](const std::string& text) { target = number_value(name, text); });
}

void CommandLine::choice(const std::string& name, std::string& target,
                         const std::vector<std::string>& words, const std::string& help) {
  parser_->app.add_option(name, target, help)->check(CLI::IsMember(words))->type_name("");
}

void CommandLine::word(const std::string& name, std::string& target, bool required,
                       const std::string& help) {
  parser_->app.add_option(name, target, help)->required(required)->type_name("");
}

void CommandLine::words(const std::string& name, std::vector<std::string>& target, bool required,
                        const std::string& help) {
  parser_->app.add_option(name, target, help)->required(required)->type_name("");
}

std::optional<int> CommandLine::parse(Arguments arguments, const Console& console) {
  if (arguments.size() == 1 && arguments.front() == kListFlags) {
    parser_->list_flags(console.out);
    return exit_status(ExitCode::good);
  }
  try {
    parser_->app.parse(reversed(arguments));
  } catch (const CLI::CallForHelp&) {
    fmt::print(console.out, "{}", parser_->app.help());
    return exit_status(ExitCode::good);
  } catch (const CLI::ParseError& error) {
    fmt::print(console.err, "reckon {}: {}{}\n`reckon {} --help` shows what it takes.\n",
               parser_->verb, error.what(), parser_->suggestion(arguments), parser_->verb);
    return exit_status(ExitCode::usage);
  }
  return std::nullopt;
}

std::string_view nearest_word(std::string_view typed,
                              std::span<const std::string_view> candidates) {
  return peer::nearest_key(typed, {candidates.begin(), candidates.end()});
}

}  // namespace reckon::tools
