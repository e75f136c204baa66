# Files and streams go through base/ alone, where every failure is an error: fails when another room
# reads, writes or prints by itself.
file(GLOB_RECURSE files ${ROOT}/*/*.h ${ROOT}/*/*.cpp)
set(words "std::(i|o)?fstream|std::fopen|std::c(out|err|in)[^a-z]|fmt::print|std::(printf|puts|fputs|fwrite)")
foreach(file IN LISTS files)
  file(RELATIVE_PATH name ${ROOT} ${file})
  if(name MATCHES "^(build|out|tests|benchmarks|base)/")
    continue()
  endif()
  file(STRINGS ${file} lines REGEX "${words}")
  if(lines)
    message(SEND_ERROR "${name}: input and output belong to base/: ${lines}")
  endif()
endforeach()
