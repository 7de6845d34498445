// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The only file that includes CLI11: its headers take seconds to compile.
#include "reckon/tools/command_line/command_line.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <iterator>
#include <map>
#include <sstream>
#include <utility>

#include "reckon/peer/notation/nearest_word.hpp"
#include "reckon/tools/command_line/duration_text.hpp"
#include "reckon/tools/command_line/manual_page.hpp"

namespace reckon::tools {
namespace {

/// Reads a value from CLI11's text; throws its ValidationError with the remedy.
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
  throw CLI::ValidationError(name, fmt::format("'{}' is not a whole number of at least 0", text));
}

/// Accepts only one of the words; help shows their list as the value's name.
CLI::Validator one_of(const std::vector<std::string>& words) {
  const auto check = [words](const std::string& text) -> std::string {
    if (std::find(words.begin(), words.end(), text) != words.end()) return {};
    const std::vector<std::string_view> known(words.begin(), words.end());
    const std::string_view nearest = peer::nearest_word(text, known);
    std::string sentence = fmt::format("'{}' is none of {}", text, fmt::join(words, ", "));
    if (!nearest.empty()) sentence += fmt::format("; did you mean '{}'?", nearest);
    return sentence;
  };
  return {check, fmt::format("{{{}}}", fmt::join(words, ","))};
}

double number_value(const std::string& name, const std::string& text) {
  double number = 0;
  const char* end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, number);
  if (result.ec == std::errc{} && result.ptr == end) return number;
  throw CLI::ValidationError(name,
                             fmt::format("'{}' is not a number; write for example 0.5", text));
}

/// Whether `word` is one of `words`, which are separated by blanks.
bool is_among(std::string_view word, std::string_view words) {
  while (!words.empty()) {
    const std::size_t end = std::min(words.find(' '), words.size());
    if (words.substr(0, end) == word) return true;
    words.remove_prefix(std::min(end + 1, words.size()));
  }
  return false;
}

/// "a b" as "a, b".
std::string listed(std::string_view words) {
  std::string list;
  for (const char letter : words)
    list += letter == ' ' ? std::string(", ") : std::string(1, letter);
  return list;
}

std::vector<std::string> reversed(Arguments arguments) {
  std::vector<std::string> words(arguments.begin(), arguments.end());
  std::reverse(words.begin(), words.end());  // the order that CLI11 needs
  return words;
}

}  // namespace

struct CommandLine::Parser {
  CLI::App app;
  std::string verb;
  std::string summary;
  std::vector<std::string> examples;
  std::map<std::string, std::vector<std::string>> choices;  // by option name
  std::map<std::string, std::vector<std::string>> offered;  // the same, only for completion
  std::map<std::size_t, std::string> owners;  // owners, by the number of their first option

  Parser(std::string_view verb_, std::string_view summary_)
      : app(std::string(summary_), "reckon " + std::string(verb_)),
        verb(verb_),
        summary(summary_) {}

  /// An option whose text is converted by `value`.
  void add(const std::string& name, auto& target, const std::string& help, const std::string& kind,
           auto value) {
    const auto read = [&target, name, value](const std::string& text) {
      target = value(name, text);
    };
    app.add_option_function<std::string>(name, read, help)->type_name(kind);
  }

  [[nodiscard]] std::vector<std::string> flag_names() const {
    std::vector<std::string> names;
    for (const CLI::Option* option : app.get_options()) {
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    }
    return names;
  }

  /// Each flag and word, followed by its choices if it has some.
  void list_flags(std::FILE* out) const {
    for (const CLI::Option* option : app.get_options()) {
      const auto& names = option->get_lnames();
      fmt::print(out, "{}", names.empty() ? option->get_name(true) : "--" + names.front());
      for (const auto& values : {choices, offered}) {
        const auto found = values.find(option->get_name());
        if (found != values.end()) fmt::print(out, " {}", fmt::join(found->second, " "));
      }
      fmt::print(out, "\n");
    }
  }

  /// "SCENE [FLAGS]".
  [[nodiscard]] std::string synopsis() const {
    std::string words;
    for (const CLI::Option* option : app.get_options()) {
      if (!option->get_positional()) continue;
      const std::string word =
          option->get_name() + (option->get_items_expected_max() > 1 ? "..." : "");
      words += option->get_required() ? word + " " : fmt::format("[{}] ", word);
    }
    return words + "[FLAGS]";
  }

  /// The words below the verb to which a flag belongs, separated by blanks; empty: all.
  [[nodiscard]] std::string_view owners_of(std::size_t option) const {
    const auto next = owners.upper_bound(option);
    return next == owners.begin() ? std::string_view() : std::prev(next)->second;
  }

  /// The word below the verb in the arguments, if flags belong to it; empty: none.
  [[nodiscard]] std::string_view word_of(Arguments arguments) const {
    for (const std::string_view word : arguments) {
      for (const auto& [first, words] : owners)
        if (is_among(word, words)) return word;
    }
    return {};
  }

  /// Text of --help: flags grouped by their owner, or for a word below the verb only its own.
  [[nodiscard]] std::string help_of(std::string_view word) {
    std::size_t number = 0;
    for (CLI::Option* option : app.get_options()) {
      const std::string_view words = owners_of(number++);
      if (words.empty()) continue;
      const bool shown = word.empty() || is_among(word, words);
      const std::string names = listed(word.empty() ? words : word);
      option->group(shown ? fmt::format("Of {} {}", verb, names) : "");
      const std::string prefix = names + ": ", help = option->get_description();
      if (help.starts_with(prefix)) option->description(help.substr(prefix.size()));
    }
    std::string footer = "Examples:";
    const std::string of_word = fmt::format("reckon {} {}", verb, word);
    for (const std::string& example : examples)
      if (word.empty() || example.starts_with(of_word)) footer += "\n  " + example;
    app.footer(footer);
    std::string text = app.help();  // two empty lines between groups
    for (std::size_t at = 0; (at = text.find("\n\n\n", at)) != std::string::npos;)
      text.erase(at, 1);
    return text;
  }

  [[nodiscard]] ManualSection manual() const {
    ManualSection section{verb, summary, synopsis(), {}, examples};
    for (const CLI::Option* option : app.get_options())
      section.entries.push_back(manual_entry(*option));
    return section;
  }

  /// The error for the first word that resembles a flag but is not one, or for a flag without its
  /// value; empty if there is none.
  [[nodiscard]] std::string wrong_flag(Arguments arguments) const {
    const CLI::Option* waits = nullptr;
    for (const std::string_view word : arguments) {
      if (word == "--") break;
      const bool is_value = std::exchange(waits, nullptr) != nullptr;
      if (is_value || word.size() < 2 || word.front() != '-') continue;
      const std::string_view name = word.substr(0, word.find('='));
      const CLI::Option* option = app.get_option_no_throw(std::string(name));
      if (option == nullptr) return no_such_flag(name);
      const bool takes_value = option->get_items_expected_min() > 0;
      waits = takes_value && name.size() == word.size() ? option : nullptr;
    }
    if (waits == nullptr) return {};
    return fmt::format("{} needs a value after it: {}", waits->get_name(),
                       manual_entry(*waits).value);
  }

 private:
  [[nodiscard]] ManualEntry manual_entry(const CLI::Option& option) const {
    ManualEntry entry{option.get_name(true), option.get_type_name(), option.get_description()};
    const auto found = choices.find(option.get_name());
    if (found != choices.end()) entry.value = fmt::format("{}", fmt::join(found->second, "|"));
    if (!option.get_positional()) entry.names = option.get_name(false, true);
    for (std::size_t at = 0; (at = entry.names.find(',', at)) != std::string::npos; at += 2)
      entry.names.insert(at + 1, " ");
    return entry;
  }

  [[nodiscard]] std::string no_such_flag(std::string_view name) const {
    const std::vector<std::string> names = flag_names();
    const std::vector<std::string_view> known(names.begin(), names.end());
    const std::string_view nearest = peer::nearest_word(name, known);
    std::string sentence = fmt::format("there is no flag '{}'", name);
    if (!nearest.empty()) sentence += fmt::format("; did you mean '{}'?", nearest);
    return sentence;
  }
};

CommandLine::CommandLine(std::string_view verb, std::string_view summary, std::string_view examples)
    : parser_(std::make_unique<Parser>(verb, summary)) {
  while (!examples.empty()) {
    const std::size_t end = std::min(examples.find('\n'), examples.size());
    parser_->examples.emplace_back(examples.substr(0, end));
    examples.remove_prefix(std::min(end + 1, examples.size()));
  }
  parser_->app.set_help_flag("-h,--help", "show this");
}

CommandLine::~CommandLine() = default;

void CommandLine::flag(const std::string& name, bool& target, const std::string& help) {
  parser_->app.add_flag(name, target, help);
}

void CommandLine::flag(const std::string& name, std::string& target, const std::string& help) {
  parser_->app.add_flag(name, target, help);
}

void CommandLine::option(const std::string& name, std::string& target, const std::string& help) {
  parser_->app.add_option(name, target, help)->type_name("TEXT");
}

void CommandLine::option(const std::string& name, std::vector<std::string>& target,
                         const std::string& help) {
  parser_->app.add_option(name, target, help)->type_name("TEXT")->allow_extra_args(false);
}

void CommandLine::option(const std::string& name, std::pair<std::string, std::string>& target,
                         const std::string& help, const std::string& values) {
  parser_->app.add_option(name, target, help)->type_name(values);
}

void CommandLine::option(const std::string& name, std::optional<std::chrono::nanoseconds>& target,
                         const std::string& help) {
  parser_->add(name, target, help, "DURATION", duration_value);
}

void CommandLine::option(const std::string& name, std::chrono::nanoseconds& target,
                         const std::string& help) {
  parser_->add(name, target, help, "DURATION", duration_value);
}

void CommandLine::option(const std::string& name, std::uint64_t& target, const std::string& help) {
  parser_->add(name, target, help, "NUMBER", count_value);
}

void CommandLine::option(const std::string& name, std::optional<std::uint64_t>& target,
                         const std::string& help) {
  parser_->add(name, target, help, "NUMBER", count_value);
}

void CommandLine::option(const std::string& name, double& target, const std::string& help) {
  parser_->add(name, target, help, "NUMBER", number_value);
}

void CommandLine::choice(const std::string& name, std::string& target,
                         const std::vector<std::string>& words, const std::string& help) {
  parser_->choices[name] = words;
  parser_->app.add_option(name, target, help)->check(one_of(words))->type_name("");
}

void CommandLine::offer(const std::string& name, std::string_view values) {
  std::string blanks(values);
  std::ranges::replace(blanks, ',', ' ');
  std::istringstream words(blanks);
  parser_->offered[name] = {std::istream_iterator<std::string>(words), {}};
}

void CommandLine::word(const std::string& name, std::string& target, bool required,
                       const std::string& help) {
  parser_->app.add_option(name, target, help)->required(required)->type_name("");
}

void CommandLine::words(const std::string& name, std::vector<std::string>& target, bool required,
                        const std::string& help) {
  parser_->app.add_option(name, target, help)->required(required)->type_name("");
}

void CommandLine::only_for(std::string_view word) {
  parser_->owners[parser_->app.get_options().size()] = word;
}

void CommandLine::check_for(std::string_view word) const {
  const auto options = std::as_const(parser_->app).get_options();
  for (std::size_t i = 0; i < options.size(); ++i) {
    const std::string_view owners = parser_->owners_of(i);
    if (options[i]->count() == 0 || owners.empty() || is_among(word, owners)) continue;
    throw UsageError(fmt::format("{} is a flag of reckon {} {}, not of reckon {} {}",
                                 options[i]->get_name(), parser_->verb,
                                 owners.substr(0, owners.find(' ')), parser_->verb, word));
  }
}

std::vector<std::string> CommandLine::given() const {
  std::vector<std::string> names;
  for (const CLI::Option* option : std::as_const(parser_->app).get_options()) {
    if (option->count() > 0) names.push_back(option->get_name());
  }
  return names;
}

std::optional<int> CommandLine::parse(Arguments arguments, const Console& console) {
  if (arguments.size() == 1 && arguments.front() == kListFlags) {
    parser_->list_flags(console.out);
    return exit_status(ExitCode::good);
  }
  if (arguments.size() == 1 && arguments.front() == kManualSection) {
    print_manual_section(parser_->manual(), console.out);
    return exit_status(ExitCode::good);
  }
  const auto wrong = [&](const std::string& sentence) {
    fmt::print(console.err, "reckon {}: {}\n`reckon {} --help` shows its arguments.\n",
               parser_->verb, sentence, parser_->verb);
    return exit_status(ExitCode::usage);
  };
  // Checked before CLI11, which would take the value after an unknown flag for a word.
  if (const std::string unknown = parser_->wrong_flag(arguments); !unknown.empty())
    return wrong(unknown);
  try {
    parser_->app.parse(reversed(arguments));
  } catch (const CLI::CallForHelp&) {
    fmt::print(console.out, "{}", parser_->help_of(parser_->word_of(arguments)));
    return exit_status(ExitCode::good);
  } catch (const CLI::ExtrasError&) {
    return wrong(fmt::format("unexpected argument '{}'; write reckon {} {}",
                             parser_->app.remaining().front(), parser_->verb, parser_->synopsis()));
  } catch (const CLI::RequiredError& error) {
    return wrong(
        fmt::format("{}; write reckon {} {}", error.what(), parser_->verb, parser_->synopsis()));
  } catch (const CLI::ParseError& error) {
    return wrong(error.what());
  }
  return std::nullopt;
}

}  // namespace reckon::tools
