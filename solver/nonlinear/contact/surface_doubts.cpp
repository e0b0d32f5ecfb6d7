#include "solver/nonlinear/contact/surface_doubts.hpp"

#include "solver/error.hpp"

namespace comma::solver {
namespace {

/// Surfaces that cannot be paired are no reason to lose a step that has converged.
template <class Check>
void where_surfaces_pair(Check&& check) {
  try {
    check();
  } catch (const Error&) {
    return;
  }
}

}  // namespace

void SurfaceDoubts::look(const SurfaceState& state, ContactDoubts& doubts) {
  where_surfaces_pair([&] { passed_master_.look(state.now, state.pushed_back, state.instant); });
  if (!state.averages.empty())
    where_surfaces_pair([&] {
      note_stale_averages(contact_, mesh_, state.now, state.averages, state.averages_as_is(), state.pushed_back,
                          doubts);
    });
  if (!state.pairs) return;
  where_surfaces_pair([&] {
    const std::vector<ContactPair> solved_with = state.pairs();
    note_stale_geometry(contact_, mesh_, state.now,
                        {solved_with, pair_surfaces(contact_, mesh_, state.now, state.instant), state.pushed_back},
                        doubts);
  });
}

}  // namespace comma::solver
