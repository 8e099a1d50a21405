#pragma once
/// Drugs of the catalogue: data/drugs/NAME.json (schemas/drug.schema.json), with a source for every number.
#include <string>
#include <vector>

#include "vascular/treatment/drugs.h"

namespace ostium::data {

/// Throws LoadError with file, line, key, value found and what was expected.
vascular::Drug read_drug(const std::string& file, const std::string& text);

/// The files of all drugs, sorted by name. Throws LoadError if there are none.
std::vector<std::string> drug_files();

}  // namespace ostium::data
