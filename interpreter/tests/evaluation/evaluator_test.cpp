#include "interpreter/evaluation/evaluator.hpp"
#include "interpreter/values/dict.hpp"

#include <catch2/catch.hpp>

#include "interpreter/tests/recording_host.hpp"

using namespace comma::interpreter;
using testing::RecordingHost;
using testing::Run;

using Findings = std::vector<std::string>;

TEST_CASE("A mistake is told once, with its code and its place", "[evaluator]") {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"MA = LIRE_MALLAGE()\nMO = AFFE_MODELE(MAILLAGE=MA)\nx = MA.f() + MA[1]\n", "unknown-command 1:6"},
      {"x = alpha + 1\ny = alpha * x\nprint(alpha, y)\n", "unknown-name 1:5"},
      {"x = alpha + 1\ntry:\n    y = alpha * x\nexcept ValueError:\n    pass\n", "unknown-name 1:5"},
      {"x = 1 / 0\ny = x + 1\n", "zero-division 1:5"},
      {"x = 'a' + 1\nif x == 3:\n    y = 1\nprint(y)\n", "type-error 1:5"},
      {"x = [1, 2]\ny = x[5]\nfor i in y:\n    z = i\nprint(z)\n", "index-error 2:5"},
      {"d = {'DX': 1}\nprint(d['DY'])\n", "key-error 2:7"},
      {"x = int('a')\n", "value-error 1:5"},
      {"x = 'a'.uper()\n", "unknown-attribute 1:5"},
      {"import maths\ny = maths.sin(1)\nz = maths.cos(1)\n", "unknown-module 2:5"},
      {"from math import sinus\nprint(sinus(1))\nprint(sinus(2))\n", "unknown-module 2:7"},
      {"from scipy.linalg import inv\nx = 2 * inv\nprint(x)\n", "unknown-module 2:9"},
      {"from scipy import *\n", "unknown-module 1:6"},
      {"import time, copy\ndef f():\n    return time.time()\nx = [f(), f()]\n", "unknown-module 3:12"},
      {"import os\nos.system('x')\n", "unknown-attribute 2:1"},
      {"f = open('x')\nf.read()\n", "not-supported 1:5"},
      {"def f(a): return a\nx = f()\nprint(x + 1)\n", "type-error 2:5"},
      {"def f(a): return a / 0\nx = f(1)\ny = f(2)\n", "zero-division 1:18"},
      {"for i in range(100):\n    x = [1][i + 1]\n    y = x\nprint(y)\n", "index-error 2:9"},
      {"i = 0\nwhile i < 10:\n    i = i + undefined\n", "unknown-name 3:13"},
      {"while True:\n    x = 1 / 0\n    if x: break\n", "zero-division 2:9"},
      {"a, b = 1, 2, 3\nprint(a, b)\n", "value-error 1:1"},
      {"assert 1 > 2, 'no'\n", "assertion-failed 1:1"},
      {"raise ValueError('bad')\n", "value-error 1:1"},
      {"x = 5\nx()\n", "type-error 2:1"},
      {"for i in 5: pass\n", "type-error 1:1"},
      {"AFFE_MODELE('x')\n", "type-error 1:1"},
      {"x = _F(A=1)\ny = x['B']\n", "key-error 2:5"},
      {"l = []\nl.append(nothing)\nprint(l[0] + 1)\n", "unknown-name 2:10"},
      {"d = {}\nd['a'] = 1 / 0\nprint(d['a'])\n", "zero-division 2:10"},
      {"def f(n): return f(n + 1)\nf(0)\n", "limit-depth 1:18"},
  };
  for (const auto& [text, expected] : cases) {
    INFO(text);
    CHECK(Run(text).findings() == Findings{expected});
  }
}

TEST_CASE("A statement that cannot be read makes one error, and hides none", "[evaluator]") {
  const std::vector<std::pair<std::string, Findings>> cases = {
      {"MA = LIRE_MAILLAGE(\nx = MA\ny = unheard\n", {"unclosed-bracket 1:19", "unknown-name 3:5"}},
      {"a, b = (1, 2]\nprint(a, b, c)\n", {"unmatched-bracket 1:13", "unknown-name 2:13"}},
      {"l = []\nl.append(1 2)\nx = l[0]\n", {"missing-comma 2:12"}},
      {"n = 0\nwhile n < 3:\n    n += = 1\n", {"syntax 3:10"}},
      {"while True:\n    x = 1\n    if x == 1 break\n", {"syntax 3:15"}},
      {"def f(n):\n    if n == 0 return 1\n    return n * f(n - 1)\nx = f(3) + 1\n", {"syntax 2:15"}},
      {"def f(n):\n    m = (n\n    return m\nx = f(3) + [1][0]\n", {"unclosed-bracket 2:9"}},
      {"from math import (gamma\nx = gamma(3)\n", {"unclosed-bracket 1:18"}},
      {"from math import *)\nx = gamma(3) + erf(1)\n", {"unmatched-bracket 1:19"}},
      {"def f(x):\ny = x + 1\nreturn y\nz = y\n", {"missing-block 1:1"}},
      {"for i in (1 2):\n    x = i\nprint(x, i)\n", {"missing-comma 1:13"}},
      {"s = {'a': 1 'b': 2}\nAFFE_MODELE(**s)\nassert [s] == [1]\n", {"missing-comma 1:13"}},
      {"x = 08\nassert [x, 1] == [8, 2]\n", {"invalid-number 1:5"}},
      {"if x\n    y = 1\nelse:\n    y = 2\n", {"missing-colon 1:5", "unknown-name 1:4"}},
  };
  for (const auto& [text, expected] : cases) {
    INFO(text);
    CHECK(Run(text).findings() == expected);
  }
}

TEST_CASE("Hints name what was meant", "[evaluator]") {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"LIRE_MALLAGE()\n", "did you mean LIRE_MAILLAGE?"},
      {"longueur = 1\nprint(longeur)\n", "did you mean longueur?"},
      {"x = 'a'.uper()\n", "did you mean upper?"},
      {"d = {'DX': 1}\nd['DXX']\n", "did you mean 'DX'?"},
      {"x = gamma(2)\n", "write 'from math import gamma' before"},
      {"def f(rayon=1): pass\nf(rayo=2)\n", "did you mean rayon?"},
      {"import numpi\nx = numpi.zeros(3)\n", "did you mean numpy?"},
  };
  for (const auto& [text, hint] : cases) {
    INFO(text);
    const Run run(text);
    REQUIRE(run.diagnostics.items().size() == 1);
    CHECK(run.diagnostics.items()[0].hint == hint);
  }
}

TEST_CASE("All errors of a file come at once, those of one call too", "[evaluator]") {
  const Run run("x = 1 / 0\nAFFE_MODELE(A=nothing, B=1 / 0, C=_F(D='a' + 1))\ny = [][0]\nprint('end')\n");
  CHECK(run.findings() ==
        Findings{"zero-division 1:5", "unknown-name 2:15", "zero-division 2:26", "type-error 2:40", "index-error 3:5"});
  CHECK(run.output == "end\n");
  REQUIRE(run.host->calls.size() == 1);
  CHECK(run.host->calls[0].arguments[0].value->is_unknown());
}

TEST_CASE("A command call reaches the host with its keywords and their places", "[evaluator]") {
  const Run run("kw = {'UNITE': 20}\nMA = LIRE_MAILLAGE(FORMAT='MED', X=_F(A=(1, 2.5)), **kw)\n");
  CHECK(run.findings().empty());
  REQUIRE(run.host->calls.size() == 1);
  const CommandCall& call = run.host->calls[0];
  CHECK(call.name == "LIRE_MAILLAGE");
  CHECK(call.span.file->position(call.span.begin).line == 2);
  REQUIRE(call.arguments.size() == 3);
  CHECK(call.arguments[0].name == "FORMAT");
  CHECK(call.arguments[0].value->as_text() == "MED");
  const std::string_view text = call.span.file->text();
  const auto part = [&](const Span& span) { return std::string(text.substr(span.begin, span.end - span.begin)); };
  CHECK(part(call.name_span) == "LIRE_MAILLAGE");
  CHECK(part(call.arguments[0].name_span) == "FORMAT");
  CHECK(part(call.arguments[0].value_span) == "'MED'");
  REQUIRE(call.arguments[1].value->is_factor());
  CHECK(part(call.arguments[1].value->as_dict().factor->span) == "_F(A=(1, 2.5))");
  CHECK(call.arguments[1].value->as_dict().find("A")->repr() == "(1, 2.5)");
  CHECK(call.arguments[2].name == "UNITE");
  CHECK(call.arguments[2].value->as_integer() == 20);
}

TEST_CASE("A concept takes the name of the first variable that it is assigned to", "[evaluator]") {
  const Run run("l = [LIRE_MAILLAGE()]\nMA = l[0]\nMB = MA\nx, MC = 1, LIRE_MAILLAGE()\n");
  CHECK(run.host->concepts[0]->name == "MA");
  CHECK(run.host->concepts[1]->name == "MC");
  CHECK(run.evaluator->global("MB")->as_concept() == run.host->concepts[0]);
}

TEST_CASE("Commands run at once inside try, and their failures are exceptions", "[evaluator]") {
  const auto attempt = [](const std::string& handler, const std::string& code) {
    auto host = std::make_unique<RecordingHost>();
    host->failure = code;
    return Run("from code_aster import CA\nimport aster\ntry:\n    R = STAT_NON_LINE()\n    print('no')\nexcept " +
                   handler + " as err:\n    print('caught', err, err.id_message)\nelse:\n    print('else')\n",
               std::move(host));
  };
  CHECK(attempt("CA.AsterError", "no-convergence").output == "caught step 3 does not converge MECANONLINE9_7\n");
  CHECK(attempt("aster.error", "contact-interpenetration").output == "caught step 3 does not converge CONTACT_93\n");
  CHECK(attempt("CA.ConvergenceError", "no-convergence").output == "caught step 3 does not converge MECANONLINE9_7\n");
  CHECK(attempt("CA.ContactError", "contact-anything").output == "caught step 3 does not converge contact-anything\n");
  CHECK(attempt("(ValueError, CA.SolverError)", "singular-matrix").output ==
        "caught step 3 does not converge FACTOR_11\n");
  const Run missed = attempt("CA.ContactError", "no-convergence");
  CHECK(missed.output.empty());
  CHECK(missed.findings() == Findings{"no-convergence 4:9"});
}

TEST_CASE("Outside try, commands wait", "[evaluator]") {
  const Run run(
      "A = LIRE_MAILLAGE()\ntry:\n    B = LIRE_MAILLAGE()\nexcept ValueError:\n    pass\nC = LIRE_MAILLAGE()\n");
  CHECK(run.host->eager == std::vector<bool>{false, true, false});
}

namespace {

/// A table with one column, for what the language can ask of a concept.
struct Table : ConceptData {
  Value subscript(const Value& key) const override { return Value(key.repr() + "!"); }
  Value call(const std::vector<Value>& arguments) const override { return Value(arguments.at(0).as_real() * 2); }
  Value method(std::string_view name, const std::vector<Value>& arguments,
               const std::map<std::string, Value>& keywords) const override {
    return Value(std::string(name) + std::to_string(arguments.size()) + std::to_string(keywords.size()));
  }
};

}  // namespace

TEST_CASE("Reading a concept runs what it depends on", "[evaluator]") {
  auto host = std::make_unique<RecordingHost>();
  host->data = std::make_shared<Table>();
  const Run run("T = DEFI_FONCTION()\nprint(T['DX', 1], T(2.5), T.EXTR(1, a=2), T.nom)\n", std::move(host));
  CHECK(run.output == "('DX', 1)! 5.0 EXTR11 T\n");
  CHECK(run.host->forced == Findings{"T", "T", "T"});
}

TEST_CASE("What a concept does not offer is told", "[evaluator]") {
  auto host = std::make_unique<RecordingHost>();
  host->data = std::make_shared<ConceptData>();
  CHECK(Run("T = DEFI_FONCTION()\nx = T['DX']\n", std::move(host)).findings() == Findings{"not-supported 2:5"});
}

TEST_CASE("A concept without data reads as unknown", "[evaluator]") {
  const Run run("T = DEFI_FONCTION()\nif T['DX'] > 1:\n    y = 1\nprint('end')\nz = y + 1\n");
  CHECK(run.findings().empty());
  CHECK(run.output == "end\n");
  CHECK(run.evaluator->global("z")->is_unknown());
}

TEST_CASE("What is not known has no text, within a list neither", "[evaluator]") {
  const Run run(
      "T = DEFI_FONCTION()\nx = [1, (T['DX'], 2)]\nprint(x)\nprint('values=' + "
      "str(x))\nprint(f'{x}')\nprint(repr(x))\nprint('end')\n");
  CHECK(run.findings().empty());
  CHECK(run.output == "end\n");
}

TEST_CASE("init and close of code_aster are the commands DEBUT and FIN", "[evaluator]") {
  const Run run(
      "import code_aster\nfrom code_aster import CA\nfrom code_aster.Commands import *\nfrom code_aster.Commands "
      "import LIRE_MAILLAGE\n"
      "code_aster.init('--test', CODE=_F(NIV='X'), debug=True)\nCA.close()\n");
  CHECK(run.findings().empty());
  REQUIRE(run.host->calls.size() == 2);
  CHECK(run.host->calls[0].name == "DEBUT");
  CHECK(run.host->calls[0].arguments.size() == 1);
  CHECK(run.host->calls[0].span.file != nullptr);
  CHECK(run.host->calls[1].name == "FIN");
}

namespace {

/// A concept with one method, and how it is asked for.
struct Counted : ConceptData {
  Value method(std::string_view name, const std::vector<Value>& arguments,
               const std::map<std::string, Value>& keywords) const override {
    return name == "size" ? Value(3) : ConceptData::method(name, arguments, keywords);
  }
  std::vector<std::string> method_names() const override { return {"size"}; }
};

/// Keeps what the file's own claims came to; `solves` as in a run, not a check.
struct JudgingHost : RecordingHost {
  bool solves = true;
  std::vector<std::string> verdicts;
  bool runs_calls() const override { return solves; }
  void judge(const Assertion& claim) override {
    verdicts.push_back(claim.method + (claim.holds ? " holds" : " fails: " + claim.message));
  }
};

std::vector<std::string> verdicts_of(const std::string& text, bool solves = true) {
  auto host = std::make_unique<JudgingHost>();
  JudgingHost& judge = *host;
  judge.solves = solves;
  judge.failure = "no-convergence";
  const Run run(
      "from code_aster import CA\ntest = CA.TestCase()\ndef fail(what='x', key=None):\n    raise ValueError('bad ' + "
      "what)\n" +
          text,
      std::move(host));
  std::vector<std::string> verdicts = judge.verdicts;
  for (const std::string& finding : run.findings()) verdicts.push_back(finding);
  return verdicts;
}

}  // namespace

TEST_CASE("Modules of older files bring _F, and messages that comma has no words for") {
  const Run run(
      "from Accas import _F\nfrom Utilitai.Utmess import UTMESS, MasquerAlarme, RetablirAlarme\n"
      "print(_F(A=1)['A'])\nMasquerAlarme('CALCULEL_2')\nUTMESS('I', 'TEST0_1', valk='a')\n"
      "try:\n    UTMESS('F', 'TEST0_2')\nexcept Exception as error:\n    print(error)\n");
  CHECK(run.output == "1\n<I> <TEST0_1>\nUTMESS <F> <TEST0_2>\n");
  CHECK(run.diagnostics.items().empty());
}

TEST_CASE("hasattr of a concept asks what it has, and does not know while it is not there", "[evaluator]") {
  auto host = std::make_unique<RecordingHost>();
  host->data = std::make_shared<Counted>();
  const Run run(
      "T = DEFI_FONCTION()\nprint(hasattr(T, 'size'), hasattr(T, 'sise'), hasattr(T, 'nom'), hasattr(T, 'getName'), "
      "T.getName(), T.userName, getattr(T, 'sise', 0), getattr(T, 'size')())\n",
      std::move(host));
  CHECK(run.output == "True False True True T T 0 3\n");
  CHECK(run.findings().empty());
  const Run unknown(
      "T = DEFI_FONCTION()\nif hasattr(T, 'size'):\n    x = 1\nelse:\n    x = 2\nprint(T.getName())\nprint(x)\n");
  CHECK(unknown.output == "T\n");
  CHECK(unknown.findings().empty());
}

TEST_CASE("What a block or a call has to raise is a claim as others are", "[evaluator]") {
  CHECK(verdicts_of("with test.assertRaises(ValueError):\n    fail()\n") == Findings{"assertRaises holds"});
  CHECK(verdicts_of("with test.assertRaises((KeyError, LookupError)) as caught:\n    "
                    "[][1]\ntest.assertEqual(str(caught.exception), 'list index out of range')\n") ==
        Findings{"assertRaises holds", "assertEqual holds"});
  CHECK(verdicts_of("with test.assertRaises(ValueError):\n    x = 1\n") ==
        Findings{"assertRaises fails: ValueError not raised"});
  CHECK(verdicts_of("with test.assertRaises(KeyError):\n    fail()\n") == Findings{"value-error 4:5"});
  CHECK(verdicts_of("with test.assertRaisesRegex(ValueError, 'b.d [xy]$'):\n    fail()\n") ==
        Findings{"assertRaisesRegex holds"});
  CHECK(verdicts_of("with test.assertRaisesRegex(ValueError, 'good'):\n    fail()\n") ==
        Findings{"assertRaisesRegex fails: 'bad x' does not hold 'good'"});
  CHECK(verdicts_of("test.assertRaises(ValueError, fail, 'y', key=2)\ntest.assertRaisesRegex(ValueError, '^bad', "
                    "fail)\ntest.assertRaises(ZeroDivisionError, lambda: 0)\n") ==
        Findings{"assertRaises holds", "assertRaisesRegex holds", "assertRaises fails: ZeroDivisionError not raised"});
  CHECK(verdicts_of(
            "def f():\n    with test.assertRaises(CA.AsterError):\n        STAT_NON_LINE()\n    return 1\nx = f()\n") ==
        Findings{"assertRaises holds"});
  CHECK(verdicts_of("test.assertIsInstance(1, (int, str))\ntest.assertNotIsInstance('a', "
                    "int)\ntest.assertIsInstance(1.5, int)\n") ==
        Findings{"assertIsInstance holds", "assertNotIsInstance holds", "assertIsInstance fails: "});
  CHECK(verdicts_of("with 3:\n    x = 1\n") == Findings{"not-supported 5:1"});
  CHECK(verdicts_of("with open('x') as f:\n    y = f.read()\nz = y\n") == Findings{"not-supported 5:6"});
}

TEST_CASE("A check does not say that nothing was raised by what it does not run", "[evaluator]") {
  CHECK(verdicts_of("with test.assertRaises(CA.AsterError):\n    x = 1\n", false).empty());
  CHECK(verdicts_of("with test.assertRaises(ValueError):\n    fail()\n", false) == Findings{"assertRaises holds"});
}

TEST_CASE("A check does not know whether a handler has bound what it would", "[evaluator]") {
  const auto findings = [](const std::string& inside) {
    auto host = std::make_unique<JudgingHost>();
    host->solves = false;
    return Run("told = ''\ntry:\n    " + inside + "\nexcept Exception as error:\n    told = str(error)\nassert told\n",
               std::move(host))
        .findings();
  };
  CHECK(findings("STAT_NON_LINE()").empty());
  CHECK(findings("x = 1") == Findings{"assertion-failed 6:1"});
}

TEST_CASE("Variables stay from one file to the next", "[evaluator]") {
  RecordingHost host;
  Diagnostics diagnostics;
  std::string output;
  Evaluator evaluator(host, diagnostics, [&](std::string_view text) { output += text; });
  {
    const Ast first = parse(
        std::make_shared<const SourceFile>("a.comm", "def f(x): return x + k\nk = 1\ng = (i for i in range(3))\n"),
        diagnostics);
    evaluator.run(first);
  }
  const Ast second = parse(std::make_shared<const SourceFile>("a.com1", "print(f(2), list(g))\n"), diagnostics);
  evaluator.run(second);
  // The generator's text is gone with the first file.
  CHECK(output == "3 []\n");
  CHECK(diagnostics.items().empty());
}

TEST_CASE("_F(...) is a dict: it can be looked through, changed and extended before a command reads it",
          "[evaluator]") {
  const Run run(
      "f = _F(GROUP_MA='TOP', PRES=1.0)\n"
      "f['PRES'] = 2.0\n"
      "f.update(NIVE=3)\n"
      "print(isinstance(f, dict), isinstance(f, _F), isinstance({}, _F), f.get('PRES'), list(f), len(f), 'NIVE' in f, "
      "f == {'GROUP_MA': 'TOP', 'PRES': 2.0, 'NIVE': 3})\n"
      "g = _F(f, PRES=4.0)\n"
      "del g['NIVE']\n"
      "print(f, g, dict(g), {**g, 'X': 1}, [k for k, v in g.items() if v == 4.0])\n"
      "AFFE_MODELE(AFFE=g)\n");
  CHECK(run.output ==
        "True True False 2.0 ['GROUP_MA', 'PRES', 'NIVE'] 3 True True\n"
        "_F(GROUP_MA='TOP', PRES=2.0, NIVE=3) _F(GROUP_MA='TOP', PRES=4.0) {'GROUP_MA': 'TOP', 'PRES': 4.0} "
        "{'GROUP_MA': 'TOP', 'PRES': 4.0, 'X': 1} ['PRES']\n");
  CHECK(run.host->calls.back().arguments[0].value->repr() == "_F(GROUP_MA='TOP', PRES=4.0)");
}

TEST_CASE("sys.exit with a status or a text ends the file with an error", "[evaluator]") {
  const auto [text, message] = GENERATE(table<std::string, std::string>(
      {{"3", "the file ends itself with status 3"}, {"'too stiff'", "the file ends itself: too stiff"}}));
  for (const std::string& way :
       {"import sys\nsys.exit(" + text + ")\n",
        "def f():\n  raise SystemExit(" + text + ")\ntry:\n  f()\nexcept Exception:\n  pass\n"}) {
    const Run run(way + "print(2)\n");
    REQUIRE(run.evaluator->failed_exit());
    CHECK(run.evaluator->failed_exit()->message == message);
    CHECK(run.output.empty());
  }
}

TEST_CASE("sys.exit ends the file without error", "[evaluator]") {
  const Run run("import sys\nprint(1)\ndef f(): sys.exit(0)\nf()\nprint(2)\n");
  CHECK(run.output == "1\n");
  CHECK(run.findings().empty());
}

TEST_CASE("The usual part of math needs no import", "[evaluator]") {
  CHECK(Run("print(sqrt(4), pi > 3)\n").output == "2.0 True\n");
  CHECK(Run("sqrt = 5\nprint(sqrt)\n").output == "5\n");
}

namespace {

/// LIRE_MAILLAGE runs another file, as INCLUDE does.
struct IncludingHost : RecordingHost {
  Evaluator* evaluator = nullptr;
  Diagnostics* diagnostics = nullptr;
  std::string text;
  Value call(const CommandCall& call, bool run_now) override {
    if (call.name != "LIRE_MAILLAGE") return RecordingHost::call(call, run_now);
    const Ast included = parse(std::make_shared<const SourceFile>("included.comm", text), *diagnostics);
    evaluator->run(included);
    return {};
  }
};

}  // namespace

TEST_CASE("A command may run another file in the middle of this one", "[evaluator]") {
  IncludingHost host;
  Diagnostics diagnostics;
  std::string output;
  Evaluator evaluator(host, diagnostics, [&](std::string_view text) { output += text; });
  host.evaluator = &evaluator;
  host.diagnostics = &diagnostics;
  host.text = "inner = outer + 1\nbad = 1 / 0\nprint('included', inner)\n";
  const Ast ast = parse(std::make_shared<const SourceFile>("main.comm",
                                                           "outer = 1\ndef f():\n    local = 5\n    LIRE_MAILLAGE()\n"
                                                           "    return local\nprint(f(), inner)\nx = [][1]\n"),
                        diagnostics);
  evaluator.run(ast);
  CHECK(output == "included 2\n5 2\n");
  REQUIRE(diagnostics.items().size() == 2);
  CHECK(diagnostics.items()[0].span.file->path() == "included.comm");
  CHECK(diagnostics.items()[1].span.file->path() == "main.comm");
}

TEST_CASE("Chains of objects may be longer than the stack is deep", "[evaluator]") {
  const std::string many = "for i in range(200000):\n    ";
  const std::vector<std::pair<std::string, Findings>> cases = {
      {"f = lambda: 1\n" + many + "f = (lambda g: lambda: g())(f)\nf = 0\n", {}},
      {"f = lambda: 1\n" + many + "f = lambda g=f: g()\nf = 0\n", {}},
      {"e = ValueError(1)\n" + many + "e = ValueError(e)\nx = repr(e)\ny = str(e)\ne = 0\n", {}},
      {"g = (i for i in [1])\n" + many + "g = (i for i in g)\ng = 0\n", {}},
      {"g = (i for i in [1])\n" + many + "g = (i for i in g)\nx = list(g)\n", {"limit-depth 4:5"}},
      {"x = ('a' * 1000000).join(['b'] * 1000000)\n", {"limit-memory 1:6"}},
  };
  for (const auto& [text, expected] : cases) {
    INFO(text);
    CHECK(Run(text).findings() == expected);
  }
}
