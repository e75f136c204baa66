# The Python module: trunnion/__init__.py and its compiled half, in build/PRESET/python, for the
# Python of Debian (python3-dev, python3-numpy, pybind11-dev). AUTO: where these are there.
set(TRUNNION_PYTHON AUTO CACHE STRING "build the Python module: ON, OFF or AUTO")
if(NOT TRUNNION_PYTHON OR CMAKE_CXX_FLAGS MATCHES "-fsanitize|--coverage")
  return()  # a plain Python cannot load code that needs a sanitizer's runtime
endif()
set(need QUIET)
if(NOT TRUNNION_PYTHON STREQUAL "AUTO")
  set(need REQUIRED)
endif()
if(NOT Python_EXECUTABLE AND EXISTS /usr/bin/python3)
  set(Python_EXECUTABLE /usr/bin/python3 CACHE FILEPATH "the Python that the module is for")
endif()
find_package(Python 3.11 ${need} COMPONENTS Interpreter Development.Module NumPy)
if(Python_Development.Module_FOUND AND Python_NumPy_FOUND)
  find_package(pybind11 2.10 ${need})
endif()
if(NOT pybind11_FOUND)
  message(STATUS "no Python module: it takes pybind11-dev, python3-dev and python3-numpy")
  return()
endif()

file(GLOB python_sources CONFIGURE_DEPENDS python/*.cpp)
pybind11_add_module(trunnion_python MODULE NO_EXTRAS ${python_sources})
get_property(rooms GLOBAL PROPERTY TRUNNION_ROOM_TARGETS)
target_compile_definitions(trunnion_python PRIVATE TRUNNION_VERSION="${PROJECT_VERSION}")
target_link_libraries(trunnion_python PRIVATE trunnion_warnings ${rooms})
set_target_properties(trunnion_python PROPERTIES OUTPUT_NAME _native
  LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/python/trunnion)
add_custom_command(TARGET trunnion_python POST_BUILD
  COMMAND ${CMAKE_COMMAND} -E copy ${PROJECT_SOURCE_DIR}/python/trunnion/__init__.py
    ${PROJECT_BINARY_DIR}/python/trunnion/__init__.py VERBATIM)
if(TRUNNION_TESTS AND TARGET trunnion)
  enable_testing()
  foreach(subject trunnion page campaign)
    add_test(NAME "python: ${subject}"
      COMMAND ${Python_EXECUTABLE} ${PROJECT_SOURCE_DIR}/tests/python/test_${subject}.py)
    set_tests_properties("python: ${subject}" PROPERTIES ENVIRONMENT
      "PYTHONPATH=${PROJECT_BINARY_DIR}/python;PYTHONDONTWRITEBYTECODE=1;TRUNNION_PROGRAM=$<TARGET_FILE:trunnion>;TRUNNION_SOURCE=${PROJECT_SOURCE_DIR}")
  endforeach()
endif()
