#include "interpreter/graph/session.hpp"

#include <catch2/catch.hpp>

#include "interpreter/tests/little_catalogue.hpp"

using namespace comma::interpreter;
using namespace comma::interpreter::tests;

namespace {

struct Data : ConceptData {
  int changes = 0;
};

/// A session whose commands note that they ran; SOLVE fails where it is told to.
struct World {
  explicit World(SessionOptions options = {}) : session(*little.catalogue, commands, diagnostics, options) {
    for (const std::string& name : little.catalogue->names())
      commands[name] = [this](const Call& call) { return run(call); };
  }

  std::shared_ptr<ConceptData> run(const Call& call) {
    log.push_back(call.command + (call.result ? " " + call.result->name : ""));
    if (call.result && call.result->name == failing) {
      if (leaves_data) call.result->data = std::make_shared<Data>();
      throw DiagnosticError("no-convergence", "step 3 does not converge");
    }
    if (call.command == "SHIFT") {
      ++data_of<Data>(call.result).changes;
      return nullptr;
    }
    return call.result ? std::make_shared<Data>() : nullptr;
  }

  Value call(const std::string& name, const Arguments& arguments, const std::string& variable = "",
             bool eager = false) {
    const Value value = session.call(written_call(name, arguments), eager);
    if (value.is_concept() && !variable.empty()) value.as_concept()->name = variable;
    return value;
  }

  std::vector<std::string> codes() const {
    std::vector<std::string> all;
    for (const Diagnostic& found : diagnostics.items()) all.push_back(found.code);
    return all;
  }

  NodeState state(int id) const { return session.graph().nodes()[static_cast<std::size_t>(id)].state; }

  LittleCatalogue little = little_catalogue();
  Diagnostics diagnostics;
  CommandTable commands;
  std::vector<std::string> log;
  std::string failing;
  bool leaves_data = false;
  Session session;
};

using Log = std::vector<std::string>;

}  // namespace

TEST_CASE("Nothing runs before the whole file is known to be right") {
  World world;
  const Value mesh = world.call("MESH", {}, "MA");
  const Value model = world.call("MODEL", {{"MESH", mesh}}, "MO");
  world.call("VERIFY", {{"WHAT", model}});
  CHECK(world.log.empty());
  world.session.finish();
  CHECK(world.log == Log{"MESH MA", "MODEL MO", "VERIFY"});
  CHECK(world.state(2) == NodeState::done);
}

TEST_CASE("A change in place keeps the concept and its data") {
  World world;
  const Value mesh = world.call("MESH", {}, "MA");
  const Value same = world.call("SHIFT", {{"reuse", mesh}, {"MESH", mesh}});
  CHECK(same.as_concept() == mesh.as_concept());
  world.session.finish();
  CHECK(data_of<Data>(mesh.as_concept()).changes == 1);
}

TEST_CASE("An error anywhere keeps the file from being solved, but what is cheap is still looked at") {
  World world;
  const Value mesh = world.call("MESH", {}, "MA");
  const Value model = world.call("MODEL", {{"MESH", mesh}}, "MO");
  world.call("SOLVE", {{"MODEL", model}}, "R");
  const Value wrong = world.call("MODDEL", {{"MESH", mesh}});
  CHECK(wrong.is_unknown());
  world.session.finish();
  CHECK(world.log == Log{"MESH MA", "MODEL MO"});
  REQUIRE(world.diagnostics.items().size() == 1);
  CHECK(world.diagnostics.items()[0].code == "unknown-command");
  CHECK(world.diagnostics.items()[0].hint == "did you mean MODEL?");
}

TEST_CASE("A command of Code_Aster that is not there is told as such, with what there is instead") {
  World world;
  const Value section = world.call("MACR_CARA_POUTRE", {});
  CHECK(section.is_unknown());
  REQUIRE(world.diagnostics.items().size() == 1);
  const Diagnostic& told = world.diagnostics.items()[0];
  CHECK(told.severity == Severity::error);
  CHECK(told.code == "unsupported");
  CHECK(told.message == "comma does not have Code_Aster's command MACR_CARA_POUTRE");
  CHECK(told.hint.starts_with("AFFE_CARA_ELEM takes"));
}

TEST_CASE("An error that a cheap command finds keeps the rest from being solved") {
  World world;
  world.failing = "MO";
  const Value mesh = world.call("MESH", {}, "MA");
  const Value model = world.call("MODEL", {{"MESH", mesh}}, "MO");
  world.call("SOLVE", {{"MODEL", model}}, "R");
  world.session.finish();
  CHECK(world.log == Log{"MESH MA", "MODEL MO"});
  CHECK(world.codes() == Log{"no-convergence"});
}

TEST_CASE("What is built on something wrong is not wrong itself, and does not run") {
  World world;
  const Value mesh = world.call("MESH", {{"UNITE", Value(20)}}, "MA");
  const Value model = world.call("MODEL", {{"MESH", mesh}}, "MO");
  CHECK(model.is_concept());
  world.session.finish();
  CHECK(world.log.empty());
  CHECK(world.codes() == Log{"unknown-keyword"});
}

TEST_CASE("A check runs what is cheap and solves, prints and verifies nothing") {
  World world({.check_only = true});
  const Value mesh = world.call("MESH", {}, "MA");
  const Value model = world.call("MODEL", {{"MESH", mesh}}, "MO");
  const Value result = world.call("SOLVE", {{"MODEL", model}}, "R");
  world.call("PRINT", {{"WHAT", mesh}});
  world.call("VERIFY", {{"WHAT", mesh}});
  world.session.force(result.as_concept());
  world.session.finish();
  CHECK(world.log == Log{"MESH MA", "MODEL MO"});
  CHECK(result.as_concept()->data == nullptr);
}

TEST_CASE(
    "Calls that solve are prepared before the first of them runs, unless they wait for one that solves, or the file "
    "catches what goes wrong") {
  const bool check_only = GENERATE(true, false);
  World world({.check_only = check_only});
  CommandTable preparations;
  preparations["SOLVE"] = [&](const Call& call) -> std::shared_ptr<ConceptData> {
    world.log.push_back("prepare " + call.result->name);
    throw DiagnosticError(call.result->name == "R1" ? "unsupported" : "contradictory-conditions", "");
  };
  world.session.prepare_with(preparations);
  const Value mesh = world.call("MESH", {}, "MA");
  const Value model = world.call("MODEL", {{"MESH", mesh}}, "MO");
  world.call("SOLVE", {{"MODEL", model}}, "R1");
  world.call("SOLVE", {{"MODEL", model}}, "R2");
  if (check_only) world.call("SOLVE", {{"MODEL", model}}, "R3", true);
  world.session.finish();
  CHECK(world.log == Log{"MESH MA", "MODEL MO", "prepare R1", "prepare R2"});
  REQUIRE(world.codes() == Log{"unsupported", "contradictory-conditions"});
  CHECK((world.diagnostics.items()[0].severity == Severity::alarm) == check_only);
}

TEST_CASE("A call that solves alone tells its errors itself") {
  World world;
  CommandTable preparations;
  preparations["SOLVE"] = [&](const Call&) -> std::shared_ptr<ConceptData> {
    world.log.emplace_back("prepare");
    return nullptr;
  };
  world.session.prepare_with(preparations);
  world.call("SOLVE", {{"MODEL", world.call("MODEL", {{"MESH", world.call("MESH", {}, "MA")}}, "MO")}}, "R");
  world.session.finish();
  CHECK(world.log == Log{"MESH MA", "MODEL MO", "SOLVE R"});
}

TEST_CASE("Where nothing is solved, a cheap change in place need not wait for the solve that reads the old state") {
  World world({.check_only = true});
  const Value mesh = world.call("MESH", {}, "MA");
  const Value model = world.call("MODEL", {{"MESH", mesh}}, "MO");
  world.call("SOLVE", {{"MODEL", model}}, "R");
  world.call("SHIFT", {{"reuse", mesh}, {"MESH", mesh}});
  world.session.finish();
  CHECK(world.log == Log{"MESH MA", "MODEL MO", "SHIFT MA"});
}

TEST_CASE("Forcing a concept runs what it depends on, once, and nothing else") {
  World world;
  const Value mesh = world.call("MESH", {}, "MA");
  const Value other = world.call("MESH", {}, "MB");
  const Value model = world.call("MODEL", {{"MESH", mesh}}, "MO");
  const Value result = world.call("SOLVE", {{"MODEL", model}}, "R");
  const Value table = world.call("TABLE", {{"RESULT", result}}, "T");
  world.session.force(table.as_concept());
  CHECK(world.log == Log{"MESH MA", "MODEL MO", "SOLVE R", "TABLE T"});
  CHECK(table.as_concept()->data != nullptr);
  world.session.force(table.as_concept());
  world.session.finish();
  CHECK(world.log == Log{"MESH MA", "MODEL MO", "SOLVE R", "TABLE T", "MESH MB"});
}

TEST_CASE(
    "A call outside of try that fails when it is forced is told once and not thrown; what depends on it does not run") {
  World world;
  world.failing = "R";
  const bool later_try = GENERATE(false, true);
  const Value mesh = world.call("MESH", {}, "MA");
  const Value model = world.call("MODEL", {{"MESH", mesh}}, "MO");
  const Value result = world.call("SOLVE", {{"MODEL", model}}, "R");
  CHECK_FALSE(world.session.force(result.as_concept()));
  CHECK_FALSE(world.session.force(result.as_concept()));
  CHECK_NOTHROW(world.call("VERIFY", {{"WHAT", result}}, "", later_try));
  world.session.finish();
  CHECK(world.log == Log{"MESH MA", "MODEL MO", "SOLVE R"});
  CHECK(world.codes() == Log{"no-convergence"});
  CHECK(world.state(3) == NodeState::waiting);
}

TEST_CASE("The rest of the file is looked at once before a solution that it asks for while it is read") {
  World world;
  world.session.look_ahead_with([&] { world.log.emplace_back("look"); });
  const Value mesh = world.call("MESH", {}, "MA");
  CHECK(world.session.force(mesh.as_concept()));
  const Value model = world.call("MODEL", {{"MESH", mesh}}, "MO");
  for (const char* name : {"R1", "R2"}) world.session.force(world.call("SOLVE", {{"MODEL", model}}, name).as_concept());
  world.call("SOLVE", {{"MODEL", model}}, "R3");
  world.session.finish();
  CHECK(world.log == Log{"MESH MA", "MODEL MO", "look", "SOLVE R1", "SOLVE R2", "SOLVE R3"});
}

TEST_CASE("What stands before an error is written and judged where the file has asked for what is solved") {
  const bool solving_fails = GENERATE(true, false);
  World world;
  const Value mesh = world.call("MESH", {}, "MA");
  const Value model = world.call("MODEL", {{"MESH", mesh}}, "MO");
  const Value first = world.call("SOLVE", {{"MODEL", model}}, "R1");
  world.call("VERIFY", {{"WHAT", first}});
  world.session.force(first.as_concept());
  world.call("SOLVE", {{"MODEL", model}}, "R2");
  if (solving_fails) {
    world.failing = "R3";
    const Value third = world.call("SOLVE", {{"MODEL", model}}, "R3");
    CHECK_FALSE(world.session.force(third.as_concept()));
  } else {
    world.diagnostics.error("unknown-keyword", "there is no such keyword", {});
  }
  world.call("VERIFY", {{"WHAT", first}});
  world.session.finish();
  CHECK(world.log == (solving_fails ? Log{"MESH MA", "MODEL MO", "SOLVE R1", "SOLVE R3", "VERIFY", "SOLVE R2"}
                                    : Log{"MESH MA", "MODEL MO", "SOLVE R1", "VERIFY"}));
}

TEST_CASE("What the file prints stands among what its commands say, in the order of the file") {
  World world;
  world.session.set_output([&](std::string_view text) { world.log.emplace_back(text); });
  world.session.print("start");
  const Value mesh = world.call("MESH", {}, "MA");
  const Value model = world.call("MODEL", {{"MESH", mesh}}, "MO");
  world.session.print("first");
  CHECK(world.log == Log{"start", "first"});
  const Value first = world.call("SOLVE", {{"MODEL", model}}, "R1");
  world.session.print("second, ");
  world.session.print("and more");
  const Value second = world.call("SOLVE", {{"MODEL", model}}, "R2");
  world.session.print("last");
  CHECK(world.log == Log{"start", "first"});
  const bool reads = GENERATE(true, false);
  if (reads) {
    world.session.force(first.as_concept());
    CHECK(world.log == Log{"start", "first", "MESH MA", "MODEL MO", "SOLVE R1"});
    world.log = {"start", "first"};
  }
  world.session.finish();
  CHECK(world.log ==
        (reads ? Log{"start", "first", "second, and more", "SOLVE R2", "last"}
               : Log{"start", "first", "MESH MA", "MODEL MO", "SOLVE R1", "second, and more", "SOLVE R2", "last"}));
}

TEST_CASE("A failure stops what depends on it, and only that; all failures are told at their place") {
  World world;
  world.failing = "R1";
  const Value mesh = world.call("MESH", {}, "MA");
  const Value model = world.call("MODEL", {{"MESH", mesh}}, "MO");
  const Value first = world.call("SOLVE", {{"MODEL", model}}, "R1");
  const Value second = world.call("SOLVE", {{"MODEL", model}}, "R2");
  world.call("VERIFY", {{"WHAT", first}});
  world.call("VERIFY", {{"WHAT", second}});
  world.session.finish();
  CHECK(world.codes() == Log{"no-convergence"});
  CHECK(text_at(world.diagnostics.items()[0].span) == "SOLVE(MODEL=MO, )");
  CHECK(world.state(2) == NodeState::failed);
  CHECK(world.state(4) == NodeState::skipped);
  CHECK(world.state(5) == NodeState::done);
}

TEST_CASE("Two commands that write one file: the second runs although the first failed") {
  World world;
  world.commands["PRINT"] = [&](const Call& call) -> std::shared_ptr<ConceptData> {
    world.log.push_back("PRINT");
    if (!call.has("WHAT")) throw std::runtime_error("disk full");
    return nullptr;
  };
  const Value mesh = world.call("MESH", {}, "MA");
  world.call("PRINT", {});
  world.call("PRINT", {{"WHAT", mesh}});
  world.session.finish();
  CHECK(world.log == Log{"MESH MA", "PRINT", "PRINT"});
  CHECK(world.codes() == Log{"command-failed"});
}

TEST_CASE("What a failure inside try left behind can be read afterwards") {
  World world;
  world.failing = "_2";
  world.leaves_data = true;
  const Value mesh = world.call("MESH", {}, "MA");
  const Value model = world.call("MODEL", {{"MESH", mesh}}, "MO");
  CHECK_THROWS_AS(world.call("SOLVE", {{"MODEL", model}}, "", true), DiagnosticError);
  const ConceptPtr left = world.session.graph().nodes().back().product;
  world.call("VERIFY", {{"WHAT", Value(left)}});
  world.session.finish();
  CHECK(world.log.back() == "VERIFY");
  CHECK(world.diagnostics.items().empty());
}

TEST_CASE("Pruning leaves out what neither a verdict nor an output needs") {
  World world({.only_tests = true});
  const Value mesh = world.call("MESH", {}, "MA");
  const Value model = world.call("MODEL", {{"MESH", mesh}}, "MO");
  world.call("SOLVE", {{"MODEL", model}}, "R1");
  const Value tested = world.call("SOLVE", {{"MODEL", model}}, "R2");
  world.call("VERIFY", {{"WHAT", tested}});
  world.session.finish();
  CHECK(world.log == Log{"MESH MA", "MODEL MO", "SOLVE R2", "VERIFY"});
  CHECK(world.state(2) == NodeState::skipped);
}

TEST_CASE("A fault of a command is told as comma's own") {
  World world;
  world.commands["MESH"] = [](const Call& call) -> std::shared_ptr<ConceptData> {
    call.at("NOTHING");
    return nullptr;
  };
  world.call("MESH", {}, "MA");
  world.session.finish();
  CHECK(world.codes() == Log{"internal-error"});
}

TEST_CASE("A command of the catalogue that nobody has written yet says so") {
  World world;
  world.commands.erase("MESH");
  world.call("MESH", {}, "MA");
  world.session.finish();
  CHECK(world.codes() == Log{"unsupported"});
}

TEST_CASE("What only writes is left out with an alarm where comma does not support it, and all else runs") {
  World world;
  const Value mesh = world.call("MESH", {}, "MA");
  world.call("PRINT", {{"WHAT", mesh}, {"COLOUR", Value("RED")}});
  world.call("PRINT", {{"WHAT", mesh}});
  world.call("VERIFY", {{"WHAT", mesh}});
  world.session.finish();
  CHECK(world.log == Log{"MESH MA", "PRINT", "VERIFY"});
  CHECK(world.state(1) == NodeState::skipped);
  REQUIRE(world.codes() == Log{"unsupported"});
  CHECK(world.diagnostics.items()[0].severity == Severity::alarm);
  CHECK(world.diagnostics.items()[0].hint == "PRINT is left out here, and writes nothing; all else runs");
}

TEST_CASE("A command that only writes may find out itself that it cannot") {
  World world;
  world.commands["PRINT"] = [](const Call&) -> std::shared_ptr<ConceptData> {
    throw DiagnosticError("unsupported", "no such format");
  };
  const Value mesh = world.call("MESH", {}, "MA");
  world.call("PRINT", {{"WHAT", mesh}});
  world.call("VERIFY", {{"WHAT", mesh}});
  world.session.finish();
  CHECK(world.log == Log{"MESH MA", "VERIFY"});
  REQUIRE(world.codes() == Log{"unsupported"});
  CHECK(world.diagnostics.items()[0].severity == Severity::alarm);
}
