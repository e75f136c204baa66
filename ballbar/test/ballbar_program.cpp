#include "ballbar/test/ballbar_program.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "ballbar/test/ballbar_program_text.h"
#include "ballbar/test/ballbar_published.h"
#include "base/alarm.h"
#include "base/units.h"

namespace trunnion::ballbar::test {

namespace {

using Words = std::map<std::string, std::string>;

std::string fill(std::string text, const Words& words) {
    for (std::size_t at = text.find('{'); at != std::string::npos; at = text.find('{', at)) {
        const std::size_t end = text.find('}', at);
        const std::string value = words.at(text.substr(at + 1, end - at - 1));
        text.replace(at, end - at + 1, value);
    }
    return text;
}

/// NC number: always with a decimal point, no more digits than needed.
std::string nc(double value) {
    std::string text = fmt::format("{:.6f}", value == 0.0 ? 0.0 : value);
    while (text.back() == '0') text.pop_back();
    return text;
}

char linear_along(const kinematics::AxisGeometry& axis) {
    return std::abs(axis.direction.x()) > 0.5 ? 'X' : 'Y';
}

/// Planes, angles and points of the stations; U is X or Y.
void add_stations(Words& words, bool along_x) {
    const std::string c = "[#550*COS[#567]]", s = "[#550*SIN[#567]]";
    const auto put = [&](const char* name, const char* for_x, const char* for_y) {
        words[name] = along_x ? for_x : for_y;
    };
    put("OU", "#551", "#552");
    put("ZU", "18", "19");
    put("Z", "0", "90.");
    put("ACROSS", "19", "18");
    put("ZX", "90.", "0");
    put("RADIAL1", "ATAN[#553]/[#552]", "ATAN[#551]/[#553]");
    put("AXIAL1", "90.*#572", "90.-90.*#572");
    put("AXIAL1XY", "90.-90.*#572", "90.*#572");
    put("AXIAL1POINT", "X[#572*#550]Y0Z0", "X0Y[#572*#550]Z0");
    words["RADIAL1POINT"] = along_x ? "X0Y" + c + "Z" + s : "X" + s + "Y0Z" + c;
}

/// Codes that the controls have different words for. The arcs are about the origin of G59.
void add_language(Words& words, setup::ProgramLanguage language) {
    const bool hurco = setup::is_hurco(language), bnc = language == setup::ProgramLanguage::bnc;
    words["START"] = setup::start_codes(language);
    words["ON"] = hurco ? "M128\nG43.4" : "G43.4H#557X#24Y#25Z#26";
    words["OFF"] = hurco ? "M129" : "G0G49Z[#26+#5083]\nG43H#557Z#26";
    words["GZX"] = bnc ? "[5-#24]" : "#24";  // G18 of BNC exchanges G2 and G3
    words["IJ"] = bnc ? "I0J0" : "I-#20J-#21";
    words["KI"] = bnc ? "K0I0" : "K-#20I-#21";
    words["JK"] = bnc ? "J0K0" : "J-#20K-#21";
}

Words words_of(const kinematics::Machine& nominal, const BallbarProgramData& data) {
    const auto [first, second] = table_axes(nominal.chain);
    const Vector3 meet = nominal_intersection(first, second).first;
    const Vector3 offset = data.layout.pivot_W_mm - meet;
    const char u = linear_along(first);
    const auto deg = [](double rad) { return nc(deg_from_rad(rad)); };
    Words words = {{"R", std::string(1, letter_of(first.axis))},
                   {"C", std::string(1, letter_of(second.axis))},
                   {"U", std::string(1, u)},
                   {"L0", nc(data.layout.length_mm)},
                   {"OX", nc(offset.x())},
                   {"OY", nc(offset.y())},
                   {"OZ", nc(offset.z())},
                   {"PX", nc(meet.x())},
                   {"PY", nc(meet.y())},
                   {"PZ", nc(meet.z())},
                   {"H", std::to_string(data.tool_offset)},
                   {"SAFE", nc(data.safe_z_mm)},
                   {"FEED", nc(data.feed_mm_min)},
                   {"TURN", nc(data.turn_deg_min)},
                   {"OVER", nc(data.overshoot_deg)},
                   {"R1", deg(data.layout.first_rad.first)},
                   {"R2", deg(data.layout.first_rad.second)},
                   {"C1", deg(data.layout.second_rad.first)},
                   {"C2", deg(data.layout.second_rad.second)},
                   {"ARC", deg(data.layout.partial_rad)},
                   {"SIDE", data.layout.inside ? "-1." : "1."}};
    add_stations(words, u == 'X');
    add_language(words, data.language);
    return words;
}

std::string subprograms(Words words) {
    std::string text = fill(ballbar_text::data_program, words);
    for (const auto& [number, letter, low, high] :
         {std::tuple("824", "R", "#562", "#563"), std::tuple("825", "C", "#564", "#565")}) {
        words["N"] = number;
        words["L"] = words.at(letter);
        words["LOW"] = low;
        words["HIGH"] = high;
        text += fill(ballbar_text::rotary_program, words);
    }
    return text + fill(ballbar_text::switch_program, words);
}

/// The wanted range, limited to the travel with room for the overshoot.
std::pair<double, double> within(const kinematics::AxisGeometry& axis,
                                 std::pair<double, double> wanted, double overshoot_rad) {
    if (axis.min) wanted.first = std::max(wanted.first, *axis.min + overshoot_rad);
    if (axis.max) wanted.second = std::min(wanted.second, *axis.max - overshoot_rad);
    return wanted;
}

}  // namespace

BallbarProgramData ballbar_program_data(const kinematics::Machine& nominal,
                                        const BallbarLayout& layout) {
    const auto [first, second] = table_axes(nominal.chain);
    const Vector3 offset = layout.pivot_W_mm - nominal_intersection(first, second).first;
    if (std::abs(second.direction.z()) < 0.99 || std::abs(first.direction.z()) > 0.01)
        throw InputError(
            "the single-set-up ballbar test requires a tilting axis that carries a rotary table "
            "axis along Z");
    if (std::hypot(offset.x(), offset.y()) < 5.0 || offset.z() < 5.0)
        throw InputError(fmt::format(
            "the ballbar's centre pivot must stand above the {} axis and beside the {} axis",
            letter_of(first.axis), letter_of(second.axis)));
    BallbarProgramData data;
    data.layout = layout;
    const double overshoot = rad_from_deg(data.overshoot_deg);
    data.layout.first_rad = within(first, layout.first_rad, overshoot);
    data.layout.second_rad = within(second, layout.second_rad, overshoot);
    if (const kinematics::AxisGeometry* z = nominal.chain.find(Axis::Z); z && z->max)
        data.safe_z_mm = std::min(data.safe_z_mm, *z->max);
    return data;
}

std::string ballbar_program(const kinematics::Machine& nominal, const BallbarProgramData& data) {
    const Words words = words_of(nominal, data);
    return "%\n" + fill(ballbar_text::main_program, words) + subprograms(words) + "%\n";
}

std::string kinematic_test_program(const kinematics::Machine& nominal,
                                   const BallbarProgramData& data) {
    const Words words = words_of(nominal, data);
    return "%\n" + fill(ballbar_text::kinematic_program, words) + subprograms(words) + "%\n";
}

}  // namespace trunnion::ballbar::test
