// What IMPR_TABLE and IMPR_FONCTION write, to the blank as Code_Aster 17.3 does.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "commands/cli/study_run.hpp"

namespace printed_tables_test {

namespace fs = std::filesystem;
using namespace comma::commands;

/// What statements write into unit 38, without the lines of dashes.
std::string printed(const std::string& statements) {
  const fs::path folder = fs::temp_directory_path() / ("comma_printed_" + std::to_string(getpid()));
  fs::create_directories(folder);
  const fs::path written = folder / "table.txt";
  std::ofstream(folder / "printed.comm") << "DEBUT()\nDEFI_FICHIER(UNITE=38, FICHIER='table.txt')\n"
                                         << statements << "\nFIN()\n";
  // Commands write into the current folder.
  const fs::path before = fs::current_path();
  fs::current_path(folder);
  StudyRun pass(open_study(folder / "printed.comm"), Verbosity::quiet, {});
  pass.run();
  fs::current_path(before);
  for (const auto& item : pass.diagnostics().items()) FAIL_CHECK(comma::interpreter::render(item));
  std::ifstream file(written);
  std::ostringstream text;
  for (std::string line; std::getline(file, line);)
    if (line != "#" && !line.starts_with("#-----")) text << line << "\n";
  file.close();
  fs::remove_all(folder);
  return text.str();
}

const char* const table =
    "T = CREA_TABLE(TITRE='own', LISTE=(_F(PARA='N', LISTE_K=('b', 'a', 'b')), _F(PARA='I', LISTE_I=(3, 1, 2)), "
    "_F(PARA='X', LISTE_R=(1.5, -2.0), NUME_LIGN=(1, 3))))\n";

TEST_CASE("IMPR_TABLE tells what filters have left, without what is empty in all of it") {
  CHECK(printed(std::string(table) + "IMPR_TABLE(TABLE=T, UNITE=38, FILTRE=_F(NOM_PARA='I', VALE_I=1))") ==
        "##own\n"
        "#FILTRE -> NOM_PARA: I                CRIT_COMP: EQ   VALE: [1]\n"
        "N        I           \n"
        "a                   1\n"
        "\n");
}

TEST_CASE("IMPR_TABLE has a page for each value, rising, and a crossed table its rows and columns") {
  CHECK(printed(std::string(table) + "IMPR_TABLE(TABLE=T, UNITE=38, PAGINATION='N')") ==
        "##own\n#N: a\nI           \n           1\n\n"
        "##own\n#N: b\nI            X           \n           3  1.50000E+00\n           2 -2.00000E+00\n\n");
  std::string filled = table;
  filled.replace(filled.find("(1.5, -2.0), NUME_LIGN=(1, 3)"), 29, "(1.5, 4.0, -2.0)");
  CHECK(printed(filled + "IMPR_TABLE(TABLE=T, UNITE=38, FORMAT='TABLEAU_CROISE', NOM_PARA=('N', 'I', 'X'))") ==
        "##own\n#X FONCTION DE I ET N\n"
        "I/N          a            b           \n"
        "           1  4.00000E+00 -           \n"
        "           2 -            -2.00000E+00\n"
        "           3 -             1.50000E+00\n"
        "\n");
}

TEST_CASE("IMPR_FONCTION names its columns after parameter and results") {
  const std::string curves =
      "F = DEFI_FONCTION(NOM_PARA='X', NOM_RESU='LONG_RESULT', VALE=(1.0, 2.0, 2.0, 3.0))\n"
      "G = DEFI_FONCTION(NOM_PARA='X', VALE=(0.0, 1.0, 4.0, 9.0))\n"
      "S = DEFI_NAPPE(NOM_PARA='Y', PARA=(0.25, 1.0), FONCTION=(G, G))\n";
  CHECK(printed(curves + "IMPR_FONCTION(UNITE=38, TITRE='own', COURBE=(_F(FONCTION=F), _F(FONCTION=S)))") ==
        "### own\n## \n## Courbe 0\n## F\n## Courbe 1\n## S Y=0.25\n## Courbe 2\n## S Y=1\n"
        "X            LONG_RES_0   TOUTRESU_1   TOUTRESU_2  \n"
        " 1.00000E+00  2.00000E+00  3.00000E+00  3.00000E+00\n"
        " 2.00000E+00  3.00000E+00  5.00000E+00  5.00000E+00\n"
        "\n");
  CHECK(printed(curves + "IMPR_FONCTION(UNITE=38, COURBE=_F(FONC_X=G, FONC_Y=F, LIST_PARA=DEFI_LIST_REEL(VALE=(1.0, "
                         "2.0))))") ==
        "### \n## \n## Courbe 0\n## G\n"
        "X            TOUTRESU_0   LONG_RES_1  \n"
        " 1.00000E+00  3.00000E+00  2.00000E+00\n"
        " 2.00000E+00  5.00000E+00  3.00000E+00\n"
        "\n");
}

}  // namespace printed_tables_test
