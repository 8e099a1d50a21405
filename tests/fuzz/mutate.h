#pragma once
/// Mutants: good files with a few changes. Seed and index decide, so any of them can be made again.
#include <cstdint>

#include "tests/fuzz/target.h"

namespace ostium::fuzz {

/// One of `seeds`, with one to four changes: bits, bytes, numbers (as text or in binary), stretches that are cut out,
/// doubled, exchanged or taken from another seed, an end that is cut off.
Seed mutant(const std::vector<Seed>& seeds, std::uint64_t seed, std::uint64_t index);

}  // namespace ostium::fuzz
