#include "commands/unit_numbers.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace comma::commands {

using interpreter::Call;
using interpreter::DiagnosticError;
using interpreter::Value;

Value UnitNumbers::number_of(Call& call, bool misses_calls) {
  const bool frees = call.text("ACTION") == "LIBERER";
  const bool names_one = call.given("UNITE");
  const int unit = names_one ? static_cast<int>(call.integer("UNITE"))
                   : frees   ? unit_of_name(call, misses_calls)
                             : free_unit(call);
  if (!names_one)
    call.items.push_back({"UNITE", Value(static_cast<std::int64_t>(unit)), {}, call.span, call.span, true});
  if (frees) {
    names_.erase(unit);
    return Value();
  }
  names_[unit] = call.given("FICHIER") ? call.text("FICHIER") : "";
  return Value(static_cast<std::int64_t>(unit));
}

int UnitNumbers::unit_of_name(const Call& call, bool misses_calls) const {
  const std::string& name = call.text("FICHIER");
  const auto found = std::ranges::find_if(names_, [&](const auto& entry) { return entry.second == name; });
  if (found != names_.end()) return found->first;
  if (misses_calls) return free_unit(call);
  throw DiagnosticError("unknown-unit", fmt::format("DEFI_FICHIER: no unit stands for the file '{}'", name),
                        call.span_of("FICHIER"), "name it as ACTION='ASSOCIER' does, or give UNITE");
}

int UnitNumbers::free_unit(const Call& call) const {
  constexpr int highest = 99, lowest = 19;
  for (int unit = highest; unit >= lowest; --unit)
    if (!taken_.contains(unit) && !names_.contains(unit)) return unit;
  throw DiagnosticError("no-unit", "DEFI_FICHIER: all unit numbers from 19 to 99 are taken", call.span,
                        "set some free (ACTION='LIBERER')");
}

}  // namespace comma::commands
