// Head of a measurement's program: the operator's sheet, and the first messages to the PC.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "diagnosis/advice/measurement_plan.h"
#include "setup/program_language.h"
#include "setup/programmed_point.h"
#include "setup/store_prints.h"

namespace trunnion::diagnosis {
namespace {

/// The text in a form allowed in an NC comment.
std::string comment(std::string text) {
    for (char& c : text) {
        c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
        if (c == '(' || c == ')' || c == '_') c = ' ';
    }
    return '(' + text + ")\n";
}

std::string place(const Vector3& v) {
    return fmt::format("X{:.3f} Y{:.3f} Z{:.3f}", v.x(), v.y(), v.z());
}

std::string with_stars(std::string text) {
    std::replace(text.begin(), text.end(), '_', '*');
    for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return text;
}

}  // namespace

/// What to mount, set and type for the plan.
std::string MeasurementPlan::sheet() const {
    std::string text = comment("operator's sheet");
    const auto uses = [&](records::Device device, const std::string& feature) {
        return std::any_of(result_.table.rows.begin(), result_.table.rows.end(), [&](auto& row) {
            return row.device == device && (feature.empty() || row.feature == feature);
        });
    };
    if (uses(records::Device::touch, ""))
        text += comment(fmt::format("mount: touch probe, ball {:.3f} mm, from the gauge point {}",
                                    setup_.probe->ball_diameter_mm, place(setup_.probe->tip_S_mm)));
    if (uses(records::Device::ballbar, ""))
        text += comment(fmt::format("mount: ballbar {:.3f} mm, tool cup from the gauge point {}",
                                    setup_.ballbar->length_mm, place(setup_.ballbar->cup_S_mm)));
    for (const setup::Artefact& a : spheres_)
        if (uses(records::Device::touch, a.name))
            text += comment(fmt::format("mount: sphere {} {:.3f} mm, centre {}, rotaries at 0",
                                        a.name, a.diameter_mm, place(a.center_W_mm)));
    for (const setup::Artefact& a : pivots_)
        if (uses(records::Device::ballbar, a.name))
            text += comment(fmt::format("mount: centre pivot {} at {}, rotaries at 0", a.name,
                                        place(a.center_W_mm)));
    text += comment("set: the PC keeps all that is printed, from the first line to END");
    for (const std::string& stop : stops_) text += comment("set, at a stop: " + stop);
    return text + comment("type: nothing. It overwrites " + overwrites_);
}

std::string MeasurementPlan::head_text() const {
    std::string zeros, letters;
    for (const Axis axis : all_axes) {
        if (!setup_.machine.chain.find(axis)) continue;
        zeros += fmt::format(" {}0.", letter_of(axis));
        if (is_rotary(axis)) letters += fmt::format("*{}", letter_of(axis));
    }
    const std::string name = with_stars(result_.name);
    const auto stores = setup::rotary_stores(setup_.machine.chain, setup_.stores);
    const setup::ProgramLanguage language = setup::language_of(setup_);
    const std::string probe =
        setup_.probe ? std::to_string(setup::probe_offset(*setup_.probe)) : std::string();
    return "%\nO8900 " + comment(result_.name) + comment(result_.text) + sheet() +
           "(POSITIONS ARE MACHINE COORDINATES: G59 IS SET TO MACHINE ZERO.)\n"
           "(NEEDS O8100 TO O8102, SPHERE9.NC. NO TOOL LENGTH IN FORCE.)\n"
           "G90 G17 " +
           setup::start_codes(language) + " G40 G49 G80 G94\nG10 L2 P6" + zeros +
           "\nG59\nPOPEN\nDPRNT[MEASUREMENT*" + name + "*AXES" + letters + "]\n" +
           (stores ? setup::store_prints(*stores, setup::is_hurco(language), probe) : "") +
           "#149=1\n" + "DPRNT[POSITIONS*DIRECT]\nDPRNT[TEST*" + name + "]\nM98P8102\n";
}

}  // namespace trunnion::diagnosis
