#include "app/command_line/links.h"

#include <fmt/format.h>

#include <cstdio>

namespace ostium::app {

void tell_links(const std::string& who, const std::string& link, const std::string& viewers, bool open) {
  fmt::print("{}: {}\nviewers: {}\n", who, link, viewers);
  std::fflush(stdout);
  if (open)
    fmt::print(stderr,
               "ostium: others in this network can reach this page, and what it sends is not encrypted: whoever has "
               "the {}'s link may do everything there\n",
               who);
}

}  // namespace ostium::app
