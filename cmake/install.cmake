# cmake --install, and find_package(trunnion) for people who use it as a library.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

get_property(rooms GLOBAL PROPERTY TRUNNION_ROOM_TARGETS)
install(TARGETS trunnion_warnings ${rooms} EXPORT trunnionTargets COMPONENT library)
if(TARGET trunnion)
  install(TARGETS trunnion RUNTIME COMPONENT program)
endif()
foreach(line IN LISTS TRUNNION_ROOMS)
  string(REGEX MATCH "^[a-z/]+" name "${line}")
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/${name}/ DESTINATION include/trunnion/${name}
    COMPONENT library
    FILES_MATCHING PATTERN "*.h")
endforeach()
install(DIRECTORY machines programs DESTINATION ${CMAKE_INSTALL_DATADIR}/trunnion COMPONENT program)
install(EXPORT trunnionTargets NAMESPACE trunnion:: DESTINATION lib/cmake/trunnion
  COMPONENT library)
configure_package_config_file(cmake/trunnionConfig.cmake.in
  ${PROJECT_BINARY_DIR}/trunnionConfig.cmake INSTALL_DESTINATION lib/cmake/trunnion)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/trunnionConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/trunnionConfig.cmake
  ${PROJECT_BINARY_DIR}/trunnionConfigVersion.cmake DESTINATION lib/cmake/trunnion
  COMPONENT library)
if(TARGET trunnion)
  include(cmake/package.cmake)
endif()
