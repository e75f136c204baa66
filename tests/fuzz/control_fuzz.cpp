// Any bytes: a whole control, with its probe signal, parameters and five axes, ends with a result;
// the checks end with findings that have a place.
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "check/check.h"
#include "controller/controller.h"
#include "fuzz/target.h"

namespace {

using namespace trunnion;

/// Reads every move half way, as a trace does, and lets each third skip come early.
class Looker : public motion::MotionSink {
  public:
    motion::MoveResult move(const motion::AxisMove& m) override {
        const AxisPositions middle = m.at(0.5);
        if (m.until_skip && ++skips_ % 3 == 0) return {true, middle};
        return {};
    }

  private:
    int skips_ = 0;
};

controller::ControlConfig config_of(std::uint8_t choice) {
    controller::ControlConfig config;
    config.dialect = choice & 1U ? interpreter::hurco_dialect() : interpreter::fanuc_dialect();
    if (choice & 2U)
        config.dialect = interpreter::fanuc_dialect(interpreter::ControlGeneration::fanuc_16i);
    for (const Axis axis : {Axis::X, Axis::Y, Axis::Z, Axis::B, Axis::C}) {
        controller::ControlAxis entry;
        entry.axis = axis;
        entry.rotary = is_rotary(axis);
        config.axes.push_back(entry);
    }
    config.max_blocks = 1500;
    return config;
}

offsets::Stores stores_of(std::uint8_t choice) {
    offsets::Stores stores;
    constexpr std::pair<int, double> table[] = {{19680, 12}, {19681, 4}, {19682, 2}, {19684, 1},
                                                {19686, 5},  {19687, 3}, {19689, 1}, {19697, 3}};
    for (const auto& [number, value] : table) stores.parameters.set(number, value);
    for (int number = 19700; number <= 19705; ++number)
        stores.parameters.set(number, number - 19702.5);
    stores.parameters.set_bit(5003, 0, choice & 4U);
    stores.parameters.set_bit(5003, 1, choice & 8U);
    stores.parameters.set_bit(19607, 2, choice & 16U);
    stores.parameters.set_bit(3401, 0, choice & 32U);
    stores.parameters.set(6050, 100.0);
    stores.tools.tool[1].radius_geometry_mm = 4.0;
    stores.tools.tool[1].length_geometry_mm = 90.0;
    return stores;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    const std::uint8_t choice = data[0];
    const std::string_view text(reinterpret_cast<const char*>(data) + 1, size - 1);
    offsets::Stores stores = stores_of(choice);
    interpreter::ProgramsInMemory none;
    Looker sink;
    controller::Controller control(config_of(choice), stores, none, sink, [](std::string_view) {});
    const controller::RunResult result =
        control.run(interpreter::ProgramText{"fuzz", text, nullptr});
    if (!result.alarm) ++fuzz::accepted;
    if (result.alarm && result.alarm->where.line < 1) std::abort();
    check::CheckOptions options;
    options.dialect = interpreter::fanuc_dialect();
    options.knows_g = [](int code10) { return code10 < 1000; };
    options.finds_program = [](int) { return false; };
    for (const check::Finding& finding : check::check_program({"fuzz", text, nullptr}, options))
        if (finding.line < 1 || finding.column < 1) std::abort();
    return 0;
}
