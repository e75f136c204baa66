#include "diagnosis/stores/programmed_points.h"

#include <fmt/format.h>

#include "setup/programmed_point.h"

namespace trunnion::diagnosis {
namespace {

using effects::EffectKind;

bool of_probe(const records::Reading& row) {
    return row.device == records::Device::sphere || row.device == records::Device::touch;
}
std::vector<setup::StoreNumber> numbers_of(const setup::Setup& setup) {
    std::vector<setup::StoreNumber> list;
    if (const auto stores = setup::ProgrammedPoint(setup).stores())
        list = setup::store_numbers(*stores);
    const int tool = setup::probe_offset(*setup.probe);
    const double length_mm = setup.stores.tools.tool[static_cast<std::size_t>(tool)].length_mm();
    if (length_mm > 0.0) list.push_back({fmt::format("H{}", tool), 0, tool, tool_place, length_mm});
    return list;
}

/// The tips that the stores of a setup mean at the positions of the rows, one below the other, mm
/// in W.
Eigen::VectorXd meant_mm(const setup::Setup& setup, const records::ReadingTable& table,
                         const PointRows& rows) {
    const setup::ProgrammedPoint point(setup);
    Eigen::VectorXd tips(static_cast<Eigen::Index>(3 * rows.row.size()));
    for (std::size_t k = 0; k < rows.row.size(); ++k) {
        const records::Reading& row = table.rows[rows.row[k]];
        tips.segment<3>(static_cast<Eigen::Index>(3 * k)) =
            point.at(row.mode, row.commanded, row.extension_mm).value_or(*row.point_W_mm);
    }
    return tips;
}

double repeats_of(const records::ReadingTable& table, const PointRows& rows) {
    std::size_t places = 1;
    for (std::size_t k = 1; k < rows.row.size(); ++k) {
        const records::Reading &a = table.rows[rows.row[k - 1]], &b = table.rows[rows.row[k]];
        places += a.commanded.value != b.commanded.value || a.point_W_mm != b.point_W_mm;
    }
    return static_cast<double>(rows.row.size()) / static_cast<double>(places);
}

}  // namespace

PointRows point_rows(const records::ReadingTable& table) {
    PointRows rows;
    for (std::size_t r = 0; r < table.rows.size(); ++r) {
        const records::Reading& row = table.rows[r];
        if (row.device == records::Device::none) continue;
        if (of_probe(row) && row.point_W_mm && row.mode != PositioningMode::none) {
            rows.row.push_back(r);
            rows.device.push_back(rows.devices);
        }
        ++rows.devices;
    }
    return rows;
}

EffectKind kind_of(const setup::StoreNumber& number) {
    if (number.place == tool_place) return EffectKind::tool_length;
    return number.place == 0 ? EffectKind::pivot_g54 : EffectKind::pivot_p1970x;
}

void add_to(setup::Setup& setup, const setup::StoreNumber& number, double change_mm) {
    offsets::Stores& stores = setup.stores;
    if (number.place == tool_place)
        stores.tools.tool[static_cast<std::size_t>(number.component)].length_geometry_mm +=
            change_mm;
    else if (number.place == 0)
        stores.work.standard[0].value[static_cast<std::size_t>(number.component)] += change_mm;
    else
        stores.parameters.set(number.parameter, number.value_mm + change_mm);
}

const char* parameter_of(const setup::StoreNumber& number) {
    static constexpr const char* names[] = {"error_mm", "dg_mm", "dp_mm",
                                            "dd_mm",    "dt_mm", "ds_mm"};
    return names[number.place + 1];
}

PointEquations point_equations(const setup::Setup& setup, const records::ReadingTable& table,
                               const PointRows& rows) {
    PointEquations e;
    const Eigen::VectorXd declared = meant_mm(setup, table, rows);
    e.difference = -declared;
    for (std::size_t k = 0; k < rows.row.size(); ++k)
        e.difference.segment<3>(static_cast<Eigen::Index>(3 * k)) +=
            *table.rows[rows.row[k]].point_W_mm;
    e.columns.resize(declared.size(), 0);
    for (const setup::StoreNumber& number : numbers_of(setup)) {
        setup::Setup changed = setup;
        add_to(changed, number, 1.0);
        const Eigen::VectorXd column = meant_mm(changed, table, rows) - declared;
        if (column.cwiseAbs().maxCoeff() < 1e-6) continue;
        e.numbers.push_back(number);
        e.columns.conservativeResize(Eigen::NoChange, e.columns.cols() + 1);
        e.columns.rightCols(1) = column;
    }
    e.gram = e.columns.transpose() * e.columns;
    e.product = e.columns.transpose() * e.difference;
    e.square = e.difference.squaredNorm();
    e.repeats = repeats_of(table, rows);
    return e;
}

std::vector<double> readings_um(const setup::Setup& setup, const records::ReadingTable& table,
                                const PointRows& rows, const Eigen::VectorXd& points_mm) {
    std::vector<double> list(rows.devices, 0.0);
    for (std::size_t k = 0; k < rows.row.size(); ++k) {
        const records::Reading& row = table.rows[rows.row[k]];
        const Matrix3 turned = setup.machine.poses(row.commanded).pose_MW.rotation;
        list[rows.device[k]] =
            1e3 *
            row.direction_M.dot(turned * points_mm.segment<3>(static_cast<Eigen::Index>(3 * k)));
    }
    return list;
}

}  // namespace trunnion::diagnosis
