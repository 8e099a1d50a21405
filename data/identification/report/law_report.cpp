#include "data/identification/report/law_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "data/formats/markup.h"
#include "data/formats/plot.h"

namespace ostium::data {

namespace {

using Json = nlohmann::ordered_json;

const std::string learned_colour = "#0072b2", prior_colour = "#aaaaaa";

std::string axis(const std::string& words, const std::string& unit) {
  return unit == "1" ? words : fmt::format("{}, {}", words, unit);
}

}  // namespace

Json json_of(const std::vector<LearnedLaw>& laws) {
  Json out = Json::object();
  for (const LearnedLaw& law : laws) {
    Json table = Json::array(), prior = Json::array();
    for (std::size_t i = 0; i < law.sigma.size(); ++i) {
      table.push_back({law.curve.points[i].x(), law.curve.points[i].y(), law.sigma[i]});
      if (!law.reached(i)) prior.push_back(i);
    }
    out[law.curve.id] = {{"x", law.curve.x},
                         {"x_unit", law.curve.x_unit},
                         {"y", law.curve.y},
                         {"y_unit", law.curve.y_unit},
                         {"table", table},
                         {"from_data", law.from_data},
                         {"prior", prior},
                         {"declared", law.curve.declared},
                         {"looks_like", law.looks_like.empty() ? Json(nullptr) : Json(law.looks_like)}};
  }
  return out;
}

std::string law_plot(const LearnedLaw& law) {
  Plot plot(law.curve.id, axis(law.curve.x, law.curve.x_unit), axis(law.curve.y, law.curve.y_unit), 940, 320);
  plot.y_from_zero();
  // In pieces, as each is the data's or the prior's.
  const std::size_t points = law.sigma.size();
  for (std::size_t from = 0; from + 1 < points;) {
    std::size_t to = from + 1;
    const bool reached = law.reached(from) && law.reached(to);
    while (to + 1 < points && (law.reached(to) && law.reached(to + 1)) == reached) ++to;
    Plot::Points middle, above, below;
    for (std::size_t i = from; i <= to; ++i) {
      const double x = law.curve.points[i].x(), y = law.curve.points[i].y(), half = band_sigmas * law.sigma[i];
      middle.emplace_back(x, y), above.emplace_back(x, y + half), below.emplace_back(x, std::max(y - half, 0.0));
    }
    const std::string& colour = reached ? learned_colour : prior_colour;
    plot.line(middle, colour, 2.2);
    plot.line(above, colour, 1, "4 3"), plot.line(below, colour, 1, "4 3");
    from = to;
  }
  plot.level(law.curve.declared, "declared");
  plot.legend("learned, from the data", learned_colour);
  plot.legend("its prior", prior_colour);
  plot.legend("two standard deviations", learned_colour, false, "4 3");
  return plot.svg() + "<p class=\"source\">" + escaped(in_words(law)) + "</p>\n";
}

}  // namespace ostium::data
