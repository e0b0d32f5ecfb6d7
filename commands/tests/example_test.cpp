// Every page of the catalogue shows an example; each of them is checked here, behind a prelude that makes the concepts
// it takes for granted, and run where comma supports the command.
#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <map>

#include "commands/catalogue.hpp"
#include "commands/cli/study_run.hpp"
#include "interpreter/catalogue/explain.hpp"

namespace fs = std::filesystem;
using namespace comma::commands;
using comma::interpreter::Catalogue;
using comma::interpreter::Severity;

namespace {

const fs::path source = COMMA_SOURCE_DIR;
const fs::path folder = source / "commands/tests/examples";

// What only one example needs, because another page uses the same name for something else.
const std::map<std::string, std::string> more = {
    {"CREA_RESU",
     "COLD = CREA_CHAMP(OPERATION='AFFE', TYPE_CHAM='NOEU_TEMP_R', MAILLAGE=MA, AFFE=_F(TOUT='OUI', NOM_CMP='TEMP', "
     "VALE=0.0))\n"
     "HOT = CREA_CHAMP(OPERATION='AFFE', TYPE_CHAM='NOEU_TEMP_R', MAILLAGE=MA, AFFE=_F(TOUT='OUI', NOM_CMP='TEMP', "
     "VALE=9.0))\n"},
    {"POST_CHAMP",
     "SLABS = AFFE_MODELE(MAILLAGE=MA, AFFE=_F(GROUP_MA='BODY', PHENOMENE='MECANIQUE', MODELISATION='DKT'))\n"
     "THICK = AFFE_CARA_ELEM(MODELE=SLABS, COQUE=_F(GROUP_MA='BODY', EPAIS=0.1, EXCENTREMENT=0.05))\n"
     "STILL = AFFE_CHAR_MECA(MODELE=SLABS, DDL_IMPO=_F(GROUP_MA='BODY', DX=0.0, DY=0.0, DZ=0.0, DRX=0.01))\n"
     "BENT = MECA_STATIQUE(MODELE=SLABS, CHAM_MATER=MF, CARA_ELEM=THICK, EXCIT=_F(CHARGE=STILL))\n"
     "BENT = CALC_CHAMP(reuse=BENT, RESULTAT=BENT, CONTRAINTE='EFGE_ELNO')\n"},
    {"LIRE_TABLE",
     "SQUARES = CREA_TABLE(LISTE=(_F(PARA='X', LISTE_R=(1.0, 2.0)), _F(PARA='Y', LISTE_R=(1.0, 4.0))))\n"
     "IMPR_TABLE(TABLE=SQUARES, UNITE=38, SEPARATEUR=';')\n"},
    {"LIRE_FONCTION",
     "POWERS = CREA_TABLE(LISTE=[_F(PARA='P%d' % n, LISTE_R=(1.0, 2.0**n)) for n in (1, 2, 3)])\n"
     "IMPR_TABLE(TABLE=POWERS, UNITE=39)\n"},
    {"DEFI_NAPPE", "COLD = DEFI_FONCTION(NOM_PARA='EPSI', VALE=(0.001, 2.0e8, 0.1, 3.0e8))\nHOT = COLD\n"},
};

// A folder for one example: what it writes goes there.
class Workplace {
 public:
  Workplace()
      : before_(fs::current_path()),
        folder_(fs::temp_directory_path() / ("comma-example-" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
    fs::current_path(folder_);
  }
  ~Workplace() {
    fs::current_path(before_);
    fs::remove_all(folder_);
  }
  Workplace(const Workplace&) = delete;
  Workplace& operator=(const Workplace&) = delete;
  const fs::path& folder() const { return folder_; }

 private:
  fs::path before_, folder_;
};

// The errors of the prelude and, behind it, the example.
std::vector<std::string> errors_of(const std::string& command, const std::string& example, bool check_only) {
  const Workplace place;
  const fs::path& work = place.folder();
  const fs::path file = work / (command + ".comm");
  const auto extra = more.find(command);
  std::ofstream(file) << (extra == more.end() ? "" : extra->second) << example << "\n";
  std::ofstream(work / "included.comm") << "YOUNG = 2.1e11\n";
  const std::vector<ExportFile> files = {{"mmed", source / "testcases/zzzz237/zzzz237.mmed", true, false, 20},
                                         {"mail", folder / "plate.mail", true, false, 21},
                                         {"comm", work / "included.comm", true, false, 91}};
  StudyRun pass(Study{{folder / "prelude.comm", file}, files}, Verbosity::quiet,
                {.check_only = check_only, .only_tests = false});
  pass.run();
  std::vector<std::string> errors;
  for (const auto& item : pass.diagnostics().items()) {
    if (item.severity == Severity::error) errors.push_back(render(item));
  }
  return errors;
}

}  // namespace

TEST_CASE("The example of every page is sound") {
  const Catalogue catalogue(catalogue_blobs());
  for (const std::string& command : catalogue.names()) {
    const std::string& example = catalogue.page(command).example;
    CAPTURE(command, example);
    CHECK(example.find(command + "(") != std::string::npos);
    CHECK(errors_of(command, example, true) == std::vector<std::string>{});
  }
}

TEST_CASE("The example of every supported command runs") {
  const Catalogue catalogue(catalogue_blobs());
  for (const std::string& command : catalogue.names()) {
    const auto& page = catalogue.page(command);
    if (!page.supported) continue;
    CAPTURE(command, page.example);
    CHECK(errors_of(command, page.example, false) == std::vector<std::string>{});
  }
}

TEST_CASE("The list of commands has every command once, under what one does with it") {
  const Catalogue catalogue(catalogue_blobs());
  const std::string list = comma::interpreter::explain_all(catalogue);
  for (const std::string& command : catalogue.names()) {
    CAPTURE(command);
    CHECK(list.find("  " + command + " ") != std::string::npos);
    CHECK_FALSE(catalogue.page(command).category.empty());
  }
  std::size_t before = 0;
  for (const char* category : {"mesh", "model", "material", "loads", "contact", "solve", "post-process", "verify"}) {
    CAPTURE(category);
    const std::size_t at = list.find(std::string("\n") + category + "\n", before);
    const bool first = before == 0 && list.starts_with(std::string(category) + "\n");
    CHECK((first || at != std::string::npos));
    before = first ? 0 : at;
  }
}
