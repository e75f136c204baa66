#!/usr/bin/env bash
# lint_test.sh SOURCE WORK: every check of .ci/lint passes on a small good project, and fails when
# what it looks for is put in. Exit code 77: a tool is missing.
set -eu
source=$1 work=$2
for tool in git ctags clang-format clang-tidy shellcheck cmake; do
  command -v "$tool" >/dev/null || { echo "lint_test: no $tool"; exit 77; }
done
rm -rf "$work"
mkdir -p "$work/.ci" "$work/room"
cp "$source/.ci/lint" "$work/.ci/"
cp "$source/.clang-format" "$source/.clang-tidy" "$work/"
cd "$work"
cat > CMakePresets.json <<'END'
{"version": 6, "configurePresets": [{"name": "release", "generator": "Ninja",
  "binaryDir": "${sourceDir}/build", "cacheVariables": {"CMAKE_EXPORT_COMPILE_COMMANDS": "ON"}}]}
END
cat > CMakeLists.txt <<'END'
cmake_minimum_required(VERSION 3.25)
project(small CXX)
add_library(room room/good.cpp room/other.cpp)
target_include_directories(room PRIVATE ${PROJECT_SOURCE_DIR})
END
cat > room/good.h <<'END'
// A small room.
#pragma once

int sum(int a, int b);
END
cat > room/good.cpp <<'END'
#include "room/good.h"

#include <string>
#include <utility>
#include <vector>

int sum(int a, int b) {
    return a + b;
}

int main() {
    return sum(1, 2);
}
END
cat > room/other.cpp <<'END'
int elsewhere() {
    return 1;
}
END
cp room/good.h good.h
cp room/good.cpp good.cpp
git init -q .
git -c user.name=test -c user.email=test commit -q --allow-empty -m start
echo build > .gitignore

lint() {
  git add -A
  .ci/lint "$1" > out.txt 2>&1
}

failed=0
expect() { # expect CHECK FILE TEXT: the check fails once the text is behind the file.
  lint "$1" || { echo "lint_test: $1 fails on a good project"; cat out.txt; failed=1; }
  printf '%s\n' "$3" >> "$2"
  if lint "$1"; then echo "lint_test: $1 does not see: $3"; failed=1; fi
  mv good.h room/good.h
  mv good.cpp room/good.cpp
  cp room/good.h good.h
  cp room/good.cpp good.cpp
  rm -f script.sh
}

expect format room/good.cpp 'int  badly ( int a );'
expect scripts script.sh '#!/bin/bash
cd $1'
expect dead room/good.h 'int nobody_calls(int a,
                 int b);'
expect parameters room/good.cpp 'int six(int a, int b, int c, int d, int e, int f) {
    return a + b + c + d + e + f;
}'
expect sizes room/good.cpp "$(echo 'int very_long() {'; yes '' | head -n 70 | sed 's/$/    \/\/ a line/'; echo '    return 1;'; echo '}')"
expect headers room/good.h 'int elsewhere();'
expect changed room/good.cpp 'std::size_t twice(std::string text) {
    std::vector<std::string> list;
    list.push_back(std::move(text));
    return text.size();
}'
expect tidy room/good.cpp 'bool blank(const std::string& text) {
    return text.size() == 0;
}'
exit "$failed"
