// Corrections with a compliance that need not be exact.
#pragma once

#include <limits>
#include <optional>

#include "solver/unilateral/schur_complement.hpp"

namespace comma::solver {

/// Conditions hold when a round changes forces by less than this share of the largest: another round would gain three
/// digits or more.
inline constexpr double negligible_change = 1e-10;
/// Or when the next round would change less than this, going by what the last two have gained, or, after the first
/// one, by the least that any round with the same compliance has.
inline constexpr double negligible_rest = 5e-13;
/// The same for bodies that lose few digits: the directions of others may depend on forces that all but cancel.
inline constexpr double negligible_rest_of_stiff_bodies = 5e-11;
/// Rounds with one compliance: each costs a solution.
inline constexpr int most_rounds = 20;

/// `settle`() solves the conditions with S as it is, moves the bodies, and returns by how much forces changed as a
/// share of the largest; nothing where an S that is not exact has led to no solution. One round is all with an exact S;
/// else there are more until the change is negligible, or the next one would be, and where it does not shrink to half
/// from round to round, S is made anew.
template <class Settle>
void settle_in_rounds(SchurComplement& schur, double negligible, Settle&& settle) {
  double last = std::numeric_limits<double>::infinity();
  for (int round = 1;; ++round) {
    const bool is_exact = schur.is_exact();
    const std::optional<double> change = settle();
    if (is_exact || (change && *change <= negligible_change)) return;
    if (round > 1 && change) schur.note_left(*change / last);
    if (change && *change * (round > 1 ? *change / last : schur.most_left()) <= negligible) return;
    if (!change || *change > 0.5 * last || round == most_rounds) schur.start_anew();
    last = change.value_or(last);
  }
}

}  // namespace comma::solver
