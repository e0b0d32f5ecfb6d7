// The modules that a command file may import. Nothing in them reaches a file, a process, the network or the clock.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>

#include "interpreter/library/builtins.hpp"
#include "interpreter/library/test_case.hpp"
#include "interpreter/values/operations.hpp"

namespace comma::interpreter {

namespace {

Value function_value(std::string_view name, Builtin function) {
  return Value(std::shared_ptr<Object>(std::make_shared<BuiltinObject>(std::string(name), function)));
}

/// code_aster.init(...) is DEBUT(...). What is not a keyword of the command sets up a Python session and means nothing
/// here: the options of a command line, and `debug`.
Value initialise(Evaluator& evaluator, const CallArguments& arguments) {
  CallArguments kept;
  kept.span = arguments.span;
  kept.callee_span = arguments.callee_span;
  for (const Value& option : arguments.positional) {
    if (!option.is_text())
      raise(ErrorKind::type, "init takes options in quotes and KEYWORD=value", "as in init(CODE=\"OUI\")");
  }
  for (const auto& item : arguments.named) {
    if (item.name != "debug") kept.named.push_back(item);
  }
  return evaluator.call(Value(std::shared_ptr<Object>(std::make_shared<CommandObject>("DEBUT"))), kept);
}

/// code_aster.close() is FIN(), but that the file goes on.
Value close(Evaluator& evaluator, const CallArguments& arguments) {
  CallArguments kept = arguments;
  kept.positional.clear();
  try {
    return evaluator.call(Value(std::shared_ptr<Object>(std::make_shared<CommandObject>("FIN"))), kept);
  } catch (const RaisedError& error) {
    if (error.object()->kind != ErrorKind::system_exit) throw;
    return Value();
  }
}

Value leave(Evaluator&, const CallArguments& arguments) {
  expect_arguments("exit", arguments, 0, 1);
  auto error = make_exception(ErrorKind::system_exit, "");
  error->arguments = arguments.positional;
  throw RaisedError(std::move(error));
}

const std::string& path_argument(const CallArguments& arguments, std::size_t index) {
  if (!arguments[index].is_text()) raise(ErrorKind::type, "expected str, not " + arguments[index].type_name());
  return arguments[index].as_text();
}

Value path_join(Evaluator&, const CallArguments& arguments) {
  expect_arguments("join", arguments, 1, std::max<std::size_t>(arguments.size(), 1));
  std::string path = path_argument(arguments, 0);
  for (std::size_t i = 1; i < arguments.size(); ++i) {
    const std::string& part = path_argument(arguments, i);
    if (part.starts_with('/'))
      path = part;
    else
      path += (path.empty() || path.ends_with('/') ? "" : "/") + part;
  }
  return path;
}

Value path_base(Evaluator&, const CallArguments& arguments) {
  expect_arguments("basename", arguments, 1, 1);
  const std::string& path = path_argument(arguments, 0);
  return path.substr(path.rfind('/') + 1);
}

Value path_folder(Evaluator&, const CallArguments& arguments) {
  expect_arguments("dirname", arguments, 1, 1);
  const std::string& path = path_argument(arguments, 0);
  std::string head = path.substr(0, path.rfind('/') + 1);
  if (head.find_first_not_of('/') != std::string::npos) {
    while (head.ends_with('/')) head.pop_back();
  }
  return head;
}

Value path_split_extension(Evaluator&, const CallArguments& arguments) {
  expect_arguments("splitext", arguments, 1, 1);
  const std::string& path = path_argument(arguments, 0);
  const std::size_t name = path.rfind('/') + 1;
  const std::size_t first = path.find_first_not_of('.', name);
  const std::size_t dot = path.rfind('.');
  if (dot == std::string::npos || first == std::string::npos || dot < first) return Value::tuple({Value(path), ""});
  return Value::tuple({Value(path.substr(0, dot)), Value(path.substr(dot))});
}

using Members = std::map<std::string, Value, std::less<>>;

Members exceptions_of_commands() {
  Members members;
  const auto add = [&](const char* name, ErrorKind kind) {
    members.emplace(name, Value(std::shared_ptr<Object>(std::make_shared<ExceptionClassObject>(kind))));
  };
  add("AsterError", ErrorKind::aster);
  add("error", ErrorKind::aster);
  add("ConvergenceError", ErrorKind::convergence);
  add("NonConvergenceError", ErrorKind::convergence);
  add("ContactError", ErrorKind::contact);
  add("SolverError", ErrorKind::solver);
  add("TimeLimitError", ErrorKind::time_limit);
  add("IntegrationError", ErrorKind::integration);
  return members;
}

Members members_of_code_aster() {
  Members members = exceptions_of_commands();
  members.emplace("init", function_value("init", initialise));
  members.emplace("close", function_value("close", close));
  members.emplace("TestCase", function_value("TestCase", make_test_case));
  return members;
}

/// Code_Aster's alarms, which comma does not have, are neither hidden nor shown.
Value ignore(Evaluator&, const CallArguments&) { return Value(); }

/// UTMESS(kind, id, ...): a message of Code_Aster, whose words comma does not have; of the kinds E, F, S and Z it ends
/// what is done.
Value show_message(Evaluator& evaluator, const CallArguments& arguments) {
  if (arguments.size() < 2 || !arguments[0].is_text() || !arguments[1].is_text())
    raise(ErrorKind::type, "UTMESS takes the kind of a message and its name", "as in UTMESS('A', 'CATAMESS_55')");
  const std::string& kind = arguments[0].as_text();
  const std::string line = fmt::format("<{}> <{}>", kind, arguments[1].as_text());
  if (kind.find_first_of("EFSZ") != std::string::npos) raise(ErrorKind::aster, "UTMESS " + line);
  evaluator.print(line + "\n");
  return Value();
}

Members members_of_messages() {
  return {{"UTMESS", function_value("UTMESS", show_message)},
          {"MasquerAlarme", function_value("MasquerAlarme", ignore)},
          {"RetablirAlarme", function_value("RetablirAlarme", ignore)}};
}

Members members_of_commands() {
  Members members = exceptions_of_commands();
  members.emplace("_F", *builtin_value("_F"));
  return members;
}

Members members_of_math() {
  Members members;
  for (const FunctionRow& row : math_functions()) members.emplace(row.name, *math_value(row.name));
  for (const char* name : {"pi", "e", "tau", "inf", "nan"}) members.emplace(name, *math_value(name));
  return members;
}

Members members_of_numpy() {
  Members members;
  for (const FunctionRow& row : numpy_functions()) members.emplace(row.name, function_value(row.name, row.function));
  for (const char* name : {"pi", "e", "inf", "nan"}) members.emplace(name, *math_value(name));
  for (const char* name : {"float64", "float32", "float_"}) members.emplace(name, *builtin_value("float"));
  for (const char* name : {"int64", "int32", "int_"}) members.emplace(name, *builtin_value("int"));
  members.emplace("bool_", *builtin_value("bool"));
  members.emplace("newaxis", Value());
  members.emplace("ndarray", Value(std::shared_ptr<Object>(std::make_shared<TypeObject>("numpy.ndarray"))));
  return members;
}

Members members_of_linalg() {
  Members members;
  for (const FunctionRow& row : linalg_functions()) members.emplace(row.name, function_value(row.name, row.function));
  return members;
}

Members members_of_path() {
  return {{"join", function_value("join", path_join)},
          {"basename", function_value("basename", path_base)},
          {"dirname", function_value("dirname", path_folder)},
          {"splitext", function_value("splitext", path_split_extension)},
          {"sep", Value("/")}};
}

Members members_of(std::span<const FunctionRow> rows) {
  Members members;
  for (const FunctionRow& row : rows) members.emplace(row.name, function_value(row.name, row.function));
  return members;
}

Members members_of_copy() { return members_of(copy_functions()); }
Members members_of_itertools() { return members_of(itertools_functions()); }
Members members_of_functools() { return members_of(functools_functions()); }
Members members_of_operator() { return members_of(operator_functions()); }

/// Every dict keeps the order of its keys.
Members members_of_collections() {
  Members members = members_of(collections_functions());
  members.emplace("OrderedDict", *builtin_value("dict"));
  return members;
}

Members members_of_string() {
  const std::string lower = "abcdefghijklmnopqrstuvwxyz", upper = "ABCDEFGHIJKLMNOPQRSTUVWXYZ", digits = "0123456789";
  const std::string punctuation = "!\"#$%&'()*+,-./:;<=>?@[\\]^_`{|}~", blanks = " \t\n\r\x0b\x0c";
  return {{"ascii_lowercase", Value(lower)},
          {"ascii_uppercase", Value(upper)},
          {"ascii_letters", Value(lower + upper)},
          {"digits", Value(digits)},
          {"hexdigits", Value(digits + "abcdefABCDEF")},
          {"octdigits", Value("01234567")},
          {"punctuation", Value(punctuation)},
          {"whitespace", Value(blanks)},
          {"printable", Value(digits + lower + upper + punctuation + blanks)}};
}

/// What these switched on, Python 3 has.
Members members_of_future() {
  Members members;
  for (const char* name : {"absolute_import", "annotations", "division", "generators", "nested_scopes",
                           "print_function", "unicode_literals", "with_statement"})
    members.emplace(name, Value(true));
  return members;
}

Members members_of_sys() {
  return {{"exit", function_value("exit", leave)},
          {"maxsize", Value(std::numeric_limits<std::int64_t>::max())},
          {"argv", Value::list({""})}};
}

Members nothing() { return {}; }
Members members_of_os() { return {{"sep", Value("/")}, {"linesep", Value("\n")}}; }

struct ModuleRow {
  std::string_view name;
  Members (*members)();
  bool brings_commands = false;
};

constexpr std::array modules = {
    ModuleRow{"math", members_of_math},
    ModuleRow{"numpy", members_of_numpy},
    ModuleRow{"numpy.linalg", members_of_linalg},
    ModuleRow{"os", members_of_os},
    ModuleRow{"os.path", members_of_path},
    ModuleRow{"sys", members_of_sys},
    ModuleRow{"copy", members_of_copy},
    ModuleRow{"itertools", members_of_itertools},
    ModuleRow{"functools", members_of_functools},
    ModuleRow{"operator", members_of_operator},
    ModuleRow{"collections", members_of_collections},
    ModuleRow{"string", members_of_string},
    ModuleRow{"__future__", members_of_future},
    // Imported out of habit; each use of what is in it is told.
    ModuleRow{"re", nothing},
    ModuleRow{"code_aster", members_of_code_aster, true},
    ModuleRow{"code_aster.CA", members_of_code_aster, true},
    ModuleRow{"code_aster.Commands", members_of_commands, true},
    ModuleRow{"code_aster.Cata.Syntax", members_of_commands},
    ModuleRow{"code_aster.Utilities", nothing},
    ModuleRow{"code_aster.Messages", members_of_messages},
    ModuleRow{"Utilitai.Utmess", members_of_messages},
    ModuleRow{"aster", exceptions_of_commands},
    ModuleRow{"aster_core", nothing},
    ModuleRow{"Cata.cata", members_of_commands, true},
    ModuleRow{"Cata", members_of_commands, true},
    ModuleRow{"Accas", members_of_commands},
};

}  // namespace

std::shared_ptr<ModuleObject> find_module(const std::string& path) {
  const auto row =
      std::find_if(modules.begin(), modules.end(), [&](const ModuleRow& module) { return module.name == path; });
  if (row == modules.end()) return nullptr;
  auto module = std::make_shared<ModuleObject>();
  module->name = path;
  module->members = row->members();
  module->brings_commands = row->brings_commands;
  return module;
}

std::vector<std::string> module_names() {
  std::vector<std::string> names;
  for (const ModuleRow& row : modules) names.emplace_back(row.name);
  return names;
}

}  // namespace comma::interpreter
