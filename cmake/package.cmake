# cpack: a Debian package of the program, its machines and programs, man page and completions.
# The libraries and headers (component "library") stay out of it.
# The package needs the program alone, not the tests.
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)
set(share ${CMAKE_INSTALL_DATADIR})
set(maintainer "trunnion maintainers <maintainers@users.noreply.github.com>")
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${share}/doc/trunnion RENAME copyright
  COMPONENT program)
install(FILES ${PROJECT_SOURCE_DIR}/web/dist/LICENSES.txt DESTINATION ${share}/doc/trunnion
  RENAME page_licenses COMPONENT program)
# Made by the program itself when it is installed, so that they name its own options.
install(CODE "
  set(root \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${share}\")
  foreach(form man bash zsh fish)
    execute_process(COMMAND \"$<TARGET_FILE:trunnion>\" completion \${form}
      OUTPUT_VARIABLE text COMMAND_ERROR_IS_FATAL ANY)
    set(file_man man/man1/trunnion.1)
    set(file_bash bash-completion/completions/trunnion)
    set(file_zsh zsh/vendor-completions/_trunnion)
    set(file_fish fish/vendor_completions.d/trunnion.fish)
    file(WRITE \"\${root}/\${file_\${form}}\" \"\${text}\")
  endforeach()
  execute_process(COMMAND gzip -9nf \"\${root}/man/man1/trunnion.1\" COMMAND_ERROR_IS_FATAL ANY)
  configure_file(\"${PROJECT_SOURCE_DIR}/CHANGELOG.md\" \"\${root}/doc/trunnion/CHANGELOG.md\" COPYONLY)
  string(TIMESTAMP day \"%a, %d %b %Y %H:%M:%S +0000\" UTC)
  file(WRITE \"\${root}/doc/trunnion/changelog\" \"trunnion (${PROJECT_VERSION}) unstable; urgency=medium

  * CHANGELOG.md.gz beside this file says what is new.

 -- ${maintainer}  \${day}
\")
  foreach(file changelog CHANGELOG.md)
    execute_process(COMMAND gzip -9nf \"\${root}/doc/trunnion/\${file}\" COMMAND_ERROR_IS_FATAL ANY)
  endforeach()
" COMPONENT program)

# Debian's folder for modules; the compiled half is for one version of Python.
set(package_depends "")
if(TARGET trunnion_python)
  set(modules lib/python3/dist-packages/trunnion)
  install(TARGETS trunnion_python LIBRARY DESTINATION ${modules} COMPONENT program)
  install(FILES python/trunnion/__init__.py DESTINATION ${modules} COMPONENT program)
  math(EXPR next_minor "${Python_VERSION_MINOR} + 1")
  set(package_depends "python3 (>= 3.${Python_VERSION_MINOR}), python3 (<< 3.${next_minor}), python3-numpy")
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME trunnion)
set(CPACK_PACKAGE_CONTACT "${maintainer}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE
  GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL program)
set(CPACK_COMPONENTS_GROUPING ALL_COMPONENTS_IN_ONE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "${package_depends}")
if(TARGET trunnion_python)
  set(CPACK_DEBIAN_PACKAGE_SUGGESTS "python3-pandas")
  set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA
    ${PROJECT_SOURCE_DIR}/cmake/debian/postinst ${PROJECT_SOURCE_DIR}/cmake/debian/prerm)
endif()
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "offline CNC control with a physical five-axis machine")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION "Runs NC programs, Macro B included, on an emulated Fanuc-style or Hurco
control and a five-axis machine with ISO 230 errors. Finds which pivot store
is stale, identifies errors from probe and ballbar readings, compares two
programs as machining, and says why simulation and machine differ.")
include(CPack)
