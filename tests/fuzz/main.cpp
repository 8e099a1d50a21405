/// `ostium-fuzz`: tries mutants of one target, for campaign.py, which starts it again behind a mutant that ended it.
///
///   ostium-fuzz --list                              names, and whether libraries of others read it
///   ostium-fuzz TARGET SEED FROM TO                 tries these indices
///   ostium-fuzz TARGET SEED INDEX write             the mutant, on stdout
///
/// Before each mutant a line with its index is written, after it "t" (taken), "r" (refused) or "! WHAT" (a finding).
#include <sys/resource.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <exception>

#include "tests/fuzz/mutate.h"

namespace {

using namespace ostium::fuzz;

/// At once, since the next mutant may end us.
void say(const std::string& line) {
  if (::write(STDOUT_FILENO, line.data(), line.size()) < 0) std::exit(1);
}

void limit_memory() {
#if !defined(__SANITIZE_ADDRESS__)             // which takes terabytes of addresses
  const rlimit bytes{2ull << 30, 2ull << 30};  // as ostium-reader has
  setrlimit(RLIMIT_AS, &bytes);
#endif
}

void try_all(const Target& target, std::uint64_t seed, std::uint64_t from, std::uint64_t to) {
  const std::vector<Seed> seeds = target.seeds();
  for (const Seed& good : seeds)
    if (target.read(good) != Answer::taken) return say("0\n! a seed itself is refused: " + good.name + "\n");
  limit_memory();
  for (std::uint64_t index = from; index < to; ++index) {
    say(std::to_string(index) + "\n");
    try {
      say(target.read(mutant(seeds, seed, index)) == Answer::taken ? "t\n" : "r\n");
    } catch (const std::exception& error) {
      std::string what = error.what();
      for (char& c : what)
        if (c == '\n') c = ' ';
      say("! " + what + "\n");
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::string first = argc > 1 ? argv[1] : "";
  if (first == "--list") {
    for (const Target& target : targets()) std::printf("%s%s\n", target.name.c_str(), target.apart ? " apart" : "");
    return 0;
  }
  for (const Target& target : targets()) {
    if (target.name != first || argc != 5) continue;
    const auto number = [&](int i) { return std::strtoull(argv[i], nullptr, 10); };
    if (std::string(argv[4]) == "write")
      say(mutant(target.seeds(), number(2), number(3)).bytes);
    else
      try_all(target, number(2), number(3), number(4));
    return 0;
  }
  std::fputs("usage: ostium-fuzz --list | TARGET SEED FROM TO | TARGET SEED INDEX write\n", stderr);
  return 2;
}
