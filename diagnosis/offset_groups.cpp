// The zero of each test: scatter of zeros is noise, a single large zero is part of the gap.
#include <cmath>
#include <map>

#include "diagnosis/candidate_groups.h"
#include "diagnosis/rules.h"
#include "diagnosis/usual_zero.h"

namespace trunnion::diagnosis {
namespace {

constexpr Eigen::Index most_tests = 60;

bool probes(const emulator::Contact& contact) {
    return contact.device == records::Device::sphere || contact.device == records::Device::touch;
}

/// Index of each device row's test among those accepted by `takes`, -1 for other rows.
std::vector<Eigen::Index> tests_of(const Prepared& p,
                                   const std::function<bool(const emulator::Contact&)>& takes,
                                   Eigen::Index& count) {
    std::map<std::string, Eigen::Index> met;
    std::vector<Eigen::Index> test(p.replay.size(), -1);
    for (std::size_t i = 0; i < p.replay.size(); ++i)
        if (takes(p.replay.contact(i)))
            test[i] = met.try_emplace(p.table.rows[p.replay.table_row(i)].test,
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

}  // namespace

void add_offset_groups(Design& design, const Prepared& prepared, const Whitener& whitener) {
    const emulator::Replay& replay = prepared.replay;
    const auto rows = static_cast<Eigen::Index>(replay.size());
    Eigen::Index count = 0;
    const auto probe = tests_of(prepared, probes, count);
    if (count > 1 && count <= most_tests) {
        Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(rows, 3 * count);
        for (Eigen::Index i = 0; i < rows; ++i) {
            const auto k = static_cast<std::size_t>(i);
            if (probe[k] >= 0)
                columns.block<1, 3>(i, 3 * probe[k]) =
                    usual_zero_mm * prepared.base.gradient[k].work_shift_mm.transpose();
        }
        add_group(design, whitener, group_named("zero of a test", single_tests),
                  std::move(columns));
    }
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
}

}  // namespace trunnion::diagnosis
