/// ostium-recognition: what made-up vessels are taken for, by kind.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fstream>
#include <stdexcept>
#include <vector>

#include "tests/support/made_up_vessels.h"
#include "vascular/anatomy/labelling/labelling.h"

namespace {

struct Options {
  std::vector<std::string> kinds = ostium::synthetic::made_up_kinds();
  unsigned first_seed = 1, seeds = 8;
  bool each = false;   ///< a line for each, too
  std::string meshes;  ///< a folder to write them to, as KIND-SEED.ply, and label none
};

struct Row {
  int vessels = 0, refused = 0, hearts = 0, aortas = 0;
  bool heart = false, aorta = false;
  std::vector<double> heart_doubts, aorta_doubts;
};

std::string range(std::vector<double> doubts) {
  if (doubts.empty()) return "none";
  std::ranges::sort(doubts);
  return fmt::format("{:.2f} {:.2f} {:.2f}", doubts.front(), doubts[doubts.size() / 2], doubts.back());
}

Row row_of(const Options& o, const std::string& kind) {
  Row row;
  for (unsigned seed = o.first_seed; seed < o.first_seed + o.seeds; ++seed) {
    const ostium::synthetic::MadeUpVessels made = ostium::synthetic::made_up_vessels(kind, seed);
    row.heart = made.heart, row.aorta = made.aorta;
    ++row.vessels;
    try {
      const ostium::vascular::LabelledVessels found = label_vessels(mesh_of(made));
      row.hearts += found.heart, row.aortas += found.anatomy.aorta;
      if (found.heart_doubt > 0) row.heart_doubts.push_back(found.heart_doubt);
      if (found.aorta_doubt > 0) row.aorta_doubts.push_back(found.aorta_doubt);
      if (o.each)
        fmt::print("{} {}: heart {} ({:.2f}), aorta {} ({:.2f})\n", kind, seed, found.heart, found.heart_doubt,
                   found.anatomy.aorta, found.aorta_doubt);
    } catch (const ostium::vascular::MeshError& error) {
      ++row.refused;
      if (o.each) fmt::print("{} {}: {}\n", kind, seed, error.what());
    }
  }
  return row;
}

int write_meshes(const Options& o) {
  for (const std::string& kind : o.kinds)
    for (unsigned seed = o.first_seed; seed < o.first_seed + o.seeds; ++seed) {
      const ostium::vascular::Mesh mesh = mesh_of(ostium::synthetic::made_up_vessels(kind, seed));
      std::string name = kind;
      std::ranges::replace(name, ' ', '-');
      const std::string path = fmt::format("{}/{}-{}.ply", o.meshes, name, seed);
      std::ofstream file(path, std::ios::binary);
      file << mesh_bytes(path, mesh, ostium::vascular::LengthUnit::millimetre);
      if (!file.flush()) throw std::runtime_error(path + ": cannot be written; expected a folder");
    }
  return 0;
}

int run(const Options& o) {
  if (!o.meshes.empty()) return write_meshes(o);
  int wrong = 0, missed = 0, all = 0;
  std::string table = fmt::format("{:<28} {:>7} {:>7} {:>7} {:>7}  {:<18} {:<18}\n", "vessels", "number", "refused",
                                  "hearts", "aortas", "doubt of heart", "of aorta");
  for (const std::string& kind : o.kinds) {
    const Row row = row_of(o, kind);
    const int taken = row.vessels - row.refused;
    all += row.vessels;
    (row.heart ? missed : wrong) += row.heart ? row.vessels - row.hearts : row.hearts;
    (row.aorta ? missed : wrong) += row.aorta ? taken - row.aortas : row.aortas;
    table += fmt::format("{:<28} {:>7} {:>7} {:>7} {:>7}  {:<18} {:<18}\n", kind, row.vessels, row.refused, row.hearts,
                         row.aortas, range(row.heart_doubts), range(row.aorta_doubts));
  }
  fmt::print("{}\n{} made up: {} taken for a heart or an aorta and none, {} missed\n", table, all, wrong, missed);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Makes vessels up, labels them, and counts what is taken for a heart or an aorta.");
  Options o;
  app.add_option("--kinds", o.kinds, "Only these")->delimiter(',');
  app.add_option("--first-seed", o.first_seed, "Where the seeds begin")->capture_default_str();
  app.add_option("--seeds", o.seeds, "Of each kind")->capture_default_str();
  app.add_flag("--each", o.each, "A line for each, too");
  app.add_option("--write", o.meshes, "Write the meshes here, and label none")->type_name("DIR");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    return run(o);
  } catch (const std::exception& error) {
    fmt::print(stderr, "ostium-recognition: {}\n", error.what());
    return 3;
  }
}
