# Compiler settings shared by every target, and the two functions that declare targets.

add_library(slicelens_warnings INTERFACE)
target_compile_options(slicelens_warnings INTERFACE -Wall -Wextra -Wconversion -Wshadow)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # GCC 12 sees overlapping copies in every `"literal" + std::string` (GCC bug 105651).
  target_compile_options(slicelens_warnings INTERFACE -Wno-restrict)
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

# slicelens_test(volume SOURCES a_test.cpp … LINKS slicelens::volume … LABELS gl …)
#
# One Catch2 program per folder of tests/; every TEST_CASE is a ctest entry named `<folder>: <case>`. A case that
# prints a line starting with "SKIPPED:" counts as skipped in ctest's summary, never as passed.
function(slicelens_test name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINKS;LABELS;ENVIRONMENT" ${ARGN})
  set(target test_${name})
  add_executable(${target} ${ARG_SOURCES})
  target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR}/tests/support)
  target_compile_definitions(${target} PRIVATE SLICELENS_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  target_link_libraries(${target} PRIVATE slicelens_warnings slicelens::core ${ARG_LINKS} Catch2::Catch2WithMain)
  set(properties SKIP_REGULAR_EXPRESSION "SKIPPED:" TIMEOUT 600)
  if(ARG_LABELS)
    list(APPEND properties LABELS "${ARG_LABELS}")
  endif()
  if(ARG_ENVIRONMENT)
    list(APPEND properties ENVIRONMENT "${ARG_ENVIRONMENT}")
  endif()
  catch_discover_tests(${target} TEST_PREFIX "${name}: " PROPERTIES ${properties})
endfunction()
