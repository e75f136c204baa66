// A log that one control wrote, judged with another's setup, through files.
#pragma once

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/cli/command_bench.h"

namespace trunnion::control_gap_bench {

using Json = nlohmann::json;

/// A five-axis machine whose [control] tables follow.
inline std::string machine(const std::string& control) {
    return R"([machine]
name  = "Log"
chain = "w C B b X Y Z t"
[machine.axis.B]
direction = [0, -1, 0]
point_mm  = [0, 0, 0]
[machine.axis.C]
direction = [0, 0, -1]
point_mm  = [0, 0, 0]
)" + control;
}

struct Control {
    std::string keys, hurco, g54 = "X = 10.0, Y = -20.0, Z = 5.0", h1 = "150.0",
                             parameters = "3401 = \"00000001\"\n";
    std::string text() const {
        return machine("[control]\n" + keys + "[control.hurco]\n" + hurco +
                       "[control.work_offsets]\nG54 = { " + g54 + " }\nG55 = { X = 50.0 }\n" +
                       "[control.parameters]\n" + parameters +
                       "[control.tools]\n1 = { length_mm = " + h1 + ", diameter_mm = 6.0 }\n");
    }
};

struct Bench : CommandBench {
    /// Runs the program on `there`, and asks which of `here` explains the trace.
    Json asked(const std::string& program, const Control& here, const Control& there,
               const std::string& log_words = "") const {
        write("here.toml", here.text());
        write("there.toml", there.text());
        write("part.nc", program);
        (void)trunnion("run " + file("part.nc") + " --setup " + file("there.toml") + " --trace " +
                       file("log.csv") + log_words);
        return asked();
    }
    Json asked() const {
        const int code = trunnion("diagnose " + file("log.csv") + " --program " + file("part.nc") +
                                  " --setup " + file("here.toml") + " --json");
        INFO(read("err.txt"));
        REQUIRE(code == 0);
        return Json::parse(read("out.txt"));
    }
};

/// All kinds of motion in the words of a three-axis mill, over two work offsets and one tool.
inline const std::string mill = R"(N10 G90 G21 G17 G40 G49 G80 G54
N20 T1 M6
N30 G43 H1 Z50.
N40 G0 X0. Y0.
N50 G1 Z2. F500.
N60 X40. Y10.
N70 G2 X60. Y30. R30.
N80 G3 X40. Y10. I-25. J10.
N90 G0 Z30.
N100 G55 X5. Y5.
N110 G99 G73 X10. Y10. Z-9. R3. Q4. F200.
N120 X25.
N130 G98 G83 X10. Y-10. Z-12. R3. Q5.
N140 G80
N150 G0 X70. Y40
N160 G1 X30 Y12
N170 G91 G1 X-5. Y-6.
N180 X-5. Z-1.
N190 G90 G49 Z80.
N200 M30
)";

/// Indexing, then G43.4, as posts write it.
inline const std::string five_axis = R"(N10 G90 G21 G54
N20 T1 M6
N30 G0 B30. C40.
N40 G43.4 H1 X50. Y20. Z60.
N50 G1 X40. Y10. Z50. B20. C10. F800.
N60 X30. Y-10. Z40. B-10. C-20.
N70 X10. Y-20. Z45. B5. C60.
N80 X0. Y0. Z60. B0. C0.
N90 G49
N100 M30
)";

/// G43 and G49 in blocks of their own.
inline const std::string lengths = R"(N10 G90 G21 G54 G0 X0. Y0.
N20 T1 M6
N30 G43 H1
N40 X20. Y10.
N50 G1 Z2. F300.
N60 X30.
N70 G49
N80 X0. Y1.
N90 G0 Z25.
N100 M30
)";

inline const Json& cause(const Json& result) {
    REQUIRE(result["causes"].size() == 1);
    const Json& only = result["causes"][0];
    CHECK(only["probability"].get<double>() < 1.0);
    CHECK(only["heldout"]["shrink"].get<double>() > 0.99);
    return only;
}

inline double value(const Json& of, const std::string& name) {
    for (const Json& parameter : of["parameters"])
        if (parameter["name"] == name) return parameter["value"];
    return -1e9;
}

}  // namespace trunnion::control_gap_bench
