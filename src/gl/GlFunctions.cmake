# Reads Khronos' GL/glcorearb.h and writes a list of all core functions up to 4.5 as
#   SLICELENS_GL_FUNCTION(version, name, type)       version 33 for 3.3; name without the prefix gl
# which gl/functions.h turns into the function table. The header is the authority on names, types and versions,
# so no list of functions is kept by hand.
function(slicelens_gl_function_list header output)
  file(READ ${header} text)
  # Only three kinds of token matter: where a version's section starts, where the extensions start (each
  # section is guarded by a name of its own), and the prototypes.
  string(REGEX MATCHALL "#ifndef GL_[A-Z]+_[A-Za-z0-9_]+|APIENTRY gl[A-Za-z0-9_]+" tokens "${text}")
  set(version 0)
  set(count 0)
  set(list "// Made at configure time from GL/glcorearb.h; do not edit.\n")
  foreach(token ${tokens})
    if(token MATCHES "^#ifndef GL_VERSION_([0-9])_([0-9])$")
      set(version ${CMAKE_MATCH_1}${CMAKE_MATCH_2})
    elseif(token MATCHES "^#ifndef GL_")
      set(version 0)
    elseif(version GREATER 0 AND version LESS_EQUAL 45)
      string(REGEX REPLACE "^APIENTRY gl" "" name "${token}")
      string(TOUPPER "PFNGL${name}PROC" type)
      string(APPEND list "SLICELENS_GL_FUNCTION(${version}, ${name}, ${type})\n")
      math(EXPR count "${count} + 1")
    endif()
  endforeach()
  # 3.3 core alone has 345 functions; far fewer means that the header is not one that this script can read.
  if(count LESS 600)
    message(FATAL_ERROR "${header}: found only ${count} core functions; the header of Debian's libgl-dev has over 600")
  endif()
  file(CONFIGURE OUTPUT ${output} CONTENT "${list}" @ONLY)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${header})
endfunction()
