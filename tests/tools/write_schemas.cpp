/// write_schemas FOLDER: writes the schemas that are generated from the readers' tables of keys (data/schemas).
#include <filesystem>
#include <fstream>
#include <iostream>

#include "tests/data/formats/schema_files.h"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: write_schemas FOLDER\n";
    return 2;
  }
  for (const ostium::data::JsonFormat& format : ostium::data::json_formats()) {
    std::ofstream out(std::filesystem::path(argv[1]) / ostium::data::schema_file(format), std::ios::binary);
    out << ostium::data::schema_text(format);
    if (!out.flush()) {
      std::cerr << argv[1] << ": cannot be written to; expected the folder of schemas, data/schemas\n";
      return 1;
    }
  }
}
