#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "data/formats/load_error.h"
#include "data/recording/recording.h"
#include "tests/fuzz/target.h"

namespace ostium::fuzz {

namespace {

namespace fs = std::filesystem;

/// A short run of made-up numbers, in a mesh of one triangle or in a case.
std::string recording(bool mesh, bool full, bool whole) {
  const fs::path folder = fs::temp_directory_path() / ("ostium-fuzz-run-" + std::to_string(getpid()));
  fs::create_directories(folder);
  const std::string file = (folder / "run.h5").string();
  data::RecordingHeader header{.software = "ostium",
                               .setup = R"({"vessel": "none"})",
                               .step_s = 1e-3,
                               .full = full,
                               .input_columns = {"a", "b", "c"},
                               .signal_columns = {"x", "y"},
                               .state_width = 7,
                               .operator_width = 2,
                               .input_units = {"m", "1", "1"},
                               .tools = {"wire"},
                               .steps_per_shape = 100,
                               .shapes = {{"wire", {0.2, 0.1, 0}}}};
  const std::vector<double> vertices(9, 0.5);
  const std::vector<std::uint64_t> triangle = {0, 1, 2};
  std::vector<data::FixedTable> tables;
  if (mesh)
    tables = {{{"mesh_vertices", data::NumberType::float64, {}, 3, 64}, vertices.data(), 3},
              {{"mesh_triangles", data::NumberType::uint64, {}, 3, 64}, triangle.data(), 1}};
  {
    data::RecordingWriter writer(file, header, tables);
    for (std::size_t block = 0; block < 3; ++block) {
      constexpr std::size_t steps = data::steps_per_block;
      data::RecordingBlock rows{.inputs = std::vector<double>(3 * steps),
                                .hashes = std::vector<std::uint64_t>(steps),
                                .signals = std::vector<float>(2 * steps / data::steps_per_signal, 0.25f),
                                .states = {},
                                .hands = {},
                                .events = {double(block), 3, 0, 1.5},
                                .shape_steps = {200 * block, 200 * block + 100},
                                .shape_inserted_m = {0.1, 0.15},
                                .shapes_m = {std::vector<float>(18, 0.5f)}};
      for (std::size_t i = 0; i < steps; ++i) rows.inputs[3 * i] = 1.0 / double(1 + i), rows.hashes[i] = i * i * i;
      if (full && block == 0) rows.states.assign(7, 0.125), rows.hands.assign(2, 4);
      writer.commit(rows);
    }
    if (whole) writer.finish(R"({"outcome": "success", "metrics": []})");
  }
  std::ifstream in(file, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  fs::remove_all(folder);
  return bytes;
}

std::vector<Seed> recordings() {
  return {{"run.h5", recording(false, true, true)},
          {"run.h5", recording(true, false, true)},
          {"run.h5", recording(true, true, false)}};
}

Answer read_stored(const Seed& input) {
  const InputFile file(input);
  return answer_of<data::LoadError>([&] { data::read_to_end(file.path()); });
}

}  // namespace

std::vector<Target> recording_targets() { return {{"recording", recordings, read_stored, true}}; }

}  // namespace ostium::fuzz
