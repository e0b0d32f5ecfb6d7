// Keywords and words that earlier versions of Code_Aster had, and what stands for them today.
#pragma once

#include <string>
#include <string_view>

namespace comma::interpreter {

/// A hint on a keyword that the level no longer has ("STAT_NON_LINE/INCREMENT", "SUBD_PAS"), or empty.
std::string hint_on_former_keyword(std::string_view level, std::string_view keyword);

/// The keyword of the level that stands for that one today, or empty: where the one is written the other is not
/// missing.
std::string of_former_keyword(std::string_view level, std::string_view keyword);

/// Today's name of a field that ends like those of versions before 10 ("SIGM_NOEU_DEPL": "SIGM_NOEU"), or empty.
std::string of_former_field(std::string_view name);

}  // namespace comma::interpreter
