#include "base/nearest.h"

#include <catch2/catch.hpp>

using namespace trunnion;

TEST_CASE("a mistyped word leads to the one that was meant, a strange one to none") {
    const std::vector<std::string> commands{"backup",  "ballbar", "check",
                                            "compare", "pivot",   "run"};
    CHECK(nearest("rum", commands) == "run");
    CHECK(nearest("RUN", commands) == "run");
    CHECK(nearest("pviot", commands) == "pivot");   // two swapped
    CHECK(nearest("comp", commands) == "compare");  // begun
    CHECK(nearest("balbar", commands) == "ballbar");
    CHECK(nearest("simulate", commands).empty());
    CHECK(nearest("x", commands).empty());
    CHECK(nearest("p", commands).empty());  // one letter begins too much
    CHECK(nearest("", commands).empty());
    CHECK(nearest(std::string(1000, 'r'), commands).empty());
    CHECK(nearest("", {"x"}).empty());
    const std::string long_word(60, 'r');
    CHECK(nearest(long_word, {long_word + "s"}) == long_word + "s");
    CHECK(nearest(long_word + "r", {long_word}).empty());  // longer words are not searched
    CHECK(nearest("run", {}).empty());
    CHECK(nearest("cat", {"cut", "bat", "cap"}) == "cut");  // the first of equals
    CHECK(did_you_mean("rum", commands) == ", did you mean 'run'?");
    CHECK(did_you_mean("simulate", commands).empty());
}
