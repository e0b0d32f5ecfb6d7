#include "interpreter/source.hpp"

#include <filesystem>
#include <fstream>

#include <catch2/catch.hpp>

#include "interpreter/diagnostic.hpp"

using namespace comma::interpreter;

TEST_CASE("A place is counted in lines and characters from 1", "[source]") {
  const SourceFile file("a.comm", "ab\né=1\r\nx");
  CHECK(file.position(0).line == 1);
  CHECK(file.position(0).column == 1);
  CHECK(file.position(3).line == 2);
  // The two bytes of é are one character.
  CHECK(file.position(5).column == 2);
  CHECK(file.position(9).line == 3);
  CHECK(file.position(1000).line == 3);
  CHECK(file.position(1000).column == 2);
}

TEST_CASE("A line comes without its line break, whatever system wrote it", "[source]") {
  const SourceFile file("a.comm", "one\r\ntwo\rthree\n");
  CHECK(file.line(1) == "one");
  CHECK(file.line(2) == "two");
  CHECK(file.line(3) == "three");
  CHECK(file.line(4).empty());
  CHECK(file.line(5).empty());
  CHECK(file.line(0).empty());
}

TEST_CASE("A Latin-1 file is read as what it means", "[source]") {
  const SourceFile file("a.comm", "# d\xE9placement");
  CHECK(file.text() == "# d\xC3\xA9placement");
}

TEST_CASE("The mark with which some editors begin UTF-8 is not part of the text", "[source]") {
  const SourceFile file("a.comm", "\xEF\xBB\xBF# \xC3\xA9");
  CHECK(file.text() == "# \xC3\xA9");
  CHECK(file.position(0).column == 1);
}

TEST_CASE("What is no regular file is not read, for it may have no end", "[source]") {
  for (const char* path : {"/dev/zero", "/"}) {
    try {
      SourceFile::read(path);
      FAIL("nothing was thrown");
    } catch (const DiagnosticError& error) {
      CHECK(error.diagnostic().message == std::string(path) + " is not a regular file");
    }
  }
}

TEST_CASE("A file that cannot be read is a diagnostic", "[source]") {
  try {
    SourceFile::read("no/such/file.comm");
    FAIL("nothing was thrown");
  } catch (const DiagnosticError& error) {
    CHECK(error.diagnostic().code == "unreadable-file");
  }
}

TEST_CASE("What is no text is told once, and not character by character", "[source]") {
  const auto path = std::filesystem::temp_directory_path() / "comma_no_text.comm";
  std::ofstream(path, std::ios::binary) << std::string("HDF\0\0\0", 6);
  try {
    SourceFile::read(path.string());
    FAIL("nothing was thrown");
  } catch (const DiagnosticError& error) {
    CHECK(error.diagnostic().message == path.string() + " is no text: it holds characters of value 0");
  }
  std::filesystem::remove(path);
}
