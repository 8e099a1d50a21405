#pragma once
/// How a command declares its options. CLI11 stays behind it: its headers take seconds to compile, once for every
/// command otherwise.
#include <initializer_list>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace ostium::app {

/// What more there is to say of an option; each returns the option again.
class Option {
 public:
  explicit Option(CLI::Option* option) : option_(option) {}

  Option required();
  Option show_default();                 ///< in --help: what the variable holds by then
  Option type(const std::string& name);  ///< in --help instead of TEXT
  Option count(int values);              ///< so many, with commas between
  Option one_of(std::initializer_list<const char*> allowed);
  Option one_of(const std::vector<int>& allowed);
  Option range(double least, double most);
  Option range(int least, int most);
  Option not_negative();
  Option positive();

 private:
  CLI::Option* option_;
};

class Options {
 public:
  explicit Options(CLI::App& app) : app_(app) {}

  /// `names`: "--units", "-o,--out", or "mesh", which stands without dashes. `value` keeps what it holds if the option
  /// is not given. Of text, int, double, std::uint64_t, std::optional<double>, or a vector of texts or doubles.
  template <class Value>
  Option add(const std::string& names, Value& value, const std::string& help);
  void flag(const std::string& names, bool& value, const std::string& help);

 private:
  CLI::App& app_;
};

}  // namespace ostium::app
