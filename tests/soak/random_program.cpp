#include "tests/soak/random_program.h"

#include <fmt/format.h>

#include <array>
#include <functional>
#include <vector>

using trunnion::SeededNoise;

namespace {

template <class List>
const auto& one_of(SeededNoise& noise, const List& list) {
    return list[static_cast<std::size_t>(noise.uniform() * static_cast<double>(std::size(list)))];
}

/// With three decimals and a point.
std::string number(SeededNoise& noise, double largest) {
    return fmt::format("{:.3f}", (2.0 * noise.uniform() - 1.0) * largest);
}

std::string words(SeededNoise& noise, const char* letters, double largest) {
    std::string out;
    for (const char* c = letters; *c; ++c)
        if (noise.uniform() < 0.7) out += fmt::format(" {}{}", *c, number(noise, largest));
    return out;
}

using Maker = std::function<std::string(SeededNoise&)>;

std::string plane(SeededNoise& noise) {
    return fmt::format("G68.2 X{} Y{} Z{} I{} J{} K{}\nG53.1\nG1{} F800.\nG69", number(noise, 20),
                       number(noise, 20), number(noise, 20), number(noise, 90), number(noise, 40),
                       number(noise, 90), words(noise, "XYZ", 20));
}

std::string tool_centre(SeededNoise& noise) {
    std::string out = "G43.4 H1 Z200.";
    for (int k = 0; k < 4; ++k) out += "\nG1" + words(noise, "XYZBC", 60) + " F1000.";
    return out + "\nG49\nG43 H1";  // without a length the control knows no tip
}

const std::vector<Maker>& makers() {
    static const std::vector<Maker> list{
        [](auto& n) { return "G0" + words(n, "XYZ", 100); },
        [](auto& n) { return "G1" + words(n, "XYZ", 100) + " F900."; },
        [](auto& n) { return "G1" + words(n, "XYZBC", 60) + " F900."; },
        [](auto& n) {
            return fmt::format("G2 X{} Y{} R-200. F500.", number(n, 80), number(n, 80));
        },
        [](auto& n) { return fmt::format("G3 I{} J{} F500.", number(n, 40), number(n, 40)); },
        [](auto& n) { return "G91\nG1" + words(n, "XYZ", 10) + "\nG90"; },
        [](auto& n) {
            return fmt::format("G81 X{} Z-20. R5. F200.\nY{}\nG80", number(n, 50), number(n, 50));
        },
        [](auto& n) { return fmt::format("G52 X{} Y{}", number(n, 5), number(n, 5)); },
        [](auto& n) { return "G54.2 P1\nG0" + words(n, "XYBC", 50) + "\nG54.2 P0"; },
        [](auto& n) { return fmt::format("G10 L2 P1 X{} Y{}", number(n, 5), number(n, 5)); },
        [](auto& n) {
            return fmt::format("#1=0\nWHILE[#1LT{}]DO1\nG91 X[#1*0.1]\nG90\n#1=#1+1\nEND1",
                               1 + static_cast<int>(4 * n.uniform()));
        },
        [](auto& n) {
            return fmt::format("IF[#100GT{}]THEN #100=0\n#100=#100+SIN[{}]", number(n, 2),
                               number(n, 90));
        },
        [](auto& n) { return fmt::format("G65 P9001 A{} B{}", number(n, 30), number(n, 30)); },
        [](auto&) { return std::string("M98 P9002 L2"); },
        [](auto& n) {
            return fmt::format("DPRNT[A#100[43]**{}]", one_of(n, std::array{"X", "YZ"}));
        },
        [](auto&) { return std::string("G43 H1"); },
        plane,
        tool_centre};
    return list;
}

}  // namespace

std::string random_machine(SeededNoise& noise) {
    constexpr std::array chains{"w C B b X Y Z t", "w C A b X Y Z t", "w b X Y Z C B t",
                                "w b X Y Z C A t", "w C b X Y Z B t", "w A b X Y Z B t"};
    const std::string chain = one_of(noise, chains);
    std::string out =
        "schema = \"trunnion.setup/1\"\n[machine]\nname = \"soak\"\nchain = \"" + chain + "\"\n";
    for (const char axis : {'A', 'B', 'C'}) {
        if (chain.find(axis) == std::string::npos) continue;
        const int sign = noise.uniform() < 0.5 ? 1 : -1;
        out += fmt::format("[machine.axis.{}]\ndirection = [{}, {}, {}]\npoint_mm = [{}, {}, {}]\n",
                           axis, sign * (axis == 'A'), sign * (axis == 'B'), sign * (axis == 'C'),
                           number(noise, 200), number(noise, 200), number(noise, 200));
    }
    return out + "[control.tools]\n1 = { length_mm = 120.5 }\n";
}

std::string random_program(SeededNoise& noise) {
    std::string out = "O1\nG21 G90 G94 G17 G54\nT1 M6\nG43 H1\n";
    const int blocks = 4 + static_cast<int>(20 * noise.uniform());
    for (int k = 0; k < blocks; ++k) out += one_of(noise, makers())(noise) + "\n";
    return out + "M30\nO9001\nG1 X#1 Y#2 F700.\nM99\nO9002\nG91 G1 Z1.\nG90\nM99\n";
}
