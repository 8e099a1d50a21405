#pragma once
/// All instruments of the catalogue, and where data lies at run time.
#include "data/catalogue/instrument/instrument.h"
#include "data/formats/load_error.h"

namespace ostium::data {

/// The folder that holds `instruments/`: the environment variable OSTIUM_DATA if set; else ../share/ostium beside the
/// executable's folder (the layout of `cmake --install`); else `data/` of the source tree it was built from. Throws
/// LoadError if that is not a folder.
std::string data_folder();
/// From now on data lie there, whatever OSTIUM_DATA says: for a program that is not ours, as Python is. For its start,
/// before it has threads.
void set_data_folder(const std::string& folder);

/// All of `folder`/*.json, sorted by name. Throws LoadError for the first bad file, or if the folder has none.
std::vector<Instrument> load_catalogue(const std::string& folder);
/// The catalogue of the data folder.
std::vector<Instrument> load_catalogue();

/// Throws LoadError, listing the names there are, if `name` is not among them.
const Instrument& find_instrument(const std::vector<Instrument>& catalogue, const std::string& name);

/// The file of an instrument: a name of the catalogue, or a file NAME.json, which is looked for from `folder` and then
/// from where we are. Throws LoadError if there is none.
std::string instrument_file(const std::string& name_or_file, const std::string& folder = "");

}  // namespace ostium::data
