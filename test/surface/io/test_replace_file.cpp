// SPDX-License-Identifier: GPL-3.0-or-later
// Files are replaced whole or not at all, through links, and with the rights they had.
#include <haptic_sculpt/surface/read_surface.h>
#include <haptic_sculpt/surface/write_surface.h>

#include <meshes/generated_meshes.h>
#include <sculpting/edits/failing_allocations.h>
#include <surface/Temporary_folder.h>
#include <surface/identical.h>

#include <boost/test/unit_test.hpp>

#include <csignal>
#include <limits>

#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

using namespace haptic_sculpt;
using meshes::Mesh;
using meshes::to_mesh;
namespace fs = std::filesystem;

namespace {

std::string note_of_rights(int, const struct stat&) {
  return "a note about rights that is long enough to be stored";
}

} // namespace

BOOST_AUTO_TEST_SUITE(reading_and_writing)

BOOST_AUTO_TEST_CASE(a_file_is_replaced_whole_or_not_at_all) {
  const Temporary_folder folder;
  const Mesh mesh = to_mesh(meshes::icosphere(4));
  const auto target = folder.file("m.off", "precious");
  fs::permissions(target, fs::perms::owner_all | fs::perms::group_read);

  // The disk is full: files may not grow beyond 10,000 bytes.
  rlimit before{};
  BOOST_REQUIRE(::getrlimit(RLIMIT_FSIZE, &before) == 0);
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit small = before;
  small.rlim_cur = 10000;
  BOOST_REQUIRE(::setrlimit(RLIMIT_FSIZE, &small) == 0);
  std::string message;
  try {
    write_surface(target, mesh);
  } catch (const Write_error& error) {
    message = error.what();
  }
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, old_handler);
  BOOST_TEST(message.find("m.off") != std::string::npos, message);
  BOOST_TEST(bytes_of(target) == "precious");
  BOOST_TEST(folder.number_of_files() == 1u);

  write_surface(target, mesh);
  BOOST_TEST(identical(read_surface<Mesh>(target), mesh));
  BOOST_TEST(int(fs::status(target).permissions()) == int(fs::perms::owner_all | fs::perms::group_read));

  // Through a symbolic link, whose target is replaced.
  fs::create_symlink(target, folder / "link.off");
  write_surface(folder / "link.off", to_mesh(meshes::cube()));
  BOOST_TEST(fs::is_symlink(folder / "link.off"));
  BOOST_TEST(read_surface<Mesh>(target).number_of_faces() == 12u);
  fs::remove(folder / "link.off");

  fs::create_directory(folder / "d.off");
  for (const fs::path& path :
       {folder / "d.off", folder / "missing" / "m.off", fs::path("/proc/m.off"), folder / "m.txt", folder / "m"})
    BOOST_CHECK_THROW(write_surface(path, mesh), Write_error);
  BOOST_CHECK_THROW(replace_file("/dev/full", "x"), Write_error);
  BOOST_TEST(fs::is_character_file("/dev/full"));
  Mesh infinite = mesh;
  infinite.point(V(7)) = {0, 0, std::numeric_limits<double>::infinity()};
  BOOST_CHECK_THROW(write_surface(target, infinite), Write_error);
  BOOST_TEST(read_surface<Mesh>(target).number_of_faces() == 12u);
  BOOST_TEST(folder.number_of_files() == 2u);
}

BOOST_AUTO_TEST_CASE(a_link_that_leads_nowhere_gets_a_file_and_a_circle_is_refused) {
  const Temporary_folder folder;
  const Mesh mesh = to_mesh(meshes::cube());
  fs::create_directory(folder / "there");
  fs::create_symlink("there/m.off", folder / "first.off"); // relative to the folder of the link
  fs::create_symlink(folder / "first.off", folder / "second.off");
  for (int i = 0; i < 2; ++i) {
    write_surface(folder / "second.off", mesh);
    BOOST_TEST(fs::is_symlink(folder / "first.off"));
    BOOST_TEST(fs::is_symlink(folder / "second.off"));
    BOOST_TEST(identical(read_surface<Mesh>(folder / "there" / "m.off"), mesh));
  }
  fs::create_symlink("b.off", folder / "a.off");
  fs::create_symlink("a.off", folder / "b.off");
  fs::create_symlink("missing/m.off", folder / "c.off");
  for (const char* name : {"a.off", "b.off", "c.off"}) {
    BOOST_CHECK_THROW(write_surface(folder / name, mesh), Write_error);
    BOOST_TEST(fs::is_symlink(folder / name));
  }
  BOOST_TEST(folder.number_of_files() == 6u);
}

BOOST_AUTO_TEST_CASE(where_memory_runs_out_the_old_file_stays) {
  const Temporary_folder folder;
  const auto target = folder / "a_name_that_is_too_long_for_a_short_string.off";
  for (int k = 0; k < 20; ++k)
    folder.file("another_name_that_is_too_long_for_a_short_string" + std::to_string(k), "");
  fs::create_symlink(target, folder / "link.off");
  for (const bool for_good : {false, true}) {
    std::size_t failures = 0;
    for (bool has_failed = true; has_failed; ++failures) {
      folder.file(target.filename().string(), "old");
      has_failed = false;
      {
        const test::Failing_allocations failing(failures + 1, for_good);
        try {
          replace_file(folder / "link.off", "new", note_of_rights);
        } catch (const std::bad_alloc&) {
          has_failed = true;
        }
      }
      BOOST_TEST(bytes_of(target) == (has_failed ? "old" : "new"));
      BOOST_TEST(folder.number_of_files() == 22u);
    }
    BOOST_TEST(failures > 10u);
  }
}

BOOST_AUTO_TEST_CASE(rights_that_a_file_lends_are_not_passed_on) {
  const Temporary_folder folder;
  const auto target = folder.file("m.off", "a program");
  for (const mode_t mode : {04755, 02755, 06711, 0640}) {
    BOOST_REQUIRE(::chmod(target.c_str(), mode) == 0);
    replace_file(target, "other bytes");
    struct stat status {};
    BOOST_REQUIRE(::stat(target.c_str(), &status) == 0);
    BOOST_TEST((status.st_mode & 07777) == (mode & 0777));
  }
  const auto look = [](int file, const struct stat& old) {
    struct stat status {};
    BOOST_TEST(::fstat(file, &status) == 0);
    BOOST_TEST((status.st_mode & 07777) == 0600u); // until then nobody else could read it
    return keep_permissions(file, old);
  };
  replace_file(target, "other bytes", look);
  const auto refuse = [](int, const struct stat&) -> std::string {
    throw std::system_error(EPERM, std::generic_category());
  };
  BOOST_CHECK_THROW(replace_file(target, "more bytes", refuse), Write_error);
  BOOST_TEST(bytes_of(target) == "other bytes");
  BOOST_TEST(folder.number_of_files() == 1u);
}

BOOST_AUTO_TEST_CASE(temporary_files_of_killed_processes_are_removed) {
  const Temporary_folder folder;
  const auto target = folder / "m.off";
  const pid_t child = ::fork();
  BOOST_REQUIRE(child >= 0);
  if (child == 0) { // is killed while it writes
    const internal::Temporary_file half(target, 0666);
    ::kill(::getpid(), SIGKILL);
  }
  BOOST_REQUIRE(::waitpid(child, nullptr, 0) == child);
  BOOST_REQUIRE(folder.number_of_files() == 1u);
  const internal::Temporary_file living(target, 0666);
  BOOST_REQUIRE(folder.number_of_files() == 2u);
  const auto other = folder.file(".m.off.haptic_sculpt-new-no", "somebody's");
  replace_file(target, "bytes");
  BOOST_TEST(bytes_of(target) == "bytes");
  BOOST_TEST(bytes_of(other) == "somebody's");
  BOOST_TEST(folder.number_of_files() == 3u); // these, and the one of the living
  struct stat status {};
  BOOST_TEST(::fstat(living.descriptor(), &status) == 0);
  BOOST_TEST(status.st_nlink == 1u);
  // A name as long as names may be.
  const fs::path longest = folder / (std::string(251, 'x') + ".off");
  replace_file(longest, "bytes");
  BOOST_TEST(bytes_of(longest) == "bytes");
}

BOOST_AUTO_TEST_SUITE_END()
