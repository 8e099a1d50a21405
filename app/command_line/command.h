#pragma once
/// A subcommand of `ostium`: its name, options and function. Each has its own file in app/commands, and its name is
/// listed in program.cpp.
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "app/command_line/options.h"

namespace ostium::app {

struct Command {
  std::string name;
  std::string help;                       ///< its line in the list of commands
  std::vector<std::string> examples;      ///< at the end of its --help
  std::function<void(Options&)> declare;  ///< declares its options; may be empty
  /// Exit code: 0 done, 1 failed or did not hold, 2 usage. An exception is reported as bad input, code 3. Empty: one of
  /// `subcommands` must be given.
  std::function<int()> run;
  std::vector<Command> subcommands;
};

/// A command whose options fill a struct that is passed to its run function.
template <class Arguments>
Command make_command(std::string name, std::string help, std::vector<std::string> examples,
                     void (*declare)(Options&, Arguments&), int (*run)(const Arguments&)) {
  const auto arguments = std::make_shared<Arguments>();
  return {std::move(name),
          std::move(help),
          std::move(examples),
          [=](Options& options) { declare(options, *arguments); },
          [=] { return run(*arguments); },
          {}};
}

}  // namespace ostium::app
