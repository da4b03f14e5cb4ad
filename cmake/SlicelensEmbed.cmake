# slicelens_embed(out.cpp FUNCTION name DIRECTORY dir FILES a b …)
#
# Writes, at build time, a C++ source that defines
#   const std::vector<slicelens::EmbeddedFile>& slicelens::<FUNCTION>()
# holding the files' texts under their paths relative to DIRECTORY, so that a program carries its shaders and
# scenes with it and works from any place it is installed in.
function(slicelens_embed output)
  cmake_parse_arguments(ARG "" "FUNCTION;DIRECTORY" "FILES" ${ARGN})
  set(inputs)
  foreach(file ${ARG_FILES})
    list(APPEND inputs ${ARG_DIRECTORY}/${file})
  endforeach()
  string(REPLACE ";" "|" file_list "${ARG_FILES}")
  add_custom_command(
    OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -DOUTPUT=${output} -DFUNCTION=${ARG_FUNCTION} -DDIRECTORY=${ARG_DIRECTORY}
            "-DFILES=${file_list}" -P ${PROJECT_SOURCE_DIR}/cmake/WriteEmbedded.cmake
    DEPENDS ${inputs} ${PROJECT_SOURCE_DIR}/cmake/WriteEmbedded.cmake
    VERBATIM)
endfunction()
