// The zero of each test, or of each cycle within one: scatter of zeros is noise, a single large
// zero is part of the gap.
#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "base/units.h"
#include "diagnosis/groups/candidate_groups.h"
#include "diagnosis/prepare/spoiled_readings.h"
#include "diagnosis/prepare/usual_zero.h"
#include "diagnosis/rules/rules.h"

namespace trunnion::diagnosis {
namespace {

constexpr Eigen::Index most_tests = 60;

bool probes(const emulator::Contact& contact) {
    return contact.device == records::Device::sphere || contact.device == records::Device::touch;
}

/// Index of each device row's test among those accepted by `takes`, -1 for other rows. A test of
/// the same name in another session is zeroed anew.
std::vector<Eigen::Index> tests_of(const Prepared& p,
                                   const std::function<bool(const emulator::Contact&)>& takes,
                                   Eigen::Index& count) {
    std::map<std::pair<std::size_t, std::string>, Eigen::Index> met;
    std::vector<Eigen::Index> test(p.replay.size(), -1);
    for (std::size_t i = 0; i < p.replay.size(); ++i)
        if (takes(p.replay.contact(i)))
            test[i] =
                met.try_emplace({p.replay.session(i), p.table.rows[p.replay.table_row(i)].test},
                                static_cast<Eigen::Index>(met.size()))
                    .first->second;
    count = static_cast<Eigen::Index>(met.size());
    return test;
}

ColumnGroup group_named(const std::string& name, const std::string& text) {
    ColumnGroup group;
    group.kind = GroupKind::offset;
    group.name = name;
    group.component = "reading";
    group.text = text;
    return group;
}

void add_group(Design& design, const Whitener& whitener, ColumnGroup group,
               Eigen::MatrixXd columns) {
    whitener.apply(columns);
    const Eigen::Index first = design.add_features(columns);
    for (Eigen::Index k = 0; k < columns.cols(); ++k) group.features.push_back(first + k);
    design.add(std::move(group));
}

constexpr const char* single_tests = "is an offset of single tests";
constexpr const char* single_cycles = "is an offset of single cycles";

/// The zero of each cycle within a test: an interferometer drifts, a reference mark slips.
void add_cycle_group(Design& design, const Prepared& p, const Whitener& whitener,
                     Eigen::Index tests) {
    const std::vector<Eigen::Index>& cycle = p.cycle;
    if (cycle.empty()) return;
    const Eigen::Index count = cycle.back() + 1;
    if (count <= std::max<Eigen::Index>(1, tests) || count > most_tests) return;
    Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(cycle.size()), count);
    for (std::size_t i = 0; i < cycle.size(); ++i)
        columns(static_cast<Eigen::Index>(i), cycle[i]) = usual_zero_mm;
    ColumnGroup group = group_named("zero of a cycle", single_cycles);
    group.of_cycles = true;
    add_group(design, whitener, std::move(group), std::move(columns));
}

/// What a zero of the probe may be set wrong in: the place of the work on the table, which turns
/// with it, or the machine's own position.
void add_probe_zeros(Design& design, const Prepared& p, const Whitener& whitener,
                     const std::vector<Eigen::Index>& test, Eigen::Index count) {
    const auto rows = static_cast<Eigen::Index>(test.size());
    Eigen::MatrixXd of_work = Eigen::MatrixXd::Zero(rows, 3 * count), of_machine = of_work;
    for (Eigen::Index i = 0; i < rows; ++i) {
        const auto k = static_cast<std::size_t>(i);
        if (test[k] < 0) continue;
        of_work.block<1, 3>(i, 3 * test[k]) =
            usual_zero_mm * p.base.gradient[k].work_shift_mm.transpose();
        of_machine.block<1, 3>(i, 3 * test[k]) =
            usual_zero_mm * p.replay.contact(k).direction_M.transpose();
    }
    add_group(design, whitener, group_named("zero of a test", single_tests), std::move(of_work));
    // Between two tests the machine may have jumped as well; of more, zeros scatter.
    if (count < 3) return;
    ColumnGroup machine = group_named("zero of a test in the machine frame", single_tests);
    machine.component = "machine frame";
    add_group(design, whitener, std::move(machine), std::move(of_machine));
}

}  // namespace

void add_offset_groups(Design& design, const Prepared& prepared, const Whitener& whitener) {
    const emulator::Replay& replay = prepared.replay;
    const auto rows = static_cast<Eigen::Index>(replay.size());
    Eigen::Index count = 0;
    const auto probe = tests_of(prepared, probes, count);
    if (count > 1 && count <= most_tests) add_probe_zeros(design, prepared, whitener, probe, count);
    const auto other = tests_of(
        prepared, [](const emulator::Contact& c) { return !probes(c); }, count);
    if (count > 1 && count <= most_tests) {
        Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(rows, count);
        for (Eigen::Index i = 0; i < rows; ++i)
            if (other[static_cast<std::size_t>(i)] >= 0)
                columns(i, other[static_cast<std::size_t>(i)]) = usual_zero_mm;
        add_group(design, whitener, group_named("zero of a pass", single_tests),
                  std::move(columns));
    }
    add_cycle_group(design, prepared, whitener, count);
}

void add_spoiled_visits(Design& design, const Prepared& prepared, const std::vector<bool>& used) {
    constexpr std::size_t most_visits = 60;  // of more, one does not decide what is claimed
    if (prepared.blocks.size() > most_visits) return;
    for (const NoiseBlock& block : prepared.blocks) {
        if (!is_single(block.device)) continue;
        std::vector<Eigen::Index> rows;
        for (const Eigen::Index row : block.rows)
            if (used[static_cast<std::size_t>(row)]) rows.push_back(row);
        if (rows.empty()) continue;
        Eigen::MatrixXd columns =
            Eigen::MatrixXd::Zero(design.data().size(), static_cast<Eigen::Index>(rows.size()));
        for (std::size_t k = 0; k < rows.size(); ++k)
            columns(rows[k], static_cast<Eigen::Index>(k)) = 1.0;
        ColumnGroup group;
        group.kind = GroupKind::spoiled;
        group.name = spoiled_visit;
        group.log_prior = std::log(rules::spoiled_part);
        const Eigen::Index first = design.add_features(columns);
        for (Eigen::Index k = 0; k < columns.cols(); ++k) group.features.push_back(first + k);
        design.keep_as_rival(design.add(std::move(group)));
    }
}

}  // namespace trunnion::diagnosis
