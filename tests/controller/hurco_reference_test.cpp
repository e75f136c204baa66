// Hurco programs with the machine positions that another hand worked out for each block.
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "controller/control.h"
#include "controller/controller.h"
#include "tests/support/table_parameters.h"

namespace trunnion {

namespace {

using nlohmann::json;

constexpr double tolerance = 0.002;  // mm, deg

/// Top face at z 0.137, a face at x 50.25 met by a ball of 6 mm, seen from G54.
class FacesToTouch : public motion::MotionSink {
  public:
    motion::MoveResult move(const motion::AxisMove& m) override {
        halfway[m.line] = m.at(0.5);
        if (!m.until_skip) return {};
        const double from_z = m.from[Axis::Z], to_z = m.to[Axis::Z];
        const double top = -380.0 + 0.137 + 200.0, side = 300.0 + 50.25 - 3.0;
        if (from_z > top && to_z < top) return stop(m, (from_z - top) / (from_z - to_z));
        const double from_x = m.from[Axis::X], to_x = m.to[Axis::X];
        if (to_z < top && from_x < side && to_x > side)
            return stop(m, (side - from_x) / (to_x - from_x));
        return {};
    }
    std::map<int, AxisPositions> halfway;

  private:
    static motion::MoveResult stop(const motion::AxisMove& m, double s) {
        return {true, m.at(s), s};
    }
};

controller::ControlConfig hurco_config(const json& setup, const std::string& name) {
    controller::ControlConfig config;
    config.dialect = interpreter::hurco_dialect();
    config.hurco.bnc = name.find("_bnc") != std::string::npos;
    config.work_positions_with_length = false;
    for (const Axis axis : {Axis::X, Axis::Y, Axis::Z, Axis::A, Axis::C}) {
        controller::ControlAxis entry;
        entry.axis = axis;
        entry.rotary = is_rotary(axis);
        if (axis == Axis::Z) entry.max = setup["Z_upper_limit"].get<double>();
        config.axes.push_back(entry);
    }
    return config;
}

offsets::Stores hurco_stores(const json& setup) {
    offsets::Stores stores;
    testing::set_two_table_axes(stores.parameters, 1);
    stores.parameters.set(19697, 3);
    stores.parameters.set(3401, 1);
    const auto &a = setup["A_centreline"], &c = setup["C_centreline_at_A0"];
    stores.parameters.set(19701, a["Y"]);
    stores.parameters.set(19702, a["Z"]);
    stores.parameters.set(19703, c["X"]);
    stores.parameters.set(19704, c["Y"].get<double>() - a["Y"].get<double>());
    for (const Axis axis : {Axis::X, Axis::Y, Axis::Z})
        stores.work.standard[0][axis] = setup["G54"][std::string(1, letter_of(axis))];
    for (const auto& [number, length] : setup["tool_lengths"].items())
        stores.tools.tool[static_cast<std::size_t>(std::stoi(number))].length_geometry_mm = length;
    return stores;
}

void check_axes(const json& wanted, const offsets::ControlPosition& is) {
    for (const auto& [letter, value] : wanted.items())
        CHECK(is[*axis_of(letter[0])] == Approx(value.get<double>()).margin(tolerance).epsilon(0));
}

void check_point(const json& wanted, const Vector3& is) {
    for (int i = 0; i < 3; ++i)
        CHECK(
            is[i] ==
            Approx(wanted[static_cast<std::size_t>(i)].get<double>()).margin(tolerance).epsilon(0));
}

struct BlockSeen {
    offsets::ControlPosition machine;
    Vector3 tip_part, tool_part;
    int line = 0;
};

/// After each block that has an N number.
std::map<int, BlockSeen> run_blocks(controller::Controller& control, const std::string& text) {
    std::map<int, BlockSeen> seen;
    control.watch([&](const controller::Control& c) {
        const positioning::RotaryTransform& t = *c.frames.believed.transform;
        const Vector3 origin = offsets::xyz_of(c.stores.work.standard[0]);
        seen[c.place.sequence_number()] = {c.frames.machine,
                                           t.tip_W(c.frames.axes, c.frames.tool.vector_mm) - origin,
                                           t.tool_direction_W(c.frames.axes), c.modal.block.line};
    });
    const auto owner = std::make_shared<const std::string>(text);
    const controller::RunResult result =
        control.run(interpreter::ProgramText{"reference", *owner, owner});
    if (result.alarm) FAIL_CHECK(result.alarm->text << " line " << result.alarm->where.line);
    return seen;
}

std::string text_of(const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

void check_blocks(const std::filesystem::path& program, bool with_linearisation) {
    INFO(program.string());
    std::filesystem::path path = program;
    const json wanted = json::parse(text_of(path.replace_extension(".json")));
    offsets::Stores stores = hurco_stores(wanted["setup"]);
    interpreter::ProgramsInMemory none;
    FacesToTouch sink;
    controller::Controller control(hurco_config(wanted["setup"], program.stem()), stores, none,
                                   sink, [](std::string_view) {});
    std::string text = text_of(program);
    if (const auto at = text.find(" G43.4"); !with_linearisation && at != std::string::npos)
        text.replace(at, 6, " G94  ");
    auto seen = run_blocks(control, text);
    for (const json& block : wanted["expect"]) {
        INFO("N" << block["n"] << " " << block["block"]);
        if (block.contains("value")) continue;  // a macro statement: looked at below
        REQUIRE(seen.contains(block["n"]));
        const BlockSeen& is = seen.at(block["n"]);
        if (block.contains("machine")) check_axes(block["machine"], is.machine);
        if (block.contains("tip_part")) check_point(block["tip_part"], is.tip_part);
        if (block.contains("tool_part")) check_point(block["tool_part"], is.tool_part);
        if (!block.contains("path")) continue;
        const char* const which = with_linearisation ? "half_way_with_G43.4" : "half_way_without";
        check_axes(block["path"][which]["machine"],
                   offsets::control_position_of(sink.halfway.at(is.line)));
    }
    for (const json& block : wanted["expect"])
        if (block.contains("value"))
            for (const auto& [name, value] : block["value"].items())
                if (name[0] == '#')
                    CHECK(control.variable(std::stoi(name.substr(1))) ==
                          Approx(value.get<double>()).margin(tolerance));
}

}  // namespace

TEST_CASE("Hurco programs go where another hand worked out", "[reference]") {
    const char* folder = std::getenv("TRUNNION_REFERENCE");
    if (!folder) {
        WARN("set TRUNNION_REFERENCE to the folder that holds hurco/");
        return;
    }
    int count = 0;
    for (const auto& entry :
         std::filesystem::directory_iterator(std::filesystem::path(folder) / "hurco")) {
        if (entry.path().extension() != ".nc") continue;
        ++count;
        check_blocks(entry.path(), true);
        if (entry.path().stem() == "h3_m128_angles") check_blocks(entry.path(), false);
    }
    CHECK(count > 0);
}

}  // namespace trunnion
