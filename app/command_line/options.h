#pragma once
/// How a command declares its options. Hides CLI11, whose headers take seconds to compile, which every command would
/// pay.
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace ostium::app {

/// Further properties of an option; each call returns the option again.
class Option {
 public:
  Option required();
  Option show_default();                 ///< shows the variable's current value in --help
  Option type(const std::string& name);  ///< shown in --help instead of TEXT
  Option count(int values);              ///< this many values, separated by commas
  Option one_of(std::initializer_list<const char*> allowed);
  Option one_of(const std::vector<int>& allowed);
  Option range(double least, double most);
  Option range(int least, int most);
  Option not_negative();
  Option positive();
  /// Names a file that the command writes: refused where the line names it twice, or as something to read, too, or
  /// where it cannot be written, which else would be found after the work.
  Option writes();

 private:
  friend class Options;
  Option(CLI::Option* option, std::vector<const CLI::Option*>* written) : option_(option), written_(written) {}

  CLI::Option* option_;
  std::vector<const CLI::Option*>* written_;
};

/// What holds of options beyond what each of them takes.
struct OptionRules {
  std::vector<const CLI::Option*> written;                               ///< they name files to be written
  std::vector<std::pair<const CLI::Option*, const CLI::Option*>> apart;  ///< two that are not given together
};

class Options {
 public:
  Options(CLI::App& app, OptionRules& rules) : app_(app), rules_(rules) {}

  /// `names`: "--units", "-o,--out", or "mesh" for a positional argument. `value` keeps its value if the option is not
  /// given. Texts that are given are not empty, and UTF-8 without control characters. For text, int, double,
  /// std::uint64_t, an optional int or double, or a vector of texts or doubles.
  template <class Value>
  Option add(const std::string& names, Value& value, const std::string& help);
  void flag(const std::string& names, bool& value, const std::string& help);
  /// `one` beside any of `others` is a usage error: one of them would be passed over. All are declared before.
  void exclude(const std::string& one, std::initializer_list<const char*> others);

 private:
  CLI::App& app_;
  OptionRules& rules_;
};

}  // namespace ostium::app
