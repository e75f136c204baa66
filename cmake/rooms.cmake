# The rooms of the house, lowest floor first: a room may include only the rooms listed behind it.
# tests/layering.cmake reads this same list and fails the build when an #include breaks it.
set(TRUNNION_ROOMS
  "geometry"
  "interpreter: geometry"
  "offsets: geometry"
  "kinematics: geometry"
  "records: geometry"
  "positioning: offsets geometry"
  "motion: positioning offsets geometry"
  "controller: motion positioning interpreter offsets geometry"
  "probe: kinematics geometry"
  "ballbar: kinematics geometry"
  "check: interpreter geometry"
  "backup: offsets interpreter geometry"
  "emulator: controller motion positioning offsets interpreter kinematics probe ballbar records geometry"
  "effects: emulator kinematics records geometry"
  "identification: emulator effects kinematics records geometry"
  "regression: emulator controller motion positioning interpreter records geometry"
  "diagnosis: effects identification emulator kinematics records geometry"
  "analysis: identification effects emulator controller motion positioning offsets interpreter kinematics probe ballbar records geometry"
  "report: analysis diagnosis identification effects regression check emulator controller offsets kinematics interpreter records geometry"
  "cli: report analysis diagnosis identification effects regression check backup emulator controller offsets kinematics probe ballbar interpreter records geometry"
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

# trunnion_room(NAME): one static library for each room, from every .cpp in its folder.
function(trunnion_room name depends)
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${name}/*.cpp)
  file(GLOB headers CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${name}/*.h)
  if(NOT sources AND NOT headers)
    return()
  endif()
  set(scope PUBLIC)
  if(sources)
    add_library(trunnion_${name} STATIC ${sources})
    target_link_libraries(trunnion_${name} PRIVATE trunnion_warnings)
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
    if(TARGET trunnion_${room})
      target_link_libraries(trunnion_${name} ${scope} trunnion_${room})
    endif()
  endforeach()
  set_property(GLOBAL APPEND PROPERTY TRUNNION_ROOM_TARGETS trunnion_${name})
endfunction()

function(trunnion_add_rooms)
  foreach(line IN LISTS TRUNNION_ROOMS)
    string(REGEX MATCH "^[a-z]+" name "${line}")
    trunnion_room_depends("${line}" depends)
    if(NOT name STREQUAL "cli")
      trunnion_room(${name} "${depends}")
    endif()
  endforeach()
endfunction()
