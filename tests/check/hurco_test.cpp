// Programs of a Hurco: what is right there is no finding, what no Hurco has is one.
#include <catch2/catch.hpp>

#include "check/check.h"
#include "controller/alarms.h"
#include "controller/block_trial.h"
#include "controller/hurco_codes.h"
#include "tests/support/table_parameters.h"

using namespace trunnion;
using OneTrial = check::TrialBy<controller::BlockTrial>;

namespace {

std::vector<check::Finding> found(const std::string& text, bool bnc) {
    controller::ControlConfig config;
    config.dialect = interpreter::hurco_dialect();
    config.hurco.bnc = bnc;
    for (const Axis axis : {Axis::X, Axis::Y, Axis::Z, Axis::A, Axis::C}) {
        controller::ControlAxis entry;
        entry.axis = axis;
        entry.rotary = is_rotary(axis);
        config.axes.push_back(entry);
    }
    offsets::Stores stores;
    testing::set_two_table_axes(stores.parameters, 1);
    stores.parameters.set(19697, 3);
    stores.parameters.set(3401, 1);
    for (const std::size_t tool : {1U, 2U}) stores.tools.tool[tool].length_given = true;
    check::CheckOptions options;
    options.dialect = config.dialect;
    options.arc_centres_are_places = bnc;
    options.knows_g = [bnc](int code10) {
        return controller::find_hurco_g_code(code10 / 10.0, bnc) != nullptr;
    };
    options.start_trial = [&] { return std::make_unique<OneTrial>(config, stores); };
    return check::check_program({"t.hnc", text, nullptr}, options);
}

}  // namespace

TEST_CASE("five axes and the last line E of ISNC are no findings") {
    CHECK(found("%\nO1001\nG90 G17 G40 G80\nG21\nM31\nM126\nT2 M6\nS8000 M3\nG43 H2\nG54\nG0 "
                "M140\nG69\nM128\nG8.2 X20. Y0. Z5. A0. C0.\nG43.4\nG94 G1 A30. F800.\nI0. J-0.5 "
                "K0.866025\nM129\nG0 M140\nG68.2 X1. Y2. Z3. I1. J0. K0. U0. V1. W0.\nG69\nG4 "
                "P0.5\nM127\nM2\nE\n",
                false)
              .empty());
}

TEST_CASE("arc centres, inches and cycles of BNC are no findings") {
    CHECK(found("%\nO1002\nG90 G17 G40 G80\nG75\nG71\nT1 M6\nG43 H1\nG54\nG1 X10. Y5. F500.\nG2 "
                "X20. Y-5. I10. J-5.\nG0 Z15.\nG98 G83 X70. Y50. Z45. Z8. R13. F250.\nG80\nM2\nE\n",
                true)
              .empty());
}

TEST_CASE("codes that no Hurco has are one finding each") {
    const auto fanuc = found("O1\nG90G21G17\nG68.2X0Y0Z0\nG53.1\nG69\nM2\nE\n", false);
    REQUIRE(fanuc.size() == 1);
    CHECK(fanuc[0].rule == "unknown-code");
    CHECK(fanuc[0].line == 4);
    CHECK(found("O1\nG90G71G17\nM2\n", false).size() == 1);
    CHECK(found("O1\nG90G17\nM56\nM2\n", false).size() == 1);
}
