// Conversions between internal units (mm, rad, s) and those of NC words, files and reports.
#pragma once

#include <numbers>

namespace trunnion::inline base {

constexpr double pi = std::numbers::pi;

constexpr double rad_from_deg(double angle_deg) {
    return angle_deg * (pi / 180.0);
}
constexpr double deg_from_rad(double angle_rad) {
    return angle_rad * (180.0 / pi);
}
constexpr double rad_from_arcsec(double angle_arcsec) {
    return angle_arcsec * (pi / 648000.0);
}
constexpr double urad_from_rad(double angle_rad) {
    return angle_rad * 1e6;
}
constexpr double mm_from_inch(double length_in) {
    return length_in * 25.4;
}
constexpr double inch_from_mm(double length_mm) {
    return length_mm / 25.4;
}
constexpr double mm_from_um(double length_um) {
    return length_um * 1e-3;
}
constexpr double um_from_mm(double length_mm) {
    return length_mm * 1e3;
}

}  // namespace trunnion::inline base
