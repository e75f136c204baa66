// G54.2, and rotary words that take the shorter way.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "table_bench.h"

namespace trunnion {

using bench::TableBench;
using bench::xyz;

TEST_CASE("G54.2: motion of both rotaries, cancel, change of set, with G43") {
    TableBench b;
    b.stores.fixture.set[0].offset[Axis::X] = 100;
    b.stores.fixture.set[1].offset[Axis::Y] = 50;
    b.stores.fixture.set[1].reference_angles[Axis::C] = 90;
    b.run("G90 G54 G0 X0 Y0 Z0 B0 C0;G54.2 P1");
    CHECK(b.control.frames.axes[Axis::X] == 0.0);  // the position shifts, nothing moves
    CHECK(b.variable(5001) == -100.0);
    b.run("G43 H1 X1. Y2. Z3. C90.");  // left-handed table: C90 carries +X to -Y
    CHECK((xyz(b.last().to) - Vector3(1, -98, 123.25)).norm() < 1e-12);
    b.run("B90.");  // the vector lies along Y: nothing changes; then C0 B90 carries it to +Z
    CHECK((xyz(b.last().to) - Vector3(1, -98, 123.25)).norm() < 1e-12);
    b.run("C0.");
    CHECK((xyz(b.last().to) - Vector3(1, 2, 223.25)).norm() < 1e-12);
    b.run("G54.2 P2;X0 Y0 Z0 B0 C0");  // set 2 measured at C90: at C0 it lies along -X
    CHECK((xyz(b.last().to) - Vector3(-50, 0, 120.25)).norm() < 1e-12);
    b.run("G54.2 P0;X0 Y0 Z0");
    CHECK((xyz(b.last().to) - Vector3(0, 0, 120.25)).norm() < 1e-12);
    CHECK(b.alarm("G54.2 P9") == 30);
    CHECK(b.alarm("G54.2") == 30);
    // Stores of the pivot do not matter to it.
    b.stores.parameters.set(19700, 77.0);
    b.control.parameters_changed();
    b.run("G54.2 P1;X0 Y0 Z0 B30. C40.");
    const Vector3 with_77 = xyz(b.last().to);
    b.stores.parameters.set(19700, 0.0);
    b.control.parameters_changed();
    b.run("X0 Y0 Z1.;Z0");
    CHECK(xyz(b.last().to) == with_77);
}

TEST_CASE("G54.2 says that it assumes a table, and only then") {
    const auto notes = [](const char* program, bool typed) {
        TableBench b;
        if (typed)
            for (const auto& [number, axis] : {std::pair(7580, 5), {7581, 1}, {7582, 2}})
                b.stores.parameters.set(number, axis);
        b.control.parameters_changed();
        b.run(program);
        return b.control.mover.record().notes.size();
    };
    CHECK(notes("G90 G54 G0 X0;G54.2 P1", false) == 1);
    CHECK(notes("G90 G54 G0 X0;G54.2 P1", true) == 0);
    CHECK(notes("G90 G54 G0 X0;G54.2 P0", false) == 0);
}

TEST_CASE("G54.2 as a shift: 7570#0 = 1 leaves the axes in a block that only turns") {
    TableBench b;
    b.stores.parameters.set(7570, 1);
    b.stores.fixture.set[0].offset[Axis::X] = 100;
    b.run("G90 G54 G0 X0 Y0 Z0;G54.2 P1;X0;C90.");
    CHECK((xyz(b.last().to) - Vector3(100, 0, 0)).norm() < 1e-12);
    b.run("X0 Y0");
    CHECK((xyz(b.last().to) - Vector3(0, -100, 0)).norm() < 1e-12);
}

TEST_CASE("roll-over axes take the shorter way, or the way of the sign") {
    TableBench b;
    b.stores.parameters.entry[1008].by_axis[5] = 1;
    b.control.parameters_changed();
    const auto c_deg = [&] { return deg_from_rad(b.control.frames.axes[Axis::C]); };
    b.run("G90 G54 G0 C350.;C10.");
    CHECK(c_deg() == Approx(10).margin(1e-9));
    b.run("C350.");
    CHECK(c_deg() == Approx(-10).margin(1e-9));
    b.run("G91 C400.;G90 B300.");
    CHECK(c_deg() == Approx(390).margin(1e-9));
    CHECK(deg_from_rad(b.control.frames.axes[Axis::B]) == Approx(300));
    b.stores.parameters.entry[1008].by_axis[5] = 3;
    b.control.parameters_changed();
    b.run("C-20.");
    CHECK(c_deg() == Approx(380).margin(1e-9));
    b.run("C10.");
    CHECK(c_deg() == Approx(730).margin(1e-9));
}

}  // namespace trunnion
