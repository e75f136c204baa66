# Several files of a room compiled as one: a fresh build reads each header once for twenty files and
# takes about half the time. One changed file then compiles its neighbours too; for daily work
# configure with -DTRUNNION_UNITY=OFF.
option(TRUNNION_UNITY "compile the files of a room in groups" OFF)

# Rooms that are compiled file by file all the same: a mutant (preset mutants) then costs one file.
set(TRUNNION_SINGLE_ROOMS "" CACHE STRING "rooms whose files are not compiled in groups")

# Files whose unnamed namespace has a name of a neighbour's: they are compiled alone.
set(TRUNNION_ALONE
  controller/dialect_codes.cpp controller/g_codes.cpp controller/m_codes.cpp
  controller/holes.cpp controller/hurco_codes.cpp setup/body_keys.cpp
  imports/points.cpp pivot/pivot_prints.cpp pivot/pivot_readings.cpp regression/effects_layer.cpp
  regression/golden.cpp)

function(trunnion_group_files target)
  string(REGEX REPLACE "^trunnion_" "" room ${target})
  string(REGEX REPLACE "^diagnosis_.*" "diagnosis" room ${room})
  if(TRUNNION_UNITY AND NOT room IN_LIST TRUNNION_SINGLE_ROOMS)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 20)
    # GCC takes the grouped files for headers, whose types should not have unnamed members.
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  endif()
endfunction()

function(trunnion_keep_files_alone)
  foreach(file IN LISTS TRUNNION_ALONE)
    set_source_files_properties(${PROJECT_SOURCE_DIR}/${file} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  endforeach()
endfunction()
