/// Whatever lies where a file should be is called what it is, and is not opened.
#include "vascular/geometry/mesh_files/paths.h"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstring>
#include <fstream>

namespace ostium::vascular {
namespace {

namespace fs = std::filesystem;

TEST(Paths, EachKindOfThingIsCalledByItsName) {
  const fs::path folder = fs::path(testing::TempDir()) / "paths";
  fs::remove_all(folder);
  fs::create_directories(folder / "folder");
  std::ofstream(folder / "file") << "text";
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  sockaddr_un at{};
  at.sun_family = AF_UNIX;
  const std::string name = (folder / "socket").string();
  ASSERT_LT(name.size(), sizeof at.sun_path);
  std::strcpy(at.sun_path, name.c_str());
  const int listener = socket(AF_UNIX, SOCK_STREAM, 0);
  ASSERT_EQ(bind(listener, reinterpret_cast<const sockaddr*>(&at), sizeof at), 0);
  fs::create_symlink("file", folder / "link");
  fs::create_symlink("pipe", folder / "link to pipe");
  fs::create_symlink("round", folder / "round");
  fs::create_symlink("none", folder / "nowhere");

  EXPECT_EQ(why_no_file(folder / "file"), "");
  EXPECT_EQ(why_no_file(folder / "link"), "");
  EXPECT_EQ(why_no_file(folder / "folder"), "it is a folder, not a file");
  EXPECT_EQ(why_no_file(folder / "pipe"), "it is a pipe, not a file");
  EXPECT_EQ(why_no_file(folder / "link to pipe"), "it is a pipe, not a file");
  EXPECT_EQ(why_no_file(folder / "socket"), "it is a socket, not a file");
  EXPECT_EQ(why_no_file("/dev/null"), "it is a device, not a file");
  EXPECT_EQ(why_no_file(folder / "round"), "a symbolic link on the way leads to itself");
  EXPECT_EQ(why_no_file(folder / "round" / "file"), "a symbolic link on the way leads to itself");
  EXPECT_EQ(why_no_file(folder / "nowhere"), "it is a symbolic link to what is not there");
  EXPECT_EQ(why_no_file(folder / "none"), "there is no such file");
  EXPECT_EQ(why_no_file(folder / "file" / "none"), "there is no such file");
  // A list of values that is taken for a path, say.
  const std::string long_name(5000, 'x');
  EXPECT_NE(why_no_file(long_name).find("cannot be seen"), std::string::npos);
  EXPECT_FALSE(is_file(long_name) || is_folder(long_name) || is_there(long_name));
  EXPECT_TRUE(is_there(folder / "nowhere") && is_there(folder / "round") && !is_there(folder / "none"));
  EXPECT_TRUE(is_folder(folder) && !is_folder(folder / "round") && !is_file(folder / "round"));
  close(listener);
  fs::remove_all(folder);
}

}  // namespace
}  // namespace ostium::vascular
