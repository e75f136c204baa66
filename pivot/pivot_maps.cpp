#include "pivot/pivot_maps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdlib>
#include <map>

#include "base/alarm.h"
#include "base/units.h"

namespace trunnion {

const std::vector<PivotFunction> pivot_functions{
    {"DPP", "G54", 8001}, {"RTDFO", "G54", 8002}, {"RTCP", "P1970x", 8003}, {"TW", "P1970x", 8004}};

namespace {

Vector3 location_shift_mm(const Machine& machine, Axis axis) {
    const auto& e = machine.errors.axis[index_of(axis)].location;
    return {e[0], e[1], e[2]};
}

/// Value behind `letter` in a printed line. DPRNT writes the sign first and blanks for leading zeros:
/// "B-  90.0000".
std::optional<double> printed_value(std::string_view line, char letter, std::size_t from) {
    const std::size_t at = line.find(letter, from);
    if (at == std::string_view::npos) return std::nullopt;
    std::string text(line.substr(at + 1));
    const bool negative = !text.empty() && text[0] == '-';
    if (negative) text[0] = ' ';
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    if (end == text.c_str()) return std::nullopt;
    return negative ? -value : value;
}

PivotMap& map_of(std::map<int, PivotMap>& maps, int number) {
    PivotMap& map = maps[number];
    if (map.number == 0) {
        map.number = number;
        for (const PivotFunction& f : pivot_functions)
            map.arcs.push_back({f.name, f.store, {}, 0.0, 0.0});
    }
    return map;
}

bool same_b(const PivotArc& arc) {
    return std::all_of(arc.points.begin(), arc.points.end(),
                       [&](const PivotPoint& p) { return p.b_deg == arc.points[0].b_deg; });
}

void name_map(PivotMap& map) {
    const auto arc = std::find_if(map.arcs.begin(), map.arcs.end(),
                                  [](const PivotArc& a) { return a.points.size() > 1; });
    if (arc == map.arcs.end()) return;
    map.moving = same_b(*arc) ? Axis::C : Axis::B;
    map.fixed = map.moving == Axis::C ? Axis::B : Axis::C;
    const PivotPoint& first = arc->points.front();
    map.fixed_deg = map.moving == Axis::C ? first.b_deg : first.c_deg;
    map.name =
        fmt::format("{} arc at {}{:g}", letter_of(map.moving), letter_of(map.fixed), map.fixed_deg);
}

}  // namespace

PivotStores pivot_stores(const Setup& setup) {
    const Chain& chain = setup.machine.chain;
    if (chain.work.size() != 2 || chain.work[0].axis != Axis::B || chain.work[1].axis != Axis::C)
        throw InputError(
            "the pivot programs are written for a table that B carries and C turns "
            "(chain \"w C B b ...\"); this machine is \"" +
                setup.chain_text + "\"",
            {setup.path});
    const AxisGeometry& b = chain.work[0];
    const AxisGeometry& c = chain.work[1];
    const auto& parameters = setup.stores.parameters;
    const auto vector_at = [&](int n) {
        return Vector3(parameters.get(n), parameters.get(n + 1), parameters.get(n + 2));
    };
    PivotStores s;
    for (const Axis axis : {Axis::X, Axis::Y, Axis::Z})
        s.g54[static_cast<Eigen::Index>(index_of(axis))] =
            setup.stores.work.standard[0][axis] + setup.stores.work.external[axis];
    s.p = vector_at(19700);
    s.d = vector_at(19703);
    s.p_true = b.point_mm + location_shift_mm(setup.machine, Axis::B);
    s.d_true = c.point_mm + location_shift_mm(setup.machine, Axis::C) - b.point_mm;
    return s;
}

Vector3 expected_error_mm(const PivotStores& s, bool g54, const Vector3& sphere_W_mm, double b_rad,
                          double c_rad) {
    const Matrix3 rb = rotation_about(Vector3::UnitY(), -b_rad);
    const Matrix3 rc = rotation_about(Vector3::UnitZ(), -c_rad);
    const auto moved = [&](const Vector3& p, const Vector3& d) -> Vector3 {
        return p + rb * (d + rc * (sphere_W_mm - p - d));
    };
    const Vector3 real = moved(s.p_true, s.d_true);
    return real - (g54 ? moved(s.g54, Vector3::Zero()) : moved(s.p, s.d));
}

double fit_arc_radius_mm(const std::vector<PivotPoint>& points, Axis moving) {
    // In the plane normal to the axis a turning error is z = c + v exp(i theta): two complex
    // unknowns.
    using Complex = std::complex<double>;
    const auto n = static_cast<double>(points.size());
    Complex sum_z, sum_w, sum_wz;
    for (const PivotPoint& p : points) {
        const bool c = moving == Axis::C;
        const Complex z =
            c ? Complex(p.error_mm.x(), p.error_mm.y()) : Complex(p.error_mm.z(), p.error_mm.x());
        const Complex w = std::polar(1.0, -rad_from_deg(c ? p.c_deg : p.b_deg));
        sum_z += z;
        sum_w += w;
        sum_wz += std::conj(w) * z;
    }
    const double determinant = n - std::norm(sum_w) / n;
    if (points.size() < 3 || determinant < 1e-9) return 0.0;
    return std::abs((sum_wz - std::conj(sum_w) * sum_z / n) / determinant);
}

std::vector<PivotMap> parse_pivot_prints(std::string_view printed) {
    std::map<int, PivotMap> maps;
    for (std::size_t at = 0; at < printed.size();) {
        const std::size_t end = std::min(printed.find('\n', at), printed.size());
        const std::string_view line = printed.substr(at, end - at);
        at = end + 1;
        const std::size_t mark = line.find("MAP");
        if (mark == std::string_view::npos) continue;
        const auto number = printed_value(line, 'P', mark);
        const auto b = printed_value(line, 'B', mark + 3), c = printed_value(line, 'C', mark + 3);
        const auto x = printed_value(line, 'X', mark), y = printed_value(line, 'Y', mark),
                   z = printed_value(line, 'Z', mark);
        if (!number || !b || !c || !x || !y || !z) continue;
        for (PivotArc& arc : map_of(maps, static_cast<int>(*number)).arcs)
            if (line.substr(0, mark).starts_with(arc.function + " "))
                arc.points.push_back({*b, *c, {*x, *y, *z}});
    }
    std::vector<PivotMap> result;
    for (auto& [number, map] : maps) {
        name_map(map);
        for (PivotArc& arc : map.arcs) arc.radius_mm = fit_arc_radius_mm(arc.points, map.moving);
        result.push_back(std::move(map));
    }
    return result;
}

}  // namespace trunnion
