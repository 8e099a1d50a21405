#pragma once
/// Learned laws in explanation.json and on the page.
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "data/identification/estimation/learned_law.h"

namespace ostium::data {

/// By id: axes with units, `table` [[x, y, sigma], ...], `from_data` (0 to 1, one a row), `prior` (the rows that are no
/// more than the prior), `declared`, `looks_like` (or null).
nlohmann::ordered_json json_of(const std::vector<LearnedLaw>& laws);

/// The curve with its band, and what is declared; grey where it is the prior. SVG text and a line of words.
std::string law_plot(const LearnedLaw& law);

}  // namespace ostium::data
