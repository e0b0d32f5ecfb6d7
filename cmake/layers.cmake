# A layer is one static library whose headers are reached as "layer/path.hpp". Each layer's include root holds a link to
# that layer's folder and nothing else, so a header of a layer that a target does not link is not found: an arrow that the
# design forbids does not compile.
function(comma_layer name)
  set(root ${CMAKE_BINARY_DIR}/layers/${name})
  file(MAKE_DIRECTORY ${root})
  file(CREATE_LINK ${CMAKE_CURRENT_SOURCE_DIR} ${root}/${name} SYMBOLIC)
  # Relative, so that the folder in which the project lies may itself be called "tests" or "tools".
  file(GLOB_RECURSE sources RELATIVE ${CMAKE_CURRENT_SOURCE_DIR} CONFIGURE_DEPENDS *.cpp)
  list(FILTER sources EXCLUDE REGEX "^(tests|bench|fuzz|tools)/|(^|/)main\\.cpp$")
  add_library(comma_${name} STATIC ${sources})
  target_include_directories(comma_${name} PUBLIC ${root})
endfunction()

# The unit tests of a layer: every *.cpp under its tests/, one executable, one ctest entry.
function(comma_layer_tests name)  # ARGN: more headers to precompile
  if(NOT COMMA_TESTS)
    return()
  endif()
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS tests/*.cpp)
  if(NOT sources)
    return()
  endif()
  add_executable(${name}_tests ${sources})
  target_link_libraries(${name}_tests PRIVATE comma_${name} comma_test_main)
  target_compile_definitions(${name}_tests PRIVATE COMMA_SOURCE_DIR="${CMAKE_SOURCE_DIR}")
  # Tests compute little: what counts is how fast they compile.
  target_compile_options(${name}_tests PRIVATE -O0)
  target_precompile_headers(${name}_tests PRIVATE <catch2/catch.hpp> <map> <memory> <string> <vector> ${ARGN})
  add_test(NAME unit.${name} COMMAND ${name}_tests)
endfunction()

# Proves that a header of layer `to` is not found from layer `from`, and that one of its own is.
function(comma_forbidden_arrow from to header own_header)
  set(compile ${CMAKE_CXX_COMPILER} -std=c++20 -fsyntax-only -I${CMAKE_BINARY_DIR}/layers/${from} -x c++)
  add_test(NAME layers.${from}_to_${to} COMMAND ${compile} -include ${header} /dev/null)
  set_tests_properties(layers.${from}_to_${to} PROPERTIES PASS_REGULAR_EXPRESSION "${header}: No such file")
  if(NOT TEST layers.${from}_itself)
    add_test(NAME layers.${from}_itself COMMAND ${compile} -include ${own_header} /dev/null)
  endif()
endfunction()
