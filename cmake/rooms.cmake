# The rooms of the house, lowest floor first: a room may include only the rooms listed behind it.
# A room inside a room (ballbar/test, diagnosis/search) stands on another floor than the room around it.
# tests/layering.cmake reads this same list and fails when an #include breaks it or when a
# permission is not used.
set(TRUNNION_ROOMS
  "base"
  "geometry: base"
  "interpreter: base"
  "offsets: geometry base"
  "kinematics: geometry base"
  "records: geometry base"
  "positioning: offsets geometry base"
  "motion: positioning geometry base"
  "cutter: motion offsets geometry base"
  "controller: cutter motion positioning offsets interpreter geometry base"
  "probe: kinematics geometry"
  "ballbar: kinematics geometry"
  "check: interpreter base"
  "backup: offsets base"
  "setup: controller positioning kinematics offsets interpreter geometry base"
  "imports: setup records geometry base"
  "emulator: setup ballbar probe controller motion positioning records kinematics geometry base"
  "inputs: emulator setup backup interpreter base"
  "effects: emulator records geometry base"
  "estimation"
  "identification: estimation effects emulator records base"
  "regression: emulator setup controller motion positioning interpreter geometry base"
  "choices: estimation emulator setup records controller motion offsets interpreter base"
  "diagnosis/rules"
  "diagnosis/prepare: diagnosis/rules identification estimation effects emulator records base"
  "diagnosis/search: diagnosis/rules diagnosis/prepare identification estimation base"
  "diagnosis/groups: diagnosis/search diagnosis/prepare diagnosis/rules identification estimation effects base"
  "diagnosis/verdict: diagnosis/groups diagnosis/search diagnosis/prepare diagnosis/rules estimation base"
  "diagnosis/stores: diagnosis/verdict diagnosis/rules identification estimation effects setup records"
  "diagnosis/advice: diagnosis/search diagnosis/prepare diagnosis/rules estimation setup records base"
  "diagnosis: diagnosis/advice diagnosis/stores diagnosis/verdict diagnosis/groups diagnosis/search diagnosis/prepare diagnosis/rules identification estimation effects setup records kinematics base"
  "pivot: estimation effects emulator setup positioning records interpreter kinematics geometry base"
  "compensation: emulator setup motion positioning kinematics offsets base"
  "volumetric: emulator setup kinematics base"
  "ballbar/test: estimation emulator setup records kinematics interpreter geometry base"
  "report: ballbar/test volumetric pivot compensation choices diagnosis identification regression effects emulator setup check records geometry base"
  "python: report inputs diagnosis regression identification effects emulator setup records interpreter base"
  "cli: report ballbar/test inputs imports pivot compensation choices diagnosis diagnosis/stores regression identification effects emulator setup backup check controller records interpreter base"
)

# What stands behind the colon of one line of the list.
function(trunnion_room_depends line result)
  string(FIND "${line}" ": " colon)
  set(depends "")
  if(NOT colon EQUAL -1)
    math(EXPR start "${colon} + 2")
    string(SUBSTRING "${line}" ${start} -1 depends)
    string(REPLACE " " ";" depends "${depends}")
  endif()
  set(${result} "${depends}" PARENT_SCOPE)
endfunction()

# Rooms whose branches are counted (preset coverage): the optimiser's copies of a lambda would count
# as branches of their own.
set(TRUNNION_UNOPTIMISED_ROOMS "" CACHE STRING "rooms compiled with -O0, without precompiled headers")
# With -O1 nothing inlines the products of Eigen; a sanitizer then looks at each access of each call.
# What the optimiser warns of there comes from the sanitizer's own code.
set(TRUNNION_OPTIMISED_ROOMS "" CACHE STRING "rooms compiled with -O2 in any build, without precompiled headers")
set(TRUNNION_UNCOPIED_ROOMS "" CACHE STRING "rooms whose branches are counted before the optimiser copies any")

# trunnion_room(NAME): one static library for each room, from every .cpp in its folder.
function(trunnion_room folder depends)
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${folder}/*.cpp)
  file(GLOB headers CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${folder}/*.h)
  string(REPLACE "/" "_" name ${folder})
  string(REGEX REPLACE "/.*" "" around ${folder})
  if(NOT sources AND NOT headers)
    return()
  endif()
  set(scope PUBLIC)
  if(sources)
    add_library(trunnion_${name} STATIC ${sources})
    target_link_libraries(trunnion_${name} PRIVATE trunnion_warnings)
    if(around IN_LIST TRUNNION_UNOPTIMISED_ROOMS)
      target_compile_options(trunnion_${name} PRIVATE -O0)
    elseif(around IN_LIST TRUNNION_OPTIMISED_ROOMS)
      target_compile_options(trunnion_${name} PRIVATE -O2 -Wno-error)
    elseif(around IN_LIST TRUNNION_UNCOPIED_ROOMS)
      # With -O0 the sums of Eigen take some hundred times as long. The counters are set behind the
      # early passes, so these may neither inline nor join conditions; headers have no counters.
      target_compile_options(trunnion_${name} PRIVATE -fno-early-inlining -fno-ssa-phiopt
        --param=logical-op-non-short-circuit=0 -fprofile-filter-files=${PROJECT_SOURCE_DIR}/.*\\.cpp)
    else()
      trunnion_reuse_precompiled(trunnion_${name} trunnion_room_headers)
    endif()
    trunnion_group_files(trunnion_${name})
  else()
    add_library(trunnion_${name} INTERFACE)
    set(scope INTERFACE)
  endif()
  add_library(trunnion::${name} ALIAS trunnion_${name})
  set_target_properties(trunnion_${name} PROPERTIES EXPORT_NAME ${name})
  target_include_directories(trunnion_${name} ${scope}
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:include/trunnion>)
  target_compile_features(trunnion_${name} ${scope} cxx_std_20)
  target_link_libraries(trunnion_${name} ${scope} Eigen3::Eigen fmt::fmt)
  foreach(room IN LISTS depends)
    string(REPLACE "/" "_" room ${room})
    if(TARGET trunnion_${room})
      target_link_libraries(trunnion_${name} ${scope} trunnion_${room})
    endif()
  endforeach()
  set_property(GLOBAL APPEND PROPERTY TRUNNION_ROOM_TARGETS trunnion_${name})
endfunction()

function(trunnion_add_rooms)
  foreach(line IN LISTS TRUNNION_ROOMS)
    string(REGEX MATCH "^[a-z/]+" name "${line}")
    trunnion_room_depends("${line}" depends)
    if(NOT name MATCHES "^(cli|python)$")
      trunnion_room(${name} "${depends}")
    endif()
  endforeach()
endfunction()
