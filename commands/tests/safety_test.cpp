// A stranger's command file: it reaches no file but those of its .export and its folder, no process, no network, and
// cannot take the machine for ever. Files that go on from one another, files that include others, and files that
// DEFI_FICHIER names.
#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "commands/cli/options.hpp"
#include "commands/cli/study_run.hpp"
#include "interpreter/diagnostic.hpp"

namespace fs = std::filesystem;
using namespace comma::commands;
using comma::interpreter::Limits;
using comma::interpreter::Severity;

namespace safety_test {

class Folder {
 public:
  Folder() : path_(fs::temp_directory_path() / ("comma-safety-" + std::to_string(getpid()))) {
    fs::create_directories(path_ / "study");
  }
  ~Folder() { fs::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / "study" / name) << text;
    return path_ / "study" / name;
  }
  fs::path outside() const { return path_; }

 private:
  fs::path path_;
};

// The codes of the errors, in order.
std::vector<std::string> codes_of(const fs::path& file, Limits limits = {}) {
  StudyRun pass(open_study(file), Verbosity::quiet, {.check_only = true, .only_tests = false}, limits);
  pass.run();
  std::vector<std::string> codes;
  for (const auto& item : pass.diagnostics().items()) {
    if (item.severity == Severity::error) codes.push_back(item.code);
  }
  return codes;
}

using Codes = std::vector<std::string>;

TEST_CASE("A command file reaches no file, process, network or clock by itself") {
  const Folder folder;
  for (const char* text : {"text = open('/etc/passwd').read()\n",
                           "import subprocess\nsubprocess.run('ls')\n",
                           "import socket\nsocket.socket()\n",
                           "import os\nos.system('ls')\n",
                           "import os\nos.environ['HOME']\n",
                           "import os\nos.remove('x')\n",
                           "import sys\nsys.modules['os']\n",
                           "import time\ntime.time()\n",
                           "import shutil as tools\ntools.rmtree('x')\n",
                           "from ctypes import *\n",
                           "from pickle import load\nload(3)\n",
                           "__import__('os')\n",
                           "eval('1')\n",
                           "exec('x = 1')\n",
                           "compile('1', 'f', 'eval')\n",
                           "globals()\n",
                           "().__class__.__bases__\n",
                           "import builtins\nbuiltins.open('x')\n",
                           "import importlib.util\nimportlib.import_module('os')\n",
                           "import numpy\nnumpy.load('x')\n",
                           "import numpy\nnumpy.fromfile('x')\n",
                           "from os import popen\npopen('ls')\n",
                           "input()\n"}) {
    INFO(text);
    CHECK(codes_of(folder.write("stranger.comm", text)).size() == 1);
  }
}

TEST_CASE("INCLUDE reads what lies in the folder, by name or by unit, and nothing else") {
  const Folder folder;
  folder.write("values.py", "YOUNG = 2.0\ndef twice(x):\n    return 2 * x\n");
  folder.write("study.91", "POISSON = 0.3\n");
  std::ofstream(folder.outside() / "secret.comm") << "SECRET = 1\n";
  fs::create_symlink(folder.outside() / "secret.comm", folder.outside() / "study" / "link.comm");
  const auto codes = [&](const std::string& text) { return codes_of(folder.write("study.comm", text)); };
  CHECK(codes("INCLUDE(DONNEE='values.py')\nINCLUDE(UNITE=91)\nassert twice(YOUNG) == 4.0 and POISSON == 0.3\n") ==
        Codes{});
  CHECK(codes("INCLUDE(DONNEE='../secret.comm')\n") == Codes{"forbidden-file"});
  CHECK(codes("INCLUDE(DONNEE='" + (folder.outside() / "secret.comm").string() + "')\n") == Codes{"forbidden-file"});
  CHECK(codes("INCLUDE(DONNEE='..')\n") == Codes{"forbidden-file"});
  CHECK(codes("INCLUDE(DONNEE='link.comm')\n") == Codes{"forbidden-file"});
  CHECK(codes("INCLUDE(DONNEE='nowhere.comm')\n") == Codes{"missing-file"});
  CHECK(codes("INCLUDE(UNITE=92)\n") == Codes{"missing-file"});
  CHECK(codes("INCLUDE(DONNEE='study.comm')\n") == Codes{"include-depth"});
  CHECK(codes("INCLUDE(DONNEE='values.py', UNITE=91)\n") == Codes{"exclusive-keywords"});
}

TEST_CASE("Files that include one another many times over come to an end") {
  const Folder folder;
  const std::string twice = "INCLUDE(DONNEE='study.comm')\nINCLUDE(DONNEE='study.comm')\n";
  const Codes codes = codes_of(folder.write("study.comm", twice));
  CHECK(std::ranges::count(codes, "limit-files") == 1);
}

TEST_CASE("A list with more steps than a run could take is refused before it is made") {
  const Folder folder;
  const auto codes = [&](const std::string& interval) {
    return codes_of(
        folder.write("list.comm", "L = DEFI_LIST_REEL(DEBUT=0.0, INTERVALLE=_F(JUSQU_A=1.0, " + interval + "))\n"));
  };
  CHECK(codes("NOMBRE=10") == Codes{});
  CHECK(codes("NOMBRE=2000000000") == Codes{"out-of-bounds"});
  CHECK(codes("NOMBRE=5000000000") == Codes{"out-of-bounds"});
  CHECK(codes("PAS=1e-300") == Codes{"out-of-bounds"});
}

TEST_CASE("A report that cannot be written is told, and the file is not called sound") {
  const Folder folder;
  const std::string nowhere = (folder.outside() / "no" / "such" / "report.json").string();
  CHECK_THROWS_AS(check({folder.write("study.comm", "A = 1\n").string(), {}, nowhere}),
                  comma::interpreter::DiagnosticError);
  CHECK_THROWS_AS(run({folder.write("study.comm", "A = 1\n").string(), {}, nowhere, false, Verbosity::quiet}),
                  comma::interpreter::DiagnosticError);
}

TEST_CASE("What is wrong in an included file is told at its line there") {
  const Folder folder;
  folder.write("part.comm", "A = 1\nB = unheard_of\n");
  StudyRun pass(open_study(folder.write("whole.comm", "INCLUDE(DONNEE='part.comm')\nC = A\n")), Verbosity::quiet,
                {.check_only = true});
  pass.run();
  REQUIRE(pass.diagnostics().items().size() == 1);
  const auto& error = pass.diagnostics().items().front();
  CHECK(error.code == "unknown-name");
  CHECK(fs::path(error.span.file->path()).filename() == "part.comm");
  CHECK(error.span.file->position(error.span.begin).line == 2);
}

TEST_CASE("A check looks behind DEFI_FICHIER, and behind what a file handles itself") {
  const Folder folder;
  folder.write("other.mail",
               "COOR_2D\nN1 0.0 0.0\nN2 1.0 0.0\nFINSF\nSEG2\nLINE1 N1 N2\nFINSF\nGROUP_MA\nLINE LINE1\nFINSF\nFIN\n");
  const auto codes = [&](const std::string& file, const std::string& then) {
    return codes_of(folder.write("named.comm", "DEBUT()\nDEFI_FICHIER(ACTION='ASSOCIER', UNITE=20, FICHIER='" + file +
                                                   "', ACCES='OLD')\nMESH = LIRE_MAILLAGE(FORMAT='ASTER', UNITE=20)\n" +
                                                   then + "FIN()\n"));
  };
  const std::string groups = "MESH = DEFI_GROUP(reuse=MESH, MAILLAGE=MESH, CREA_GROUP_NO=_F(GROUP_MA='";
  CHECK(codes("other.mail", groups + "LINE'))\n") == Codes{});
  CHECK(codes("other.mail", groups + "CURVE'))\n") == Codes{"unknown-group"});
  CHECK(codes("missing.mail", "") == Codes{"missing-file"});
  // What comma leaves out with an alarm is an error for its reader.
  CHECK(codes("/elsewhere/other.mail", "") == Codes{"not-computed"});
  // A solution that is not there keeps the group waiting, so that nothing runs it at once.
  const std::string solved =
      "MODEL = AFFE_MODELE(MAILLAGE=MESH, AFFE=_F(TOUT='OUI', PHENOMENE='MECANIQUE', MODELISATION='BARRE'))\nRESULT = "
      "MECA_STATIQUE(MODELE=MODEL, CARA_ELEM=AFFE_CARA_ELEM("
      "MODELE=MODEL, BARRE=_F(GROUP_MA='LINE', SECTION='GENERALE', CARA='A', VALE=1.0)), "
      "CHAM_MATER=AFFE_MATERIAU(MAILLAGE=MESH, AFFE=_F(TOUT='OUI', MATER=DEFI_MATERIAU(ELAS=_F(E=1.0, NU=0.0)))))\n";
  CHECK(codes("other.mail", solved + "try:\n    " + groups + "CURVE'))\nexcept Exception:\n    pass\n") == Codes{});
  CHECK(codes("other.mail", solved + groups + "CURVE'))\n") == Codes{"unknown-group"});
}

TEST_CASE("The files of an .export go on from one another") {
  const Folder folder;
  folder.write("a.comm", "DEBUT()\nTIMES = DEFI_LIST_REEL(VALE=(0.0, 1.0))\nx = 3\nFIN()\n");
  folder.write("a.com1",
               "POURSUITE(CODE='OUI')\nassert x == 3\nRAMP = DEFI_LIST_REEL(DEBUT=0.0, INTERVALLE=_F(JUSQU_A=1.0, "
               "NOMBRE=x))\nFIN()\n");
  folder.write("b.py",
               "from code_aster.Commands import *\nfrom code_aster import CA\nCA.init('--continue')\nassert x == "
               "3\nCA.close()\n");
  CHECK(codes_of(folder.write("a.export",
                              "P time_limit 10\nF comm a.comm D 1\nF comm a.com1 D 1\nF comm b.py D 1\n")) == Codes{});
  CHECK(codes_of(folder.write("alone.comm", "POURSUITE()\n")) == Codes{"nothing-before"});
  CHECK(codes_of(folder.write("legacy.comm",
                              "import code_aster\nfrom code_aster.Commands import *\ncode_aster.init('--test')\n"
                              "L = DEFI_LIST_REEL(VALE=(0.0, 1.0))\ncode_aster.close()\n")) == Codes{});
}

TEST_CASE("The limits of the command line end in a diagnostic") {
  const Folder folder;
  const fs::path loop = folder.write("loop.comm", "i = 0\nwhile True:\n    i = i + 1\n");
  Limits limits;
  limits.steps = 10'000;
  CHECK(codes_of(loop, limits) == Codes{"limit-steps"});
  limits = {};
  limits.seconds = 0.05;
  CHECK(codes_of(loop, limits) == Codes{"limit-time"});
  limits = {};
  limits.memory = 64U << 20;
  CHECK(codes_of(folder.write("hoard.comm", "l = []\nwhile True:\n    l.append('x' * 100000 + str(len(l)))\n"),
                 limits) == Codes{"limit-memory"});
  limits = {};
  limits.seconds = 0.05;
  // Each file is short; together they take too long.
  folder.write("slow.comm", "x = sum(range(20000))\n");
  CHECK(codes_of(folder.write("often.comm", "for i in range(10000000):\n    INCLUDE(DONNEE='slow.comm')\n"), limits) ==
        Codes{"limit-time"});
  limits = {};
  limits.call_depth = 10;
  CHECK(codes_of(folder.write("deep.comm", "def f(n):\n    return f(n + 1)\nf(0)\n"), limits).size() == 1);
}

TEST_CASE("Each assertion of a TestCase is a verdict, held or not") {
  const Folder folder;
  const fs::path file = folder.write("claims.comm",
                                     "from code_aster import CA\ntest = CA.TestCase()\ntest.assertEqual(1 + 1, "
                                     "2)\ntest.assertEqual((1, 2), (1, 3), 'pairs')\n"
                                     "test.assertAlmostEqual(0.1 + 0.2, 0.3)\ntest.assertAlmostEqual(1.0, 1.1, "
                                     "1)\ntest.assertAlmostEqual(1.0, 1.1, delta=0.2)\n"
                                     "test.assertTrue(3 > 2)\ntest.assertIsNone(None)\ntest.assertIn(2, [1, "
                                     "2])\ntest.assertLess(3, 2)\ntest.printSummary()\n");
  StudyRun pass(open_study(file), Verbosity::quiet, {});
  pass.run();
  CHECK_FALSE(pass.diagnostics().has_errors());
  std::vector<bool> held;
  for (const Verdict& verdict : pass.context().verdicts) held.push_back(verdict.passed);
  // unittest rounds |1.0 - 1.1| = 0.1 to one decimal: that is not zero.
  CHECK(held == std::vector<bool>{true, false, true, false, true, true, true, true, false});
  CHECK(pass.context().verdicts[1].label == "assertEqual: pairs");
  CHECK(pass.context().verdicts[1].line == 4);
}

}  // namespace safety_test
