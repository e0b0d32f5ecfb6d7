#include "commands/files.hpp"

#include <catch2/catch.hpp>
#include <fstream>

#include "commands/cli/export_file.hpp"
#include "interpreter/diagnostic.hpp"

namespace fs = std::filesystem;
using namespace comma::commands;
using comma::interpreter::DiagnosticError;

namespace {

// A folder that goes with the test.
struct Folder {
  fs::path path = fs::temp_directory_path() / fs::path("comma_files_" + std::to_string(std::hash<const void*>{}(this)));
  Folder() { fs::create_directories(path); }
  ~Folder() { fs::remove_all(path); }
  fs::path file(const std::string& name, const std::string& text = "") const {
    std::ofstream(path / name) << text;
    return path / name;
  }
};

}  // namespace

TEST_CASE("A mesh is found by the stem, then by the stem without its letter, then alone in the folder") {
  const Folder folder;
  const Files files(folder.path / "beam1a.comm", {}, folder.path);
  CHECK_THROWS_AS(files.input(20, {"mmed", "med"}), DiagnosticError);
  const auto alone = folder.file("other.med");
  CHECK(files.input(20, {"mmed", "med"}) == alone);
  const auto shared = folder.file("beam1.med");
  CHECK(files.input(20, {"mmed", "med"}) == shared);
  const auto own = folder.file("beam1a.mmed");
  CHECK(files.input(20, {"mmed", "med"}) == own);
}

TEST_CASE("What was written under a unit is what is read under it") {
  const Folder folder, elsewhere;
  folder.file("a.med");
  const Files files(folder.path / "a.comm", {}, elsewhere.path);
  const auto written = files.output(80, "rmed", 80);
  CHECK(files.input(20, {"med"}) == folder.path / "a.med");
  std::ofstream(written) << "";
  CHECK(files.input(80, {"med"}) == written);
}

TEST_CASE("A unit that the command file names is that file, whatever else could stand for it") {
  const Folder folder, elsewhere;
  folder.file("a.med");
  const auto other = folder.file("other.med"), exported = folder.file("exported.med");
  Files files(folder.path / "a.comm", {{"med", exported, true, false, 20}}, elsewhere.path);
  files.name_output(20, "other.med");
  CHECK(files.input(20, {"med"}) == other);
  CHECK(files.included(20, {}) == other);
  files.name_output(20, "nowhere.med");
  CHECK_THROWS_WITH(files.input(20, {"med"}), Catch::Contains("nowhere.med"));
  files.name_output(21, "fort.20");
  files.name_output(20, "");
  CHECK(files.input(20, {"med"}) == exported);
  CHECK(files.input(21, {"med"}) == exported);
}

TEST_CASE("An .export names files by unit, and outputs land in the current folder") {
  const Folder folder;
  folder.file("a.comm");
  const auto path = folder.file(
      "a.export", "P time_limit 60\n# comment\nF comm a.comm D 1\nF mmed m.mmed D 20\nF rmed out.rmed R 80\n");
  const Study study = read_export(path, "/elsewhere");
  REQUIRE(study.command_files.size() == 1);
  const Files files(study.command_files[0], study.files, "/elsewhere");
  CHECK(files.input(20, {"mmed"}) == folder.path / "m.mmed");
  CHECK(files.output(80, "rmed", 80) == fs::path("/elsewhere/out.rmed"));
  CHECK(files.output(8, "resu", 8) == fs::path("/elsewhere/a.resu"));
  CHECK(files.output(38, "resu", 8) == fs::path("/elsewhere/a.38.resu"));
}

TEST_CASE("An .export that names a device as its command file says that it is none") {
  const Folder folder;
  const auto path = folder.file("a.export", "F comm /dev/zero D 1\n");
  CHECK_THROWS_WITH(read_export(path, "."), Catch::Contains("the command file /dev/zero is not a regular file"));
}

TEST_CASE("A wrong line of an .export is told with its place") {
  const Folder folder;
  folder.file("a.comm");
  const auto path = folder.file("a.export", "F comm a.comm D 1\nF mmed m.mmed D twenty\n");
  try {
    read_export(path, ".");
    FAIL("no error");
  } catch (const DiagnosticError& error) {
    CHECK(error.diagnostic().code == "bad-export");
    CHECK(error.diagnostic().span.file->position(error.diagnostic().span.begin).line == 2);
  }
}

TEST_CASE(
    "A unit that the command file names writes under that name until it is set free, and into the current folder "
    "alone") {
  Files files("/study/a.comm", {}, "/here");
  files.name_output(37, "./curve.txt");
  CHECK(files.output(37, "resu", 8) == fs::path("/here/curve.txt"));
  CHECK(files.output(38, "resu", 8) == fs::path("/here/a.38.resu"));
  files.name_output(37, "");
  CHECK(files.output(37, "resu", 8) == fs::path("/here/a.37.resu"));
  for (const char* elsewhere : {"/etc/passwd", "../b.txt", "deep/b.txt", ".."})
    CHECK_THROWS_AS(files.name_output(37, elsewhere), DiagnosticError);
}

TEST_CASE("A path that leads into the folder itself is the bare name") {
  const Folder folder, elsewhere;
  const auto other = folder.file("b.comm");
  Files files(folder.path / "a.comm", {}, folder.path);
  files.name_output(37, (folder.path / "." / "curve.txt").string());
  CHECK(files.output(37, "resu", 8) == folder.path / "curve.txt");
  for (const fs::path& path : {elsewhere.path / "curve.txt", folder.path / "deep" / "curve.txt", folder.path})
    CHECK_THROWS_WITH(files.name_output(37, path.string()), Catch::Contains("current folder alone"));
  CHECK(files.included(other.string(), {}) == other);
  CHECK(files.included("./b.comm", {}) == other);
  CHECK_THROWS_WITH(files.included((elsewhere.path / "b.comm").string(), {}), Catch::Contains("its own folder"));
  fs::create_symlink(elsewhere.file("far.txt"), folder.path / "link.txt");
  files.name_output(37, (folder.path / "link.txt").string());
  CHECK_THROWS_WITH(files.output(37, "resu", 8), Catch::Contains("link.txt is a link"));
}

TEST_CASE("What the study reads is not written over") {
  const Folder folder;
  const auto mesh = folder.file("my.mail"), command_file = folder.file("a.comm");
  Files files(command_file, {}, folder.path);
  files.name_output(20, "my.mail");
  CHECK(files.input(20, {"mail"}) == mesh);
  CHECK_THROWS_WITH(files.output(20, "mail", 30), Catch::Contains("my.mail is read by this study"));
  files.name_output(21, "a.comm");
  CHECK_THROWS_WITH(files.output(21, "resu", 8), Catch::Contains("a.comm is read by this study"));
  // What it has written itself it may read and write again.
  files.name_output(22, "own.mail");
  const auto own = files.output(22, "mail", 30);
  std::ofstream(own) << "";
  CHECK(files.input(22, {"mail"}) == own);
  CHECK(files.output(22, "mail", 30) == own);
}

TEST_CASE("Nothing is written, and no commands are read, through a link") {
  const Folder folder, elsewhere;
  const auto outside = elsewhere.file("outside.txt");
  fs::create_symlink(outside, folder.path / "link.txt");
  fs::create_symlink(outside, folder.path / "a.resu");
  Files files(folder.file("a.comm"), {}, folder.path);
  files.name_output(37, "link.txt");
  CHECK_THROWS_WITH(files.output(37, "resu", 8), Catch::Contains("link.txt is a link"));
  CHECK_THROWS_WITH(files.output(8, "resu", 8), Catch::Contains("a.resu is a link"));
  CHECK_THROWS_WITH(files.included(37, {}), Catch::Contains("link.txt is a link"));
  CHECK_THROWS_WITH(files.included("link.txt", {}), Catch::Contains("link.txt is a link"));
}
