#pragma once
/// What is fuzzed: a reader, with the good files that mutants are made of.
#include <concepts>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

namespace ostium::fuzz {

struct Seed {
  std::string name;  ///< of the file; readers may want its stem or its ending
  std::string bytes;
};

enum class Answer { taken, refused };

struct Target {
  std::string name;
  std::vector<Seed> (*seeds)();
  /// Reads one input. What it throws is a finding, as is its death.
  Answer (*read)(const Seed& input);
  /// A library of others reads it, and people's files meet it in `ostium-reader` alone: its death is a refusal there.
  bool apart = false;
};

const std::vector<Target>& targets();

/// The targets of each source of this folder.
std::vector<Target> json_targets();
std::vector<Target> mesh_targets();
std::vector<Target> recording_targets();
std::vector<Target> protocol_targets();
std::vector<Target> text_targets();
std::vector<Target> sweep_targets();

/// A promise that does not hold.
struct Finding : std::logic_error {
  using std::logic_error::logic_error;
};
inline void require(bool holds, const std::string& promise) {
  if (!holds) throw Finding(promise);
}

/// Refused where `read` throws an `Error` with a message that fits a terminal.
template <class Error>
Answer answer_of(std::invocable auto&& read) {
  try {
    read();
  } catch (const Error& error) {
    const std::string message = error.what();
    require(!message.empty() && message.size() < 6000, "a refusal says why, in less than 6000 bytes");
    return Answer::refused;
  }
  return Answer::taken;
}

/// A file for readers that want one, removed at the end.
class InputFile {
 public:
  explicit InputFile(const Seed& input);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace ostium::fuzz
