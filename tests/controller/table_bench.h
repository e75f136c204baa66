// A table-table machine's control on the bench: blocks typed as text, believed tip looked at.
#pragma once

#include <fmt/format.h>

#include <string>

#include "base/random.h"
#include "base/units.h"
#include "block_bench.h"
#include "positioning/rotary_transform.h"

namespace trunnion::bench {

inline Vector3 xyz(const AxisPositions& q) {
    return {q[Axis::X], q[Axis::Y], q[Axis::Z]};
}

/// BC or AC table, axes turning left-handed, true geometry as chosen here.
struct TableBench : Bench {
    explicit TableBench(Axis tilt_axis = Axis::B) : Bench(axes(tilt_axis)), tilt(tilt_axis) {
        offsets::Parameters& p = stores.parameters;
        p.set(19680, 12);
        p.set(19681, 4);
        p.set(19682, tilt == Axis::A ? 1 : 2);
        p.set(19684, 1);
        p.set(19686, 5);
        p.set(19687, 3);
        p.set(19689, 1);
        p.set(19697, 3);
        p.set(3401, 1);
        stores.tools.tool[1].length_geometry_mm = 120.0;
        stores.tools.tool[1].length_wear_mm = 0.25;
        control.parameters_changed();
    }
    static controller::ControlConfig axes(Axis tilt) {
        controller::ControlConfig config = bench::five_axes();
        config.axes[3].axis = tilt;
        return config;
    }
    void set_pivot(const Vector3& point, const Vector3& offset) {
        for (int i = 0; i < 3; ++i) {
            stores.parameters.set(19700 + i, point[i]);
            stores.parameters.set(19703 + i, offset[i]);
        }
        control.parameters_changed();
    }
    void set_g54(const Vector3& zero) {
        stores.work.standard[0][Axis::X] = zero.x();
        stores.work.standard[0][Axis::Y] = zero.y();
        stores.work.standard[0][Axis::Z] = zero.z();
        control.frames.take_work_offset(control.modal);
        control.mover.frames_changed();
    }
    const positioning::RotaryTransform& belief() const {
        return *control.frames.believed.transform;
    }
    Vector3 tip_W(const AxisPositions& q) const { return belief().tip_W(q, {0, 0, 120.25}); }
    void run(const std::string& text) { (*this)(text); }

    Axis tilt;
};

inline std::string words(const char* format, const Vector3& v) {
    return fmt::format(fmt::runtime(format), v.x(), v.y(), v.z());
}
constexpr const char* xyz_words = " X{:.15e} Y{:.15e} Z{:.15e}";

inline Vector3 random_vector(SeededNoise& noise, double size) {
    return Vector3(noise.uniform() - 0.5, noise.uniform() - 0.5, noise.uniform() - 0.5) * size;
}

}  // namespace trunnion::bench
