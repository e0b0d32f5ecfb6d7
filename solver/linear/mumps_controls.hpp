// What MUMPS is told by numbers ("MUMPS 5.5.1 Users' guide", section 5).
#pragma once

namespace comma::solver {

inline constexpr int job_initialise = -1;
inline constexpr int job_destroy = -2;
inline constexpr int whole_communicator = -987654;
inline constexpr int general_symmetric = 2;  // sym=1 takes every pivot on trust

}  // namespace comma::solver
