#pragma once
/// How like a real angiogram a picture is, in numbers, each with the range of real ones.
///
/// Ranges: cine frames of two public sets, vessels full, 512 x 512 (60 of ARCADE, Popov 2024, Sci Data 11:20; 45 of
/// AngioData): of a frame the wider of both sets' 4th to 96th percentile; of a set the wider of both sets' 95 %
/// interval of a median of nine. Necessary, not sufficient: clouds of noise crossed by worms can pass.
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "data/picture/image.h"

namespace ostium::data {

/// By name (`picture_numbers()`); a number that cannot be measured in this picture is missing.
using Likeness = std::map<std::string, double>;

struct PictureNumber {
  std::string name, what;
  struct Range {
    double low = 0, high = 0;
    bool holds(double value) const { return low <= value && value <= high; }
  };
  std::optional<Range> of_frame, of_set;
};
/// In the order of the table.
const std::vector<PictureNumber>& picture_numbers();

/// Of a picture of any size above 64 pixels a side.
Likeness measure_likeness(const Image& image);

/// Medians over pictures of the numbers that they have.
Likeness median_of(const std::vector<Likeness>& pictures);

/// How many ranges hold, and which do not.
struct LikenessVerdict {
  int held = 0, ranges = 0;
  std::vector<std::string> misses;
};
LikenessVerdict judge_frame(const Likeness& numbers);
LikenessVerdict judge_set(const Likeness& medians);

}  // namespace ostium::data
