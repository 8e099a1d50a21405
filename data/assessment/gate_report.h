#pragma once
/// The result of a physics gate, and its text forms.
#include <string>
#include <utility>
#include <vector>

namespace ostium::data {

struct GateResult {
  std::string gate;      ///< name, as `ostium verify --only` takes it
  double value = 0;      ///< what the simulator gives
  double reference = 0;  ///< what the closed form, solver or measurement says
  double tolerance = 0;  ///< largest |value - reference| that passes; >= 0
  std::string unit;      ///< of all three; "1" where there is none

  bool pass() const;  ///< false if the value is not a number
};

bool all_pass(const std::vector<GateResult>& results);

/// Array of {"gate", "value", "reference", "tolerance", "unit", "pass"} (data/schemas/verify.schema.json). A value that
/// is not finite becomes null.
std::string to_json(const std::vector<GateResult>& results);

/// Array of {"gate", "what"}.
std::string names_to_json(const std::vector<std::pair<std::string, std::string>>& gates);

/// One line of a table, without a line end; `table_heading` gives the first line.
std::string table_line(const GateResult& result);
std::string table_heading();

}  // namespace ostium::data
