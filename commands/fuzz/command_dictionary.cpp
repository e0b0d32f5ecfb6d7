// Writes libFuzzer's dictionary for command files: the words of the language, and the commands, keywords and allowed
// words of the catalogue.
#include <cctype>
#include <cstdio>
#include <set>
#include <string>

#include "commands/catalogue.hpp"
#include "interpreter/values/repr.hpp"

using namespace comma::interpreter;

namespace {

using Words = std::set<std::string>;

void collect(const LevelPage& level, Words& words);

void collect(const KeywordPage& keyword, Words& words) {
  words.insert(keyword.name + "=");
  for (const WordPage& word : keyword.words) words.insert(repr_of(word.value));
  collect(keyword.inside, words);
}

void collect(const LevelPage& level, Words& words) {
  for (const KeywordPage& keyword : level.keywords) collect(keyword, words);
  for (const BlockPage& block : level.blocks) collect(block.inside, words);
}

/// In quotes, with what is not a plain letter as a hexadecimal escape.
std::string quoted(const std::string& word) {
  std::string text = "\"";
  for (const char c : word) {
    const auto byte = static_cast<unsigned char>(c);
    char escape[5];
    std::snprintf(escape, sizeof escape, "\\x%02X", byte);
    if (std::isprint(byte) && c != '"' && c != '\\')
      text += c;
    else
      text += escape;
  }
  return text + '"';
}

}  // namespace

int main() {
  Words words = {"and ",      "as ",     "assert ", "break",   "class ",   "continue", "def f(x):", "del ",
                 "elif ",     "else:",   "except:", "f'{x}'",  "finally:", "for ",     "from ",     "global ",
                 "if ",       "import ", " in ",    " is ",    "lambda ",  "None",     "nonlocal ", "not ",
                 " or ",      "pass",    "raise ",  "return ", "True",     "try:",     "while ",    "with ",
                 "yield ",    "**",      "//",      "<<",      ">>",       "!=",       "<=",        ">=",
                 "+=",        "'''",     "_F(",     "range(",  "numpy",    "math",     ".format(",  "%",
                 "{:>10.3e}", "1e308",   "-1",      "[::-1]",  "\n    ",   "\n",       "j"};
  const Catalogue catalogue(comma::commands::catalogue_blobs());
  for (const std::string& name : catalogue.names()) {
    words.insert(name + "(");
    collect(catalogue.page(name).inside, words);
  }
  for (const std::string& word : words) std::printf("%s\n", quoted(word).c_str());
  return 0;
}
