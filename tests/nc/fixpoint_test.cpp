// Law 3 on every program of the corpus: parse, print, parse gives the same blocks.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "interpreter/print.h"

using namespace trunnion;

TEST_CASE("parse print parse is a fixpoint on the whole corpus") {
    int programs = 0;
    for (const auto& entry :
         std::filesystem::recursive_directory_iterator(TRUNNION_SOURCE_DIR "/tests/nc")) {
        if (entry.path().extension() != ".nc") continue;
        std::stringstream bytes;
        bytes << std::ifstream(entry.path(), std::ios::binary).rdbuf();
        const std::string text = bytes.str();
        INFO(entry.path().string());
        const interpreter::ParsedProgram a = interpreter::parse_program({"a", text, nullptr}, {});
        const std::string once = interpreter::print_program(a);
        const interpreter::ParsedProgram b = interpreter::parse_program({"b", once, nullptr}, {});
        INFO(once);
        CHECK(b.faults.empty());
        REQUIRE(a.blocks.size() == b.blocks.size());
        for (std::size_t i = 0; i < a.blocks.size(); ++i)
            REQUIRE(interpreter::same_block(a, a.blocks[i], b, b.blocks[i]));
        CHECK(interpreter::print_program(b) == once);
        ++programs;
    }
    CHECK(programs > 400);
}
