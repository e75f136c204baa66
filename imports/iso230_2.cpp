// ISO 230-2 table of a laser or autocollimator: targets, runs and directions of one axis.
#include "records/iso230_2.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "base/alarm.h"
#include "base/units.h"
#include "imports/iso_tables.h"
#include "imports/iso_test.h"
#include "imports/iso_values.h"
#include "imports/row_writer.h"
#include "imports/rtl.h"
#include "imports/told_direction.h"

namespace trunnion::imports {
namespace {

constexpr double overrun_mm = 1.0;  ///< before the first target of a run; a row without device
const double overrun_rad = rad_from_deg(1.0);

/// ISO 841: direction in which a + command moves (or turns) the tool relative to the workpiece.
Vector3 direction_M(const setup::Setup& setup, Axis axis) {
    const kinematics::Chain& chain = setup.machine.chain;
    const bool carries_work =
        std::any_of(chain.work.begin(), chain.work.end(), [&](auto& a) { return a.axis == axis; });
    return carries_work ? Vector3(-chain.find(axis)->direction) : chain.find(axis)->direction;
}

/// How far before the first target of a pass it is approached: nobody tells, so no further than the
/// next target, lest a distance that was not driven explains a decay.
double overrun_of(const std::vector<IsoPoint>& points, std::size_t first, const MovedAxis& moved) {
    const double usual = moved.rotary ? overrun_rad : overrun_mm;
    if (first + 1 == points.size()) return usual;
    const double step = std::abs(points[first + 1].target - points[first].target);
    return step > 0.0 ? std::min(usual, step) : usual;
}

void write_points(const std::vector<IsoPoint>& points, records::Reading row, const MovedAxis& moved,
                  RowWriter& rows) {
    const Axis axis = moved.axis;
    const records::Device device = row.device;
    for (std::size_t k = 0; k < points.size(); ++k) {
        const IsoPoint& p = points[k];
        const bool begins =
            k == 0 || points[k - 1].direction != p.direction || points[k - 1].run != p.run;
        row.time_s = p.time_s;
        if (begins) {
            records::Reading before = row;
            before.device = records::Device::none;
            before.angular = false;
            before.value_mm.reset();
            before.commanded[axis] = p.target - overrun_of(points, k, moved) * p.direction;
            before.time_s = k == 0 ? p.time_s - 1.0 : 0.5 * (points[k - 1].time_s + p.time_s);
            rows.add(std::move(before), 0);
        }
        row.device = device;
        row.commanded[axis] = p.target;
        row.value_mm = p.deviation;
        rows.add(row, p.line);
    }
}

int count_of(const std::vector<IsoPoint>& points, bool targets) {
    std::set<double> distinct;
    for (const IsoPoint& p : points) distinct.insert(targets ? p.target : double(p.run));
    return static_cast<int>(distinct.size());
}

/// R and A need two readings of each target; missing ones leave them open.
void note_repeats(const TextTable& table, const records::Iso230Figures& figures,
                  const MovedAxis& moved, Imported& result) {
    const auto& targets = figures.targets;
    const auto any = [&](auto is) { return std::any_of(targets.begin(), targets.end(), is); };
    if (!any([](const auto& t) { return t.n_up > 1 || t.n_down > 1; })) return;
    const bool up = any([](const auto&t) { return t.n_up > 0; }),
               down = any([](const auto&t) { return t.n_down > 0; });
    for (const records::TargetFigures& t : targets) {
        const bool few_up = up && t.n_up < 2, few_down = down && t.n_down < 2;
        if (!few_up && !few_down) continue;
        const double at = moved.rotary ? deg_from_rad(t.target) : t.target;
        const int count = few_up ? t.n_up : t.n_down;
        result.notes.push_back(
            fmt::format("{}: R and A (-) need two readings of each target: {} {} has {} towards {}",
                        table.path(), fmt::format("{:.6g}", at), moved.rotary ? "deg" : "mm",
                        count == 0 ? "none" : "one", few_up ? '+' : '-'));
        return;
    }
}

void tell(const TextTable& table, const std::vector<IsoPoint>& points, const MovedAxis& moved,
          bool angular, Imported& result) {
    const bool both = std::any_of(points.begin(), points.end(),
                                  [&](auto& p) { return p.direction != points[0].direction; });
    result.summary.push_back(fmt::format("{}: {}, {} runs {} at {} targets, {}; {}", table.path(),
                                         moved.name, count_of(points, false),
                                         both ? "both ways" : "one way", count_of(points, true),
                                         moved.rotary ? "deg" : "mm", table.dialect_words()));
    std::vector<records::DeviationPoint> list;
    for (const IsoPoint& p : points) list.push_back({p.target, p.direction, p.deviation});
    const records::Iso230Figures figures = records::iso230_2_figures(list);
    result.summary.push_back(records::iso230_2_words(figures, angular));
    note_repeats(table, figures, moved, result);
}

MovedAxis axis_of(const TextTable& table, const setup::Setup& setup, const std::string& told) {
    if (told.empty())
        throw InputError(
            "which axis was measured? --with axis=X, a line 'Axis: X' above the table, or a column",
            {table.path(), 1, 1});
    const auto axis = axis_named(setup, told);
    if (!axis) {
        std::string names;
        for (const kinematics::AxisGeometry& a : setup.machine.chain.axes())
            names += (names.empty() ? "" : ", ") + a.name;
        throw InputError(
            "the machine of " + setup.path + " has no axis '" + told + "'; it has " + names,
            {table.path(), 1, 1});
    }
    return {*axis, turns(setup, *axis), setup.machine.chain.names()[*axis]};
}

/// "X", "Y", "Z" of `--with along=` or `about=`: a unit vector of M.
Vector3 unit_vector(const std::string& key, const std::string& letter) {
    const std::size_t d = std::string_view("XYZ").find(letter);
    if (letter.size() != 1 || d == std::string_view::npos)
        throw InputError(key + ": '" + letter + "' is not X, Y or Z");
    return Vector3::Unit(static_cast<Eigen::Index>(d));
}

WhatWasRead what_was_read(const setup::Setup& setup, const MovedAxis& moved, const Facts& facts) {
    for (const char* key : {"along", "about"})
        if (facts.has(key))
            return {key == std::string("about"), unit_vector(key, facts.text(key)),
                    moved.name + '_' + key + '_' + facts.text(key)};
    return {moved.rotary, direction_M(setup, moved.axis), moved.name};
}

IsoQuantities quantities_of(const setup::Setup& setup, const Facts& facts) {
    const auto axis = axis_named(setup, facts.text("axis"));
    const Quantity target = axis && turns(setup, *axis) ? Quantity::angle : Quantity::length;
    if (facts.has("about")) return {target, Quantity::angle};
    return {target, facts.has("along") ? Quantity::length : target};
}

class IsoImport {
  public:
    explicit IsoImport(const ImportRequest& request)
        : request_(request), rows_(request.setup, "iso230-2", {}, true, true) {}

    void take(const TextTable& table) {
        const Facts facts = request_.facts.with_head_of(table, result.notes);
        const setup::Setup& setup = request_.setup;
        const IsoQuantities quantities = quantities_of(setup, facts);
        for (IsoSeries& series : read_iso_points(table, facts, quantities, result)) {
            refuse_other_axis(table, facts, series.axis);
            const MovedAxis axis =
                axis_of(table, setup, series.axis.empty() ? facts.text("axis") : series.axis);
            const int run = run_of_heading(table, series);
            add_test(tests_,
                     {&table, facts, quantities, axis, what_was_read(setup, axis, facts),
                      std::move(series), run},
                     result.notes);
        }
    }

    void write() {
        for (auto test = tests_.begin(); test != tests_.end(); ++test) {
            take_deviations(*test->table, test->facts, test->quantities, test->series.points,
                            result.notes);
            const auto earlier =
                std::find_if(tests_.begin(), test, [&](auto& e) { return repeats(e, *test); });
            if (earlier == test)
                write(*test);
            else
                result.notes.push_back(fmt::format(
                    "{}: the table of line {} repeats the readings of line {}: passed over",
                    test->table->path(), test->table->header_line().number,
                    earlier->table->header_line().number));
        }
        result.readings = rows_.take();
    }

    Imported result;

  private:
    /// A column of axes, and --with axis= of another one.
    void refuse_other_axis(const TextTable& table, const Facts& facts,
                           const std::string& name) const {
        const setup::Setup& setup = request_.setup;
        if (name.empty() || !facts.is_told("axis")) return;
        if (axis_named(setup, name) != axis_named(setup, facts.text("axis")))
            table.header_line().fail("the column of axes has '" + name + "', --with axis=" +
                                         facts.text("axis") + ": omit --with axis=",
                                     1);
    }

    void write(const IsoTest& test) {
        const std::vector<IsoPoint>& points = test.series.points;
        rows_.begin_file(*test.table, test.facts);
        if (!test.series.timed && !test.facts.has("step_s")) rows_.invent_times();
        if (test.series.dated) rows_.name_days();
        write_points(points, row_of(test.what, test.facts), test.axis, rows_);
        tell(*test.table, points, test.axis, test.what.angular, result);
    }

    records::Reading row_of(const WhatWasRead& what, const Facts& facts) {
        const setup::Setup& setup = request_.setup;
        records::Reading row;
        row.test = facts.text("test", what.test);
        const int again = ++names_[row.test];
        if (again > 1) row.test += '_' + std::to_string(again);
        row.device = what.angular ? records::Device::angle : records::Device::linear;
        row.angular = what.angular;
        row.feature =
            artefact_for(setup, facts.text("feature"), setup::Artefact::Kind::target).name;
        row.direction_M = what.direction_M;
        row.commanded = positions_told(setup, facts.text("at"));
        return row;
    }

    const ImportRequest& request_;
    RowWriter rows_;
    std::vector<IsoTest> tests_;
    std::map<std::string, int> names_;  ///< tests of each name
};

}  // namespace

Imported import_iso230_2(const ImportRequest& request) {
    std::vector<std::string> notes;
    std::vector<ImportFile> files(request.files.begin(), request.files.end());
    for (ImportFile& file : files)
        if (is_rtl(file.text)) file.text = table_of_rtl(file, request.facts, notes);
    const ImportRequest plain{request.setup, files, request.facts, request.map};
    const std::string sense = request.facts.text("sense");
    if (!sense.empty() && direction_in(sense).value_or(0) == 0)
        throw InputError("--with: sense is forward or backward, + or - here, not '" + sense + "'");
    IsoImport import(plain);
    import.result.notes = std::move(notes);
    const std::vector<TextTable> tables = tables_of(plain, import.result.notes);
    for (const TextTable* table : tables_with_readings(tables, import.result.notes))
        import.take(*table);
    import.write();
    return std::move(import.result);
}

}  // namespace trunnion::imports
