#include "commands/context.hpp"

#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>

namespace fs = std::filesystem;
using namespace comma::commands;

namespace context_test {

// Standard output goes to a file for as long as this lives, as that of a run whose log is kept.
class Redirected {
 public:
  Redirected() {
    std::fflush(stdout);
    saved_ = dup(STDOUT_FILENO);
    REQUIRE(std::freopen(path_.c_str(), "w", stdout) != nullptr);
  }
  ~Redirected() {
    std::fflush(stdout);
    dup2(saved_, STDOUT_FILENO);
    close(saved_);
    fs::remove(path_);
  }
  std::uintmax_t written() const { return fs::file_size(path_); }

 private:
  fs::path path_ = fs::temp_directory_path() / ("comma_console_" + std::to_string(getpid()));
  int saved_ = 0;
};

TEST_CASE("Lines are in the log before the run ends") {
  std::uintmax_t after_line = 0, after_text = 0;
  {
    const Redirected log;
    const Console console(Verbosity::normal);
    console.line("instant");
    after_line = log.written();
    console.print("text");
    after_text = log.written();
  }
  CHECK(after_line == 8);
  CHECK(after_text == 12);
}

TEST_CASE("What is written to unit 6 is shown, unless a file stands for it") {
  comma::interpreter::Diagnostics diagnostics;
  const fs::path folder = fs::temp_directory_path() / ("comma_units_" + std::to_string(getpid()));
  fs::create_directory(folder);
  const ExportFile messages{"mess", folder / "a.mess", false, true, 6};
  std::uintmax_t shown = 0, shown_beside_file = 0;
  {
    const Redirected log;
    Context context{Files("a.comm", {}, folder), Console(Verbosity::quiet), diagnostics};
    context.write(6, "resu", 8, "a table\n");
    shown = log.written();
    Context exported{Files("a.comm", {messages}, folder), Console(Verbosity::quiet), diagnostics};
    exported.write(6, "resu", 8, "a table\n");
    shown_beside_file = log.written();
  }
  CHECK(shown == 8);
  CHECK(shown_beside_file == 8);
  CHECK(fs::file_size(folder / "a.mess") == 8);
  fs::remove_all(folder);
}

}  // namespace context_test
