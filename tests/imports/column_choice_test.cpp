// Which column is the value where several could be.
#include <algorithm>

#include "tests/imports/import_bench.h"

using namespace trunnion;
using import_bench::Case;
using import_bench::imported;
using import_bench::read_rows;
using import_bench::refuses;

namespace {

constexpr auto iso = imports::ImportKind::iso230_2;

bool has(const std::vector<std::string>& list, const std::string& part) {
    return std::any_of(list.begin(), list.end(),
                       [&](auto& line) { return line.find(part) != std::string::npos; });
}

/// The deviation at the last target, and whether a note has `part`.
void takes(const Case& c, double value_mm, const std::string& part) {
    INFO(c.text << c.told.back());
    const setup::Setup setup = import_bench::setup();
    CHECK(*read_rows(setup, c).back().value_mm == Approx(value_mm));
    CHECK(has(imported(setup, c).notes, part));
}

}  // namespace

TEST_CASE("the very word for the value comes before other words for it", "[imports][choice]") {
    const std::string rows = "1,10,10.001,1,10.007,7\n2,20,20.002,2,20.008,8\n";
    const auto named = [&](const std::string& columns) {
        return Case{iso, rows, {"axis=X", "columns=" + columns}, ""};
    };
    takes(named("n,target [mm],resolver [mm],dr,value [mm],dv"), 0.008,
          "'value' taken as the value, not 'resolver'");
    takes(named("n,target [mm],diff [um],q,value [mm],p"), 0.008,
          "'value' taken as the value, not 'diff'");
    takes(named("n,target [mm],resolver [mm],deviation [um],value [mm],p"), 0.002,
          "'deviation' taken as the value, not 'resolver', 'value'");
    // The letter of "reverse" beside it is no pass.
    takes(named("n,target [mm],r [mm],dr,value [mm],dv"), 0.008,
          "'value' taken as the value, not 'r'");
    CHECK_FALSE(has(imported(import_bench::setup(), named("n,target [mm],q,p,value [mm],o")).notes,
                    "taken as the value"));
}

TEST_CASE("columns of one name are refused only if one of them is needed", "[imports][choice]") {
    const std::string rows = "1,10,10.001,1,10.007,7\n2,20,20.002,2,20.008,8\n";
    takes({iso,
           "n,target [mm],encoder [mm],diff [um],camera [mm],diff [um]\n" + rows,
           {"axis=X"},
           ""},
          0.002, "'encoder' taken as the value, not 'diff', 'diff'");
    refuses(import_bench::setup(),
            {iso, "n,target [mm],q [mm],diff [um],p [mm],diff [um]\n" + rows, {"axis=X"}, ""},
            "'diff' and 'diff' could both be the value", 1);
    refuses(import_bench::setup(),
            {iso, "n,target [mm],error [um],diff [um],target [mm],m\n" + rows, {"axis=X"}, ""},
            "'target' and 'target' hold the same", 1);
}
