#pragma once
/// Every instrument there is, and where data lies at run time.
#include "data/catalogue/instrument/instrument.h"
#include "data/formats/load_error.h"

namespace ostium::data {

/// The folder that holds `instruments/`: the environment variable OSTIUM_DATA where it is set; else ../share/ostium
/// beside the executable's folder (as `cmake --install` lays it out); else `data/` of the source tree it was built
/// from. Throws LoadError if that is no folder.
std::string data_folder();

/// All of `folder`/*.json, by name. All or nothing: the first file that is wrong throws LoadError, as does a folder
/// without any.
std::vector<Instrument> load_catalogue(const std::string& folder);
/// That of the data folder.
std::vector<Instrument> load_catalogue();

/// Throws LoadError naming what there is if `name` is not among them.
const Instrument& find_instrument(const std::vector<Instrument>& catalogue, const std::string& name);

}  // namespace ostium::data
