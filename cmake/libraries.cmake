# Third-party libraries that only some rooms use; none is visible through a room's headers.
function(trunnion_use room)
  if(TARGET trunnion_${room})
    get_target_property(kind trunnion_${room} TYPE)
    if(kind STREQUAL "STATIC_LIBRARY")
      target_link_libraries(trunnion_${room} PRIVATE ${ARGN})
    endif()
  endif()
endfunction()

# nettle's SHA-256 uses the processor's instructions for it. Debian ships no CMake file with nettle.
find_library(NETTLE_LIBRARY nettle REQUIRED)
trunnion_use(base tomlplusplus::tomlplusplus nettle)
trunnion_use(regression tomlplusplus::tomlplusplus nlohmann_json::nlohmann_json Threads::Threads)
trunnion_use(estimation Boost::headers)
trunnion_use(identification NLopt::nlopt Threads::Threads)
trunnion_use(diagnosis_prepare NLopt::nlopt)
trunnion_use(diagnosis Threads::Threads)
trunnion_use(check nlohmann_json::nlohmann_json)
trunnion_use(report nlohmann_json::nlohmann_json)

# Style sheet and scripts of the pages: web/dist is committed, so that no build fetches anything.
find_package(ZLIB REQUIRED)
trunnion_use(report ZLIB::ZLIB)
if(TARGET trunnion_report)
  file(GLOB page_files CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/web/dist/*)
  add_custom_command(OUTPUT ${PROJECT_BINARY_DIR}/page_assets.cpp
    COMMAND ${CMAKE_COMMAND} -DDIST=${PROJECT_SOURCE_DIR}/web/dist
      -DOUTPUT=${PROJECT_BINARY_DIR}/page_assets.cpp
      -P ${PROJECT_SOURCE_DIR}/cmake/page_assets.cmake
    DEPENDS ${page_files} ${PROJECT_SOURCE_DIR}/cmake/page_assets.cmake VERBATIM)
  target_sources(trunnion_report PRIVATE ${PROJECT_BINARY_DIR}/page_assets.cpp)
  # One literal for each file, longer than what the standard requires; clang says so (-Wpedantic).
  set_source_files_properties(${PROJECT_BINARY_DIR}/page_assets.cpp PROPERTIES
    SKIP_UNITY_BUILD_INCLUSION ON COMPILE_OPTIONS -Wno-overlength-strings)
endif()
