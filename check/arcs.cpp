// Arcs whose end is not on their circle, and arcs outside their plane, as far as the text shows it.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "check/section.h"

namespace trunnion::check {

namespace {

constexpr std::array<char, 3> axis_letters{'X', 'Y', 'Z'};
constexpr std::array<char, 3> centre_letters{'I', 'J', 'K'};

/// First and second axis of each plane: 0 = X, 1 = Y, 2 = Z.
struct Plane {
    std::size_t first, second;
};
constexpr Plane plane_xy{0, 1}, plane_zx{2, 0}, plane_yz{1, 2};

/// Code times ten. G40, G43, G49, G61, G64, G80, G94 do not change position or plane.
constexpr std::array harmless{400, 430, 490, 610, 640, 800, 940};
/// Canned cycles cancel the motion mode.
constexpr std::array cycles{730, 740, 760, 810, 820, 830, 840, 850, 860, 870, 880, 890};

/// Known positions and modes at a block; unknown after computed words or jumps.
class ArcCheck {
  public:
    ArcCheck(const CheckSection& section, const CheckOptions& options, Findings& findings)
        : section_(section), program_(*section.program), options_(options), findings_(findings) {}

    void run() {
        for (const interpreter::Block* block : section_.blocks) step(*block);
    }

  private:
    void step(const interpreter::Block& block) {
        if (block.sequence_number >= 0 &&
            (section_.computed_jump || section_.targets.contains(block.sequence_number)))
            forget();
        bool other = false;
        for (const interpreter::Item& item : program_.items(block)) {
            if (item.kind == interpreter::ItemKind::assign) continue;
            if (item.kind != interpreter::ItemKind::word) {
                other = true;
                continue;
            }
            if (item.letter == 'G') take_code(item, other);
            if (item.letter == 'M') take_m(item, other);
        }
        if (other) {
            forget_position();
            return;
        }
        if (arc_ == 2 || arc_ == 3) check(block);
        move(block);
    }

    void take_code(const interpreter::Item& item, bool& other) {
        const auto value = interpreter::constant_value(program_, item);
        if (!value) {
            forget();
            other = true;
            return;
        }
        const int code = code10_of(*value);
        if (code == 0 || code == 10 || code == 20 || code == 30) {
            arc_ = code / 10;
        } else if (code == 170 || code == 180 || code == 190) {
            set_plane(code == 170 ? plane_xy : code == 180 ? plane_zx : plane_yz);
        } else if (code == 900 || code == 910) {
            absolute_ = code == 900;
        } else if (code == 200 || code == 210) {
            const double unit_mm = code == 200 ? 25.4 : 1.0;
            if (unit_mm != unit_mm_) forget_position();
            unit_mm_ = unit_mm;
        } else if (std::find(harmless.begin(), harmless.end(), code) == harmless.end()) {
            if (std::find(cycles.begin(), cycles.end(), code) != cycles.end()) arc_ = -1;
            other = true;  // cycles, work offsets, rotation, polar words, reference moves, ...
        }
    }

    /// Calls may move axes and change modes; spindle and coolant codes do not.
    void take_m(const interpreter::Item& item, bool& other) {
        const auto value = interpreter::constant_value(program_, item);
        if (!value || code10_of(*value) >= 900 || code10_of(*value) == 60) other = true;
    }

    void set_plane(Plane plane) {
        plane_ = plane;
        plane_named_ = true;
    }

    void check(const interpreter::Block& block) {
        const bool words = has_word(block, "XYZIJKR");
        if (!words) return;
        if (!plane_named_ && !section_.subprogram && !plane_told_) {
            plane_told_ = true;
            findings_.add("arc-plane", Severity::warning, {block, 1},
                          "an arc, and no G17, G18 or G19 before it: the plane is what was left on",
                          "Write the plane at the start of the program.");
        }
        const auto start_1 = position_[plane_.first], start_2 = position_[plane_.second];
        if (!absolute_ || (*absolute_ && (!start_1 || !start_2))) return;
        double end_1 = 0.0, end_2 = 0.0;
        if (!delta(block, plane_.first, end_1) || !delta(block, plane_.second, end_2)) return;
        if (has_word(block, "R"))
            check_radius(block, std::hypot(end_1, end_2));
        else
            check_centre(block, end_1, end_2);
    }

    /// Distance from the start along one axis of the plane; false when it is unknown.
    bool delta(const interpreter::Block& block, std::size_t axis, double& way) const {
        if (!has_word(block, std::string_view(&axis_letters[axis], 1))) return true;
        const auto value = length(block, axis_letters[axis]);
        if (!value) return false;
        way = *absolute_ ? *value - *position_[axis] : *value;
        return true;
    }

    void check_radius(const interpreter::Block& block, double chord) {
        const auto radius = length(block, 'R');
        if (!radius || !options_.chord_exceeds ||
            !options_.chord_exceeds(chord * unit_mm_, *radius * unit_mm_))
            return;
        findings_.add(
            "arc-radius", Severity::error, {block, 1},
            fmt::format("the arc's ends are {:.4f} apart, more than twice R{:g}", chord, *radius),
            "Correct the end point or the radius.");
    }

    void check_centre(const interpreter::Block& block, double end_1, double end_2) {
        double centre[2] = {0.0, 0.0};
        const std::size_t axes[2] = {plane_.first, plane_.second};
        bool any = false;
        for (int k = 0; k < 2; ++k) {
            if (!has_word(block, std::string_view(&centre_letters[axes[k]], 1))) continue;
            const auto value = length(block, centre_letters[axes[k]]);
            if (!value) return;
            centre[k] = *value;
            any = true;
        }
        if (!any) return;
        const double at_start = std::hypot(centre[0], centre[1]);
        const double at_end = std::hypot(end_1 - centre[0], end_2 - centre[1]);
        if (!options_.arc_fit) return;
        const ArcFit fit = options_.arc_fit(at_start * unit_mm_, at_end * unit_mm_);
        if (fit == ArcFit::good) return;
        findings_.add(
            "arc-radius", fit == ArcFit::refused ? Severity::error : Severity::warning, {block, 1},
            fmt::format("radius {:.4f} at the arc's start and {:.4f} at its end", at_start, at_end),
            "Correct the end point or the centre (I, J, K from the start).");
    }

    /// In the unit of words with a decimal point.
    std::optional<double> length(const interpreter::Block& block, char letter) const {
        for (const interpreter::Item& item : program_.items(block)) {
            if (item.kind != interpreter::ItemKind::word || item.letter != letter) continue;
            const auto value = interpreter::constant_value(program_, item);
            if (!value || options_.bare_is_unit || item.decimal_point) return value;
            return *value * (unit_mm_ == 1.0 ? 1e-3 : 1e-4);
        }
        return std::nullopt;
    }

    bool has_word(const interpreter::Block& block, std::string_view letters) const {
        for (const interpreter::Item& item : program_.items(block))
            if (item.kind == interpreter::ItemKind::word &&
                letters.find(item.letter) != std::string_view::npos)
                return true;
        return false;
    }

    void move(const interpreter::Block& block) {
        for (std::size_t k = 0; k < 3; ++k) {
            if (!has_word(block, std::string_view(&axis_letters[k], 1))) continue;
            const auto value = length(block, axis_letters[k]);
            if (!value || !absolute_ || (!*absolute_ && !position_[k]))
                position_[k].reset();
            else
                position_[k] = *absolute_ ? *value : *position_[k] + *value;
        }
    }

    void forget_position() { position_.fill(std::nullopt); }
    void forget() {
        forget_position();
        absolute_.reset();
        arc_ = -1;
    }

    const CheckSection& section_;
    const interpreter::ParsedProgram& program_;
    const CheckOptions& options_;
    Findings& findings_;
    std::array<std::optional<double>, 3> position_{};
    std::optional<bool> absolute_;
    Plane plane_ = plane_xy;
    bool plane_named_ = false, plane_told_ = false;
    double unit_mm_ = 1.0;
    int arc_ = -1;  ///< group 01: 0 1 2 3, -1 unknown
};

}  // namespace

void check_arcs(const CheckSection& section, const CheckOptions& options, Findings& findings) {
    if (options.arc_centres_are_places) return;
    ArcCheck(section, options, findings).run();
}

}  // namespace trunnion::check
