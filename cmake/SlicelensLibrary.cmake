# Compiler settings shared by every target, and the two functions that declare targets.

add_library(slicelens_warnings INTERFACE)
target_compile_options(slicelens_warnings INTERFACE -Wall -Wextra -Wconversion -Wshadow)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # GCC 12 sees overlapping copies in every `"literal" + std::string` (GCC bug 105651).
  target_compile_options(slicelens_warnings INTERFACE -Wno-restrict)
  if(SLICELENS_SANITIZE)
    # With sanitizers it takes std::regex's own members for uninitialized (GCC bug 105562).
    target_compile_options(slicelens_warnings INTERFACE -Wno-maybe-uninitialized)
  endif()
endif()
if(SLICELENS_WERROR)
  target_compile_options(slicelens_warnings INTERFACE -Werror)
endif()
if(SLICELENS_SANITIZE)
  add_compile_options(-fsanitize=${SLICELENS_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${SLICELENS_SANITIZE})
endif()

# slicelens_library(core SOURCES a.cpp … LINKS slicelens::x … PRIVATE_LINKS …)
#
# One static library per folder of src/. Its only include root holds one entry, a link named after the folder,
# so `#include "core/errors.h"` compiles exactly where slicelens::core is linked: the include rule is an error
# of the compiler, not a habit.
function(slicelens_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINKS;PRIVATE_LINKS" ${ARGN})
  set(target slicelens_${name})
  set(root ${PROJECT_BINARY_DIR}/include/${name})
  file(MAKE_DIRECTORY ${root})
  file(CREATE_LINK ${PROJECT_SOURCE_DIR}/src/${name} ${root}/${name} SYMBOLIC)
  if(ARG_SOURCES)
    add_library(${target} STATIC ${ARG_SOURCES})
    target_include_directories(${target} PUBLIC ${root})
    target_link_libraries(${target} PUBLIC ${ARG_LINKS} PRIVATE slicelens_warnings ${ARG_PRIVATE_LINKS})
  else()
    add_library(${target} INTERFACE)
    target_include_directories(${target} INTERFACE ${root})
    target_link_libraries(${target} INTERFACE ${ARG_LINKS})
  endif()
  add_library(slicelens::${name} ALIAS ${target})
endfunction()

# One Catch2 program per folder of tests/. In asan builds leaks inside the graphics drivers are suppressed
# (tests/support/lsan.supp says which).
function(slicelens_test_program name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINKS" ${ARGN})
  set(target test_${name})
  add_executable(${target} ${ARG_SOURCES})
  target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR}/tests/support)
  target_compile_definitions(${target} PRIVATE SLICELENS_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  target_link_libraries(${target} PRIVATE slicelens_warnings slicelens::core ${ARG_LINKS} Catch2::Catch2WithMain)
endfunction()

# Every TEST_CASE becomes a ctest entry named `<PREFIX>: <case>`. A case that prints a line starting with
# "SKIPPED:" counts as skipped in ctest's summary, never as passed. SPEC selects cases, as Catch2 takes it.
function(slicelens_register_tests name)
  cmake_parse_arguments(ARG "" "PREFIX;SPEC" "LABELS;ENVIRONMENT" ${ARGN})
  if(SLICELENS_SANITIZE MATCHES "address")
    list(APPEND ARG_ENVIRONMENT
      "LSAN_OPTIONS=suppressions=${PROJECT_SOURCE_DIR}/tests/support/lsan.supp:print_suppressions=0")
  endif()
  # Properties are checked on the same random cases in every run; the programs themselves, started by hand, draw new
  # ones (and RC_PARAMS="seed=…" repeats a failure that they print).
  list(APPEND ARG_ENVIRONMENT "RC_PARAMS=seed=2006")
  set(properties SKIP_REGULAR_EXPRESSION "SKIPPED:" TIMEOUT 600)
  foreach(property LABELS ENVIRONMENT)
    if(ARG_${property})
      # A list inside the list of properties: catch_discover_tests, its custom command and its script each take
      # one escape away (tried with Catch2 2.13; `ctest --print-labels` must show gl and softpipe as two).
      string(REPLACE ";" "\\\\\\\\\\;" value "${ARG_${property}}")
      list(APPEND properties ${property} "${value}")
    endif()
  endforeach()
  catch_discover_tests(test_${name} TEST_PREFIX "${ARG_PREFIX}: " TEST_SPEC ${ARG_SPEC} PROPERTIES ${properties})
endfunction()

# What `tools/test --all` builds with sanitizers: the programs that open no context.
add_custom_target(tests_without_gl)

# slicelens_test(volume SOURCES a_test.cpp … LINKS slicelens::volume … LABELS slow … ENVIRONMENT A=1 …)
function(slicelens_test name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINKS;LABELS;ENVIRONMENT" ${ARGN})
  slicelens_test_program(${name} SOURCES ${ARG_SOURCES} LINKS ${ARG_LINKS})
  slicelens_register_tests(${name} PREFIX ${name} LABELS ${ARG_LABELS} ENVIRONMENT ${ARG_ENVIRONMENT})
  if(NOT "gl" IN_LIST ARG_LABELS)
    add_dependencies(tests_without_gl test_${name})
  endif()
endfunction()

# slicelens_gl_test(render SOURCES a_test.cpp … LINKS slicelens::render …)
#
# The same for tests that open a context: every case runs on the default driver (label gl) and again as
# `<folder> [softpipe]: <case>` on Mesa's other software rasteriser (labels gl and softpipe), which shares no code
# generation with the first. Cases with the tag [one-driver] run on the default one only: use it for what softpipe
# is too slow for.
function(slicelens_gl_test name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINKS;LABELS;ENVIRONMENT" ${ARGN})
  slicelens_test_program(${name} SOURCES ${ARG_SOURCES} LINKS slicelens::gl ${ARG_LINKS})
  slicelens_register_tests(${name} PREFIX ${name} LABELS gl ${ARG_LABELS} ENVIRONMENT ${ARG_ENVIRONMENT})
  slicelens_register_tests(${name} PREFIX "${name} [softpipe]" SPEC ~[one-driver] LABELS gl softpipe ${ARG_LABELS}
    ENVIRONMENT GALLIUM_DRIVER=softpipe ${ARG_ENVIRONMENT})
endfunction()
