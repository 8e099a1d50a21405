#include "app/command_line/command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdint>
#include <exception>
#include <optional>
#include <type_traits>

#include "app/command_line/interrupt.h"
#include "data/formats/decimal.h"
#include "data/formats/write_file.h"

namespace ostium::app {

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
Option Option::not_negative() { return option_->check(CLI::NonNegativeNumber), *this; }
Option Option::positive() { return option_->check(CLI::PositiveNumber), *this; }

namespace {

/// CLI11 reads "nan", "0x10" and, as a number without a sign, "-1"; its ranges let NaN through.
template <class Value>
void check_number(CLI::Option& option) {
  constexpr bool is_unsigned = std::is_same_v<Value, std::uint64_t>,
                 is_whole = is_unsigned || std::is_same_v<Value, int>;
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

}  // namespace

template <class Value>
Option Options::add(const std::string& names, Value& value, const std::string& help) {
  CLI::Option* option = app_.add_option(names, value, help);
  check_number<Value>(*option);
  return Option(option);
}
template Option Options::add(const std::string&, std::string&, const std::string&);
template Option Options::add(const std::string&, int&, const std::string&);
template Option Options::add(const std::string&, double&, const std::string&);
template Option Options::add(const std::string&, std::uint64_t&, const std::string&);
template Option Options::add(const std::string&, std::optional<double>&, const std::string&);
template Option Options::add(const std::string&, std::vector<std::string>&, const std::string&);
template Option Options::add(const std::string&, std::vector<double>&, const std::string&);

void Options::flag(const std::string& names, bool& value, const std::string& help) {
  app_.add_flag(names, value, help);
}

namespace {

constexpr int done = 0, failed = 1, usage = 2, bad_input = 3;

/// `chosen` is set to the command that the parsed line names.
void declare(const Command& command, CLI::App& app, const Command*& chosen) {
  Options options(app);
  if (command.declare) command.declare(options);
  for (const Command& sub : command.subcommands) {
    CLI::App* sub_app = app.add_subcommand(sub.name, sub.help);
    if (sub.run) sub_app->callback([&chosen, &sub] { chosen = &sub; });
    declare(sub, *sub_app, chosen);
  }
  if (!command.subcommands.empty()) app.require_subcommand(command.run ? 0 : 1, 1);
  std::string footer;
  for (const std::string& example : command.examples) footer += (footer.empty() ? "Examples:\n  " : "\n  ") + example;
  if (!footer.empty()) app.footer(footer);
}

}  // namespace

int run_command_line(const Command& program, int argc, char** argv) {
  CLI::App app(program.help, program.name);
  app.set_version_flag("--version", OSTIUM_VERSION);
  // Also used for commands declared later that have no examples.
  app.footer("Exit codes: 0 done, 1 failed or did not hold, 2 usage, 3 bad input, 128 + N ended by signal N.");
  const Command* chosen = &program;
  declare(program, app, chosen);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? done : usage;
  }
  try {
    const int code = chosen->run();
    return interrupting_signal ? 128 + interrupting_signal : code;
  } catch (const data::WriteError& error) {
    fmt::print(stderr, "{}: {}\n", program.name, error.what());
    return failed;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}: {}\n", program.name, error.what());
    return bad_input;
  }
}

}  // namespace ostium::app
