// G54.2 Pn: the dynamic fixture offset in force. It never reads 19680-19714.
#include <fmt/format.h>

#include "controller/five_axis.h"
#include "controller/g_codes.h"
#include "controller/g_handlers.h"

namespace trunnion {

namespace {

const FixtureSettings& fixture_settings(ControlState& c) {
    if (c.five_axis.fixture) return *c.five_axis.fixture;
    std::vector<Axis> order;
    for (const ControlAxis& axis : c.config.axes) order.push_back(axis.axis);
    c.five_axis.fixture = decode_fixture_settings(c.stores.parameters, order);
    if (c.five_axis.fixture->assumed)
        c.note("G54.2: groups 7580-7588 are not given; a left-handed rotary table is assumed");
    return *c.five_axis.fixture;
}

}  // namespace

bool turn_fixture(ControlState& c, const ControlPosition& machine) {
    const auto& set = c.stores.fixture.set[static_cast<std::size_t>(c.fixture_number - 1)];
    const ControlPosition vector = turned_fixture_offset(fixture_settings(c), set, machine);
    if (vector == c.coordinates.fixture) return false;
    c.coordinates.fixture = vector;
    return true;
}

bool follow_fixture(ControlState& c, const ControlPosition& target) {
    if (c.fixture_number == 0 || c.stores.parameters.bit(7570, 0)) return false;
    return turn_fixture(c, c.coordinates.machine_from_program(target));
}

void g_fixture_offset(ControlState& c, const GCode& code) {
    if (c.five_axis.tcp) raise_alarm(5421, "(G54.2 under it)");
    if (c.five_axis.plane) raise_alarm(5457, "(G54.2 inside a tilted plane)");
    const int most = static_cast<int>(c.stores.fixture.set.size());
    const int p = c.words.has('P') ? c.whole_word('P') : -1;
    if (p < 0 || p > most)
        raise_alarm(31, fmt::format("(G54.2: P is 0 to {})", most), c.words.column_of('P'));
    c.modal.set(ModalGroup::fixture, p == 0 ? 0 : code.code10);
    c.fixture_number = p;
    c.coordinates.fixture = {};
    if (p != 0) turn_fixture(c, c.machine);
    five_axis_changed(c);
    c.frame_changed();
}

}  // namespace trunnion
