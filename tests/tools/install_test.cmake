# Installs into a prefix, moves the prefix, and runs the program there as a user of an installed program would:
# from another folder, without an environment, through a link. Run with
#   cmake -DBUILD=… -DBINDIR=bin -DLIBDIR=lib -DDATADIR=share -DDOCDIR=share/doc/slicelens -P install_test.cmake
cmake_minimum_required(VERSION 3.21)

string(RANDOM LENGTH 8 suffix)
if(DEFINED ENV{TMPDIR})
  set(base "$ENV{TMPDIR}")
else()
  set(base /tmp)
endif()
set(base "${base}/slicelens install ${suffix}") # with spaces: users have them

function(finish message)
  file(REMOVE_RECURSE "${base}")
  if(message)
    message(FATAL_ERROR "${message}")
  endif()
endfunction()

file(MAKE_DIRECTORY "${base}/elsewhere")
execute_process(COMMAND ${CMAKE_COMMAND} --install "${BUILD}" --prefix "${base}/first"
  RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
if(status)
  finish("cmake --install failed: ${output}")
endif()
file(RENAME "${base}/first" "${base}/moved")
foreach(file ${BINDIR}/slicelens ${LIBDIR}/slicelens/libslicelens_codec.so
        ${DATADIR}/slicelens/scenes/gallery/01_head_bone.json ${DATADIR}/slicelens/studies/lamar-table3.json ${DATADIR}/slicelens/render_with_vtk
        ${DOCDIR}/LICENSE)
  if(NOT EXISTS "${base}/moved/${file}")
    finish("${file} was not installed")
  endif()
endforeach()
file(CREATE_LINK "${base}/moved/${BINDIR}/slicelens" "${base}/linked" SYMBOLIC)

# The loader reports which module it opens: that of the moved prefix, not the one of the build folder, which the
# program falls back to.
foreach(program "${base}/moved/${BINDIR}/slicelens" "${base}/linked")
  execute_process(
    COMMAND env -i LD_DEBUG=files ${RUN_ENVIRONMENT} "${program}" render "${base}/moved/${DATADIR}/slicelens/scenes/gallery/11_ball.json"
            --set volume.size=[16,16,16] --set render.size=[32,32] -o picture.png
    WORKING_DIRECTORY "${base}/elsewhere" RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE trace)
  if(status OR NOT output STREQUAL "picture.png\n")
    string(REGEX MATCHALL "slicelens: [^\n]*" errors "${trace}")
    finish("${program} ended with ${status}: ${output} ${errors}")
  endif()
  string(REGEX MATCH "file=([^\n]*libslicelens_codec.so) \\[0\\];  dynamically loaded" opened "${trace}")
  file(REAL_PATH "${base}/moved/${LIBDIR}/slicelens/libslicelens_codec.so" expected)
  if(NOT CMAKE_MATCH_1)
    finish("the loader does not say where libslicelens_codec.so comes from")
  endif()
  file(REAL_PATH "${CMAKE_MATCH_1}" actual)
  if(NOT actual STREQUAL expected)
    finish("${program} opened ${actual}, not ${expected}")
  endif()
  file(SIZE "${base}/elsewhere/picture.png" size)
  if(size LESS 500)
    finish("the picture has ${size} bytes")
  endif()
  file(REMOVE "${base}/elsewhere/picture.png")
endforeach()

finish("")
