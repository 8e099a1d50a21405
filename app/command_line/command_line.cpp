#include "app/command_line/command_line.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <type_traits>

#include "app/command_line/interrupt.h"
#include "data/formats/controls.h"
#include "data/formats/decimal.h"
#include "data/formats/load_error.h"
#include "data/formats/paths.h"
#include "data/formats/write_file.h"

namespace ostium::app {

namespace {

/// CLI11's own name the largest number there is, digit by digit.
CLI::Validator from_zero(const char* name, bool zero_too) {
  return CLI::Validator(
      [zero_too](const std::string& text) -> std::string {
        const std::optional<double> number = data::decimal(text);
        if (number && (*number > 0 || (zero_too && *number == 0))) return "";
        return text + (zero_too ? " is not 0 or more" : " is not above 0");
      },
      name);
}

}  // namespace

Option Option::required() { return option_->required(), *this; }
Option Option::show_default() { return option_->capture_default_str(), *this; }
Option Option::type(const std::string& name) { return option_->type_name(name), *this; }
Option Option::count(int values) { return option_->expected(values)->delimiter(','), *this; }
Option Option::one_of(std::initializer_list<const char*> allowed) {
  return option_->check(CLI::IsMember(std::vector<std::string>(allowed.begin(), allowed.end()))), *this;
}
Option Option::one_of(const std::vector<int>& allowed) { return option_->check(CLI::IsMember(allowed)), *this; }
Option Option::range(double least, double most) { return option_->check(CLI::Range(least, most)), *this; }
Option Option::range(int least, int most) { return option_->check(CLI::Range(least, most)), *this; }
Option Option::not_negative() { return option_->check(from_zero("NONNEGATIVE", true)), *this; }
Option Option::positive() { return option_->check(from_zero("POSITIVE", false)), *this; }

namespace {

/// CLI11 reads "nan", "0x10" and, as a number without a sign, "-1"; its ranges let NaN through.
template <class Value>
void check_number(CLI::Option& option) {
  constexpr bool is_unsigned = std::is_same_v<Value, std::uint64_t>,
                 is_whole = is_unsigned || std::is_same_v<Value, int> || std::is_same_v<Value, std::optional<int>>;
  constexpr bool is_number = is_whole || std::is_same_v<Value, double> ||
                             std::is_same_v<Value, std::optional<double>> || std::is_same_v<Value, std::vector<double>>;
  if constexpr (is_number)
    option.check(CLI::Validator(
        [](const std::string& text) -> std::string {
          const std::optional<double> number = data::decimal(text);
          if (!number) return "\"" + text + "\" is not a number";
          if (is_unsigned && !data::whole(text)) return text + " is not a whole number from 0 on";
          if (is_whole && *number != std::floor(*number)) return text + " is not a whole number";
          return "";
        },
        ""));
}

/// An empty one is mostly a shell's variable that is not set: taken as not given, a run would be kept nowhere. What is
/// no UTF-8 could not be written into JSON, hours later. Names are printed, and told to browsers.
template <class Value>
void check_text(CLI::Option& option) {
  if constexpr (std::is_same_v<Value, std::string> || std::is_same_v<Value, std::vector<std::string>>)
    option.check(CLI::Validator(
        [](const std::string& text) -> std::string {
          if (text.empty()) return "it is empty";
          if (data::has_control(text)) return "it holds a control character";
          try {
            (void)nlohmann::json(text).dump();
          } catch (const nlohmann::json::exception&) {
            return "it is not UTF-8";
          }
          return "";
        },
        ""));
}

}  // namespace

Option Option::writes() {
  written_->push_back(option_);
  return *this;
}

template <class Value>
Option Options::add(const std::string& names, Value& value, const std::string& help) {
  CLI::Option* option = app_.add_option(names, value, help);
  check_number<Value>(*option);
  check_text<Value>(*option);
  return {option, &rules_.written};
}
template Option Options::add(const std::string&, std::string&, const std::string&);
template Option Options::add(const std::string&, int&, const std::string&);
template Option Options::add(const std::string&, double&, const std::string&);
template Option Options::add(const std::string&, std::uint64_t&, const std::string&);
template Option Options::add(const std::string&, std::optional<int>&, const std::string&);
template Option Options::add(const std::string&, std::optional<double>&, const std::string&);
template Option Options::add(const std::string&, std::vector<std::string>&, const std::string&);
template Option Options::add(const std::string&, std::vector<double>&, const std::string&);

void Options::flag(const std::string& names, bool& value, const std::string& help) {
  app_.add_flag(names, value, help);
}

void Options::exclude(const std::string& one, std::initializer_list<const char*> others) {
  for (const char* other : others) rules_.apart.emplace_back(app_.get_option(one), app_.get_option(other));
}

namespace {

constexpr int done = 0, failed = 1, usage = 2, bad_input = 3;

/// `chosen` is set to the command that the parsed line names.
void declare(const Command& command, CLI::App& app, const Command*& chosen, OptionRules& rules) {
  Options options(app, rules);
  if (command.declare) command.declare(options);
  for (const Command& sub : command.subcommands) {
    CLI::App* sub_app = app.add_subcommand(sub.name, sub.help);
    if (sub.run) sub_app->callback([&chosen, &sub] { chosen = &sub; });
    declare(sub, *sub_app, chosen, rules);
  }
  if (!command.subcommands.empty()) app.require_subcommand(command.run ? 0 : 1, 1);
  std::string footer;
  for (const std::string& example : command.examples) footer += (footer.empty() ? "Examples:\n  " : "\n  ") + example;
  if (!footer.empty()) app.footer(footer);
}

/// What an option was given, or has by default.
std::vector<std::string> values_of(const CLI::Option& option) {
  if (option.count() > 0) return option.results();
  return option.get_default_str().empty() ? std::vector<std::string>{} : std::vector{option.get_default_str()};
}

bool is_one_file(const std::string& a, const std::string& b) {
  namespace fs = std::filesystem;
  std::error_code none;
  if (fs::exists(a, none) && !fs::is_regular_file(a, none)) return false;  // a device takes what comes
  if (fs::equivalent(a, b, none)) return true;
  // A path may lead through folders that are yet to be made.
  const fs::path to_a = fs::weakly_canonical(fs::absolute(a, none), none),
                 to_b = fs::weakly_canonical(fs::absolute(b, none), none);
  return (to_a == to_b && !to_a.empty()) || fs::equivalent(to_a, to_b, none);
}

/// Throws LoadError if a file that is to be written is named twice, or is one to read; WriteError if it cannot be
/// written.
void require_apart(const CLI::App& app, const std::vector<const CLI::Option*>& written) {
  for (const CLI::App* sub : app.get_subcommands()) require_apart(*sub, written);
  const std::vector<const CLI::Option*> options = app.get_options();
  const auto writes = [&](const CLI::Option* o) {
    return std::find(written.begin(), written.end(), o) != written.end();
  };
  for (std::size_t i = 0; i < options.size(); ++i) {
    if (!writes(options[i])) continue;
    if (options[i]->count() > 0) data::require_place_for(options[i]->results().front());
    for (const std::string& file : values_of(*options[i]))
      for (std::size_t j = 0; j < options.size(); ++j) {
        const bool both = writes(options[j]);
        if (j == i || (both && j < i)) continue;
        for (std::string other : values_of(*options[j])) {
          if (!both && other.find('=') != std::string::npos && !data::is_there(other))
            other = other.substr(other.find('=') + 1);  // --set wire=FILE
          if (!is_one_file(file, other)) continue;
          if (both)
            throw data::LoadError(fmt::format("{} and {} are one file, {}; expected one for each",
                                              options[i]->get_name(), options[j]->get_name(), file));
          if (data::is_file(other))
            throw data::LoadError(fmt::format("{} {} would take the place of what is read, {}; expected another name",
                                              options[i]->get_name(), file, other));
        }
      }
  }
}

/// A stream that whoever calls has closed becomes one that nothing can be written to; else the first file that is
/// opened would take its place, and get what is printed.
void hold_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(stream, F_GETFD) < 0) open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

/// What cannot be written to the standard error stream, as to a log on a full disk, is lost, and nothing else is: fmt
/// would throw.
void let_messages_be_lost() {
  cookie_io_functions_t functions{};
  functions.write = [](void*, const char* bytes, std::size_t size) {
    for (std::size_t sent = 0; sent < size;) {
      const ssize_t n = write(STDERR_FILENO, bytes + sent, size - sent);
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) break;
      sent += static_cast<std::size_t>(n);
    }
    return static_cast<ssize_t>(size);
  };
  std::FILE* const all_taken = fopencookie(nullptr, "w", functions);
  if (!all_taken) return;
  std::setvbuf(all_taken, nullptr, _IONBF, 0);
  stderr = all_taken;
}

/// `code`, if all that was printed has been written.
int with_output_checked(int code) {
  if (std::fflush(stdout) == 0 && !std::ferror(stdout)) return code;
  fmt::print(stderr, "ostium: what it prints could not be written; is the disk full, or the pipe closed?\n");
  return failed;
}

/// Names and words of files without what moves a terminal's cursor.
std::string shown(const std::string& words) { return data::without_controls(words, "\n\t"); }

/// (CLI11's own way says it all over the help.)
bool are_apart(const OptionRules& rules) {
  for (const auto& [one, other] : rules.apart)
    if (one->count() > 0 && other->count() > 0) {
      fmt::print(stderr, "{} beside {} would do nothing; expected one of them\nRun with --help for more information.\n",
                 other->get_name(), one->get_name());
      return false;
    }
  return true;
}

/// Files whose names look like options.
void explain_dashes(int argc, char** argv) {
  for (int i = 1; i < argc; ++i)
    if (argv[i][0] == '-' && access(argv[i], F_OK) == 0)
      fmt::print(stderr, "{} is a file, too; to name it, write ./{}\n", argv[i], argv[i]);
}

}  // namespace

int run_command_line(const Command& program, int argc, char** argv) {
  hold_standard_streams();
  let_messages_be_lost();
  std::signal(SIGXFSZ, SIG_IGN);  // a file longer than `ulimit -f` then cannot be written, as on a full disk
  CLI::App app(program.help, program.name);
  app.set_version_flag("--version", OSTIUM_VERSION);
  // Also used for commands declared later that have no examples.
  app.footer("Exit codes: 0 done, 1 failed or did not hold, 2 usage, 3 bad input, 128 + N ended by signal N.");
  const Command* chosen = &program;
  OptionRules rules;
  declare(program, app, chosen, rules);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const int code = app.exit(error) == 0 ? done : usage;
    if (code == usage) explain_dashes(argc, argv);
    return with_output_checked(code);
  }
  if (!are_apart(rules)) return usage;
  try {
    require_apart(app, rules.written);
    const int code = with_output_checked(chosen->run());
    return interrupting_signal ? 128 + interrupting_signal : code;
  } catch (const data::WriteError& error) {
    fmt::print(stderr, "{}: {}\n", program.name, shown(error.what()));
    return failed;
  } catch (const std::exception& error) {
    if (std::ferror(stdout)) return with_output_checked(failed);  // fmt throws where it cannot print
    std::error_code gone;
    (void)std::filesystem::current_path(gone);
    fmt::print(stderr, "{}: {}\n", program.name,
               gone ? "the folder that this runs in is gone; change to another" : shown(error.what()));
    return interrupting_signal ? 128 + interrupting_signal : bad_input;  // what lacks as it was ended is no bad input
  }
}

}  // namespace ostium::app
