# Precompiled headers: the standard and third-party headers that most files read. Every file still
# includes what it uses, so a build without them (-DTRUNNION_PRECOMPILED=OFF) compiles too.
option(TRUNNION_PRECOMPILED "precompile headers of libraries" ON)

set(TRUNNION_PRECOMPILED_ROOM
  <Eigen/Core> <Eigen/Geometry> <fmt/format.h> <algorithm> <array> <cmath> <cstdint> <functional>
  <map> <memory> <optional> <set> <span> <string> <string_view> <utility> <vector>)

# trunnion_precompile(OWNER HEADER...): an object library of no code that owns one set of headers.
function(trunnion_precompile owner)
  if(NOT TRUNNION_PRECOMPILED)
    return()
  endif()
  set(empty ${CMAKE_CURRENT_BINARY_DIR}/${owner}.cpp)
  if(NOT EXISTS ${empty})
    file(WRITE ${empty} "")
  endif()
  add_library(${owner} OBJECT ${empty})
  target_precompile_headers(${owner} PRIVATE ${ARGN})
endfunction()

# trunnion_reuse_precompiled(TARGET OWNER): compiles TARGET with the headers of OWNER, where there
# are any. Both need the same definitions and options.
function(trunnion_reuse_precompiled target owner)
  if(TARGET ${owner})
    target_precompile_headers(${target} REUSE_FROM ${owner})
  endif()
endfunction()
