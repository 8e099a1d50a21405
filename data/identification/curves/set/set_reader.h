#pragma once
/// What sets of all kinds of curves share in their files (schema ostium-measurement/2).
#include <memory>

#include "data/formats/json/json_object.h"
#include "data/identification/curves/set/curve_kind.h"
#include "data/identification/measurement/measured_numbers.h"

namespace ostium::data::curves {

/// A kind of curves: its name in files, and its reader.
struct Kind {
  std::string name, what;
  std::unique_ptr<Set> (*read)(const JsonValue& root);
  std::vector<const JsonObjectKeys*> keys;  ///< for its schema; the file's own object comes first
};

/// Keys of the file's own object that every kind has.
std::vector<JsonKey> with_common_keys(const std::string& kind, std::vector<JsonKey> own);
/// Of a run: id and group, `own`, and `samples`, its lists, which may be columns of a table (run_table.h) instead.
JsonObjectKeys run_keys(const std::string& object, std::vector<JsonKey> own, std::vector<JsonKey> samples);
extern const JsonObjectKeys effect_keys;  ///< of an effect that a file declares
inline constexpr const char* one_or_more = "runs in the order in which they were made, not empty";

/// What every kind has: title, source, what a fit found before, and the effects that the file declares.
void declare(const JsonObject& root, Set& set);

std::vector<MeasuredNumbers> measured_numbers(const std::vector<Run>& runs);

/// A run's list, or LoadError if it has none.
const JsonValue& samples(const JsonObject& run, const std::string& key);
/// A number of a list, up to 1e12 as all numbers of files are; LoadError.
double sample(const JsonValue& value);
/// Numbers of one key, all finite, at least `least` of them.
Eigen::VectorXd read_samples(const JsonObject& run, const std::string& key, Eigen::Index least = 4);
/// The same, as many as `of` has.
Eigen::VectorXd read_samples_like(const JsonObject& run, const std::string& key, const Eigen::VectorXd& of,
                                  const std::string& of_key);
/// Refuses numbers that do not rise, at the first that does not.
void must_rise(const JsonObject& run, const std::string& key, const Eigen::VectorXd& x);
/// id, group and place; refuses an id that another run has.
Run begin_run(const JsonObject& entry, const std::vector<Run>& others);

}  // namespace ostium::data::curves
