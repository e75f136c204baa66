#include "setup/declared.h"

#include <fmt/format.h>

#include "base/sha256.h"

namespace trunnion::setup {
namespace {

constexpr std::size_t digits = 12;

/// To 1e-9: a direction that was written and read again may differ in its last bit.
std::string text_of(const Vector3& v) {
    std::string text;
    for (const double c : {v.x(), v.y(), v.z()}) {
        std::string number = fmt::format(" {:.9f}", c);
        text += number == " -0.000000000" ? " 0.000000000" : number;
    }
    return text;
}

std::string text_of(const std::vector<kinematics::AxisGeometry>& axes) {
    std::string text;
    for (const kinematics::AxisGeometry& axis : axes) {
        text += ' ' + axis.name + text_of(axis.direction);
        if (axis.rotary) text += " about" + text_of(axis.point_mm);
    }
    return text;
}

std::string text_of(const Instrument& instrument) {
    return (instrument.sees_table ? "W" : "M") + text_of(instrument.origin_mm) +
           text_of(instrument.rotation_deg);
}

std::string digest(const std::string& text) {
    return sha256(text).substr(0, digits);
}

}  // namespace

std::map<std::string, std::string> declared_digests(const Setup& setup) {
    const kinematics::Chain& chain = setup.machine.chain;
    std::map<std::string, std::string> all{
        {"chain", digest("w" + text_of(chain.work) + " b" + text_of(chain.tool) + " t")}};
    for (const Artefact& a : setup.artefacts)
        if (a.kind == Artefact::Kind::target)
            all["target " + a.name] = digest(a.tool_S_mm ? "tool" + text_of(*a.tool_S_mm)
                                                         : "table" + text_of(a.center_W_mm));
    for (const Instrument& one : setup.instruments)
        all["instrument " + one.name] = digest(text_of(one));
    all["instrument"] = setup.instruments.size() == 1 ? digest(text_of(setup.instruments.front()))
                                                      : std::string("none");
    return all;
}

}  // namespace trunnion::setup
