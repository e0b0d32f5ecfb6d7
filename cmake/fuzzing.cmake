# A fuzz target is one source FOLDER/fuzz/NAME_fuzz.cpp with LLVMFuzzerTestOneInput. It is built twice: by the preset `fuzz`
# against libFuzzer, with the targets fuzz_NAME that run it; and by the others as a test that replays the seeds and all that was
# ever found (NAME.finds/), so that a find stays fixed. docs/fuzzing.md says how to use it.

set(COMMA_FUZZ_SECONDS 600 CACHE STRING "How long the targets fuzz_NAME run")

# DICTIONARY file, or none; SEEDS folders and files; OPTIONS of libFuzzer; LIBRARIES.
function(comma_fuzz_target name)
  cmake_parse_arguments(arg "" "DICTIONARY" "SEEDS;OPTIONS;LIBRARIES" ${ARGN})
  set(source ${CMAKE_CURRENT_SOURCE_DIR}/fuzz/${name}_fuzz.cpp)
  set(finds ${CMAKE_CURRENT_SOURCE_DIR}/fuzz/${name}.finds)
  if(IS_DIRECTORY ${finds})
    list(APPEND arg_SEEDS ${finds})
  endif()
  if(COMMA_FUZZ)
    add_executable(${name}_fuzz ${source})
    target_link_options(${name}_fuzz PRIVATE -fsanitize=fuzzer)
    target_link_libraries(${name}_fuzz PRIVATE ${arg_LIBRARIES})
    set(corpus ${CMAKE_BINARY_DIR}/corpus/${name})
    add_custom_target(
      fuzz_${name}
      COMMAND ${CMAKE_COMMAND} -E make_directory ${corpus}
      COMMAND ${name}_fuzz -max_total_time=${COMMA_FUZZ_SECONDS} -print_final_stats=1 -timeout=20 ${arg_OPTIONS}
              "$<$<BOOL:${arg_DICTIONARY}>:-dict=${arg_DICTIONARY}>" ${corpus} ${arg_SEEDS}
      DEPENDS ${arg_DICTIONARY}
      WORKING_DIRECTORY ${CMAKE_BINARY_DIR}
      COMMAND_EXPAND_LISTS VERBATIM USES_TERMINAL)
  elseif(COMMA_TESTS)
    add_executable(${name}_replay ${source} ${CMAKE_SOURCE_DIR}/cmake/replay_main.cpp)
    target_link_libraries(${name}_replay PRIVATE ${arg_LIBRARIES})
    target_compile_options(${name}_replay PRIVATE -O0)
    add_test(NAME fuzz.${name} COMMAND ${name}_replay ${arg_SEEDS})
  endif()
endfunction()
